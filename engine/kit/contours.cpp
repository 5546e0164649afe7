// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/contours.h"

#include "engine/base/index.h"
#include "engine/kit/bend.h"
#include "engine/kit/border_owners.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace keyline {

namespace {

constexpr double kReach = 4;  // pixels of a line that its curvature is told from

// An end of a border at a junction, or a place in its middle.
struct End {
    std::size_t border = 0;
    bool last = false;
};

// A border with what is found out about it.
struct Outline {
    std::vector<OwnedRun> runs;
    std::vector<MapPoint> points;  // of its crossings
    std::vector<Bend> bends;

    const OwnedRun& run_at(bool last) const { return last ? runs.back() : runs.front(); }
};

// Where lines meet: the nearest of those objects whose line goes on there; 0: nobody's does.
struct Meeting {
    std::vector<End> ends;
    uint32_t through = 0;
};

MapPoint operator+(const MapPoint& a, const MapPoint& b) { return {a.x + b.x, a.y + b.y}; }
MapPoint operator-(const MapPoint& a, const MapPoint& b) { return {a.x - b.x, a.y - b.y}; }
MapPoint operator*(double f, const MapPoint& a) { return {f * a.x, f * a.y}; }
double dot(const MapPoint& a, const MapPoint& b) { return a.x * b.x + a.y * b.y; }

MapPoint mean(const std::vector<MapPoint>& points) {
    MapPoint sum;
    for (const MapPoint& p : points) sum = sum + p;
    return 1 / static_cast<double>(points.size()) * sum;
}

// The point between a and b that is nearest to p.
MapPoint foot(const MapPoint& a, const MapPoint& b, const MapPoint& p) {
    const double length2 = dot(b - a, b - a);
    return length2 > 0 ? a + std::clamp(dot(p - a, b - a) / length2, 0.0, 1.0) * (b - a) : a;
}

class Maker {
public:
    Maker(const BorderMap& map, const ContourOptions& options) : map_(map), options_(options) {}

    std::vector<Stroke> make() {
        for (const Border& border : map_.borders)
            outlines_.push_back({runs_of(map_, border, {options_.pixel_angle, options_.step}), {}, {}});
        find_meetings();
        for (std::size_t b = 0; b < outlines_.size(); ++b) place(b);
        undo_blur();
        for (std::size_t b = 0; b < outlines_.size(); ++b)
            for (std::size_t r = 0; r < outlines_[b].runs.size(); ++r) add_stroke(b, r);
        return std::move(strokes_);
    }

private:
    const Border& border(std::size_t b) const { return map_.borders[b]; }
    int junction(End e) const { return border(e.border).ends[e.last ? 1 : 0]; }
    int crossing_at(End e) const {
        return e.last ? border(e.border).crossings.back() : border(e.border).crossings.front();
    }
    const MapPoint& point_at(End e) const {
        return e.last ? outlines_[e.border].points.back() : outlines_[e.border].points.front();
    }
    uint32_t owner_at(End e) const { return outlines_[e.border].run_at(e.last).owner; }

    void find_meetings() {
        meetings_.resize(map_.junctions.size());
        for (std::size_t b = 0; b < outlines_.size(); ++b)
            for (const bool last : {false, true})
                if (!border(b).closed && junction({b, last}) != Border::kRim)
                    meetings_[index(junction({b, last}))].ends.push_back({b, last});
        for (Meeting& m : meetings_) m.through = through(m);
    }

    uint32_t through(const Meeting& meeting) const {
        std::map<uint32_t, std::pair<int, float>> owners;  // how many ends each has, and how near it is
        for (const End& e : meeting.ends) {
            auto& [ends, near] = owners[owner_at(e)];
            ++ends;
            near = std::max(near, map_.side(crossing_at(e), owner_at(e)).near);
        }
        std::pair<float, uint32_t> best{-1.0F, 0};
        for (const auto& [id, of] : owners)
            if (of.first > 1) best = std::max(best, {of.second, id});
        return best.second;
    }

