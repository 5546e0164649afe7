// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/crossings.h"

#include "engine/base/index.h"
#include "engine/kit/blurred_shares.h"
#include "engine/kit/sparse_row.h"
#include "engine/simd/elementary.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <utility>

namespace keyline {

namespace {

constexpr double kAstray = 0.75;  // pixels between two places of one border that can be true
constexpr int kAside = 2;         // pixels from a border within which its sides are looked for
// Outputs: the label, then what there is of a crossing with each neighbour.
constexpr std::size_t kRight = 1, kDown = 10, kPlanes = 9;
constexpr std::size_t kAlong = 1;  // of those: above 0 where there is one

// Shares nearer to 0 and 1 than this are noise.
double probit_of(double share) { return elementary::probit(std::clamp(share, 1e-4, 1 - 1e-4)); }

// A pixel, as it is blurred.
struct Blurred {
    const BlurredRows::Row& row;
    std::size_t i;

    uint32_t label() const { return row.labels()[i]; }
    double share(uint32_t id) const { return row.share(i, id); }
};

double share_of(const Blurred& pixel, uint32_t a, uint32_t b) {
    const double of_a = pixel.share(a), of_b = pixel.share(b);
    return of_a / (of_a + of_b);
}

// Both sides of borders, from the depth beside them.
class Surfaces {
public:
    Surfaces(const SharedPixels& pixels, std::span<const View> depth, double pixel_angle)
        : pixels_(pixels), depth_(depth.empty() ? nullptr : depth.data()), angle_(pixel_angle) {}

    // Of the object `id` at the border that lies `distance` from the pixel's centre, in the direction
    // opposite to (dx, dy).
    Crossing::Side side(uint32_t id, int x, int y, int dx, int dy, double distance) const {
        Crossing::Side out{id, 0, 0, 1};
        if (!depth_ || id == 0) return out;
        for (int i = 0; i <= kAside; ++i) {
            const int u = x + i * dx, v = y + i * dy;
            if (!shows(id, u, v)) continue;
            const double here = near(u, v),
                         slope = shows(id, u + dx, v + dy) ? here - near(u + dx, v + dy) : 0;
            const double across = slope_between(id, u + dy, v + dx, u - dy, v - dx, here);
            out.near = static_cast<float>(std::clamp(here + slope * (i + distance), here / 2, here * 2));
            out.facing = here > 0 ? facing(slope / here, across / here) : 1.0F;
            return out;
        }
        out.near = static_cast<float>(near(x, y));
        return out;
    }

private:
    // Whether the object has a pixel for itself.
    bool shows(uint32_t id, int x, int y) const {
        return depth_->rect.contains(x, y) && pixels_.shows(id, x, y);
    }

    double near(int x, int y) const {
        if (!depth_->rect.contains(x, y)) return 0;
        const double z = double{*depth_->at(x, y)};
        return z > 0 && std::isfinite(z) ? 1 / z : 0;
    }

    double slope_between(uint32_t id, int x0, int y0, int x1, int y1, double here) const {
        const bool first = shows(id, x0, y0), second = shows(id, x1, y1);
        if (first && second) return (near(x0, y0) - near(x1, y1)) / 2;
        return first ? near(x0, y0) - here : second ? here - near(x1, y1) : 0;
    }

    // Of a surface whose 1 / depth changes by these shares of itself from pixel to pixel.
    float facing(double along, double across) const {
        const double tilt2 = (along * along + across * across) / (angle_ * angle_);
        return static_cast<float>(1 / std::sqrt(1 + tilt2));
    }

