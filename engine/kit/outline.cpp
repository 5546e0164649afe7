// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/outline.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace keyline {

namespace {

constexpr double kFlat = 0.01;
constexpr double kSharpest = -0.8;  // cosine of a turn that is no end of a line and the beginning of another

struct Vector {
    double x = 0, y = 0;
    friend Vector operator+(Vector a, Vector b) { return {a.x + b.x, a.y + b.y}; }
    friend Vector operator-(Vector a, Vector b) { return {a.x - b.x, a.y - b.y}; }
    friend Vector operator*(double s, Vector a) { return {s * a.x, s * a.y}; }
};

double dot(Vector a, Vector b) { return a.x * b.x + a.y * b.y; }
double length(Vector a) { return std::sqrt(dot(a, a)); }
Vector turned(Vector a) { return {-a.y, a.x}; }

struct Disc {
    Vector centre;
    double radius = 0;
};

// Whether a disc lies in another, or so nearly that their common tangents touch at one end of both.
bool lies_in(const Disc& inner, const Disc& outer) {
    return outer.radius - inner.radius >= 0.98 * length(outer.centre - inner.centre);
}

// From one disc to the next: the direction, and where their common tangents touch, seen from the centres.
struct Segment {
    double length = 0;
    Vector along, right, left;
};

Segment segment_between(const Disc& a, const Disc& b) {
    Segment s;
    const Vector way = b.centre - a.centre;
    s.length = length(way);
    s.along = 1 / s.length * way;
    const double slope = (b.radius - a.radius) / s.length, across = std::sqrt(1 - slope * slope);
    s.right = across * turned(s.along) - slope * s.along;
    s.left = -across * turned(s.along) - slope * s.along;
    return s;
}

double within_reach(double d) { return std::clamp(d, double(-kMaxCoordinate), double(kMaxCoordinate)); }

FixedPoint fixed(Vector v) {
    const auto of = [](double d) {
        return static_cast<int64_t>(std::floor(within_reach(d) * kFixedOne + 0.5));
    };
    return {of(v.x), of(v.y)};
}

// A polygon in the making.
class Pen {
public:
    void point(Vector v) {
        const FixedPoint p = fixed(v);
        if (loop_.empty() || !(loop_.back() == p)) loop_.push_back(p);
    }

    // Around a disc, the shorter way between directions less than a half circle apart.
    void arc(const Disc& disc, Vector from, Vector to) {
        point(disc.centre + disc.radius * from);
        bend(disc, from, to);
        point(disc.centre + disc.radius * to);
    }

    Loop take(bool backwards = false) {
        if (backwards) std::ranges::reverse(loop_);
        return std::move(loop_);
    }

private:
    void bend(const Disc& disc, Vector from, Vector to) {
        const Vector sum = from + to;
        const double size = length(sum);  // the middle of the chord lies half of it from the centre
        if (disc.radius * (1 - size / 2) <= kFlat) return;
        const Vector middle = 1 / size * sum;
        bend(disc, from, middle);
        point(disc.centre + disc.radius * middle);
        bend(disc, middle, to);
    }

    Loop loop_;
};

// All loops wind the same way, so that what one covers no other takes away.
class Outliner {
public:
    explicit Outliner(const Stroke& stroke) : closed_(stroke.closed) {
        for (const StrokeVertex& v : stroke.vertices)
            add({{within_reach(v.x), within_reach(v.y)}, within_reach(v.width / 2)});
        if (closed_) close();
        leave_out_needless();
        const std::size_t n = discs_.size();
        for (std::size_t i = 0; n > 1 && i + (closed_ ? 0 : 1) < n; ++i)
            segments_.push_back(segment_between(discs_[i], discs_[(i + 1) % n]));
    }

    std::vector<Loop> loops() {
        if (discs_.size() == 1) add_disc(discs_[0]);
        if (discs_.size() > 1) closed_ ? add_ring() : add_ribbon();
        return std::move(loops_);
    }

private:
    void add(const Disc& disc) {
        while (!discs_.empty() && lies_in(discs_.back(), disc)) discs_.pop_back();
        if (discs_.empty() || !lies_in(disc, discs_.back())) discs_.push_back(disc);
    }

    void close() {
        while (discs_.size() > 1 && lies_in(discs_.back(), discs_.front())) discs_.pop_back();
        while (discs_.size() > 1 && lies_in(discs_.front(), discs_.back())) discs_.erase(discs_.begin());
    }

