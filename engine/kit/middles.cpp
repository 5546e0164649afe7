// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/middles.h"

#include "engine/base/index.h"
#include "engine/kit/borders.h"
#include "engine/kit/piece_index.h"
#include "engine/kit/point_chains.h"
#include "engine/kit/spline.h"
#include "engine/kit/stroke_joints.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

namespace keyline {

namespace {

constexpr int kAround = 4;         // points on either side that a width and a depth are told from
constexpr double kSlender = 12;    // a thing is thin that is so many times as long as wide
constexpr double kGap = 4;         // pixels between two parts of one thing, where noise has cut it
constexpr double kTurn = 40;       // degrees that it may turn there
constexpr double kFaint = 0.25;    // pixels: what is thinner fades
constexpr double kHem = 0.75;      // pixels that an outline may lie outside of its thing
constexpr double kTouches = 0.05;  // pixels from a middle: on it
constexpr double kTouch = 1.25;    // pixels from a thin thing to the end of a line behind it
constexpr double kEnd = 3;         // pixels from an outline that is cut to the end that it goes on from
constexpr double kCap = 12;        // pixels of outline around such an end
constexpr std::size_t kCrumb = 3;  // vertices of an outline that are no line of their own
constexpr double kRimReach = 5;    // pixels

auto order_of(const ThinPoint& p) { return std::pair(p.at.y, p.at.x); }

// What of a chain is thin, from point to point.
struct Run {
    std::size_t begin = 0, end = 0;
};

class Maker {
public:
    Maker(std::vector<ThinPoint> points, const MiddleOptions& options)
        : points_(std::move(points)), options_(options) {
        std::ranges::sort(points_, {}, order_of);
    }

    Middles make() {
        std::vector<LinePoint> places;
        for (const ThinPoint& p : points_) places.push_back(p.at);
        for (const PointChain& chain : link_points(std::move(places), false, 0)) add(chain);
        finish(middles_.things);
        finish(middles_.gaps);
        return std::move(middles_);
    }

private:
    const ThinPoint& of(const LinePoint& p) const {
        return *std::ranges::lower_bound(points_, std::pair(p.y, p.x), {}, order_of);
    }

    void add(const PointChain& chain) {
        const std::vector<double> widths = strengths_along(chain, kAround);
        const bool whole = std::ranges::all_of(widths, [&](double w) { return w < options_.widest; });
        if (whole) return add_run(chain, widths, {0, chain.points.size()}, chain.closed);
        for (const Run& run : thin_runs(widths)) add_run(chain, widths, run, false);
    }

    // Those that hold something thinner than the limit go on up to a little more, so that a width near it
    // does not cut them in pieces.
    std::vector<Run> thin_runs(const std::vector<double>& widths) const {
        std::vector<Run> out;
        for (std::size_t begin = 0; begin < widths.size();) {
            std::size_t end = begin;
            bool thin = false;
            while (end < widths.size() && widths[end] < kWider * options_.widest)
                thin |= widths[end++] < options_.widest;
            if (thin) out.push_back({begin, end});
            begin = std::max(end, begin + 1);
        }
        return out;
    }

    void add_run(const PointChain& chain, const std::vector<double>& widths, const Run& run, bool closed) {
        if (run.end - run.begin < 2) return;
        Stroke stroke;
        stroke.closed = closed;
        std::array<int, 4> votes{};
        std::map<uint32_t, int> beside;
        for (std::size_t i = run.begin; i < run.end; ++i) {
            const ThinPoint& p = of(chain.points[i]);
            ++votes[static_cast<std::size_t>(p.place)];
            for (const uint32_t id : p.beside) ++beside[id];
            stroke.vertices.push_back(vertex(chain, i, widths[i]));
        }
        const auto count = [&](ThinPoint::Place place) { return votes[static_cast<std::size_t>(place)]; };
        const int behind = count(ThinPoint::Place::kBehind), before = count(ThinPoint::Place::kBefore),
                  between = count(ThinPoint::Place::kBetween), all = static_cast<int>(run.end - run.begin);
        const uint32_t id = chain.points.front().owner,
                       other =
                           std::ranges::max_element(beside, {}, [](const auto&b) { return b.second; })->first;
        if (2 * between > all) return;  // what looks out from behind something has one outline, with a hem
        const bool gap = behind > before && kShare * behind > all;
        stroke.kind = gap ? StrokeKind::kOutline : StrokeKind::kRidge;
        stroke.near = gap ? other : id;
        stroke.far = gap ? id : other;
        if (stroke.near != 0) (gap ? middles_.gaps : middles_.things).push_back(std::move(stroke));
    }

