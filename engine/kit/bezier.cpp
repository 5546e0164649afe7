// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/bezier.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

namespace keyline {

namespace {

constexpr double kCornerCosine = 0.7;  // a turn of more than 45 degrees
constexpr double kArm = 1.5;           // between arms of so many pixels
constexpr double kLook = 3;            // directions are taken over so many pixels on either side
constexpr int kRounds = 4;             // of moving the points along the curve
constexpr double kHopeless = 20;       // what is so many times too far off won't come near in them

CurvePoint operator+(CurvePoint a, CurvePoint b) { return {a.x + b.x, a.y + b.y}; }
CurvePoint operator-(CurvePoint a, CurvePoint b) { return {a.x - b.x, a.y - b.y}; }
CurvePoint operator*(double s, CurvePoint a) { return {s * a.x, s * a.y}; }
double dot(CurvePoint a, CurvePoint b) { return a.x * b.x + a.y * b.y; }
double length(CurvePoint a) { return std::sqrt(dot(a, a)); }
CurvePoint unit(CurvePoint a) {
    const double l = length(a);
    return l > 0 ? 1 / l * a : CurvePoint{};
}

using Cubic = std::array<CurvePoint, 4>;

CurvePoint at(const Cubic& c, double t) {
    const double s = 1 - t;
    return s * s * s * c[0] + 3 * s * s * t * c[1] + 3 * s * t * t * c[2] + t * t * t * c[3];
}
CurvePoint slope_at(const Cubic& c, double t) {
    const double s = 1 - t;
    return 3 * s * s * (c[1] - c[0]) + 6 * s * t * (c[2] - c[1]) + 3 * t * t * (c[3] - c[2]);
}
CurvePoint bend_at(const Cubic& c, double t) {
    return 6 * (1 - t) * (c[2] - 2 * c[1] + c[0]) + 6 * t * (c[3] - 2 * c[2] + c[1]);
}

// How a curve may leave an end: along one direction, or along any.
struct Tangent {
    CurvePoint along;  // of length 1
    bool is_free = false;
};

// A symmetric system of equations for what the handles of one curve are.
class Handles {
public:
    // Two numbers of a free handle, one of another.
    Handles(const Tangent& begin, const Tangent& end) {
        add(0, begin);
        add(1, end);
    }

    // A point of the curve lies `rest` from where it would be with handles of no length.
    void add(CurvePoint rest, double of_begin, double of_end) {
        const std::array<double, 2> share{of_begin, of_end};
        for (std::size_t i = 0; i < count_; ++i) {
            const double here = share[handle_[i]];
            for (std::size_t k = 0; k <= i; ++k)
                left_[i][k] += here * share[handle_[k]] * dot(way_[i], way_[k]);
            right_[i] += here * dot(way_[i], rest);
        }
    }

    // By Cholesky's way; nothing where the points don't tell them.
    std::optional<std::array<CurvePoint, 2>> solve() {
        for (std::size_t i = 0; i < count_; ++i) {
            const double whole = left_[i][i];
            for (std::size_t k = 0; k <= i; ++k) {
                for (std::size_t j = 0; j < k; ++j) left_[i][k] -= left_[i][j] * left_[k][j];
                if (k < i) left_[i][k] /= left_[k][k];
            }
            if (!(left_[i][i] > 1e-9 * whole)) return {};
            left_[i][i] = std::sqrt(left_[i][i]);
        }
        for (std::size_t i = 0; i < count_; ++i) {
            for (std::size_t k = 0; k < i; ++k) right_[i] -= left_[i][k] * right_[k];
            right_[i] /= left_[i][i];
        }
        for (std::size_t i = count_; i-- > 0;) {
            for (std::size_t k = i + 1; k < count_; ++k) right_[i] -= left_[k][i] * right_[k];
            right_[i] /= left_[i][i];
        }
        std::array<CurvePoint, 2> out{};
        for (std::size_t i = 0; i < count_; ++i) out[handle_[i]] = out[handle_[i]] + right_[i] * way_[i];
        return out;
    }

private:
    void add(std::size_t handle, const Tangent& tangent) {
        if (!tangent.is_free) return add(handle, tangent.along);
        add(handle, CurvePoint{1, 0});
        add(handle, CurvePoint{0, 1});
    }
    void add(std::size_t handle, CurvePoint way) {
        handle_[count_] = handle;
        way_[count_++] = way;
    }

    std::size_t count_ = 0;
    std::array<std::size_t, 4> handle_{};
    std::array<CurvePoint, 4> way_{};
    std::array<std::array<double, 4>, 4> left_{};
    std::array<double, 4> right_{};
};

class Fitter {
public:
    // Of a closed line the last point is the first.
    Fitter(std::vector<CurvePoint> points, bool closed, double tolerance)
        : points_(std::move(points)), closed_(closed), tolerance_(tolerance), way_(points_.size()) {
        for (std::size_t i = 1; i < points_.size(); ++i)
            way_[i] = way_[i - 1] + length(points_[i] - points_[i - 1]);
    }

