// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/bezier.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace keyline {

namespace {

constexpr double kCornerCosine = 0.7;  // a turn of more than 45 degrees
constexpr double kLook = 3;            // directions are taken over so many pixels
constexpr int kRounds = 4;             // of moving the points along the curve

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

class Fitter {
public:
    // Of a closed line the last point is the first.
    Fitter(const std::vector<CurvePoint>& points, bool closed, double tolerance)
        : points_(points), closed_(closed), tolerance_(tolerance) {}

    std::vector<Bezier> fit() {
        const std::size_t last = points_.size() - 1;
        CurvePoint begin = direction(0, last), end = direction(last, 0);
        if (closed_ && turn(points_[last - 1], points_[0], points_[1]) >= kCornerCosine) {
            begin = unit(begin - end);
            end = -1.0 * begin;
        }
        std::size_t from = 0;
        for (std::size_t i = 1; i < last; ++i) {
            if (!is_corner(i)) continue;
            fit_between(from, i, begin, direction(i, from));
            begin = direction(i, last);
            from = i;
        }
        fit_between(from, last, begin, end);
        return std::move(out_);
    }

private:
    // Seen from a point towards another, over a few pixels.
    CurvePoint direction(std::size_t i, std::size_t towards) const {
        std::size_t k = i;
        while (k != towards && length(points_[k] - points_[i]) < kLook) k < towards ? ++k : --k;
        return unit(points_[k] - points_[i]);
    }

    // The sharpest of its neighbours.
    bool is_corner(std::size_t i) const {
        const double c = turn_at(i);
        return c < kCornerCosine && c <= turn_at(i - 1) && c < turn_at(i + 1);
    }
    double turn_at(std::size_t i) const {
        const bool inside = i > 0 && i + 1 < points_.size();
        return inside ? turn(points_[i - 1], points_[i], points_[i + 1]) : 1;
    }
    static double turn(CurvePoint a, CurvePoint b, CurvePoint c) { return dot(unit(b - a), unit(c - b)); }

    void fit_between(std::size_t from, std::size_t to, CurvePoint begin, CurvePoint end) {
        const CurvePoint a = points_[from], b = points_[to];
        if (to - from == 1) return add(straight(a, b));
        std::vector<double> places = along(from, to);
        std::size_t worst = from + 1;
        for (int round = 0; round <= kRounds; ++round) {
            const Cubic c = solve(from, to, begin, end, places);
            double off = 0;
            for (std::size_t i = from + 1; i < to; ++i) {
                const double d = length(at(c, places[i - from]) - points_[i]);
                if (d <= off) continue;
                off = d;
                worst = i;
            }
            if (off <= tolerance_) return add(c);
            for (std::size_t i = from + 1; i < to; ++i)
                places[i - from] = nearer(c, points_[i], places[i - from]);
        }
        const CurvePoint through = unit(direction(worst, to) - direction(worst, from));
        fit_between(from, worst, begin, -1.0 * through);
        fit_between(worst, to, through, end);
    }

    static Cubic straight(CurvePoint a, CurvePoint b) {
        return {a, a + 1.0 / 3 * (b - a), b - 1.0 / 3 * (b - a), b};
    }

    // By the way from point to point, 0 to 1.
    std::vector<double> along(std::size_t from, std::size_t to) const {
        std::vector<double> out(to - from + 1);
        for (std::size_t i = from + 1; i <= to; ++i)
            out[i - from] = out[i - from - 1] + length(points_[i] - points_[i - 1]);
        const double all = out.back();
        for (double& t : out) t = all > 0 ? t / all : 0;
        return out;
    }

    // The handles' lengths by least squares.
    Cubic solve(std::size_t from, std::size_t to, CurvePoint begin, CurvePoint end,
                const std::vector<double>& places) const {
        const CurvePoint a = points_[from], b = points_[to];
        double c00 = 0, c01 = 0, c11 = 0, x0 = 0, x1 = 0;
        for (std::size_t i = from; i <= to; ++i) {
            const double t = places[i - from], s = 1 - t, b1 = 3 * s * s * t, b2 = 3 * s * t * t;
            const CurvePoint u = b1 * begin, v = b2 * end;
            const CurvePoint rest = points_[i] - ((s * s * s + b1) * a + (b2 + t * t * t) * b);
            c00 += dot(u, u);
            c01 += dot(u, v);
            c11 += dot(v, v);
            x0 += dot(u, rest);
            x1 += dot(v, rest);
        }
        const double chord = length(b - a), determinant = c00 * c11 - c01 * c01;
        double first = determinant != 0 ? (x0 * c11 - x1 * c01) / determinant : 0;
        double second = determinant != 0 ? (c00 * x1 - c01 * x0) / determinant : 0;
        const auto is_sound = [&](double handle) { return handle > 1e-3 * chord && handle < 3 * chord; };
        if (!is_sound(first) || !is_sound(second)) first = second = chord / 3;
        return {a, a + first * begin, b + second * end, b};
    }

    // One step of Newton's towards the place on the curve that is nearest to a point.
    static double nearer(const Cubic& c, CurvePoint p, double t) {
        const CurvePoint off = at(c, t) - p, slope = slope_at(c, t);
        const double square = dot(slope, slope) + dot(off, bend_at(c, t));
        return square > 0 ? std::clamp(t - dot(off, slope) / square, 0.0, 1.0) : t;
    }

    void add(const Cubic& c) { out_.push_back({c[1], c[2], c[3]}); }

    const std::vector<CurvePoint>& points_;
    bool closed_;
    double tolerance_;
    std::vector<Bezier> out_;
};

}  // namespace

std::vector<Bezier> fit_beziers(std::vector<CurvePoint> points, bool closed, double tolerance) {
    if (closed && !points.empty()) points.push_back(points.front());
    if (points.size() < 2) return {};
    return Fitter(points, closed, tolerance).fit();
}

}  // namespace keyline
