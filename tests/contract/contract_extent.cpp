// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/plan/planner.h"
#include "tests/contract/contract.h"
#include "tests/support/draw.h"

#include <cmath>
#include <exception>
#include <fmt/format.h>

namespace keyline::testing {

namespace {

constexpr unsigned kSeed = 4;
constexpr int kCases = 60;
constexpr Rect kDisplay{-3, 2, 37, 30};

// Inside the display window, across its border, outside it, empty, and now and then all of it.
Rect cut_window(Draw& draw) {
    if (draw.one_in(12)) return kDisplay;
    if (draw.one_in(12)) return {};
    return translate(draw.window(30, 24), draw.whole(0, 12), draw.whole(0, 12));
}

// Colour without an A counts as opaque inside its data window, so that what is cut is another picture.
void give_alpha(Image& image, Draw& draw) {
    if (!image.has("R") || image.has("A")) return;
    Image alpha = noise(image.window, {"A"}, static_cast<unsigned>(draw.whole(0, 1 << 20)));
    image.channels.push_back(alpha.channels.front());
}

// The same picture with a data window as far as it goes.
Image whole(const Image& cut) {
    Image out(unite(cut.window, cut.display), std::vector<std::string>{});
    out.display = cut.display;
    out.metadata = cut.metadata;
    for (const Image::Channel& c : cut.channels) {
        out.channels.push_back(
            {c.name, c.type, std::vector<float>(static_cast<std::size_t>(out.window.area()))});
        out.fill(c.name, [&](int x, int y) { return cut.at(c.name, x, y); });
    }
    return out;
}

// -0 and 0 are the same here: what is outside a data window has no sign.
std::string difference(const Image& cut, const Image& whole) {
    if (!(cut.display == whole.display)) return "the display windows differ";
    for (const Image::Channel& c : whole.channels) {
        if (!cut.has(c.name)) return "there is no channel " + c.name;
        for (int y = whole.display.y0; y < whole.display.y1; ++y)
            for (int x = whole.display.x0; x < whole.display.x1; ++x) {
                const float a = cut.at(c.name, x, y), b = whole.at(c.name, x, y);
                if (a == b || (std::isnan(a) && std::isnan(b))) continue;
                return fmt::format("{} at {},{} is {}, and {} of the whole", c.name, x, y, a, b);
            }
    }
    return "";
}

// What a picture is turned into; a node's datum instead is compared by contract_pixels.cpp, and is no
// picture.
Image rendered(const NodeCase& c) { return render(make_plan(c.resolve(), {2, 16, 0})).front(); }

std::string compare_windows(const NodeType& type, Draw& draw) {
    NodeCase cut;
    try {
        cut = draw_case(type, draw, cut_window);
        for (auto& [name, images] : cut.inputs)
            for (Image& image : images) {
                image.display = kDisplay;
                give_alpha(image, draw);
            }
        NodeCase uncut = cut;
        for (auto& [name, images] : uncut.inputs)
            for (Image& image : images) image = whole(image);
        const std::string found = difference(rendered(cut), rendered(uncut));
        return found.empty() ? "" : found + "\n" + cut.text();
    } catch (const std::exception& e) {
        return fmt::format("threw: {}\n{}", e.what(), cut.text());
    }
}

}  // namespace

Complaints check_extent(const NodeType& type) {
    if (!type.gives.empty()) return {};
    Draw draw(kSeed);
    for (int i = 0; i < kCases; ++i)
        if (std::string found = compare_windows(type, draw); !found.empty()) return {std::move(found)};
    return {};
}

}  // namespace keyline::testing