    StrokeVertex vertex(const PointChain& chain, std::size_t i, double width) const {
        const LinePoint& p = chain.points[i];
        StrokeVertex v;
        v.x = p.x + 0.5 + double{p.dx};
        v.y = p.y + 0.5 + double{p.dy};
        v.thickness = width;
        v.strength = v.width = v.opacity = std::min(width / kFaint, 1.0);
        v.epsilon = kSure + kBlind * std::max(1 - width, 0.0);
        // A depth is of one place in the pixel, beside the thing as often as not.
        float near = 0;
        const std::size_t n = chain.points.size();
        for (std::size_t k = i - std::min<std::size_t>(i, kAround); k < std::min(i + kAround + 1, n); ++k)
            near = std::max(near, of(chain.points[k]).near);
        v.depth = near > 0 ? 1 / double{near} : 0;
        return v;
    }

    void finish(std::vector<Stroke>& strokes) const {
        strokes = join_strokes(std::move(strokes), kGap, kTurn);
        std::erase_if(strokes, [&](const Stroke& s) {
            double sum = 0;
            for (const StrokeVertex& v : s.vertices) sum += v.thickness;
            const double wide = sum / static_cast<double>(s.vertices.size());
            return length_of(s) < std::max(options_.min_length, kSlender * wide);
        });
        for (Stroke& s : strokes) {
            begin_at_upper_end(s);
            if (!s.closed) {
                straighten_end(s.vertices);
                std::ranges::reverse(s.vertices);
                straighten_end(s.vertices);
                std::ranges::reverse(s.vertices);
            }
            measure(s);
            double sum = 0;
            for (const StrokeVertex& v : s.vertices) sum += v.epsilon;
            smooth(s, sum / static_cast<double>(s.vertices.size()), 1);
            if (s.closed) continue;
            reach_rim(s, false);
            reach_rim(s, true);
        }
    }

    // A middle has no right, so it begins where no mirror sees a difference but left and right.
    static void begin_at_upper_end(Stroke& s) {
        const auto place = [](const StrokeVertex& v) { return std::pair(v.y, v.x); };
        if (s.closed || place(s.vertices.front()) <= place(s.vertices.back())) return;
        std::ranges::reverse(s.vertices);
        std::swap(s.ends[0], s.ends[1]);
    }

    // Where a thing ends there is no across, and the last points turn into its corners: the last turns go
    // back on the way that leads there, as far along it as they are.
    static void straighten_end(std::vector<StrokeVertex>& v) {
        const std::size_t n = v.size();
        if (n < kBlunt + kAround + 2) return;
        std::size_t sound = n - 1 - kBlunt;  // the last vertex that is not too near the end
        const MapPoint way = way_to(v, sound);
        while (sound + 1 < n && turns_little(way, v[sound], v[sound + 1])) ++sound;
        if (sound + 1 == n) return;
        const double along = (v[n - 1].x - v[sound].x) * way.x + (v[n - 1].y - v[sound].y) * way.y;
        StrokeVertex end = v[n - 1];
        end.x = v[sound].x + along * way.x;
        end.y = v[sound].y + along * way.y;
        v.resize(sound + 1);
        if (along > kLeast) v.push_back(end);
    }

    // Of length 1, from some vertices before.
    static MapPoint way_to(const std::vector<StrokeVertex>& v, std::size_t i) {
        const double x = v[i].x - v[i - kAround].x, y = v[i].y - v[i - kAround].y;
        const double length = std::sqrt(x * x + y * y);
        return length > 0 ? MapPoint{x / length, y / length} : MapPoint{0, 0};
    }

    static bool turns_little(const MapPoint& way, const StrokeVertex& a, const StrokeVertex& b) {
        const double x = b.x - a.x, y = b.y - a.y;
        return x * way.x + y * way.y > kOnward * std::sqrt(x * x + y * y);
    }

    // Near the rim nobody knows how a thing goes on, so its middle does as before.
    void reach_rim(Stroke& s, bool last) const {
        const std::size_t n = s.vertices.size(), far = std::min<std::size_t>(kAround, n - 1);
        StrokeVertex v = last ? s.vertices.back() : s.vertices.front();
        const StrokeVertex& before = s.vertices[last ? n - 1 - far : far];
        const Rect& r = options_.extent;
        const auto share_to = [](double at, double by, double low, double high) {
            const double share = by > 0 ? (high - at) / by : by < 0 ? (low - at) / by : kNever;
            return std::max(share, 0.0);
        };
        const double dx = v.x - before.x, dy = v.y - before.y;
        const double to_x = share_to(v.x, dx, r.x0, r.x1), to_y = share_to(v.y, dy, r.y0, r.y1);
        const double share = std::min(to_x, to_y);
        if (!(share * std::sqrt(dx * dx + dy * dy) < kRimReach)) return;
        v.x = to_x <= to_y ? (dx > 0 ? r.x1 : r.x0) : v.x + share * dx;
        v.y = to_y <= to_x ? (dy > 0 ? r.y1 : r.y0) : v.y + share * dy;
        s.vertices.insert(last ? s.vertices.end() : s.vertices.begin(), v);
        s.ends[last ? 1 : 0] = StrokeEnd::kRim;
    }

