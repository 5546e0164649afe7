// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/measure/form.h"

#include "engine/kit/bezier.h"
#include "engine/measure/spots.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

namespace keyline {

namespace {

constexpr double kBeside = 1.5;     // pixels: as near as two lines are one
constexpr double kSameWay = 0.866;  // cosine of 30 degrees
constexpr double kElsewhere = 6;    // pixels along a stroke: from there on it is as if it were another
constexpr double kCurveTolerance = 0.2;
constexpr std::ptrdiff_t kAround = 6;  // spots on either side: 3 pixels

class Former {
public:
    explicit Former(const Strokes& drawing) : drawing_(drawing), spots_(spots_of(drawing)), index_(spots_) {}

    Form form() const {
        Form out;
        out.strokes = drawing_.strokes.size();
        for (const Stroke& s : drawing_.strokes) {
            out.vertices += s.vertices.size();
            out.curves += curves_of(s);
        }
        for (const Spot& s : spots_) out.length += s.length;
        add_doubles(out);
        add_ends(out);
        add_evenness(out);
        return out;
    }

private:
    static std::size_t curves_of(const Stroke& stroke) {
        std::vector<CurvePoint> points;
        for (const StrokeVertex& v : stroke.vertices) points.push_back({v.x, v.y});
        return fit_beziers(std::move(points), stroke.closed, kCurveTolerance).size();
    }

    bool is_elsewhere(const Spot& a, const Spot& b) const {
        if (a.stroke != b.stroke) return true;
        const double apart = std::fabs(a.arc - b.arc);
        const Stroke& s = drawing_.strokes[a.stroke];
        return (s.closed ? std::min(apart, length_of(s) - apart) : apart) > kElsewhere;
    }

    // Strokes of one kind that run against each other are both sides of something thin.
    bool has_a_double_before(const Spot& spot) const {
        bool found = false;
        index_.near(spot.x, spot.y, kBeside, [&](std::size_t i) {
            const Spot& other = spots_[i];
            if (found || &other >= &spot || !is_elsewhere(spot, other)) return;
            const OffLine off = off_line(other, spot.x, spot.y);
            const bool one_kind = drawing_.strokes[other.stroke].kind == drawing_.strokes[spot.stroke].kind;
            const double turn = cosine(other, spot);
            found = std::fabs(off.across) < kBeside && is_beside(other, off) &&
                    (one_kind ? turn : std::fabs(turn)) > kSameWay;
        });
        return found;
    }

    void add_doubles(Form& out) const {
        double doubled = 0;
        for (const Spot& s : spots_)
            if (has_a_double_before(s)) doubled += s.length;
        if (out.length > 0) out.doubles = doubled / out.length;
    }

    double to_rim(double x, double y) const {
        const Rect& w = drawing_.window;
        return std::min({x - w.x0, w.x1 - x, y - w.y0, w.y1 - y});
    }

    bool is_loose(const Spot& end, double x, double y) const {
        constexpr double kRim = 2;
        if (to_rim(x, y) < kRim) return false;
        bool met = false;
        index_.near(x, y, kBeside + kSpotLength, [&](std::size_t i) {
            const double dx = spots_[i].x - x, dy = spots_[i].y - y;
            met = met || (is_elsewhere(spots_[i], end) && std::sqrt(dx * dx + dy * dy) < kBeside);
        });
        return !met;
    }

    struct Outline {
        bool in_view = true, closed = true;
    };

    void add_ends(Form& out) const {
        std::map<uint32_t, Outline> outlines;
        for (std::size_t first = 0; first < spots_.size();) {
            std::size_t last = first;
            while (last + 1 < spots_.size() && spots_[last + 1].stroke == spots_[first].stroke) ++last;
            add_ends_of(first, last, out, outlines);
            first = last + 1;
        }
        for (const auto& [id, outline] : outlines) {
            if (id == 0 || !outline.in_view) continue;
            ++out.objects;
            if (outline.closed) ++out.closed;
        }
    }

