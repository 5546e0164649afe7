// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/coverage.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <span>
#include <tuple>

namespace keyline {

namespace {

constexpr int64_t kOne = kFixedOne;
constexpr int64_t kWhole = 2 * kOne * kOne;  // twice the area of a pixel

int64_t pixel_of(int64_t fixed) { return fixed >= 0 ? fixed / kOne : -((-fixed + kOne - 1) / kOne); }

// Where a line from a to b is at `at`, of which a is at from and b at to.
int64_t between(int64_t a, int64_t b, int64_t from, int64_t to, int64_t at) {
    if (at == from) return a;
    if (at == to) return b;
    const double share = static_cast<double>(at - from) / static_cast<double>(to - from);
    return a + static_cast<int64_t>(std::floor(static_cast<double>(b - a) * share + 0.5));
}

// An edge, or the part of one that lies in a row of pixels: it runs down, `sign` says which way the loop
// does.
struct Edge {
    int64_t x0 = 0, y0 = 0, x1 = 0, y1 = 0;
    int sign = 1;

    int64_t x_at(int64_t y) const { return between(x0, x1, y0, y1, y); }
    int64_t left() const { return pixel_of(std::min(x0, x1)); }
    int64_t right() const { return pixel_of(std::max(x0, x1)); }
    bool is_level() const { return y0 == y1; }
    Edge part(int64_t from, int64_t to) const { return {x_at(from), from, x_at(to), to, sign}; }
};

// The row of pixels between x0 and x1 that is being filled: what lies right of the edges added to it, and
// from the left on where that is covered.
class Cells {
public:
    void begin(int64_t x0, int64_t x1, bool covered) {
        x0_ = x0;
        covered_ = covered;
        const auto n = static_cast<std::size_t>(x1 - x0);
        area_.assign(n, 0);
        cover_.assign(n, 0);
    }

    // Pixel by pixel along the edge.
    void add(const Edge& e) {
        const bool to_right = e.x0 <= e.x1;
        int64_t x = e.x0, y = e.y0;
        for (int64_t p = pixel_of(x), last = pixel_of(e.x1); p != last; p += to_right ? 1 : -1) {
            const int64_t border = (to_right ? p + 1 : p) * kOne;
            const int64_t at = between(e.y0, e.y1, e.x0, e.x1, border);
            add_to(p, x, border, at - y, e.sign);
            x = border;
            y = at;
        }
        add_to(pixel_of(e.x1), x, e.x1, e.y1 - y, e.sign);
    }

    // What is covered of each pixel from `from` to `to`.
    void sum(int64_t from, int64_t to, std::vector<float>& out) const {
        int64_t cover = covered_ ? kOne : 0;
        for (std::size_t i = 0; i < area_.size(); ++i) {
            cover += cover_[i];
            const int64_t x = x0_ + static_cast<int64_t>(i), area = 2 * kOne * cover - area_[i];
            if (x >= from && x < to)
                out.push_back(static_cast<float>(std::clamp<int64_t>(area, 0, kWhole)) /
                              static_cast<float>(kWhole));
        }
    }

private:
    void add_to(int64_t pixel, int64_t from, int64_t to, int64_t height, int sign) {
        const auto i = static_cast<std::size_t>(pixel - x0_);
        cover_[i] += sign * height;
        area_[i] += sign * height * (from + to - 2 * pixel * kOne);
    }

    int64_t x0_ = 0;
    bool covered_ = false;
    std::vector<int64_t> area_, cover_;
};

// Edges whose pixels touch, with the winding on their left.  What they change it by is the same on every
// height of the row: nothing passes between them and the edges beside.
class Cluster {
public:
    explicit Cluster(Cells& cells) : cells_(cells) {}

