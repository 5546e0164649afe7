// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/spline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

namespace keyline {

namespace {

constexpr double kLambda = 200;          // for vertices one pixel apart
constexpr double kPinned = 1e4;          // the weight of a point that stays
constexpr double kLoose = 0.05;          // of those around a corner, which the pixel grid rounds off
constexpr double kArm = 4;               // a corner stands between arms of so many pixels
constexpr double kArmStraight = 0.22;    // that leave a straight line by no more
constexpr double kCornerCosine = 0.819;  // and turn by more than 35 degrees

struct Point {
    double x = 0, y = 0;
    friend Point operator-(Point a, Point b) { return {a.x - b.x, a.y - b.y}; }
};

double dot(Point a, Point b) { return a.x * b.x + a.y * b.y; }
double cross(Point a, Point b) { return a.x * b.y - a.y * b.x; }
double length(Point a) { return std::sqrt(dot(a, a)); }

using Numbers = std::vector<double>;

// A x = b for a symmetric, positive A that has two diagonals beside the main one.
class Pentadiagonal {
public:
    explicit Pentadiagonal(const Numbers& diagonal)
        : main_(diagonal), first_(diagonal.size()), second_(diagonal.size()) {}

    // Adds s v vᵀ for a v of three numbers from i on.
    void add(std::size_t i, double s, const std::array<double, 3>& v) {
        for (std::size_t k = 0; k < 3; ++k) main_[i + k] += s * v[k] * v[k];
        for (std::size_t k = 0; k < 2; ++k) first_[i + k] += s * v[k] * v[k + 1];
        second_[i] += s * v[0] * v[2];
    }

    // Into L D Lᵀ.
    void decompose() {
        for (std::size_t i = 0; i < main_.size(); ++i) {
            if (i >= 1) main_[i] -= main_[i - 1] * first_[i - 1] * first_[i - 1];
            if (i >= 2) main_[i] -= main_[i - 2] * second_[i - 2] * second_[i - 2];
            if (i >= 1) first_[i] -= main_[i - 1] * first_[i - 1] * second_[i - 1];
            first_[i] /= main_[i];
            second_[i] /= main_[i];
        }
    }

    Numbers solve(Numbers b) const {
        const std::size_t n = b.size();
        for (std::size_t i = 0; i < n; ++i) {
            if (i >= 1) b[i] -= first_[i - 1] * b[i - 1];
            if (i >= 2) b[i] -= second_[i - 2] * b[i - 2];
        }
        for (std::size_t i = 0; i < n; ++i) b[i] /= main_[i];
        for (std::size_t i = n; i-- > 0;) {
            if (i + 1 < n) b[i] -= first_[i] * b[i + 1];
            if (i + 2 < n) b[i] -= second_[i] * b[i + 2];
        }
        return b;
    }

private:
    Numbers main_, first_, second_;
};

// An open row of points on its way to be smooth.
class Smoother {
public:
    Smoother(std::vector<Point> points, double noise, double stiffness)
        : points_(std::move(points)),
          noise_(noise),
          lambda_(kLambda * stiffness * stiffness * stiffness * stiffness) {
        const std::size_t n = points_.size();
        weights_.assign(n, 1);
        bends_.assign(n, 1);
        arcs_.assign(n, 0);
        for (std::size_t i = 1; i < n; ++i)
            arcs_[i] = arcs_[i - 1] + std::max(1e-3, length(points_[i] - points_[i - 1]));
    }

    void pin(std::size_t i) { weights_[i] = kPinned; }

    void keep_corners() {
        const std::size_t n = points_.size();
        Numbers tips(n, 0);
        for (std::size_t i = 2; i + 2 < n; ++i) {
            const double cosine = corner_cosine(i);
            if (cosine < kCornerCosine && is_pointed(i, cosine)) tips[i] = tip(i);
        }
        for (std::size_t i = 2; i + 2 < n; ++i) {
            if (tips[i] == 0 || !is_sharpest(tips, i)) continue;
            bends_[i] = 0;
            for (const std::size_t k : {i - 1, i, i + 1}) weights_[k] = std::min(weights_[k], kLoose);
        }
    }

    const std::vector<Point>& smooth() {
        constexpr int kRounds = 3;
        for (int round = 0; round < kRounds; ++round) {
            solve();
            if (round + 1 < kRounds) give_way();
        }
        for (std::size_t i = 0; i < out_.size(); ++i) {
            const Point off = out_[i] - points_[i];
            const double share = std::min(1.0, 3 * noise_ / std::max(length(off), 1e-12));
            if (bends_[i] > 0) out_[i] = {points_[i].x + share * off.x, points_[i].y + share * off.y};
        }
        return out_;
    }

private:
    // Of the turn between the arms on both sides; 1 where they are bent or not there.
    double corner_cosine(std::size_t i) const {
        const auto arm = [&](std::ptrdiff_t step) -> std::optional<Point> {
            const auto n = static_cast<std::ptrdiff_t>(points_.size());
            std::ptrdiff_t k = static_cast<std::ptrdiff_t>(i) + step;
            const auto far = [&] { return std::fabs(arcs_[static_cast<std::size_t>(k)] - arcs_[i]); };
            if (k < 0 || k >= n) return {};
            const std::ptrdiff_t first = k;
            while (k >= 0 && k < n && far() < kArm) k += step;
            if (k < 0 || k >= n) return {};
            const Point from = points_[static_cast<std::size_t>(first)],
                        way = points_[static_cast<std::size_t>(k)] - from;
            const double straight = std::max(kArmStraight, noise_);
            for (std::ptrdiff_t j = first; j != k; j += step)
                if (std::fabs(cross(points_[static_cast<std::size_t>(j)] - from, way)) >
                    straight * length(way))
                    return {};
            return way;
        };
        const auto before = arm(-1), after = arm(1);
        if (!before || !after) return 1;
        return -dot(*before, *after) / std::max(1e-12, length(*before) * length(*after));
    }