    void add_ends_of(std::size_t first, std::size_t last, Form& out,
                     std::map<uint32_t, Outline>& outlines) const {
        const Stroke& stroke = drawing_.strokes[spots_[first].stroke];
        int loose = 0;
        if (!stroke.closed) {
            const StrokeVertex &a = stroke.vertices.front(), &b = stroke.vertices.back();
            loose = is_loose(spots_[first], a.x, a.y) + is_loose(spots_[last], b.x, b.y);
            out.ends += 2;
            out.loose_ends += static_cast<std::size_t>(loose);
        }
        if (stroke.kind > StrokeKind::kOcclusion) return;
        Outline& outline = outlines[stroke.near];
        outline.closed = outline.closed && loose == 0;
        constexpr double kRim = 2;
        for (std::size_t i = first; i <= last; ++i)
            outline.in_view = outline.in_view && to_rim(spots_[i].x, spots_[i].y) > kRim;
    }

    // The spots around one, all of its stroke; nothing near an end.
    const Spot* around(std::size_t i) const {
        if (i < kAround || i + kAround >= spots_.size()) return nullptr;
        const Spot* const middle = &spots_[i];
        return middle[-kAround].stroke == middle->stroke && middle[kAround].stroke == middle->stroke
                   ? middle
                   : nullptr;
    }

    static bool turns(const Spot* middle) {
        const Spot &a = middle[-kAround], &b = middle[kAround];
        const double ax = middle->x - a.x, ay = middle->y - a.y, bx = b.x - middle->x, by = b.y - middle->y;
        return ax * bx + ay * by < kSameWay * std::sqrt((ax * ax + ay * ay) * (bx * bx + by * by));
    }

    // By the least squares of even spacing.
    static double off_the_parabola(const Spot* middle) {
        constexpr double kScale = (2 * kAround + 3) * (2 * kAround + 1) * (2 * kAround - 1);
        constexpr double kMiddle = 3 * kAround * kAround + 3 * kAround - 1;
        double x = 0, y = 0;
        for (std::ptrdiff_t i = -kAround; i <= kAround; ++i) {
            const double weight = 3 * (kMiddle - static_cast<double>(5 * i * i)) / kScale;
            x += weight * middle[i].x;
            y += weight * middle[i].y;
        }
        return off_line(*middle, x, y).across;
    }

    static double spread_of_width(const Spot* middle) {
        double sum = 0, squares = 0;
        constexpr double kCount = 2 * kAround + 1;
        for (std::ptrdiff_t i = -kAround; i <= kAround; ++i) {
            sum += middle[i].width;
            squares += middle[i].width * middle[i].width;
        }
        const double mean = sum / kCount;
        return mean > 0 ? (squares / kCount - mean * mean) / (mean * mean) : 0;
    }

    bool may_be_tapered(const Spot& spot) const {
        constexpr double kTaper = 24;  // pixels
        const Stroke& s = drawing_.strokes[spot.stroke];
        return !s.closed && (spot.arc < kTaper || spot.arc > s.vertices.back().arc - kTaper);
    }

    void add_evenness(Form& out) const {
        double ripple = 0, spread = 0, straight = 0, even = 0;
        std::vector<double> slopes;
        for (std::size_t i = 0; i < spots_.size(); ++i) {
            const Spot* const middle = around(i);
            if (!middle) continue;
            if (!turns(middle)) {
                const double off = off_the_parabola(middle);
                ripple += off * off;
                ++straight;
            }
            if (may_be_tapered(*middle)) continue;
            spread += spread_of_width(middle);
            ++even;
            slopes.push_back(std::fabs(middle[1].width - middle->width) / (middle[1].arc - middle->arc));
        }
        if (straight > 0) out.ripple = std::sqrt(ripple / straight);
        if (even > 0) out.width_spread = std::sqrt(std::max(spread / even, 0.0));
        std::ranges::sort(slopes);
        constexpr double kMost = 0.95;
        if (!slopes.empty())
            out.width_slope =
                slopes[static_cast<std::size_t>(kMost * static_cast<double>(slopes.size() - 1))];
    }

    const Strokes& drawing_;
    const std::vector<Spot> spots_;
    const SpotIndex index_;
};

}  // namespace

Form form_of(const Strokes& drawing) { return Former(drawing).form(); }

}  // namespace keyline
