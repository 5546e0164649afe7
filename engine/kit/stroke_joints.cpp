// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/stroke_joints.h"

#include "engine/base/index.h"
#include "engine/kit/stroke_index.h"
#include "engine/simd/elementary.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

namespace keyline {

namespace {

constexpr double kMeets = 0.5;        // pixels between ends that are one point
constexpr double kSharpest = 0;       // cosine of the sharpest turn of a line that goes on at a point
constexpr double kShare = 3;          // a stroke is so many times longer than a gap beside it
constexpr double kStraightReach = 2;  // how much farther a line that ends straight goes on to one ahead
constexpr double kRoot = 1;           // pixels that something thin may end before what it grows out of
constexpr double kTangent = 3;        // pixels of a stroke that the direction of its end is told from

struct End {
    int stroke = -1, last = 0;
    friend auto operator<=>(const End&, const End&) = default;
};

// Where an end is, and in which direction it points.
struct Tip {
    End end;
    double x = 0, y = 0, tx = 0, ty = 0;
};

struct Joint {
    double cost = 0;
    End a, b;
    friend bool operator<(const Joint& p, const Joint& q) {
        return std::tie(p.cost, p.a, p.b) < std::tie(q.cost, q.a, q.b);
    }
};

Tip tip_of(const Stroke& s, End e) {
    const std::size_t n = s.vertices.size();
    const auto from_end = [&](std::size_t k) { return s.vertices[e.last ? n - 1 - k : k]; };
    const StrokeVertex tip = from_end(0);
    std::size_t k = 1;
    double length = 0, x = 0, y = 0;
    for (; k < n && length < kTangent; ++k) {
        x = tip.x - from_end(k).x;
        y = tip.y - from_end(k).y;
        length = std::sqrt(x * x + y * y);
    }
    return length > 0 ? Tip{e, tip.x, tip.y, x / length, y / length} : Tip{e, tip.x, tip.y, 0, 0};
}

// Whether the last vertices of a stroke before an end lie in a row, so that it is known where it goes on.
bool is_straight(const Stroke& s, bool last) {
    constexpr std::size_t kRow = 10;
    constexpr double kShake = 0.12;  // pixels, rms
    const std::size_t n = s.vertices.size();
    if (n <= kRow) return false;
    const auto from_end = [&](std::size_t k) { return s.vertices[last ? n - 1 - k : k]; };
    const StrokeVertex tip = from_end(0);
    const double x = from_end(kRow).x - tip.x, y = from_end(kRow).y - tip.y, length2 = x * x + y * y;
    double sum = 0;
    for (std::size_t k = 1; k < kRow; ++k) {
        const double off = (from_end(k).x - tip.x) * y - (from_end(k).y - tip.y) * x;
        sum += off * off;
    }
    return length2 > 0 && sum / length2 < kShake * kShake * kRow;
}

// How far an end goes on.  The middle of something thin is found up to where that ends.
double reach_of(const Stroke& s, bool last, double reach) {
    const double thickness = (last ? s.vertices.back() : s.vertices.front()).thickness;
    if (thickness > 0) return std::min(reach, thickness + kRoot);
    return is_straight(s, last) ? kStraightReach * reach : reach;
}

class Joiner {
public:
    Joiner(std::vector<Stroke> strokes, double gap, double angle)
        : strokes_(std::move(strokes)),
          gap_(gap),
          least_(elementary::sin_cos_degrees(angle).cos),
          mates_(strokes_.size()) {}

    std::vector<Stroke> join() {
        choose();
        seen_.assign(strokes_.size(), false);
        std::vector<Stroke> out;
        for (int s = 0; s < static_cast<int>(strokes_.size()); ++s)
            for (const int last : {0, 1})
                if (!seen_[index(s)] && mate({s, last}).stroke < 0) out.push_back(follow({s, last}));
        for (int s = 0; s < static_cast<int>(strokes_.size()); ++s)
            if (!seen_[index(s)]) out.push_back(close(follow({s, 0})));
        return out;
    }

private:
    const Stroke& of(End e) const { return strokes_[index(e.stroke)]; }
    End& mate(End e) { return mates_[index(e.stroke)][index(e.last)]; }

    std::vector<Tip> tips() const {
        std::vector<Tip> out;
        for (int s = 0; s < static_cast<int>(strokes_.size()); ++s)
            for (const int last : {0, 1}) {
                const StrokeEnd kind = strokes_[index(s)].ends[index(last)];
                if (!strokes_[index(s)].closed && (kind == StrokeEnd::kEnd || kind == StrokeEnd::kJoined))
                    out.push_back(tip_of(strokes_[index(s)], {s, last}));
            }
        std::ranges::sort(
            out, [](const Tip& a, const Tip& b) { return std::tie(a.y, a.end) < std::tie(b.y, b.end); });
        return out;
    }

    void choose() {
        const std::vector<Tip> all = tips();
        const double reach = std::max(gap_, kMeets);
        std::vector<Joint> joints;
        for (std::size_t i = 0; i < all.size(); ++i)
            for (std::size_t k = i + 1; k < all.size() && all[k].y <= all[i].y + reach; ++k)
                add(all[i], all[k], joints);
        std::ranges::sort(joints, std::less<>());
        for (const Joint& j : joints) {
            if (mate(j.a).stroke >= 0 || mate(j.b).stroke >= 0) continue;
            mate(j.a) = j.b;
            mate(j.b) = j.a;
        }
    }