    // Whether a line ends there behind another.
    bool is_occluded(End e) const {
        if (border(e.border).closed || junction(e) == Border::kRim) return false;
        const uint32_t through = meetings_[index(junction(e))].through;
        return through != 0 && through != owner_at(e);
    }

    // The owner is in front of whatever else there is, except near an end where it is itself behind another:
    // there, and where nobody is in front, the two share what the others leave.
    void place(std::size_t b) {
        Outline& outline = outlines_[b];
        const std::vector<int>& crossings = border(b).crossings;
        const bool first = is_occluded({b, false}), last = is_occluded({b, true});
        outline.points.resize(crossings.size());
        for (const OwnedRun& run : outline.runs)
            for (int k = 0; k < run.count; ++k) {
                const std::size_t i = index(run.first + k) % crossings.size();
                const bool shared = run.meets || (2 * i < crossings.size() ? first : last);
                outline.points[i] = map_.at(crossings[i], shared ? 0 : run.owner);
            }
        outline.bends = bends_of(outline.points, border(b).closed, kReach);
    }

    // Blurred, a curve lies too far inside by half its curvature times the variance of the blur.
    void undo_blur() {
        const double variance = blur_variance(), most = 1 / (2 * std::sqrt(variance));
        for (Outline& outline : outlines_)
            for (std::size_t i = 0; i < outline.points.size(); ++i) {
                const Bend& bend = outline.bends[i];
                const double out = variance / 2 * std::clamp(bend.curvature, -most, most);
                outline.points[i] = outline.points[i] + out * MapPoint{bend.ty, -bend.tx};
            }
    }

    // Of the blur and the renderer's filter together: across a straight border the probit of coverage is a
    // straight line, the flatter the wider the blur.  The median over the frame.
    double blur_variance() const {
        std::vector<double> all;
        for (std::size_t b = 0; b < outlines_.size(); ++b)
            for (std::size_t i = 0; i < outlines_[b].bends.size(); ++i) {
                const Crossing& c = map_.crossings[index(border(b).crossings[i])];
                const Bend& bend = outlines_[b].bends[i];
                const double across = c.down ? bend.tx : bend.ty;
                if (std::fabs(across) > 0.5 && std::fabs(bend.curvature) < 0.05)
                    all.push_back(across * across / (double{c.steepness} * double{c.steepness}));
            }
        const double expected = options_.sigma * options_.sigma + 1.0 / 12;
        if (all.empty()) return expected;
        const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
        std::ranges::nth_element(all, middle);
        return std::clamp(*middle, expected / 2, expected * 2);
    }

    // Lines that end at another touch it.
    MapPoint place_of(const Meeting& meeting) const {
        std::vector<MapPoint> through, others;
        for (const End& e : meeting.ends)
            (meeting.through != 0 && owner_at(e) == meeting.through ? through : others)
                .push_back(point_at(e));
        if (through.size() == 2 && !others.empty()) return foot(through[0], through[1], mean(others));
        return mean(through.empty() ? others : through);
    }

    // On along the line, half a pixel from the last centre.
    MapPoint at_rim(End e) const {
        const Bend& bend = e.last ? outlines_[e.border].bends.back() : outlines_[e.border].bends.front();
        const bool down = !map_.crossings[index(crossing_at(e))].down;
        const double along = std::fabs(down ? bend.ty : bend.tx), far = 0.5 / std::max(along, 0.5);
        MapPoint p = point_at(e) + (e.last ? far : -far) * MapPoint{bend.tx, bend.ty};
        const Rect& r = map_.extent;
        if (down)
            p.y = p.y < (r.y0 + r.y1) / 2.0 ? r.y0 : r.y1;
        else
            p.x = p.x < (r.x0 + r.x1) / 2.0 ? r.x0 : r.x1;
        return p;
    }

    StrokeVertex vertex(std::size_t b, std::size_t i, uint32_t owner) const {
        const Outline& outline = outlines_[b];
        StrokeVertex v;
        v.x = outline.points[i].x;
        v.y = outline.points[i].y;
        const double near = double{map_.side(border(b).crossings[i], owner).near};
        v.depth = near > 0 ? 1 / near : 0;
        v.curvature = outline.bends[i].curvature;
        v.epsilon = options_.epsilon;
        return v;
    }