    const SharedPixels& pixels_;
    const View* depth_;
    double angle_;
};

void put(Outputs out, std::size_t first, const Crossing& c) {
    const auto& [p, q] = c.sides;
    const std::array values{std::bit_cast<float>(q.id),
                            c.along,
                            c.steepness,
                            p.along,
                            q.along,
                            p.near,
                            q.near,
                            p.facing,
                            q.facing};
    static_assert(values.size() == kPlanes);
    for (std::size_t i = 0; i < values.size(); ++i) *out[first + i].at(c.x, c.y) = values[i];
}

Crossing crossing_at(std::span<const View> outputs, std::size_t first, int x, int y) {
    const auto value = [&](std::size_t i) { return *outputs[first + i].at(x, y); };
    Crossing c{x, y, first == kDown, value(1), value(2), {}};
    c.sides[0] = {std::bit_cast<uint32_t>(*outputs[0].at(x, y)), value(3), value(5), value(7)};
    c.sides[1] = {std::bit_cast<uint32_t>(value(0)), value(4), value(6), value(8)};
    return c;
}

// Where a share is a half, of which p and q have so much.
double half_between(double p, double q) { return probit_of(p) / (probit_of(p) - probit_of(q)); }

// Where an object alone has half; `otherwise` where that is not at this crossing.
float half_of(uint32_t id, const Blurred& p, const Blurred& q, double otherwise) {
    const double along = half_between(p.share(id), q.share(id));
    return static_cast<float>(std::fabs(along - otherwise) < kAstray ? along : otherwise);
}

// Between two neighbours whose labels differ.
Crossing between(const Surfaces& surfaces, const Blurred& p, const Blurred& q, int x, int y, bool down) {
    Crossing out{x, y, down, 0, 0, {}};
    const uint32_t a = p.label(), b = q.label();
    const double from = share_of(p, a, b), to = share_of(q, a, b);
    const double along = std::clamp(half_between(from, to), 1e-4, 1 - 1e-4);
    const int dx = down ? 0 : 1, dy = down ? 1 : 0;
    out.along = static_cast<float>(along);
    out.steepness = static_cast<float>(probit_of(from) - probit_of(to));
    out.sides = {surfaces.side(a, x, y, -dx, -dy, along),
                 surfaces.side(b, x + dx, y + dy, dx, dy, 1 - along)};
    for (Crossing::Side& side : out.sides) side.along = half_of(side.id, p, q, along);
    return out;
}

// The first of the pixels from `i` up to `end` whose label may differ from its right or lower neighbour's.
std::size_t next_border(std::span<const uint32_t> labels, std::span<const uint32_t> below, std::size_t i,
                        std::size_t end) {
    constexpr std::size_t kAtOnce = 32;
    const auto differ = [&](std::size_t k) { return (labels[k] ^ labels[k + 1]) | (labels[k] ^ below[k]); };
    for (; i + kAtOnce < end; i += kAtOnce) {
        uint32_t any = 0;
        for (std::size_t k = i; k < i + kAtOnce; ++k) any |= differ(k);
        if (any != 0) break;
    }
    while (i + 1 < end && differ(i) == 0) ++i;
    return i;
}

}  // namespace

FindCrossings::FindCrossings(const Options& options)
    : options_(options),
      reach_(static_cast<int>(std::ceil(3 * options.sigma))),
      weights_(blur_weights(options.sigma, reach_)),
      sure_(sure_within(weights_)) {}

Halo FindCrossings::halo() const {
    const int reach = 1 + std::max(reach_, kAside + 1);
    return {reach, reach};
}

// Where there is none, only the outputs that say so are written.
void FindCrossings::compute(const Inputs& in, Outputs out, Scratch& scratch) const {
    const SharedPixels pixels(in.slot(0), options_.integers, reach_, sure_, scratch);
    const Surfaces surfaces(pixels, in.slot(1), options_.pixel_angle);
    BlurredRows rows(pixels, weights_);
    const Rect &rect = out[0].rect, &all = pixels.rect();
    const auto left = index(rect.x0 - all.x0), width = index(rect.width());
    BlurredRows::Row here(index(all.width())), below(index(all.width()));
    rows.fill(rect.y0, below);
    for (int y = rect.y0; y < rect.y1; ++y) {
        std::swap(here, below);
        const bool has_below = y + 1 < all.y1;
        if (has_below) rows.fill(y + 1, below);
        std::memcpy(out[0].row(y), &here.labels()[left], width * sizeof(float));
        for (const std::size_t plane : {kRight, kDown}) std::fill_n(out[plane + kAlong].row(y), width, 0.0F);
        if (!pixels.is_near_any(y)) continue;
        const std::span<const uint32_t> labels = here.labels(), next = has_below ? below.labels() : labels;
        const std::size_t last = index(all.width()) - 1;
        for (std::size_t i = left; i < left + width; ++i) {
            i = next_border(labels, next, i, left + width);
            const int x = all.x0 + static_cast<int>(i);
            if (i < last && labels[i] != labels[i + 1])
                put(out, kRight, between(surfaces, {here, i}, {here, i + 1}, x, y, false));
            if (labels[i] != next[i]) put(out, kDown, between(surfaces, {here, i}, {below, i}, x, y, true));
        }
    }
}

std::vector<Crossing> crossings_in(std::span<const View> outputs, const Rect& block) {
    std::vector<Crossing> out;
    for (int y = block.y0; y < block.y1; ++y)
        for (const std::size_t plane : {kRight, kDown})
            each_where(
                outputs[plane + kAlong].at(block.x0, y), block.width(),
                [](float along) { return along != 0; },
                [&](int i) { out.push_back(crossing_at(outputs, plane, block.x0 + i, y)); });
    return out;
}

}  // namespace keyline