    void add(const Tip& a, const Tip& b, std::vector<Joint>& joints) const {
        const Stroke &p = of(a.end), &q = of(b.end);
        if (p.kind != q.kind || p.near != q.near) return;
        // Whose owner is on the right stays so.
        if (p.kind <= StrokeKind::kIntersection && a.end.last == b.end.last) return;
        if (a.end.stroke == b.end.stroke && p.vertices.size() < 4) return;
        const double x = b.x - a.x, y = b.y - a.y, distance = std::sqrt(x * x + y * y);
        double cosine = -(a.tx * b.tx + a.ty * b.ty);
        const bool meets = distance < kMeets;
        if (!meets)
            cosine = std::min({cosine, (a.tx * x + a.ty * y) / distance, -(b.tx * x + b.ty * y) / distance});
        const double widest = std::min(gap_, std::min(length_of(p), length_of(q)) / kShare);
        if (cosine < (meets ? kSharpest : least_) || (!meets && distance > widest)) return;
        const double reach = std::max(gap_, kMeets);
        joints.push_back({0.8 * (1 - cosine) / std::max(1 - least_, 1e-3) +
                              0.2 * distance * distance / (4 * reach * reach),
                          std::min(a.end, b.end), std::max(a.end, b.end)});
    }

    // Everything from an end on; round, where it comes back.
    Stroke follow(End e) {
        Stroke out;
        double longest = -1;
        for (bool first = true;; first = false) {
            seen_[index(e.stroke)] = true;
            Stroke part = strokes_[index(e.stroke)];
            if (e.last) turn(part);
            if (first)
                out = part;
            else
                append(out, part);
            if (const double length = length_of(part); length > longest) {
                longest = length;
                out.far = part.far;
            }
            const End on = mate({e.stroke, 1 - e.last});
            if (on.stroke < 0 || seen_[index(on.stroke)]) return out;
            e = on;
        }
    }

    static void turn(Stroke& s) {
        std::ranges::reverse(s.vertices);
        std::swap(s.ends[0], s.ends[1]);
        for (StrokeVertex& v : s.vertices) v.curvature = -v.curvature;
    }

    static double distance(const StrokeVertex& a, const StrokeVertex& b) {
        return std::sqrt((a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y));
    }

    // From a on to b, for `share` of the way.
    static StrokeVertex between(const StrokeVertex& a, const StrokeVertex& b, double share) {
        using Numbers = std::array<double, StrokeVertex::kNumbers>;
        auto p = std::bit_cast<Numbers>(a);
        const auto q = std::bit_cast<Numbers>(b);
        for (std::size_t i = 0; i < p.size(); ++i) p[i] += share * (q[i] - p[i]);
        return std::bit_cast<StrokeVertex>(p);
    }

    // A vertex a pixel across the gap; ends that meet are one vertex.  `next` may be one of `to`, which
    // grows.
    static void bridge(std::vector<StrokeVertex>& to, StrokeVertex next) {
        const StrokeVertex last = to.back();
        const double length = distance(last, next);
        if (length < kMeets) {
            to.back() = between(last, next, 0.5);
            return;
        }
        const int steps = static_cast<int>(std::ceil(length));
        for (int k = 1; k <= steps; ++k) to.push_back(between(last, next, static_cast<double>(k) / steps));
    }

    static void append(Stroke& to, const Stroke& part) {
        bridge(to.vertices, part.vertices.front());
        to.vertices.insert(to.vertices.end(), part.vertices.begin() + 1, part.vertices.end());
        to.ends[1] = part.ends[1];
        if (part.anchor != to.anchor) to.anchor = StrokeAnchor::kNone;
    }

    static Stroke close(Stroke s) {
        bridge(s.vertices, s.vertices.front());
        s.vertices.front() = s.vertices.back();
        s.vertices.pop_back();
        s.closed = true;
        return s;
    }

    std::vector<Stroke> strokes_;
    double gap_, least_;
    std::vector<std::array<End, 2>> mates_;  // by stroke and end
    std::vector<bool> seen_;
};

}  // namespace

void meet_strokes(std::vector<Stroke>& strokes, double reach) {
    StrokeIndex all(0);
    for (const Stroke& s : strokes) all.add(s);
    for (int s = 0; s < static_cast<int>(strokes.size()); ++s) {
        Stroke& stroke = strokes[index(s)];
        const double length = length_of(stroke);
        for (const int last : {0, 1}) {
            if (stroke.closed || stroke.ends[index(last)] != StrokeEnd::kEnd) continue;
            const Tip tip = tip_of(stroke, {s, last});
            const double most = std::min(reach_of(stroke, last != 0, reach), length / kShare);
            const double ahead = all.ahead({tip.x, tip.y, tip.tx, tip.ty, stroke.kind}, most, s);
            if (!(ahead <= most)) continue;
            StrokeVertex v = last ? stroke.vertices.back() : stroke.vertices.front();
            v.x += ahead * tip.tx;
            v.y += ahead * tip.ty;
            stroke.vertices.insert(last ? stroke.vertices.end() : stroke.vertices.begin(), v);
            stroke.ends[index(last)] = StrokeEnd::kJoined;
        }
    }
}

std::vector<Stroke> join_strokes(std::vector<Stroke> strokes, double gap, double angle) {
    return Joiner(std::move(strokes), gap, angle).join();
}

}  // namespace keyline
