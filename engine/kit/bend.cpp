// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/bend.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace keyline {

namespace {

// Weighted sums for a parabola in the way s: of s^k, and of s^k times a coordinate.
struct Moments {
    std::array<double, 5> s{};
    std::array<double, 3> x{}, y{};
    int points = 0;

    void add(double way, const MapPoint& p, double weight) {
        double power = weight;
        for (std::size_t k = 0; k < s.size(); ++k, power *= way) {
            s[k] += power;
            if (k >= x.size()) continue;
            x[k] += power * p.x;
            y[k] += power * p.y;
        }
        ++points;
    }
};

struct Parabola {
    double slope = 0, bend = 0;  // the first and the second derivative
};

// By Cramer's rule; `known` is whether there are points enough for it.
Parabola fit(const std::array<double, 5>& s, const std::array<double, 3>& v, bool& known) {
    const double c0 = s[2] * s[4] - s[3] * s[3], c1 = s[1] * s[4] - s[2] * s[3],
                 c2 = s[1] * s[3] - s[2] * s[2];
    const double det = s[0] * c0 - s[1] * c1 + s[2] * c2;
    known = det > 1e-9 * s[0] * s[2] * s[4];
    const double slope = s[0] * (v[1] * s[4] - s[3] * v[2]) - v[0] * c1 + s[2] * (s[1] * v[2] - v[1] * s[2]);
    const double bend = s[0] * (s[2] * v[2] - v[1] * s[3]) - s[1] * (s[1] * v[2] - v[1] * s[2]) + v[0] * c2;
    return {slope / det, 2 * bend / det};
}

class Line {
public:
    Line(std::span<const MapPoint> points, bool closed)
        : points_(points), closed_(closed), way_(points.size() + 1) {
        for (std::size_t i = 1; i <= points.size(); ++i)
            way_[i] = way_[i - 1] + distance(points[i - 1], points[i % points.size()]);
    }
    double length() const { return closed_ ? way_.back() : way_[points_.size() - 1]; }

    Bend at(std::size_t i, double reach) const {
        Moments moments;
        moments.add(0, {}, 1);
        for (const bool back : {true, false}) add_side(i, back, reach, moments);
        bool known = moments.points > 3;
        const Parabola x = fit(moments.s, moments.x, known), y = fit(moments.s, moments.y, known);
        const double speed = std::sqrt(x.slope * x.slope + y.slope * y.slope);
        if (!known || moments.points < 4 || speed < 0.1) return chord(i);
        const double turn = x.slope * y.bend - y.slope * x.bend;
        return {x.slope / speed, y.slope / speed, turn / (speed * speed * speed)};
    }

private:
    static double distance(const MapPoint& a, const MapPoint& b) {
        return std::sqrt((a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y));
    }

    // The points before or behind point i, relative to it.
    void add_side(std::size_t i, bool back, double reach, Moments& moments) const {
        const std::size_t n = points_.size();
        for (std::size_t k = 1; k < n; ++k) {
            if (!closed_ && (back ? k > i : i + k >= n)) return;
            const std::size_t j = back ? (i + n - k) % n : (i + k) % n;
            double way = way_[j] - way_[i];
            if (back && way > 0) way -= way_[n];
            if (!back && way < 0) way += way_[n];
            const double share = way / reach;
            if (std::fabs(share) >= 1) return;
            moments.add(way, {points_[j].x - points_[i].x, points_[j].y - points_[i].y}, 1 - share * share);
        }
    }

    Bend chord(std::size_t i) const {
        const std::size_t n = points_.size();
        const MapPoint& a = points_[i > 0 ? i - 1 : closed_ ? n - 1 : 0];
        const MapPoint& b = points_[i + 1 < n ? i + 1 : closed_ ? 0 : i];
        const double length = distance(a, b);
        return length > 0 ? Bend{(b.x - a.x) / length, (b.y - a.y) / length, 0} : Bend{};
    }

    std::span<const MapPoint> points_;
    bool closed_;
    std::vector<double> way_;  // to each point, and round
};

}  // namespace

std::vector<Bend> bends_of(std::span<const MapPoint> points, bool closed, double reach) {
    std::vector<Bend> out;
    if (points.empty()) return out;
    const Line line(points, closed);
    if (closed) reach = std::min(reach, line.length() / 4);
    for (std::size_t i = 0; i < points.size(); ++i) out.push_back(line.at(i, reach));
    return out;
}

}  // namespace keyline