    std::vector<Bezier> fit() {
        const std::size_t last = points_.size() - 1;
        const std::vector<std::size_t> corners = find_corners();
        std::size_t from = 0;
        for (const std::size_t corner : corners) {
            fit_between(from, corner, {{}, true}, {{}, true});
            from = corner;
        }
        const bool goes_round = closed_ && corners.empty() && turn(last - 1, 0, 1) > kCornerCosine;
        const Tangent seam = goes_round ? Tangent{through_seam(), false} : Tangent{{}, true};
        fit_between(from, last, seam, {-1.0 * seam.along, seam.is_free});
        return std::move(out_);
    }

private:
    double turn(std::size_t before, std::size_t i, std::size_t after) const {
        return dot(unit(points_[i] - points_[before]), unit(points_[after] - points_[i]));
    }

    // Over arms long enough that what points are off does not look like a turn.
    double turn_at(std::size_t i) const {
        std::size_t before = i, after = i;
        while (before > 0 && way_[i] - way_[before] < kArm) --before;
        while (after + 1 < points_.size() && way_[after] - way_[i] < kArm) ++after;
        return before < i && i < after ? turn(before, i, after) : 1;
    }

    // The sharpest within an arm's length; the first of those that are as sharp.
    std::vector<std::size_t> find_corners() const {
        std::vector<double> turns;
        for (std::size_t i = 0; i < points_.size(); ++i) turns.push_back(turn_at(i));
        const auto is_sharpest = [&](std::size_t i) {
            for (std::size_t k = i; k-- > 0 && way_[i] - way_[k] <= kArm;)
                if (turns[k] <= turns[i]) return false;
            for (std::size_t k = i + 1; k < turns.size() && way_[k] - way_[i] <= kArm; ++k)
                if (turns[k] < turns[i]) return false;
            return true;
        };
        std::vector<std::size_t> out;
        for (std::size_t i = 1; i + 1 < points_.size(); ++i)
            if (turns[i] < kCornerCosine && is_sharpest(i)) out.push_back(i);
        return out;
    }

    // The direction in which the line runs through a point between two others: of the parabola through what
    // is near.
    CurvePoint through(std::size_t i, std::size_t from, std::size_t to) const {
        std::size_t first = i, last = i;
        while (first > from && way_[i] - way_[first] < kLook) --first;
        while (last < to && way_[last] - way_[i] < kLook) ++last;
        return slope(first, last, way_[i]);
    }

    // By least squares.
    CurvePoint slope(std::size_t first, std::size_t last, double at) const {
        double s1 = 0, s2 = 0, s3 = 0, s4 = 0;
        CurvePoint p0, p1, p2;
        const auto n = static_cast<double>(last - first + 1);
        for (std::size_t k = first; k <= last; ++k) {
            const double s = way_[k] - at;
            const CurvePoint p = points_[k] - points_[first];
            s1 += s, s2 += s * s, s3 += s * s * s, s4 += s * s * s * s;
            p0 = p0 + p, p1 = p1 + s * p, p2 = p2 + s * s * p;
        }
        const double c0 = s2 * s4 - s3 * s3, c1 = s1 * s4 - s2 * s3, c2 = s1 * s3 - s2 * s2;
        const double determinant = n * c0 - s1 * c1 + s2 * c2;
        if (!(determinant > 1e-9 * n * s2 * s4)) return unit(points_[last] - points_[first]);
        return unit((n * s4 - s2 * s2) * p1 + (s1 * s2 - n * s3) * p2 + -c1 * p0);
    }

    CurvePoint through_seam() const {
        const std::size_t last = points_.size() - 1;
        std::size_t before = last, after = 0;
        while (before > 0 && way_[last] - way_[before] < kLook) --before;
        while (after < last && way_[after] < kLook) ++after;
        return unit(points_[after] - points_[before]);
    }

    // The longest curve, and the next from there on.
    void fit_between(std::size_t first, std::size_t to, Tangent begin, const Tangent& end) {
        const auto ends = [&](std::size_t i) {
            return i == to ? end : Tangent{-1.0 * through(i, first, to), false};
        };
        for (std::size_t from = first; from < to;) {
            std::size_t good = from + 1;
            Cubic best = straight(points_[from], points_[good]);
            const auto reaches = [&](std::size_t i) {
                const auto c = curve(from, i, begin, ends(i));
                if (!c) return false;
                best = *c;
                good = i;
                return true;
            };
            if (!reaches(to)) {
                std::size_t bad = to;
                for (std::size_t step = 4; good + step < bad; step *= 2)
                    if (!reaches(good + step)) bad = good + step;
                while (bad - good > 1)
                    if (const std::size_t middle = (good + bad) / 2; !reaches(middle)) bad = middle;
            }
            out_.push_back({best[1], best[2], best[3]});
            begin = {-1.0 * ends(good).along, ends(good).is_free};
            from = good;
        }
    }