    static constexpr double kNever = 1e9;
    static constexpr std::size_t kBlunt = 3;  // points from an end that may be turned by it
    static constexpr double kOnward = 0.95;   // cosine of what a thin thing may turn within that
    static constexpr double kLeast = 0.25;    // pixels between vertices
    static constexpr double kWider = 1.4;
    static constexpr int kShare = 4;  // a part of so many in a chain says that it is a gap
    static constexpr double kSure = 0.05,
                            kBlind = 0.2;  // how far off a middle may be: in wide things, in none

    std::vector<ThinPoint> points_;
    const MiddleOptions& options_;
    Middles middles_;
};

// The middles of one sort, by place and by what is thin there.
class Places {
public:
    Places(std::vector<Stroke>& middles, bool gaps) : middles_(middles), gaps_(gaps), pieces_(middles) {
        pieces_.add_all([](uint32_t, uint32_t, uint32_t) { return true; });
        for (const Stroke& s : middles) {
            ids_.insert(id_of(s));
            if (gaps) ids_.insert(s.near);
            for (const StrokeVertex& v : s.vertices) widest_ = std::max(widest_, v.thickness);
        }
    }

    bool knows(const Stroke& outline) const {
        return ids_.contains(outline.near) || ids_.contains(outline.far);
    }

    bool covers(const Stroke& outline, const StrokeVertex& v) const {
        bool covered = false;
        const double reach = widest_ / 2 + kHem;
        pieces_.near(v.x, v.y, reach, [&](const PieceIndex::Piece& piece) {
            if (covered || !is_of(outline, pieces_.of(piece))) return;
            const StrokeVertex &a = pieces_.from(piece), &b = pieces_.to(piece);
            const MapPoint foot = foot_of(a, b, v);
            const double x = foot.x - v.x, y = foot.y - v.y;
            const double within = std::max(a.thickness, b.thickness) / 2 + kHem;
            covered = x * x + y * y < within * within;
        });
        return covered;
    }

    // The nearest place that lies ahead of an end: what ends behind something thin touches its middle.
    std::optional<MapPoint> ahead(const StrokeVertex& end, const StrokeVertex& before) const {
        std::optional<MapPoint> best;
        bool touches = false;
        double least = widest_ / 2 + kTouch;
        pieces_.near(end.x, end.y, least, [&](const PieceIndex::Piece& piece) {
            const StrokeVertex &a = pieces_.from(piece), &b = pieces_.to(piece);
            const MapPoint foot = foot_of(a, b, end);
            const double x = foot.x - end.x, y = foot.y - end.y, distance = std::sqrt(x * x + y * y);
            if (distance < kTouches) touches = true;
            if (distance >= least || distance > a.thickness / 2 + kTouch) return;
            if (!(x * (end.x - before.x) + y * (end.y - before.y) > 0)) return;
            least = distance;
            best = foot;
        });
        return touches ? std::nullopt : best;
    }

    // The end that an outline goes on from, which is then joined.
    const StrokeVertex* end_near(const Stroke& outline, const StrokeVertex& v) {
        std::tuple<double, std::size_t, std::size_t> best{kEnd * kEnd, 0, 2};
        for (std::size_t s = 0; s < middles_.size(); ++s) {
            const Stroke& m = middles_[s];
            if (m.closed || !is_of(outline, m)) continue;
            for (const std::size_t last : {std::size_t{0}, std::size_t{1}}) {
                const StrokeVertex& end = last == 1 ? m.vertices.back() : m.vertices.front();
                const double x = end.x - v.x, y = end.y - v.y;
                best = std::min(best, {x * x + y * y, s, last});
            }
        }
        const auto [distance, s, last] = best;
        if (last == 2) return nullptr;
        middles_[s].ends[last] = StrokeEnd::kJoined;
        return last == 1 ? &middles_[s].vertices.back() : &middles_[s].vertices.front();
    }

private:
    static MapPoint foot_of(const StrokeVertex& a, const StrokeVertex& b, const StrokeVertex& v) {
        const double dx = b.x - a.x, dy = b.y - a.y, length2 = dx * dx + dy * dy;
        const double share =
            length2 > 0 ? std::clamp(((v.x - a.x) * dx + (v.y - a.y) * dy) / length2, 0.0, 1.0) : 0;
        return {a.x + share * dx, a.y + share * dy};
    }

