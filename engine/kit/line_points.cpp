// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/line_points.h"

#include "engine/base/index.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace keyline {

namespace {

constexpr float kFarthest = 0.6F;  // from a pixel's centre along an axis, of the points that are its own

// Values around the region to compute, a pixel on each side where the picture has one.
struct Field {
    Rect rect;
    std::span<float> values;

    float at(int x, int y) const {
        return values[index(y - rect.y0) * index(rect.width()) + index(x - rect.x0)];
    }
};

Field empty_field(const Rect& rect, Scratch& scratch) {
    return {rect, scratch.floats(static_cast<std::size_t>(rect.area()))};
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

    explicit Edges(std::span<const Field> fields) : dx_(fields[0]), dy_(fields[1]) {}

    LinePoint at(int x, int y) const {
        const float dx = dx_.at(x, y), dy = dy_.at(x, y), here = magnitude(x, y);
        const bool across = std::fabs(dx) >= std::fabs(dy);
        const int u = across ? 1 : 0, v = across ? 0 : 1;
        if (!dx_.rect.contains(x - u, y - v) || !dx_.rect.contains(x + u, y + v)) return {};
        const float before = magnitude(x - u, y - v), behind = magnitude(x + u, y + v);
        if (!(here > before && here >= behind)) return {};
        const float top = top_of(before, here, behind);
        return {x, y, across ? top : 0, across ? 0 : top, dy / here, -dx / here, here, 0};
    }

private:
    float magnitude(int x, int y) const {
        return std::sqrt(dx_.at(x, y) * dx_.at(x, y) + dy_.at(x, y) * dy_.at(x, y));
    }
    const Field &dx_, &dy_;
};

// Steger: across its direction of strongest bend a ridge has its top in the pixel.
class Ridges {
public:
    static constexpr std::array kOrders{std::array{1, 0}, std::array{0, 1}, std::array{2, 0},
                                        std::array{1, 1}, std::array{0, 2}};

    Ridges(std::span<const Field> fields, float sign) : fields_(fields), sign_(sign) {}

    LinePoint at(int x, int y) const {
        const auto value = [&](std::size_t i) { return sign_ * fields_[i].at(x, y); };
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
    std::span<const Field> fields_;
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

void copy(const View& from, const Field& to) {
    std::size_t i = 0;
    for (int y = to.rect.y0; y < to.rect.y1; ++y)
        for (int x = to.rect.x0; x < to.rect.x1; ++x) to.values[i++] = *from.at(x, y);
}

void put(Outputs out, const LinePoint& p, int x, int y) {
    const std::array values{p.strength, p.dx, p.dy, p.tx, p.ty, std::bit_cast<float>(p.owner)};
    for (std::size_t i = 0; i < values.size(); ++i) *out[i].at(x, y) = values[i];
}

template <class Kind>
void find(const Kind& kind, std::span<const View> ids, bool integers, Outputs out) {
    const Rect& rect = out[0].rect;
    for (int y = rect.y0; y < rect.y1; ++y)
        for (int x = rect.x0; x < rect.x1; ++x) {
            LinePoint p = kind.at(x, y);
            if (!std::isfinite(p.strength)) p = {};
            if (p.strength > 0) p.owner = owner_at(ids, integers, x, y);
            put(out, p, x, y);
        }
}

}  // namespace

void FindLinePoints::compute(const Inputs& in, Outputs out, Scratch& scratch) const {
    const std::span<const View> channels = in.slot(0), ids = in.slot(1);
    const Rect around = intersect(grow(out[0].rect, {1, 1}), channels[0].rect);
    const auto derive = [&](const auto& orders) {
        std::vector<Field> fields;
        for (const auto& [x, y] : orders) {
            fields.push_back(empty_field(around, scratch));
            field_.fill(channels[0], around, x, y, fields.back().values, scratch);
        }
        return fields;
    };
    if (channels.size() == 3) {
        const std::array given{empty_field(around, scratch), empty_field(around, scratch)};
        copy(channels[0], given[0]);
        copy(channels[1], given[1]);
        find(Edges(given), ids, integers_, out);
    } else if (feature_ == LineFeature::kEdge) {
        const std::vector<Field> fields = derive(Edges::kOrders);
        find(Edges(fields), ids, integers_, out);
    } else {
        const std::vector<Field> fields = derive(Ridges::kOrders);
        find(Ridges(fields, feature_ == LineFeature::kRidge ? 1.0F : -1.0F), ids, integers_, out);
    }
}

std::vector<LinePoint> points_in(std::span<const View> outputs, const Rect& block, double least) {
    std::vector<LinePoint> out;
    for (int y = block.y0; y < block.y1; ++y)
        for (int x = block.x0; x < block.x1; ++x) {
            const auto value = [&](std::size_t i) { return *outputs[i].at(x, y); };
            if (!(value(0) > 0) || double{value(0)} < least) continue;
            out.push_back(
                {x, y, value(1), value(2), value(3), value(4), value(0), std::bit_cast<uint32_t>(value(5))});
        }
    return out;
}

}  // namespace keyline
