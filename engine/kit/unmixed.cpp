// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/unmixed.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace keyline {

namespace {

constexpr double kSteepest = 0.25;  // change of a normal from pixel to pixel that a surface goes on with
constexpr double kContrast = 0.02;  // squared length between two normals that can be told apart
constexpr double kBeyond = 0.3;     // how far outside of both centres an edge may be found
constexpr double kFacing = 0.5;     // of a normal's length: what is shorter is mixed with nothing

using Normal = std::array<double, 3>;

Normal add(const Normal& a, double factor, const Normal& b) {
    return {a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]};
}
double dot(const Normal& a, const Normal& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

class Row {
public:
    Row(std::span<const View> normals, int x, int y, int dx, int dy)
        : normals_(normals), x_(x), y_(y), dx_(dx), dy_(dy) {}

    std::optional<Normal> at(int i) const {
        const int x = x_ + i * dx_, y = y_ + i * dy_;
        if (!normals_[0].rect.contains(x, y)) return {};
        const auto value = [&](std::size_t c) { return double{*normals_[c].at(x, y)}; };
        const Normal n{value(0), value(1), value(2)};
        const double length2 = dot(n, n);
        return length2 > kFacing * kFacing && std::isfinite(length2) ? std::optional(n) : std::nullopt;
    }

    // The surface from pixel `first` on, away from the edge, as it would go on in the other direction.
    struct Side {
        Normal nearest{}, slope{};
        Normal on(int pixels) const { return add(nearest, pixels, slope); }
    };
    std::optional<Side> side(int first, int away) const {
        const auto nearest = at(first), next = at(first + away);
        if (!nearest) return {};
        if (!next) return Side{*nearest, {}};
        Normal slope = add(*nearest, -1, *next);
        const double steepness = std::sqrt(dot(slope, slope));
        if (steepness > kSteepest)
            for (double& s : slope) s *= kSteepest / steepness;
        return Side{*nearest, slope};
    }

private:
    std::span<const View> normals_;
    int x_, y_, dx_, dy_;
};

}  // namespace

std::optional<double> unmixed_edge(std::span<const View> normals, int x, int y, int dx, int dy) {
    const Row row(normals, x, y, dx, dy);
    const auto before = row.side(-1, -1), behind = row.side(2, 1);
    if (!before || !behind) return {};
    std::array<double, 2> shares{};
    for (const int i : {0, 1}) {
        const auto mixed = row.at(i);
        if (!mixed) return {};
        const Normal front = before->on(1 + i), back = behind->on(2 - i), apart = add(front, -1, back);
        const double contrast = dot(apart, apart);
        if (!(contrast > kContrast)) return {};
        double& share = shares[static_cast<std::size_t>(i)];
        share = dot(add(*mixed, -1, back), apart) / contrast;
        if (!(share > -kBeyond && share < 1 + kBeyond)) return {};
    }
    if (shares[1] > shares[0]) return {};
    return std::clamp(shares[0] + shares[1] - 0.5, -kBeyond, 1 + kBeyond);
}

}  // namespace keyline