    // Discs that lie on the way between others.  What is left is longer than it is wide, mostly, so that the
    // outline is wound around once.
    void leave_out_needless() {
        constexpr std::size_t kMost = 32;
        std::vector<Disc> kept;
        for (std::size_t i = 0; i < discs_.size();) {
            kept.push_back(discs_[i]);
            std::size_t next = i + 1;
            while (next + 1 < discs_.size() && next - i < kMost && is_straight(i, next + 1)) ++next;
            i = next;
        }
        discs_ = std::move(kept);
    }

    bool is_straight(std::size_t from, std::size_t to) const {
        const Disc &a = discs_[from], &b = discs_[to];
        const Vector way = b.centre - a.centre;
        const double square = dot(way, way);
        if (!(square > 0)) return false;
        for (std::size_t i = from + 1; i < to; ++i) {
            const Vector off = discs_[i].centre - a.centre;
            const double along = dot(off, way) / square;
            const double radius = a.radius + along * (b.radius - a.radius);
            if (along < 0 || along > 1 || length(off - along * way) > kFlat ||
                std::fabs(discs_[i].radius - radius) > kFlat)
                return false;
        }
        return true;
    }

    void add_disc(const Disc& disc) {
        constexpr std::array<Vector, 5> kQuarters{Vector{1, 0}, {0, -1}, {-1, 0}, {0, 1}, {1, 0}};
        Pen pen;
        for (std::size_t i = 0; i < 4; ++i) pen.arc(disc, kQuarters[i], kQuarters[i + 1]);
        loops_.push_back(pen.take());
    }

    // From one segment to the next.  Where they turn, each is wound around by itself, and the disc too.
    void join(const Segment& before, const Disc& disc, const Segment& after) {
        const double shorter = std::min(before.length, after.length);
        if (is_smooth(disc, before.right, after.right, shorter) &&
            is_smooth(disc, before.left, after.left, shorter)) {
            right_.point(disc.centre + disc.radius / 2 * (before.right + after.right));
            left_.point(disc.centre + disc.radius / 2 * (before.left + after.left));
            return;
        }
        if (dot(before.along, after.along) > kSharpest) return turn_at(disc, before, after);
        right_.point(disc.centre + disc.radius * before.right);
        left_.point(disc.centre + disc.radius * before.left);
        right_.point(disc.centre);
        left_.point(disc.centre);
        right_.point(disc.centre + disc.radius * after.right);
        left_.point(disc.centre + disc.radius * after.left);
        add_disc(disc);
    }

    // Both segments cover the disc but for the wedge on a side where they gape; and for what of it lies
    // behind all of a short segment, which is nearer to the disc before and so in that, and so on.
    void turn_at(const Disc& disc, const Segment& before, const Segment& after) {
        turn_side(right_, disc, before.right, after.right, dot(turned(before.right), after.right) < 0);
        turn_side(left_, disc, before.left, after.left, dot(turned(before.left), after.left) > 0);
    }

    static void turn_side(Pen& pen, const Disc& disc, Vector from, Vector to, bool gapes) {
        if (gapes) return pen.arc(disc, from, to);
        pen.point(disc.centre + disc.radius * from);
        pen.point(disc.centre);
        pen.point(disc.centre + disc.radius * to);
    }

    // One point may stand for the arc, and both segments' sides keep their directions.
    static bool is_smooth(const Disc& disc, Vector from, Vector to, double shorter) {
        return disc.radius * (1 - length(from + to) / 2) <= kFlat &&
               disc.radius * length(to - from) <= shorter / 2;
    }

    void add_ribbon() {
        const Segment &first = segments_.front(), &last = segments_.back();
        right_.arc(discs_.front(), -1.0 * first.along, first.right);
        left_.arc(discs_.front(), -1.0 * first.along, first.left);
        for (std::size_t i = 1; i + 1 < discs_.size(); ++i) join(segments_[i - 1], discs_[i], segments_[i]);
        right_.arc(discs_.back(), last.right, last.along);
        left_.arc(discs_.back(), last.left, last.along);
        Loop loop = right_.take();
        const Loop back = left_.take(true);
        loop.insert(loop.end(), back.begin(), back.end());
        loops_.push_back(std::move(loop));
    }

    void add_ring() {
        const std::size_t n = discs_.size();
        for (std::size_t i = 0; i < n; ++i) join(segments_[(i + n - 1) % n], discs_[i], segments_[i]);
        loops_.push_back(right_.take());
        loops_.push_back(left_.take(true));
    }

    bool closed_;
    std::vector<Disc> discs_;
    std::vector<Segment> segments_;
    Pen right_, left_;
    std::vector<Loop> loops_;
};

}  // namespace

std::vector<Loop> outline_of(const Stroke& stroke) { return Outliner(stroke).loops(); }

}  // namespace keyline