    // The junction or the rim that the border ends at, with what else is known there.
    StrokeVertex end_vertex(End e) const {
        const std::size_t i = e.last ? border(e.border).crossings.size() - 1 : 0;
        StrokeVertex v = vertex(e.border, i, owner_at(e));
        const MapPoint p = junction(e) == Border::kRim ? at_rim(e) : place_of(meetings_[index(junction(e))]);
        v.x = p.x;
        v.y = p.y;
        return v;
    }

    // Where one run ends and the next begins: half way from crossing i on.
    StrokeVertex cut(std::size_t b, const OwnedRun& run, int i) const {
        const std::size_t n = border(b).crossings.size();
        const auto at = [&](int k) { return index(k) % n; };
        const StrokeVertex next = vertex(b, at(i + 1), run.owner);
        StrokeVertex v = vertex(b, at(i + static_cast<int>(n)), run.owner);
        v.x = (v.x + next.x) / 2;
        v.y = (v.y + next.y) / 2;
        return v;
    }

    StrokeEnd kind_of(End e) const {
        if (junction(e) == Border::kRim) return StrokeEnd::kRim;
        return is_occluded(e) ? StrokeEnd::kOccluded : StrokeEnd::kJoined;
    }

    void add_stroke(std::size_t b, std::size_t r) {
        const Border& of = border(b);
        const OwnedRun& run = outlines_[b].runs[r];
        const bool whole = outlines_[b].runs.size() == 1, begins = !of.closed && r == 0,
                   ends = !of.closed && r + 1 == outlines_[b].runs.size();
        Stroke stroke;
        stroke.kind = run.meets ? StrokeKind::kIntersection : StrokeKind::kOutline;
        stroke.near = run.owner;
        stroke.far = run.owner == of.right ? of.left : of.right;
        stroke.closed = of.closed && whole;
        stroke.ends = {StrokeEnd::kJoined, StrokeEnd::kJoined};
        for (int k = 0; k < run.count; ++k)
            stroke.vertices.push_back(vertex(b, index(run.first + k) % of.crossings.size(), run.owner));
        if (!stroke.closed)
            set_ends(stroke.vertices, begins ? end_vertex({b, false}) : cut(b, run, run.first - 1),
                     ends ? end_vertex({b, true}) : cut(b, run, run.first + run.count - 1));
        if (begins) stroke.ends[0] = kind_of({b, false});
        if (ends) stroke.ends[1] = kind_of({b, true});
        if (run.owner == of.left) turn(stroke);
        if (!stroke.closed || length_of(stroke) >= options_.min_length) strokes_.push_back(std::move(stroke));
    }

    // Crossings that lie nearly there would make directions of noise.
    static void set_ends(std::vector<StrokeVertex>& vertices, const StrokeVertex& first,
                         const StrokeVertex& last) {
        constexpr double kNearly = 0.25;  // pixels
        const auto is_near = [](const StrokeVertex& a, const StrokeVertex& b) {
            return std::max(std::fabs(a.x - b.x), std::fabs(a.y - b.y)) < kNearly;
        };
        if (!vertices.empty() && is_near(vertices.front(), first)) vertices.erase(vertices.begin());
        if (!vertices.empty() && is_near(vertices.back(), last)) vertices.pop_back();
        vertices.insert(vertices.begin(), first);
        vertices.push_back(last);
    }

    // So that the owner is on the right.
    static void turn(Stroke& stroke) {
        std::ranges::reverse(stroke.vertices);
        std::swap(stroke.ends[0], stroke.ends[1]);
        for (StrokeVertex& v : stroke.vertices) v.curvature = -v.curvature;
    }

    const BorderMap& map_;
    const ContourOptions& options_;
    std::vector<Outline> outlines_;  // one a border
    std::vector<Meeting> meetings_;  // one a junction
    std::vector<Stroke> strokes_;
};

}  // namespace

std::vector<Stroke> strokes_of(const BorderMap& map, const ContourOptions& options) {
    return Maker(map, options).make();
}

}  // namespace keyline