    // The borders of what is covered go to the cells.  Returns the winding on the right.
    int add(std::span<const Edge> edges, int winding) {
        if (winding == 0)
            for (const int into : {1, -1})
                if (is_simple(edges, into)) return add_whole(edges, winding, into);
        if (std::abs(winding) == 1 && is_simple(edges, -winding)) return add_whole(edges, winding, winding);
        for (const Edge& e : edges) add_part(e, 0, kOne);
        return add_parts(0, 0, kOne, winding);
    }

private:
    // Whether on no height there is more than one edge of the sign `first`, and each is left of those of the
    // other: then the winding goes from what it is on the left to what it is beside that and back, no
    // farther, and the edges are the borders as they are.  On all heights it is the same on the right, so
    // that the sum says whether on any there is one of the other sign only.
    static bool is_simple(std::span<const Edge> edges, int first) {
        if (edges.size() > kFew) return false;
        Heights taken{};
        int64_t height = 0;
        for (const Edge& e : edges) {
            height += e.sign * first * (e.y1 - e.y0);
            if (e.sign != first) continue;
            if (!take(e.y0, e.y1, taken)) return false;
            for (const Edge& other : edges)
                if (other.sign != first && !is_left(e, other)) return false;
        }
        return height >= 0;
    }

    using Heights = std::array<uint64_t, kOne / 64>;  // a bit for each of a row

    // Whether none of those from `top` up to `bottom` was taken before.
    static bool take(int64_t top, int64_t bottom, Heights& taken) {
        for (int64_t y = top; y < bottom;) {
            const int64_t end = std::min(bottom, (y / 64 + 1) * 64);
            const uint64_t bits = (~uint64_t{0} >> (64 - (end - y))) << (y % 64);
            uint64_t& word = taken[static_cast<std::size_t>(y / 64)];
            if ((word & bits) != 0) return false;
            word |= bits;
            y = end;
        }
        return true;
    }

    static bool is_left(const Edge& a, const Edge& b) {
        if (std::max(a.x0, a.x1) <= std::min(b.x0, b.x1)) return true;
        const int64_t top = std::max(a.y0, b.y0), bottom = std::min(a.y1, b.y1);
        return top >= bottom || (a.x_at(top) <= b.x_at(top) && a.x_at(bottom) <= b.x_at(bottom));
    }

    // `into` is the sign of edges into what is covered.
    int add_whole(std::span<const Edge> edges, int winding, int into) {
        int64_t height = 0;
        for (Edge e : edges) {
            height += e.sign * (e.y1 - e.y0);
            e.sign *= into;
            if (!e.is_level()) cells_.add(e);
        }
        return winding + static_cast<int>(height / kOne);
    }

    // All parts from `first` on, which lie between `top` and `bottom`; takes them away.  What hangs together
    // there is added by itself, so that edges are cut where others end or cross that they have to do with,
    // and not where any do.
    int add_parts(std::size_t first, int64_t top, int64_t bottom, int winding) {
        std::ranges::sort(parts_.begin() + static_cast<std::ptrdiff_t>(first), parts_.end(), {},
                          [](const Edge& e) { return std::min(e.x0, e.x1); });
        const std::size_t end = parts_.size();
        for (std::size_t i = first; i < end;) {
            const std::size_t begin = i;
            int64_t right = std::max(parts_[i].x0, parts_[i].x1);
            for (++i; i < end && std::min(parts_[i].x0, parts_[i].x1) <= right; ++i)
                right = std::max({right, parts_[i].x0, parts_[i].x1});
            winding = add_group(begin, i, top, bottom, winding);
        }
        parts_.resize(first);
        return winding;
    }

