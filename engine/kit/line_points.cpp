// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/line_points.h"

#include "engine/base/index.h"
#include "engine/kit/sparse_row.h"
#include "engine/kit/unmixed.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

namespace keyline {

namespace {

constexpr float kFarthest = 0.6F;  // from a pixel's centre along an axis, of the points that are its own

// Values around the region to compute, a pixel on each side where the picture has one.
MutView empty_field(const Rect& rect, Scratch& scratch) {
    return {scratch.floats(static_cast<std::size_t>(rect.area())).data(), rect.width(), rect, rect};
}

// Where a parabola through three values has its top, from the middle one.
float top_of(float before, float here, float behind) {
    return 0.5F * (before - behind) / (before - 2 * here + behind);
}

// Devernay: the gradient is largest in a pixel among its neighbours to the sides, or among those above and
// below, whichever it points to more; and its place lies on that axis.  Along the gradient itself places
// would swing at slopes near 45 degrees.
class Edges {
public:
    static constexpr std::array kOrders{std::array{1, 0}, std::array{0, 1}};

    Edges(std::span<const View> fields, const Rect& around, double least, Scratch& scratch)
        : dx_(fields[0]), dy_(fields[1]), squares_(empty_field(around, scratch)) {
        for (int y = around.y0; y < around.y1; ++y)
            square(dx_.at(around.x0, y), dy_.at(around.x0, y), index(around.width()), squares_.row(y));
        // A little less, as roots are rounded.
        const double square = std::min(least * least * (1 - 1e-6), double{std::numeric_limits<float>::max()});
        least_square_ = static_cast<float>(square);
    }

    // Calls take(x) for the pixels of a row in which there may be a point.
    template <class Take>
    void each(int y, int x0, int x1, const Take& take) const {
        each_where(
            squares_.at(x0, y), x1 - x0, [&](float square) { return square >= least_square_; },
            [&](int i) { take(x0 + i); });
    }

    LinePoint at(int x, int y) const {
        const float dx = *dx_.at(x, y), dy = *dy_.at(x, y);
        const bool across = std::fabs(dx) >= std::fabs(dy);
        const int u = across ? 1 : 0, v = across ? 0 : 1;
        const Rect& rect = squares_.rect;
        if (!rect.contains(x - u, y - v) || !rect.contains(x + u, y + v)) return {};
        if (!(*squares_.at(x, y) > *squares_.at(x - u, y - v))) return {};
        const float here = magnitude(x, y), before = magnitude(x - u, y - v),
                    behind = magnitude(x + u, y + v);
        if (!(here > before && here >= behind)) return {};
        const float top = top_of(before, here, behind);
        return {x, y, across ? top : 0, across ? 0 : top, dy / here, -dx / here, here, 0};
    }

private:
    static void square(const float* __restrict dx, const float* __restrict dy, std::size_t n,
                       float* __restrict out) {
        for (std::size_t i = 0; i < n; ++i) out[i] = dx[i] * dx[i] + dy[i] * dy[i];
    }
    float magnitude(int x, int y) const { return std::sqrt(*squares_.at(x, y)); }

    const View &dx_, &dy_;
    MutView squares_;  // of magnitudes
    float least_square_ = 0;
};

// Steger: across its direction of strongest bend a ridge has its top in the pixel.
class Ridges {
public:
    static constexpr std::array kOrders{std::array{1, 0}, std::array{0, 1}, std::array{2, 0},
                                        std::array{1, 1}, std::array{0, 2}};

    Ridges(std::span<const View> fields, float sign) : fields_(fields), sign_(sign) {}

    template <class Take>
    static void each(int /*y*/, int x0, int x1, const Take& take) {
        for (int x = x0; x < x1; ++x) take(x);
    }

