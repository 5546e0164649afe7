// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/simd/extrema.h"

#include "tests/support/rows.h"
#include "tests/support/targets.h"

#include <optional>

namespace keyline {
namespace {

using simd::Extremum;
using simd::HalfWidths;
using Shape = std::vector<int>;

Shape disk(double radius) {
    Shape shape;
    for (int d = 0; d <= radius; ++d) shape.push_back(static_cast<int>(std::sqrt(radius * radius - d * d)));
    return shape;
}

Shape diamond(int radius) {
    Shape shape;
    for (int d = 0; d <= radius; ++d) shape.push_back(radius - d);
    return shape;
}

Shape box(int x, int y) { return Shape(static_cast<std::size_t>(y) + 1, x); }

// Memory as the engine's scratch gives it, with something in it.
struct Workspace {
    template <class T>
    std::span<T> take(std::size_t n) {
        memory.emplace_back((n * sizeof(T) + 7) / 8, 0xABABABABABABABABULL);
        return {reinterpret_cast<T*>(memory.back().data()), n};
    }
    std::vector<std::vector<uint64_t>> memory;
};

struct Picture {
    Rect window;
    std::vector<float> pixels;
    View view(const Rect& r) const {
        const View whole{pixels.data(), window.width(), window, window};
        return {whole.at(r.x0, r.y0), window.width(), r, window};
    }
};

Picture awkward_picture(const Rect& window, unsigned seed) {
    return {window, test::awkward_row(static_cast<int>(window.area()), seed)};
}

Picture two_values(const Rect& window, float usual, float rare, unsigned seed) {
    Picture picture{window, std::vector<float>(static_cast<std::size_t>(window.area()), usual)};
    std::mt19937 random(seed);
    for (float& v : picture.pixels)
        if (random() % 40 == 0) v = rare;
    return picture;
}

// Whether b stands beyond a: signed zeros are ordered.
bool beyond(float a, float b, Extremum which) {
    if (a == 0 && b == 0)
        return which == Extremum::kMaximum ? std::signbit(a) && !std::signbit(b)
                                           : !std::signbit(a) && std::signbit(b);
    return which == Extremum::kMaximum ? b > a : b < a;
}

float reference(const Picture& picture, int x, int y, HalfWidths shape, Extremum which) {
    std::optional<float> best;
    const int reach = static_cast<int>(shape.size()) - 1;
    for (int dy = -reach; dy <= reach; ++dy) {
        const int w = shape[static_cast<std::size_t>(std::abs(dy))];
        for (int dx = -w; dx <= w; ++dx) {
            if (!picture.window.contains(x + dx, y + dy)) continue;
            const float v = *picture.view(picture.window).at(x + dx, y + dy);
            if (!std::isnan(v) && (!best || beyond(*best, v, which))) best = v;
        }
    }
    return best.value_or(0.0F);
}

std::vector<float> reference_tile(const Picture& picture, const Rect& tile, HalfWidths shape,
                                  Extremum which) {
    std::vector<float> out;
    for (int y = tile.y0; y < tile.y1; ++y)
        for (int x = tile.x0; x < tile.x1; ++x) out.push_back(reference(picture, x, y, shape, which));
    return out;
}

enum class Way { kShape, kBox, kMask, kFastest };

// The tile by the given kernel; empty where it refuses.
std::vector<float> compute(Way way, const Picture& picture, const Rect& tile, HalfWidths shape,
                           Extremum which) {
    const Halo halo{shape[0], static_cast<int>(shape.size()) - 1};
    const View in = picture.view(intersect(grow(tile, halo), picture.window));
    std::vector<float> pixels(static_cast<std::size_t>(tile.area()));
    const MutView out{pixels.data(), tile.width(), tile, picture.window};
    Workspace w;
    switch (way) {
        case Way::kShape:
            simd::shape_extremum(in, out, shape, which, w.take<int32_t>(simd::shape_workspace(tile, shape)));
            break;
        case Way::kBox:
            simd::box_extremum(in, out, shape, which, w.take<int32_t>(simd::box_workspace(tile, shape)));
            break;
        case Way::kMask:
            if (!simd::mask_extremum(in, out, shape, which,
                                     w.take<uint64_t>(simd::mask_workspace(in, tile, shape))))
                return {};
            break;
        case Way::kFastest: simd::extremum(in, out, shape, which, w); break;
    }
    return pixels;
}

void expect_formula(Way way, const Picture& picture, const Rect& tile, const Shape& shape) {
    for (const Extremum which : {Extremum::kMaximum, Extremum::kMinimum}) {
        const auto expected = reference_tile(picture, tile, shape, which);
        test::on_every_target(
            [&] { test::expect_same_bits(compute(way, picture, tile, shape, which), expected); });
    }
}

const Rect kWindow{-5, 3, 135, 40};
const Rect kTiles[] = {kWindow,        {-5, 3, 2, 4}, {20, 10, 84, 30}, {100, 30, 135, 40},
                       {0, 39, 1, 40}, {-1, 5, 65, 9}};
const Shape kShapes[] = {disk(0),    disk(1),     disk(1.5), disk(2.9), disk(20),   disk(70),
                         diamond(3), diamond(64), box(2, 2), box(0, 3), box(33, 1), box(70, 50)};

TEST(Extremum, OfAnyShapeIsTheFormulaOnEveryTarget) {
    const Picture picture = awkward_picture(kWindow, 1);
    for (const Shape& shape : {kShapes[1], kShapes[3], kShapes[4], kShapes[6], kShapes[10]})
        for (const Rect& tile : {kTiles[1], kTiles[2], kTiles[3], kTiles[4]})
            expect_formula(Way::kShape, picture, tile, shape);
}

TEST(Extremum, OfABoxIsTheFormulaOnEveryTarget) {
    const Picture picture = awkward_picture(kWindow, 2);
    for (const Shape& shape : {box(0, 0), box(1, 1), box(5, 0), box(0, 5), box(12, 7), box(33, 30)})
        for (const Rect& tile : {kTiles[1], kTiles[3], kTiles[4], kTiles[5]})
            expect_formula(Way::kBox, picture, tile, shape);
}

TEST(Extremum, OfAMaskIsTheFormulaOnEveryTarget) {
    const Picture lines = two_values(kWindow, 0, 1, 3), signs = two_values(kWindow, -0.0F, 0.0F, 4);
    const Picture holes = two_values(kWindow, test::kNan, -test::kInfinity, 5);
    for (const Picture* picture : {&lines, &signs, &holes})
        for (const Shape& shape : {kShapes[1], kShapes[4], kShapes[7]})
            for (const Rect& tile : {kTiles[1], kTiles[2], kTiles[3]})
                expect_formula(Way::kMask, *picture, tile, shape);
}

TEST(Extremum, IsTheFormulaForEveryShapeAndTile) {
    const Picture picture = awkward_picture({-5, 3, 95, 33}, 6), lines = two_values({-5, 3, 95, 33}, 0, 1, 7);
    for (const Shape& shape : kShapes) {
        expect_formula(Way::kFastest, picture, {60, 20, 75, 30}, shape);
        expect_formula(Way::kFastest, lines, {60, 20, 75, 30}, shape);
    }
}

TEST(Extremum, IsTheSameWhateverTheTile) {
    const Picture picture = awkward_picture(kWindow, 8);
    const auto whole = compute(Way::kFastest, picture, kWindow, disk(6), Extremum::kMaximum);
    for (const Rect& tile : kTiles) {
        const auto part = compute(Way::kFastest, picture, tile, disk(6), Extremum::kMaximum);
        for (int y = tile.y0; y < tile.y1; ++y)
            for (int x = tile.x0; x < tile.x1; ++x)
                ASSERT_EQ(std::bit_cast<uint32_t>(
                              part[static_cast<std::size_t>((y - tile.y0) * tile.width() + x - tile.x0)]),
                          std::bit_cast<uint32_t>(whole[static_cast<std::size_t>(
                              (y - kWindow.y0) * kWindow.width() + x - kWindow.x0)]));
    }
}

TEST(Extremum, AThirdValueIsNoMask) {
    Picture picture = two_values(kWindow, 0, 1, 9);
    picture.pixels.back() = 0.5F;
    EXPECT_TRUE(compute(Way::kMask, picture, kWindow, disk(2), Extremum::kMaximum).empty());
    EXPECT_FALSE(compute(Way::kMask, picture, kTiles[1], disk(2), Extremum::kMaximum).empty());
}

TEST(Extremum, WhereThereIsOnlyNanIsZeroAndMinusInfinityStays) {
    const Picture nothing{{0, 0, 3, 1}, {test::kNan, test::kNan, -test::kNan}};
    const Picture lowest{{0, 0, 3, 1}, {test::kNan, -test::kInfinity, test::kNan}};
    for (const Way way : {Way::kShape, Way::kBox}) {
        test::expect_same_bits(compute(way, nothing, nothing.window, box(1, 1), Extremum::kMaximum),
                               std::vector<float>(3, 0.0F));
        test::expect_same_bits(compute(way, lowest, lowest.window, box(1, 1), Extremum::kMaximum),
                               std::vector<float>(3, -test::kInfinity));
    }
}

}  // namespace
}  // namespace keyline