    int add_group(std::size_t begin, std::size_t end, int64_t top, int64_t bottom, int winding) {
        const std::span<Edge> group(&parts_[begin], end - begin);
        int64_t height = 0;
        int back = 0;  // edges that lead towards what is not covered
        for (const Edge& e : group) {
            height += e.sign * (e.y1 - e.y0);
            if (e.sign * winding < 0) ++back;
        }
        if (std::abs(winding) <= back) {
            if (const int64_t cut = find_cut(group, top, bottom); cut < bottom) {
                const std::size_t first = parts_.size();
                for (std::size_t i = begin; i < end; ++i) add_part(parts_[i], top, cut);
                add_parts(first, top, cut, winding);
                for (std::size_t i = begin; i < end; ++i) add_part(parts_[i], cut, bottom);
                return add_parts(first, cut, bottom, winding);
            }
            add_borders(group, winding);
        }
        return winding + static_cast<int>(height / (bottom - top));
    }

    // A height between, at which some edge ends, the nearest to the middle; where none does, one at which two
    // cross; `bottom` where the edges just stand side by side, or all is flat.
    static int64_t find_cut(std::span<Edge> group, int64_t top, int64_t bottom) {
        int64_t cut = bottom, least = bottom - top;
        for (const Edge& e : group)
            for (const int64_t y : {e.y0, e.y1})
                if (const int64_t off = std::abs(2 * y - top - bottom); off < least) {
                    cut = y;
                    least = off;
                }
        if (cut < bottom) return cut;
        std::ranges::sort(group, {}, [](const Edge& e) { return std::tuple(e.x0 + e.x1, e.x0, e.sign); });
        for (std::size_t i = 1; bottom - top > 1 && i < group.size(); ++i) {
            const int64_t above = group[i].x0 - group[i - 1].x0, below = group[i].x1 - group[i - 1].x1;
            if (above < 0 || below < 0)
                return std::clamp(between(top, bottom, 0, std::abs(above) + std::abs(below), std::abs(above)),
                                  top + 1, bottom - 1);
        }
        return bottom;
    }

    // What is level at the top or the bottom parts nothing.
    void add_part(const Edge& e, int64_t top, int64_t bottom) {
        const int64_t from = std::max(e.y0, top), to = std::min(e.y1, bottom);
        if (from < to)
            parts_.push_back(e.part(from, to));
        else if (e.is_level() && top < e.y0 && e.y0 < bottom)
            parts_.push_back(e);
    }

    void add_borders(std::span<const Edge> side_by_side, int winding) {
        for (const Edge& e : side_by_side) {
            const bool covered = winding != 0;
            winding += e.sign;
            if (covered == (winding != 0)) continue;
            Edge border = e;
            border.sign = covered ? -1 : 1;
            cells_.add(border);
        }
    }

    static constexpr std::size_t kFew = 16;

    Cells& cells_;
    std::vector<Edge> parts_;  // a stack
};

class Filler {
public:
    explicit Filler(const Rect& window)
        : window_(window), least_((int64_t{window.x0} - 1) * kOne), most_((int64_t{window.x1} + 1) * kOne) {}

    Coverage fill(const std::vector<Loop>& loops) {
        for (const Loop& loop : loops)
            for (std::size_t i = 0; i < loop.size(); ++i) split(loop[i], loop[(i + 1) % loop.size()]);
        order_by_rows();
        for (std::size_t i = 0; i < pieces_.size();) {
            std::size_t end = i;
            while (end < pieces_.size() && pieces_[end].y == pieces_[i].y) ++end;
            const std::span row = std::span(pieces_).subspan(i, end - i);
            std::ranges::sort(row, {}, &Piece::left);
            fill_row(row);
            i = end;
        }
        return std::move(out_);
    }

private:
    // The part of an edge in one row of pixels, its heights counted from the row's top.
    struct Piece {
        int64_t y = 0, left = 0;
        Edge edge;
    };

