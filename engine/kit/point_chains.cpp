// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/point_chains.h"

#include "engine/base/index.h"
#include "engine/kit/stroke_way.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <tuple>
#include <utility>

namespace keyline {

namespace {

constexpr int kAround = 3;             // pixels to look for the next point in
constexpr double kFarthest = 2;        // pixels to it
constexpr double kStraightest = 0.64;  // cosine of the most that the way turns, and that it may lie aside

auto order_of(const LinePoint& p) { return std::tuple(p.y, p.x); }

// A point is left along its direction (1) or against it (0).
struct End {
    int point = -1, side = 0;
    friend bool operator==(const End&, const End&) = default;
};

class Linker {
public:
    Linker(std::vector<LinePoint> points, bool directed) : points_(std::move(points)), directed_(directed) {
        std::ranges::sort(points_, {}, order_of);
        best_.resize(points_.size());
        for (int i = 0; i < static_cast<int>(points_.size()); ++i)
            while (rows_.size() <= index(of(i).y - of(0).y)) rows_.push_back(i);
        std::array<Row, 2 * kAround + 1> around;
        for (int i = 0; i < static_cast<int>(points_.size()); ++i) {
            const LinePoint& p = of(i);
            for (int k = -kAround; k <= kAround; ++k) {
                Row& row = around[index(k + kAround)];
                if (i == 0 || of(i - 1).y != p.y) row = row_at(p.y + k);
                while (row.next < row.end && of(row.next).x < p.x - kAround) ++row.next;
            }
            for (const int side : {0, 1}) best_[index(i)][index(side)] = nearest({i, side}, around);
        }
    }

    std::vector<PointChain> chains() {
        seen_.assign(points_.size(), false);
        std::vector<PointChain> out;
        for (int i = 0; i < static_cast<int>(points_.size()); ++i)
            for (const int side : {0, 1})
                if (!seen_[index(i)] && next({i, 1 - side}).point < 0)
                    out.push_back(follow({i, side}, false));
        for (int i = 0; i < static_cast<int>(points_.size()); ++i)
            if (!seen_[index(i)]) out.push_back(follow({i, 1}, true));
        return out;
    }

private:
    const End& best(End e) const { return best_[index(e.point)][index(e.side)]; }
    const LinePoint& of(int i) const { return points_[index(i)]; }

    // Points of a row, from the first that is not too far to the left.
    struct Row {
        int next = 0, end = 0;
    };
    Row row_at(int y) const {
        const int row = y - of(0).y, rows = static_cast<int>(rows_.size());
        if (row < 0 || row >= rows) return {};
        return {rows_[index(row)], row + 1 < rows ? rows_[index(row + 1)] : static_cast<int>(points_.size())};
    }

    // The nearest point on that side, of equally near ones the upper left; and the side on which it is
    // entered.
    End nearest(End e, std::span<const Row> around) const {
        End best;
        double least = kFarthest * kFarthest;
        const int last = of(e.point).x + kAround;
        for (const Row& row : around)
            for (int i = row.next; i < row.end && of(i).x <= last; ++i) {
                const auto [distance2, side] = way_to(e, i);
                if (side < 0 || distance2 >= least) continue;
                least = distance2;
                best = {i, side};
            }
        return best;
    }

    // The squared distance, and the side of point i that faces this one; −1: not to be linked.
    std::pair<double, int> way_to(End e, int i) const {
        const LinePoint &p = of(e.point), &q = of(i);
        if (i == e.point || p.owner != q.owner) return {0, -1};
        const double x = q.x - p.x + double{q.dx} - double{p.dx}, y = q.y - p.y + double{q.dy} - double{p.dy};
        const double distance2 = x * x + y * y, distance = std::sqrt(distance2);
        const double along_p = (x * double{p.tx} + y * double{p.ty}) * (e.side == 1 ? 1 : -1);
        const double along_q = x * double{q.tx} + y * double{q.ty};
        const double turn = double{p.tx} * double{q.tx} + double{p.ty} * double{q.ty};
        if (along_p < kStraightest * distance || std::fabs(along_q) < kStraightest * distance ||
            std::fabs(turn) < kStraightest)
            return {0, -1};
        const int side = along_q > 0 ? 0 : 1;
        return directed_ && side == e.side ? std::pair{0.0, -1} : std::pair{distance2, side};
    }

    // What is linked to an end: each must be the other's best.
    End next(End e) const {
        const End to = best(e);
        return to.point >= 0 && best(to) == e ? to : End{};
    }

    PointChain follow(End e, bool closed) {
        PointChain chain{closed, {}};
        for (;;) {
            seen_[index(e.point)] = true;
            chain.points.push_back(of(e.point));
            const End to = next(e);
            if (to.point < 0 || seen_[index(to.point)]) return chain;
            e = {to.point, 1 - to.side};
        }
    }

    std::vector<LinePoint> points_;
    bool directed_;
    std::vector<int> rows_;                 // the first point of each row, from the topmost's on
    std::vector<std::array<End, 2>> best_;  // by point and side
    std::vector<bool> seen_;
};

}  // namespace

std::vector<PointChain> link_points(std::vector<LinePoint> points, bool directed, double high) {
    std::vector<PointChain> chains = Linker(std::move(points), directed).chains();
    std::erase_if(chains, [high](const PointChain& c) {
        return std::ranges::none_of(c.points,
                                    [high](const LinePoint& p) { return double{p.strength} >= high; });
    });
    return chains;
}

std::vector<double> strengths_along(const PointChain& chain, std::ptrdiff_t around) {
    std::vector<double> strengths, out;
    for (const LinePoint& p : chain.points) strengths.push_back(double{p.strength});
    for (std::size_t i = 0; i < strengths.size(); ++i)
        out.push_back(mean_along(strengths, chain.closed, i, around, false));
    return out;
}

}  // namespace keyline
