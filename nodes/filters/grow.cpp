// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/node/node_adaptor.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace keyline {

namespace {

constexpr float kHalf = 0.5F;

struct Place {
    float x = 0, y = 0;
};

// NaN covers nothing.
float share(const View& in, int x, int y) {
    if (!in.rect.contains(x, y)) return 0;
    const float a = *in.at(x, y);
    return a > 0 ? std::min(a, 1.0F) : 0;
}

float distance(Place p, Place a, Place b) {
    const float dx = b.x - a.x, dy = b.y - a.y, square = dx * dx + dy * dy;
    const float along = square > 0 ? ((p.x - a.x) * dx + (p.y - a.y) * dy) / square : 0;
    const float t = std::clamp(along, 0.0F, 1.0F), ex = a.x + t * dx - p.x, ey = a.y + t * dy - p.y;
    return std::sqrt(ex * ex + ey * ey);
}

// The border of what is covered more than half, between the centres of four pixels: none, one or two pieces,
// seen from the first of the centres.
class Border {
public:
    Border(const View& in, int x, int y) {
        constexpr std::array<std::array<int, 2>, 4> kRound{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
        float sum = 0;
        for (std::size_t i = 0; i < 4; ++i) {
            shares_[i] = share(in, x + kRound[i][0], y + kRound[i][1]);
            sum += shares_[i];
        }
        for (std::size_t i = 0; i < 4; ++i) cross(i, kRound[i], kRound[(i + 1) % 4]);
        // Of two pieces, each goes round a corner that is other than the middle.
        if (count_ == 4 && (shares_[0] >= kHalf) == (sum >= 2))
            std::rotate(at_.begin(), at_.begin() + 1, at_.end());
    }

    std::size_t pieces() const { return count_ / 2; }
    Place begin(std::size_t piece) const { return at_[2 * piece]; }
    Place end(std::size_t piece) const { return at_[2 * piece + 1]; }

private:
    // Where the border crosses from one centre to the next: as far as both together are covered.
    void cross(std::size_t i, const std::array<int, 2>& from, const std::array<int, 2>& to) {
        const float a = shares_[i], b = shares_[(i + 1) % 4];
        if ((a >= kHalf) == (b >= kHalf)) return;
        const float t = a >= kHalf ? a + b - kHalf : 1.5F - a - b;
        at_[count_++] = {static_cast<float>(from[0]) + t * static_cast<float>(to[0] - from[0]),
                         static_cast<float>(from[1]) + t * static_cast<float>(to[1] - from[1])};
    }

    std::array<float, 4> shares_{};
    std::array<Place, 4> at_{};
    std::size_t count_ = 0;
};

// The border of a mask lies between the pixels that it covers more and less than half; a pixel is then
// covered by how far its centre is from the border moved by the radius.  What is nowhere covered half, such
// as a hair, is covered by radius + a − d at a distance d from a pixel that is covered by a.
struct Grow {
    static constexpr Info info{"grow", "Makes masks larger all round by a distance; their edges stay soft."};

    struct Params {
        Input in;
        double radius = 1;

        static constexpr auto fields =
            declare(input(&Params::in, "in", "Masks, 0 to 1; each channel by itself."),
                    field(&Params::radius, "radius", "How far; fractions of a pixel count.",
                          px(0, 100).tested_to(6)));
    };

    explicit Grow(const Params& p)
        : radius(static_cast<float>(p.radius)), reach(static_cast<int>(std::ceil(p.radius + 1.5))) {}

    Halo halo() const { return {reach, reach}; }
    double cost() const { return 20 + reach * reach; }

    void compute(const View& in, const MutView& out, Scratch& scratch) const {
        MutView nearest = out;
        nearest.data = scratch.floats(static_cast<std::size_t>(out.rect.area())).data();
        nearest.stride = out.rect.width();
        for (int y = out.rect.y0; y < out.rect.y1; ++y)
            for (int x = out.rect.x0; x < out.rect.x1; ++x) {
                *out.at(x, y) = share(in, x, y);
                *nearest.at(x, y) = std::numeric_limits<float>::infinity();
            }
        for (int y = in.rect.y0 - 1; y < in.rect.y1; ++y)
            for (int x = in.rect.x0 - 1; x < in.rect.x1; ++x) {
                measure(Border(in, x, y), x, y, nearest);
                spread(share(in, x, y), x, y, out);
            }
        cover(in, nearest, out);
    }

    const float radius;
    const int reach;

private:
    template <class Visit>
    void for_each_near(int x, int y, const Rect& rect, const Visit& visit) const {
        const Rect near = intersect(rect, {x - reach, y - reach, x + reach + 1, y + reach + 1});
        for (int py = near.y0; py < near.y1; ++py)
            for (int px = near.x0; px < near.x1; ++px)
                visit(px, py, Place{static_cast<float>(px - x), static_cast<float>(py - y)});
    }

    void measure(const Border& border, int x, int y, const MutView& nearest) const {
        for (std::size_t i = 0; i < border.pieces(); ++i)
            for_each_near(x, y, nearest.rect, [&](int px, int py, Place p) {
                float& d = *nearest.at(px, py);
                d = std::min(d, distance(p, border.begin(i), border.end(i)));
            });
    }

    void spread(float a, int x, int y, const MutView& out) const {
        if (a == 0 || a >= kHalf) return;
        for_each_near(x, y, out.rect, [&](int px, int py, Place p) {
            float& covered = *out.at(px, py);
            covered = std::max(covered, std::min(1.0F, radius + a - std::sqrt(p.x * p.x + p.y * p.y)));
        });
    }

    void cover(const View& in, const MutView& nearest, const MutView& out) const {
        if (radius == 0) return;
        for (int y = out.rect.y0; y < out.rect.y1; ++y)
            for (int x = out.rect.x0; x < out.rect.x1; ++x) {
                const float d = *nearest.at(x, y), inside = share(in, x, y) >= kHalf ? d : -d;
                float& covered = *out.at(x, y);
                covered = std::max(covered, std::min(1.0F, radius + kHalf + inside));
            }
    }
};

}  // namespace

KEYLINE_NODE(grow, Grow)

}  // namespace keyline