    // An edge by the rows of the window that it crosses.  A level one covers nothing, but what it joins hangs
    // together.
    void split(const FixedPoint& a, const FixedPoint& b) {
        const Edge e = a.y <= b.y ? Edge{a.x, a.y, b.x, b.y, 1} : Edge{b.x, b.y, a.x, a.y, -1};
        const int64_t first = std::max<int64_t>(pixel_of(e.y0), window_.y0),
                      last = std::min<int64_t>(pixel_of(std::max(e.y0, e.y1 - 1)), window_.y1 - 1);
        for (int64_t y = first; y <= last; ++y) {
            Edge part = e.is_level() ? e : e.part(std::max(e.y0, y * kOne), std::min(e.y1, (y + 1) * kOne));
            part.y0 -= y * kOne;
            part.y1 -= y * kOne;
            clip(y, part);
        }
    }

    // Beside the window only the winding counts: there an edge stands upright.
    void clip(int64_t y, const Edge& e) {
        const auto [left, right] = std::minmax(e.x0, e.x1);
        if (e.is_level() || (left >= least_ && right < most_)) return add(y, e);
        std::array<int64_t, 4> heights{e.y0, e.y0, e.y0, e.y1};
        if ((e.x0 < least_) != (e.x1 < least_)) heights[1] = between(e.y0, e.y1, e.x0, e.x1, least_);
        if ((e.x0 < most_) != (e.x1 < most_)) heights[2] = between(e.y0, e.y1, e.x0, e.x1, most_);
        std::ranges::sort(heights);
        for (std::size_t i = 1; i < heights.size(); ++i)
            if (heights[i] > heights[i - 1]) add(y, e.part(heights[i - 1], heights[i]));
    }

    void add(int64_t y, Edge e) {
        e.x0 = std::clamp(e.x0, least_, most_);
        e.x1 = std::clamp(e.x1, least_, most_);
        pieces_.push_back({y, e.left(), e});
    }

    void order_by_rows() {
        if (pieces_.empty()) return;
        const auto [top, bottom] = std::ranges::minmax(pieces_, {}, &Piece::y);
        std::vector<std::size_t> next(static_cast<std::size_t>(bottom.y - top.y) + 2);
        for (const Piece& p : pieces_) ++next[static_cast<std::size_t>(p.y - top.y) + 1];
        for (std::size_t i = 1; i < next.size(); ++i) next[i] += next[i - 1];
        std::vector<Piece> ordered(pieces_.size());
        for (const Piece& p : pieces_) ordered[next[static_cast<std::size_t>(p.y - top.y)]++] = p;
        pieces_ = std::move(ordered);
    }

    void fill_row(std::span<const Piece> row) {
        const auto y = static_cast<int>(row.front().y);
        int winding = 0;
        for (std::size_t i = 0; i < row.size();) {
            const int64_t left = row[i].left;
            int64_t right = left;
            edges_.clear();
            for (; i < row.size() && row[i].left <= right; ++i) {
                edges_.push_back(row[i].edge);
                right = std::max(right, row[i].edge.right());
            }
            cells_.begin(left, right + 1, winding != 0);
            winding = cluster_.add(edges_, winding);
            add_span(y, left, right + 1, out_.covers.size());
            if (winding != 0 && i < row.size()) add_span(y, right + 1, row[i].left, CoverageSpan::kWhole);
        }
    }

    void add_span(int y, int64_t x0, int64_t x1, std::size_t first) {
        x0 = std::max<int64_t>(x0, window_.x0);
        x1 = std::min<int64_t>(x1, window_.x1);
        if (x0 >= x1) return;
        out_.spans.push_back({y, static_cast<int>(x0), static_cast<int>(x1), first});
        if (first != CoverageSpan::kWhole) cells_.sum(x0, x1, out_.covers);
    }

    Rect window_;
    int64_t least_, most_;  // x, in the pixels beside the window
    std::vector<Piece> pieces_;
    std::vector<Edge> edges_;
    Cells cells_;
    Cluster cluster_{cells_};
    Coverage out_;
};

}  // namespace

Coverage coverage_of(const std::vector<Loop>& loops, const Rect& window) {
    return window.empty() ? Coverage{} : Filler(window).fill(loops);
}

}  // namespace keyline