    // How far a point stands out of the line past it.
    double tip(std::size_t i) const {
        const Point chord = points_[i + 2] - points_[i - 2];
        return std::fabs(cross(points_[i] - points_[i - 2], chord)) / std::max(1e-12, length(chord));
    }

    // Whether the turn is at the point: of an arc that turns as much over both arms, it stands out less than
    // half as far.
    bool is_pointed(std::size_t i, double cosine) const {
        const double side =
            std::min(length(points_[i] - points_[i - 2]), length(points_[i + 2] - points_[i]));
        return tip(i) > 0.7 * side * std::sqrt((1 - cosine) / 2);
    }

    bool is_sharpest(const Numbers& tips, std::size_t i) const {
        for (std::size_t k = i; k-- > 0 && arcs_[i] - arcs_[k] < kArm;)
            if (tips[k] >= tips[i]) return false;
        for (std::size_t k = i + 1; k < tips.size() && arcs_[k] - arcs_[i] < kArm; ++k)
            if (tips[k] > tips[i]) return false;
        return true;
    }

    void solve() {
        const std::size_t n = points_.size();
        Pentadiagonal matrix(weights_);
        for (std::size_t i = 1; i + 1 < n; ++i) {
            const double before = arcs_[i] - arcs_[i - 1], after = arcs_[i + 1] - arcs_[i],
                         both = before + after;
            const double a = 2 / (before * both), c = 2 / (after * both);
            matrix.add(i - 1, lambda_ * bends_[i] * both / 2, {a, -(a + c), c});
        }
        matrix.decompose();
        Numbers x(n), y(n);
        for (std::size_t i = 0; i < n; ++i) {
            x[i] = weights_[i] * points_[i].x;
            y[i] = weights_[i] * points_[i].y;
        }
        x = matrix.solve(std::move(x));
        y = matrix.solve(std::move(y));
        out_.resize(n);
        for (std::size_t i = 0; i < n; ++i) out_[i] = {x[i], y[i]};
    }

    // Where points together deviate by more than the noise, it is shape, and all around gives way: what bends
    // easily in one place only would bend there in a kink.
    void give_way() {
        constexpr std::size_t kMean = 3, kAround = 6;
        const std::size_t n = points_.size();
        Numbers factors(n);
        for (std::size_t i = 0; i < n; ++i) {
            const std::size_t from = i < kMean ? 0 : i - kMean, to = std::min(n, i + kMean + 1);
            double sum = 0;
            for (std::size_t k = from; k < to; ++k) sum += length(out_[k] - points_[k]);
            const double off = sum / static_cast<double>(to - from) / noise_, square = off * off;
            factors[i] = 1 / (1 + square * square);
        }
        for (std::size_t i = 0; i < n; ++i) {
            const auto begin = factors.begin() + static_cast<std::ptrdiff_t>(i < kAround ? 0 : i - kAround);
            const auto end = factors.begin() + static_cast<std::ptrdiff_t>(std::min(n, i + kAround + 1));
            bends_[i] *= *std::min_element(begin, end);
        }
    }

    std::vector<Point> points_, out_;
    double noise_, lambda_;
    Numbers weights_, bends_, arcs_;
};

void set_curvature(Stroke& s) {
    const std::size_t n = s.vertices.size();
    if (n < 3) return;
    const auto at = [&](std::size_t i) { return Point{s.vertices[i % n].x, s.vertices[i % n].y}; };
    for (std::size_t i = s.closed ? 0 : 1; i + (s.closed ? 0 : 1) < n; ++i) {
        const Point before = at(i) - at(i + n - 1), after = at(i + 1) - at(i),
                    chord = at(i + 1) - at(i + n - 1);
        // Of the circle through the three.
        const double sides = length(before) * length(after) * length(chord);
        s.vertices[i].curvature = sides > 0 ? 2 * cross(before, after) / sides : 0;
    }
    if (s.closed) return;
    s.vertices.front().curvature = s.vertices[1].curvature;
    s.vertices.back().curvature = s.vertices[n - 2].curvature;
}

}  // namespace

void smooth(Stroke& stroke, double noise, double stiffness) {
    const std::size_t n = stroke.vertices.size();
    if (n < 5 || !(noise > 0)) return;
    // A closed stroke goes round until what is far no longer matters.
    const auto pad = stroke.closed ? static_cast<std::size_t>(60 * stiffness) : 0;
    std::vector<Point> points(n + 2 * pad);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const StrokeVertex& v = stroke.vertices[(i + n - pad % n) % n];
        points[i] = {v.x, v.y};
    }
    Smoother smoother(std::move(points), noise, stiffness);
    if (!stroke.closed && stroke.ends[0] == StrokeEnd::kJoined) smoother.pin(0);
    if (!stroke.closed && stroke.ends[1] == StrokeEnd::kJoined) smoother.pin(n - 1);
    smoother.keep_corners();
    const std::vector<Point>& smoothed = smoother.smooth();
    for (std::size_t i = 0; i < n; ++i) {
        stroke.vertices[i].x = smoothed[i + pad].x;
        stroke.vertices[i].y = smoothed[i + pad].y;
    }
    set_curvature(stroke);
}

}  // namespace keyline
