// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/borders.h"

#include "engine/base/index.h"

#include <algorithm>
#include <span>
#include <tuple>
#include <utility>

namespace keyline {

namespace {

// A crossing is left towards the cell with the smaller coordinate (0), above it or to the left, or towards
// the other (1).
struct Exit {
    int crossing = -1, to = 0;
};

// What is behind an exit: another crossing, entered from that side, or a junction, or the rim.
struct Next {
    enum class Kind { kRim, kCrossing, kJunction } kind = Kind::kRim;
    int index = -1, side = 0;
};

auto order_of(const Crossing& c) { return std::tuple(c.y, c.x, c.down); }

class Linker {
public:
    explicit Linker(BorderMap& map) : map_(map), next_(map.crossings.size()) {
        for (std::size_t i = 0; i < map.crossings.size(); ++i)
            while (row_of(map.crossings[i].y) >= rows_.size()) rows_.push_back(i);
    }

    void link() {
        for (std::size_t i = 0; i < map_.crossings.size(); ++i) {
            const Crossing& c = map_.crossings[i];
            for (int k = -1; k <= 1; ++k) {
                Row& row = around_[index(k + 1)];
                if (i == 0 || map_.crossings[i - 1].y != c.y) row = row_at(c.y + k);
                while (row.next < row.end && map_.crossings[row.next].x < c.x - 1) ++row.next;
            }
            link_cell(c.x, 1);
            link_cell(c.down ? c.x - 1 : c.x, c.down ? 1 : 0);
        }
    }

    void walk() {
        seen_.assign(map_.crossings.size(), false);
        for (std::size_t i = 0; i < seen_.size(); ++i)
            for (const int to : {0, 1})
                if (!seen_[i] && next_[i][index(1 - to)].kind != Next::Kind::kCrossing)
                    follow({static_cast<int>(i), to}, false);
        for (std::size_t i = 0; i < seen_.size(); ++i)
            if (!seen_[i]) follow({static_cast<int>(i), 1}, true);
    }

private:
    // Crossings of a row, from the first that is not too far to the left.
    struct Row {
        std::size_t next = 0, end = 0;
    };

    std::size_t row_of(int y) const { return index(y - map_.crossings.front().y); }

    Row row_at(int y) const {
        if (y < map_.crossings.front().y || y > map_.crossings.back().y) return {};
        const std::size_t row = row_of(y);
        return {rows_[row], row + 1 < rows_.size() ? rows_[row + 1] : map_.crossings.size()};
    }

    int find(const Row& row, int x, bool down) const {
        for (std::size_t i = row.next; i < row.end && map_.crossings[i].x <= x; ++i)
            if (map_.crossings[i].x == x && map_.crossings[i].down == down) return static_cast<int>(i);
        return -1;
    }
    const Crossing& at(Exit e) const { return map_.crossings[index(e.crossing)]; }
    Next& next(Exit e) { return next_[index(e.crossing)][index(e.to)]; }

    // The cell whose upper left corner is the centre of pixel x in a row of those around.
    void link_cell(int x, std::size_t r) {
        const Row &here = around_[r], &below = around_[r + 1];
        const std::array<Exit, 4> sides{Exit{find(here, x, false), 1}, Exit{find(here, x + 1, true), 0},
                                        Exit{find(below, x, false), 0}, Exit{find(here, x, true), 1}};
        std::array<Exit, 4> crossed;
        const auto end =
            std::ranges::copy_if(sides, crossed.begin(), [](Exit e) { return e.crossing >= 0; }).out;
        const std::span<const Exit> found(crossed.begin(), end);
        if (found.size() < 2 || next(found[0]).kind != Next::Kind::kRim) return;  // at the rim; or done
        if (found.size() == 2)
            join(found[0], found[1]);
        else if (found.size() == 3 || !join_saddle(sides))
            meet(found);
    }

    void join(Exit a, Exit b) {
        next(a) = {Next::Kind::kCrossing, b.crossing, b.to};
        next(b) = {Next::Kind::kCrossing, a.crossing, a.to};
    }

    void meet(std::span<const Exit> exits) {
        MapPoint sum;
        for (const Exit& e : exits) {
            const MapPoint p = map_.at(e.crossing);
            sum.x += p.x;
            sum.y += p.y;
            next(e) = {Next::Kind::kJunction, static_cast<int>(map_.junctions.size())};
        }
        const auto n = static_cast<double>(exits.size());
        map_.junctions.push_back({sum.x / n, sum.y / n});
    }

    // All four sides are crossed.  Where opposite corners are of one object they may hang together: the
    // hyperbola through the crossings says whether.
    bool join_saddle(const std::array<Exit, 4>& sides) {
        const auto [top, right, bottom, left] = sides;
        const bool falling = at(top).sides[0].id == at(bottom).sides[1].id;  // of one object
        const bool rising = at(top).sides[1].id == at(bottom).sides[0].id;
        const float bias = (at(left).along - at(right).along) + (at(top).along - at(bottom).along);
        if (falling && (bias > 0 || (bias == 0 && !rising)))
            return join(top, right), join(left, bottom), true;
        if (rising && bias <= 0) return join(top, left), join(right, bottom), true;
        return false;
    }

    void follow(Exit e, bool closed) {
        Border border;
        border.closed = closed;
        // Who leaves a crossing downwards or to the left has the first pixel, or the second, at the right.
        const std::size_t right = at(e).down == (e.to == 1) ? 1 : 0;
        border.right = at(e).sides[right].id;
        border.left = at(e).sides[1 - right].id;
        if (!closed) border.ends[0] = end_at(next({e.crossing, 1 - e.to}));
        for (;;) {
            seen_[index(e.crossing)] = true;
            border.crossings.push_back(e.crossing);
            const Next on = next(e);
            if (on.kind != Next::Kind::kCrossing) {
                border.ends[1] = end_at(on);
                break;
            }
            if (seen_[index(on.index)]) break;
            e = {on.index, 1 - on.side};
        }
        map_.borders.push_back(std::move(border));
    }

    static int end_at(const Next& n) { return n.kind == Next::Kind::kJunction ? n.index : Border::kRim; }

    BorderMap& map_;
    std::array<Row, 3> around_;              // the one that is being linked in the middle
    std::vector<std::size_t> rows_;          // the first crossing of each row, from the topmost's on
    std::vector<std::array<Next, 2>> next_;  // by crossing and exit
    std::vector<bool> seen_;
};

}  // namespace

MapPoint BorderMap::at(int crossing, uint32_t owner) const {
    const Crossing& c = crossings[index(crossing)];
    const double along = double{owner == 0 ? c.along : side(crossing, owner).along};
    return {c.x + 0.5 + (c.down ? 0 : along), c.y + 0.5 + (c.down ? along : 0)};
}

const Crossing::Side& BorderMap::side(int crossing, uint32_t id) const {
    const Crossing& c = crossings[index(crossing)];
    return c.sides[c.sides[0].id == id ? 0 : 1];
}

BorderMap link_borders(std::vector<Crossing> crossings, const Rect& extent) {
    BorderMap map{extent, std::move(crossings), {}, {}};
    std::ranges::sort(map.crossings, {}, order_of);
    Linker linker(map);
    linker.link();
    linker.walk();
    return map;
}

}  // namespace keyline
