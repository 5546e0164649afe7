// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/measure/motion.h"

#include "engine/measure/motion_field.h"
#include "engine/measure/offsets.h"
#include "engine/measure/spots.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace keyline {

namespace {

// Beside a line, where samples are not mixed of both sides, and farther in.
constexpr double kInside = 1.5, kFartherInside = 2.5;

// A place of a line with one on what it is drawn on; both move together.
struct Carried {
    Spot spot;
    double inside_x = 0, inside_y = 0;  // from the spot, of length 1
};

// On the right, or on the other side where that is nearer: what crests are traced from has no right.
Carried carried(const Spot& s, const Field& field) {
    const double x = -s.ty, y = s.tx;
    const bool other = field.depth_at(s.x - kInside * x, s.y - kInside * y) <
                       field.depth_at(s.x + kInside * x, s.y + kInside * y);
    return other ? Carried{s, -x, -y} : Carried{s, x, y};
}

// What is thin is under its middle in some pixels, and beside it in others: where it is, it is nearest.
std::optional<Way> way_of_middle(const Spot& spot, const Field& field) {
    constexpr int kAlong = 4;  // pixels
    const auto at = [&](int far) { return std::pair(spot.x + far * spot.tx, spot.y + far * spot.ty); };
    std::pair<double, double> nearest = at(0);
    for (int i = 1; i <= kAlong; ++i)
        for (const auto& [x, y] : {at(-i), at(i)})
            if (field.depth_at(x, y) < field.depth_at(nearest.first, nearest.second)) nearest = {x, y};
    return field.at(nearest.first, nearest.second);
}

// Motion changes along a surface, so it is carried on to the line where the surface goes on that far.
std::optional<Way> way_of(const Carried& c, const Field& field) {
    if (c.spot.is_middle) return way_of_middle(c.spot, field);
    const auto at = [&](double far) {
        return field.at(c.spot.x + far * c.inside_x, c.spot.y + far * c.inside_y);
    };
    const std::optional<Way> near = at(kInside), farther = at(kFartherInside);
    if (!near || !farther) return near;
    constexpr double kOneSurface = 0.25;  // pixels
    const double dx = near->x - farther->x, dy = near->y - farther->y;
    if (std::sqrt(dx * dx + dy * dy) > kOneSurface) return near;
    constexpr double kBack = kInside / (kFartherInside - kInside);
    return Way{near->x + kBack * dx, near->y + kBack * dy};
}

// To the frame beside; nothing where it leaves the view or something comes before it: there the way back
// leads elsewhere.
std::optional<Carried> carry(const Carried& from, const Field& here, const Field& back) {
    const std::optional<Way> way = way_of(from, here);
    if (!way) return {};
    Carried to = from;
    to.spot.x += way->x;
    to.spot.y += way->y;
    const std::optional<Way> returns = way_of(to, back);
    if (!returns) return {};
    constexpr double kSamePlace = 0.5;  // pixels
    const double x = way->x + returns->x, y = way->y + returns->y;
    return std::sqrt(x * x + y * y) < kSamePlace ? std::optional(to) : std::nullopt;
}

// The nearest line there that goes the same way.
std::optional<double> off_nearest(const Spot& spot, const std::vector<Spot>& spots, const SpotIndex& index,
                                  double within, double same_way) {
    std::optional<double> best;
    index.near(spot.x, spot.y, within + kSpotLength, [&](std::size_t i) {
        const OffLine off = off_line(spots[i], spot.x, spot.y);
        if (std::fabs(off.across) > within || !is_beside(spots[i], off) ||
            std::fabs(cosine(spots[i], spot)) < same_way)
            return;
        if (!best || std::fabs(off.across) < std::fabs(*best)) best = off.across;
    });
    return best;
}

class Books {
public:
    explicit Books(const AccuracyOptions& options)
        : options_(options), same_way_(std::cos(options.angle * std::numbers::pi / 180)) {}

    // What of a frame's lines is in the one beside it.
    void compare(const std::vector<Spot>& spots, const std::vector<Spot>& beside, const Field& here,
                 const Field& back) {
        const SpotIndex index(beside);
        double run = 0, run_ink = 0;
        const auto end_run = [&] {
            (run >= kPop ? pops_ : flecks_) += run;
            lost_ink_ += run_ink;
            run = run_ink = 0;
        };
        for (std::size_t i = 0; i < spots.size(); ++i) {
            if (i > 0 && spots[i].stroke != spots[i - 1].stroke) end_run();
            const std::optional<Carried> to = carry(carried(spots[i], here), here, back);
            if (!to) continue;
            length_ += spots[i].length;
            ink_ += spots[i].length * spots[i].width;
            if (const auto off = off_nearest(to->spot, beside, index, options_.within, same_way_)) {
                offs_.push_back(*off);
                end_run();
            } else {
                run += spots[i].length;
                run_ink += spots[i].length * spots[i].width;
            }
        }
        end_run();
    }

    void fill(Steadiness& out) const {
        out.length = length_;
        out.swim = offsets_of(offs_);
        if (length_ > 0) {
            out.pops = pops_ / length_;
            out.flecks = flecks_ / length_;
        }
        if (ink_ > 0) out.lost_ink = lost_ink_ / ink_;
        double sum = 0;
        for (const double off : offs_) sum += std::fabs(off);
        if (!offs_.empty()) out.drift = sum / static_cast<double>(offs_.size());
    }

private:
    static constexpr double kPop = 4;  // pixels
    const AccuracyOptions options_;
    const double same_way_;
    std::vector<double> offs_;
    double length_ = 0, ink_ = 0, pops_ = 0, flecks_ = 0, lost_ink_ = 0;
};

void add_drift(const std::vector<MovingFrame>& frames, const std::vector<std::vector<Spot>>& spots,
               const AccuracyOptions& options, Steadiness& out) {
    const double same_way = std::cos(options.angle * std::numbers::pi / 180);
    const SpotIndex index(spots.back());
    double sum = 0;
    for (const Spot& spot : spots.front()) {
        std::optional<Carried> at = carried(spot, Field(frames.front().motion, true));
        for (std::size_t f = 0; at && f + 1 < frames.size(); ++f)
            at = carry(*at, Field(frames[f].motion, true), Field(frames[f + 1].motion, false));
        if (!at) continue;
        // What is not found at all has popped, and is not counted a second time.
        if (const auto off = off_nearest(at->spot, spots.back(), index, 3 * options.within, same_way)) {
            sum += std::fabs(*off) * spot.length;
            out.drifted += spot.length;
        }
    }
    if (out.drifted > 0) out.shot_drift = sum / out.drifted;
}

}  // namespace

Steadiness steadiness_of(const std::vector<MovingFrame>& frames, const AccuracyOptions& options) {
    Steadiness out;
    if (frames.size() < 2) return out;
    std::vector<std::vector<Spot>> spots;
    for (const MovingFrame& f : frames) spots.push_back(spots_of(f.drawing));
    Books books(options);
    for (std::size_t i = 0; i + 1 < frames.size(); ++i) {
        const MotionPass &here = frames[i].motion, &next = frames[i + 1].motion;
        books.compare(spots[i], spots[i + 1], Field(here, true), Field(next, false));
        books.compare(spots[i + 1], spots[i], Field(next, false), Field(here, true));
    }
    out.pairs = frames.size() - 1;
    books.fill(out);
    add_drift(frames, spots, options, out);
    return out;
}

}  // namespace keyline
