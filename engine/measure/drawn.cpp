// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/measure/drawn.h"

#include "engine/measure/motion_field.h"
#include "engine/measure/spots.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace keyline {

namespace {

constexpr double kAcross = 4;           // pixels on either side of a stroke that its width is summed up from
constexpr double kStep = 0.25;          // pixels
constexpr double kClear = 2 * kAcross;  // pixels to the next line
constexpr std::ptrdiff_t kAlong = 20;   // spots on either side: 10 pixels
constexpr double kStraight = 0.94;      // cosine of how much a stroke may turn over 10 pixels
constexpr double kFaint = 0.1;          // pixels: no width
constexpr double kOfMedian = 1.4826;    // from the median of what is off to the deviation of a bell curve
constexpr int kOwner = 2;               // pixels from a line to what it is drawn on
constexpr double kSamePlace = 0.5;      // pixels

// The widths of strokes in a picture, where they can be told.
class Widths {
public:
    Widths(const Strokes& strokes, const DrawnLines& drawn)
        : drawn_(drawn), spots_(spots_of(strokes)), index_(spots_) {
        for (std::size_t i = 0; i < spots_.size(); ++i)
            widths_.push_back(is_clear(i) ? width_at(spots_[i]) : std::nullopt);
    }

    DrawnWidth spread() const {
        DrawnWidth out;
        std::vector<double> off;
        for (std::size_t i = 0; i < spots_.size(); ++i)
            if (const auto here = off_the_mean(static_cast<std::ptrdiff_t>(i))) {
                off.push_back(*here);
                out.length += spots_[i].length;
            }
        if (off.empty()) return out;
        const auto middle = off.begin() + static_cast<std::ptrdiff_t>(off.size() / 2);
        std::ranges::nth_element(off, middle);
        out.spread = kOfMedian * *middle;
        return out;
    }

private:
    bool is_clear(std::size_t i) const {
        const Spot& spot = spots_[i];
        bool clear = true;
        index_.near(spot.x, spot.y, kClear, [&](std::size_t k) {
            const Spot& other = spots_[k];
            const bool here = other.stroke == spot.stroke && std::fabs(other.arc - spot.arc) < 2 * kClear;
            const double x = other.x - spot.x, y = other.y - spot.y;
            if (!here && x * x + y * y < kClear * kClear) clear = false;
        });
        return clear;
    }

    std::optional<double> width_at(const Spot& spot) const {
        double sum = 0;
        constexpr int kSteps = static_cast<int>(kAcross / kStep);
        for (int k = -kSteps; k <= kSteps; ++k)
            sum += drawn_.at(spot.x - k * kStep * spot.ty, spot.y + k * kStep * spot.tx);
        return sum * kStep > kFaint ? std::optional(sum * kStep) : std::nullopt;
    }

    // Nothing near ends, bends and other lines.
    std::optional<double> off_the_mean(std::ptrdiff_t i) const {
        const auto n = static_cast<std::ptrdiff_t>(spots_.size());
        if (i < kAlong || i + kAlong >= n) return {};
        const auto at = [&](std::ptrdiff_t k) -> const Spot& { return spots_[static_cast<std::size_t>(k)]; };
        const auto width = [&](std::ptrdiff_t k) { return widths_[static_cast<std::size_t>(k)]; };
        if (at(i - kAlong).stroke != at(i).stroke || at(i + kAlong).stroke != at(i).stroke) return {};
        if (cosine(at(i - kAlong), at(i)) < kStraight || cosine(at(i), at(i + kAlong)) < kStraight) return {};
        double sum = 0;
        for (std::ptrdiff_t k = i - kAlong; k <= i + kAlong; ++k) {
            if (!width(k)) return {};
            sum += *width(k);
        }
        const double mean = sum / (2 * kAlong + 1);
        return std::fabs(*width(i) - mean) / mean;
    }

    const DrawnLines& drawn_;
    const std::vector<Spot> spots_;
    const SpotIndex index_;
    std::vector<std::optional<double>> widths_;
};

// As the nearest thing around a place moves.
std::optional<Way> way_of_nearest(const Field& field, double x, double y) {
    std::optional<Way> way;
    double least = 0;
    for (int dy = -kOwner; dy <= kOwner; ++dy)
        for (int dx = -kOwner; dx <= kOwner; ++dx) {
            const double depth = field.depth_at(x + dx, y + dy);
            if (way && !(depth < least)) continue;
            if (const auto here = field.at(x + dx, y + dy)) {
                way = here;
                least = depth;
            }
        }
    return way;
}

struct Flicker {
    double change = 0, whole = 0;

    void add(const DrawnFrame& before, const DrawnFrame& now) {
        const Field back(now.motion, false), forth(before.motion, true);
        const Rect& window = now.drawn.window;
        for (int y = window.y0; y < window.y1; ++y)
            for (int x = window.x0; x < window.x1; ++x) add(before, now, back, forth, x + 0.5, y + 0.5);
    }

private:
    void add(const DrawnFrame& before, const DrawnFrame& now, const Field& back, const Field& forth, double x,
             double y) {
        const auto way = way_of_nearest(back, x, y);
        if (!way) return;
        const double from_x = x + way->x, from_y = y + way->y;
        const double a = before.drawn.at(from_x, from_y), b = now.drawn.at(x, y);
        if (a == 0 && b == 0) return;
        const auto returns = way_of_nearest(forth, from_x, from_y);
        if (!returns) return;
        const double off_x = way->x + returns->x, off_y = way->y + returns->y;
        if (!(off_x * off_x + off_y * off_y < kSamePlace * kSamePlace)) return;
        change += std::fabs(a - b);
        whole += std::max(a, b);
    }
};

}  // namespace

double DrawnLines::at(double x, double y) const {
    const double u = x - 0.5, v = y - 0.5;
    const int column = static_cast<int>(std::floor(u)), row = static_cast<int>(std::floor(v));
    const auto pixel = [&](int px, int py) {
        if (!window.contains(px, py)) return 0.0;
        const auto i = static_cast<std::size_t>(py - window.y0) * static_cast<std::size_t>(window.width()) +
                       static_cast<std::size_t>(px - window.x0);
        return std::isfinite(coverage[i]) ? std::clamp(double{coverage[i]}, 0.0, 1.0) : 0.0;
    };
    const double s = u - column, t = v - row;
    return (1 - t) * ((1 - s) * pixel(column, row) + s * pixel(column + 1, row)) +
           t * ((1 - s) * pixel(column, row + 1) + s * pixel(column + 1, row + 1));
}

DrawnWidth width_in(const Strokes& strokes, const DrawnLines& drawn) {
    return Widths(strokes, drawn).spread();
}

std::optional<double> flicker_of(const std::vector<DrawnFrame>& frames) {
    Flicker flicker;
    for (std::size_t i = 1; i < frames.size(); ++i) flicker.add(frames[i - 1], frames[i]);
    if (!(flicker.whole > 0)) return {};
    return flicker.change / flicker.whole;
}

}  // namespace keyline