    LinePoint at(int x, int y) const {
        const auto value = [&](std::size_t i) { return sign_ * *fields_[i].at(x, y); };
        const float gx = value(0), gy = value(1), xx = value(2), xy = value(3), yy = value(4);
        const float half = (xx - yy) / 2, root = std::sqrt(half * half + xy * xy),
                    least = (xx + yy) / 2 - root;
        if (!(least < 0)) return {};
        // The eigenvector of the smaller eigenvalue, from whichever row of the matrix is the better one.
        float nx = half <= 0 ? half - root : xy, ny = half <= 0 ? xy : -half - root;
        const float length = std::sqrt(nx * nx + ny * ny);
        if (!(length > 0))
            nx = 1, ny = 0;
        else
            nx /= length, ny /= length;
        const float to_top = -(gx * nx + gy * ny) / least;
        // One point a column of a line that runs across, and one a row of one that runs down.
        const float most = kFarthest * std::max(std::fabs(nx), std::fabs(ny));
        if (!(std::fabs(to_top) <= most)) return {};
        return {x, y, to_top * nx, to_top * ny, -ny, nx, -least, 0};
    }

private:
    std::span<const View> fields_;
    float sign_;
};

// The object with the most of a pixel.
uint32_t owner_at(std::span<const View> ids, bool integers, int x, int y) {
    if (ids.empty() || !ids[0].rect.contains(x, y)) return 0;
    const auto id_of = [&](const View& v) {
        const float id = *v.at(x, y);
        return id == 0 && !integers ? 0 : std::bit_cast<uint32_t>(id);
    };
    if (ids.size() == 1) return id_of(ids[0]);
    uint32_t owner = 0;
    float most = 0;
    for (std::size_t r = 0; r + 1 < ids.size(); r += 2)
        if (const float covered = *ids[r + 1].at(x, y); covered > most) {
            most = covered;
            owner = id_of(ids[r]);
        }
    return owner;
}

void put(Outputs out, const LinePoint& p, int x, int y) {
    const std::array values{p.strength, p.dx,
                            p.dy,       p.tx,
                            p.ty,       std::bit_cast<float>(p.owner),
                            p.aside,    p.by_column ? 1.0F : 0.0F};
    for (std::size_t i = 0; i < values.size(); ++i) *out[i].at(x, y) = values[i];
}

// An edge lies on an axis through its pixel; on it the line runs where the normals have it.
void place_by(std::span<const View> normals, LinePoint& p) {
    p.by_column = std::fabs(p.tx) > std::fabs(p.ty);
    const int dx = p.by_column ? 0 : 1, dy = 1 - dx;
    const float off = p.by_column ? p.dy : p.dx;
    const int step = off < 0 ? -1 : 0;
    if (const auto edge = unmixed_edge(normals, p.x + step * dx, p.y + step * dy, dx, dy))
        p.aside = static_cast<float>(*edge + step) - off;
}

// Where there is none, only the output that says so is written.
template <class Kind>
void find(const Kind& kind, double least, std::span<const View> ids, bool integers, Outputs out,
          std::span<const View> normals = {}) {
    const Rect& rect = out[0].rect;
    for (int y = rect.y0; y < rect.y1; ++y) {
        std::fill_n(out[0].row(y), rect.width(), 0.0F);
        kind.each(y, rect.x0, rect.x1, [&](int x) {
            LinePoint p = kind.at(x, y);
            if (!(p.strength > 0) || !std::isfinite(p.strength) || double{p.strength} < least) return;
            p.owner = owner_at(ids, integers, x, y);
            if (!normals.empty()) place_by(normals, p);
            put(out, p, x, y);
        });
    }
}

}  // namespace

Halo FindLinePoints::halo() const {
    const int reach = std::max(field_.reach() + 1, kUnmixReach + 1);
    return {reach, reach};
}

void FindLinePoints::compute(const Inputs& in, Outputs out, Scratch& scratch) const {
    const std::span<const View> channels = in.slot(0), ids = in.slot(1), normals = in.slot(2);
    const Rect around = intersect(grow(out[0].rect, {1, 1}), channels[0].rect);
    const auto derive = [&](const auto& orders) {
        std::vector<View> fields;
        for (const auto& [x, y] : orders) {
            const MutView field = empty_field(around, scratch);
            field_.fill(channels[0], around, x, y, {field.data, static_cast<std::size_t>(around.area())},
                        scratch);
            fields.emplace_back(field);
        }
        return fields;
    };
    if (channels.size() == 3) {
        find(Edges(channels, around, least_, scratch), least_, ids, integers_, out, normals);
    } else if (feature_ == LineFeature::kEdge) {
        const std::vector<View> fields = derive(Edges::kOrders);
        find(Edges(fields, around, least_, scratch), least_, ids, integers_, out, normals);
    } else {
        const std::vector<View> fields = derive(Ridges::kOrders);
        find(Ridges(fields, feature_ == LineFeature::kRidge ? 1.0F : -1.0F), least_, ids, integers_, out);
    }
}

std::vector<LinePoint> points_in(std::span<const View> outputs, const Rect& block) {
    std::vector<LinePoint> out;
    for (int y = block.y0; y < block.y1; ++y) {
        const auto add = [&](int i) {
            const auto value = [&](std::size_t k) { return *outputs[k].at(block.x0 + i, y); };
            out.push_back({block.x0 + i, y, value(1), value(2), value(3), value(4), value(0),
                           std::bit_cast<uint32_t>(value(5)), value(6), value(7) != 0});
        };
        each_where(
            outputs[0].at(block.x0, y), block.width(), [](float strength) { return strength > 0; }, add);
    }
    return out;
}

}  // namespace keyline