    // Nothing where none is near enough to the points between.
    std::optional<Cubic> curve(std::size_t from, std::size_t to, const Tangent& begin,
                               const Tangent& end) const {
        if (to - from == 1) return straight(points_[from], points_[to]);
        std::vector<double> places = along(from, to);
        for (int round = 0; round <= kRounds; ++round) {
            const std::optional<Cubic> c = solve(from, to, begin, end, places);
            if (!c) return {};
            double off = 0;
            for (std::size_t i = from + 1; i < to; ++i)
                off = std::max(off, length(at(*c, places[i - from]) - points_[i]));
            if (off <= tolerance_) return c;
            if (off > kHopeless * tolerance_) return {};
            for (std::size_t i = from + 1; i < to; ++i)
                places[i - from] = nearer(*c, points_[i], places[i - from]);
        }
        return {};
    }

    static Cubic straight(CurvePoint a, CurvePoint b) {
        return {a, a + 1.0 / 3 * (b - a), b - 1.0 / 3 * (b - a), b};
    }

    // By the way from point to point, 0 to 1.
    std::vector<double> along(std::size_t from, std::size_t to) const {
        std::vector<double> out;
        const double all = way_[to] - way_[from];
        for (std::size_t i = from; i <= to; ++i) out.push_back(all > 0 ? (way_[i] - way_[from]) / all : 0);
        return out;
    }

    // The handles by least squares.
    std::optional<Cubic> solve(std::size_t from, std::size_t to, const Tangent& begin, const Tangent& end,
                               const std::vector<double>& places) const {
        const CurvePoint a = points_[from], b = points_[to];
        // Two points between the ends don't tell four numbers.
        const bool few = to - from < 4;
        const auto held = [&](const Tangent& t, CurvePoint along) {
            return t.is_free && few ? Tangent{along, false} : t;
        };
        const Tangent first = held(begin, unit(points_[from + 1] - a)),
                      second = held(end, unit(points_[to - 1] - b));
        Handles handles(first, second);
        for (std::size_t i = from + 1; i < to; ++i) {
            const double t = places[i - from], s = 1 - t, b1 = 3 * s * s * t, b2 = 3 * s * t * t;
            handles.add(points_[i] - ((s * s * s + b1) * a + (b2 + t * t * t) * b), b1, b2);
        }
        const auto found = handles.solve();
        const double way = way_[to] - way_[from];
        const auto is_sound = [&](CurvePoint handle, const Tangent& t) {
            return length(handle) < way && (t.is_free || dot(handle, t.along) > 1e-3 * way);
        };
        if (found && is_sound((*found)[0], first) && is_sound((*found)[1], second))
            return Cubic{a, a + (*found)[0], b + (*found)[1], b};
        if (first.is_free || second.is_free) return {};
        return Cubic{a, a + way / 3 * first.along, b + way / 3 * second.along, b};
    }

    // One step of Newton's towards the place on the curve that is nearest to a point.
    static double nearer(const Cubic& c, CurvePoint p, double t) {
        const CurvePoint off = at(c, t) - p, slope = slope_at(c, t);
        const double square = dot(slope, slope) + dot(off, bend_at(c, t));
        return square > 0 ? std::clamp(t - dot(off, slope) / square, 0.0, 1.0) : t;
    }

    std::vector<CurvePoint> points_;
    bool closed_;
    double tolerance_;
    std::vector<double> way_;  // to each point
    std::vector<Bezier> out_;
};

// Between points that are far apart a curve could go anywhere.
std::vector<CurvePoint> with_points_between(const std::vector<CurvePoint>& points) {
    constexpr double kMost = 64;  // between two
    std::vector<CurvePoint> out{points.front()};
    for (std::size_t i = 1; i < points.size(); ++i) {
        const CurvePoint a = points[i - 1], way = points[i] - a;
        const int parts = static_cast<int>(std::clamp(std::ceil(length(way)), 1.0, kMost));
        for (int k = 1; k < parts; ++k) out.push_back(a + static_cast<double>(k) / parts * way);
        out.push_back(points[i]);
    }
    return out;
}

}  // namespace

std::vector<Bezier> fit_beziers(std::vector<CurvePoint> points, bool closed, double tolerance) {
    if (closed && !points.empty()) points.push_back(points.front());
    if (points.size() < 2) return {};
    return Fitter(with_points_between(points), closed, tolerance).fit();
}

}  // namespace keyline