    // Outlines of what has a middle; beside a gap also those of what it belongs to, as where the gap is
    // narrowest both its sides meet.
    bool is_of(const Stroke& outline, const Stroke& middle) const {
        const auto has = [&](uint32_t id) { return outline.near == id || outline.far == id; };
        return has(id_of(middle)) || (gaps_ && has(middle.near));
    }

    uint32_t id_of(const Stroke& middle) const { return gaps_ ? middle.far : middle.near; }

    std::vector<Stroke>& middles_;
    bool gaps_;
    PieceIndex pieces_;
    std::set<uint32_t> ids_;
    double widest_ = 0;
};

class Cutter {
public:
    Cutter(Middles& middles, double min_length)
        : places_{Places(middles.things, false), Places(middles.gaps, true)}, min_length_(min_length) {}

    void cut(Stroke&& outline, std::vector<Stroke>& out) {
        std::vector<bool> covered;
        for (const StrokeVertex& v : outline.vertices)
            covered.push_back(std::ranges::any_of(
                places_, [&](const Places& p) { return p.knows(outline) && p.covers(outline, v); }));
        const auto first = std::ranges::find(covered, true);
        if (first == covered.end()) return out.push_back(std::move(outline));
        if (outline.closed) {
            const auto at = first - covered.begin();
            std::rotate(outline.vertices.begin(), outline.vertices.begin() + at, outline.vertices.end());
            std::rotate(covered.begin(), covered.begin() + at, covered.end());
            outline.vertices.push_back(outline.vertices.front());
            covered.push_back(true);
            outline.closed = false;
        }
        const std::size_t n = covered.size();
        for (std::size_t begin = 0; begin < n;) {
            std::size_t end = begin;
            while (end < n && !covered[end]) ++end;
            if (end - begin >= kCrumb) add(outline, begin, end, out);
            begin = end + 1;
        }
    }

    // Lines that end behind something thin.
    void touch(Stroke& s) const {
        const std::size_t n = s.vertices.size();
        if (s.closed || n < 2) return;
        for (const bool last : {false, true}) {
            if (s.ends[last ? 1 : 0] == StrokeEnd::kRim) continue;
            StrokeVertex end = last ? s.vertices.back() : s.vertices.front();
            const StrokeVertex& before = last ? s.vertices[s.vertices.size() - 2] : s.vertices[1];
            for (const Places& p : places_)
                if (const auto to = p.ahead(end, before)) {
                    end.x = to->x;
                    end.y = to->y;
                    s.vertices.insert(last ? s.vertices.end() : s.vertices.begin(), end);
                    break;
                }
        }
    }

private:
    void add(const Stroke& outline, std::size_t begin, std::size_t end, std::vector<Stroke>& out) {
        const std::size_t n = outline.vertices.size();
        Stroke part = outline;
        part.vertices.assign(outline.vertices.begin() + static_cast<std::ptrdiff_t>(begin),
                             outline.vertices.begin() + static_cast<std::ptrdiff_t>(end));
        if (begin > 0 && end < n &&
            (length_of(part) < min_length_ ||
             is_cap(part, outline.vertices[begin - 1], outline.vertices[end])))
            return;
        if (begin > 0) {
            part.vertices.insert(part.vertices.begin(), from(outline, begin, begin - 1));
            part.ends[0] = StrokeEnd::kJoined;
        }
        if (end < n) {
            part.vertices.push_back(from(outline, end - 1, end));
            part.ends[1] = StrokeEnd::kJoined;
        }
        out.push_back(std::move(part));
    }

    // The way round the end of something thin, from one side of its middle to the other.
    static bool is_cap(const Stroke& part, const StrokeVertex& before, const StrokeVertex& after) {
        const double x = after.x - before.x, y = after.y - before.y;
        return x * x + y * y < kEnd * kEnd && length_of(part) < kCap;
    }

    // Where it begins: the end of a middle, or the vertex that is covered.
    StrokeVertex from(const Stroke& outline, std::size_t first, std::size_t covered) {
        StrokeVertex v = outline.vertices[first];
        const StrokeVertex* at = &outline.vertices[covered];
        for (Places& p : places_)
            if (const StrokeVertex* end = p.end_near(outline, v)) {
                at = end;
                break;
            }
        v.x = at->x;
        v.y = at->y;
        return v;
    }

    std::array<Places, 2> places_;
    double min_length_;
};

}  // namespace

Middles middles_of(std::vector<ThinPoint> points, const MiddleOptions& options) {
    return Maker(std::move(points), options).make();
}

std::vector<Stroke> outlines_beside(std::vector<Stroke> outlines, Middles& middles, double min_length) {
    Cutter cutter(middles, min_length);
    std::vector<Stroke> out;
    for (Stroke& s : outlines) cutter.cut(std::move(s), out);
    for (Stroke& s : out) cutter.touch(s);
    return out;
}

}  // namespace keyline
