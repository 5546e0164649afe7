// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/measure/accuracy.h"

#include "engine/measure/offsets.h"
#include "engine/measure/spots.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>

namespace keyline {

namespace {

// A drawn spot beside a true one.
struct Pair {
    double distance = 0;  // across
    std::size_t drawn = 0, truth = 0;
    double outward = 0;  // the distance, positive outside of what owns the drawn line
};

Strokes laid_over(Strokes truth, const Rect& display) {
    const Rect from = truth.display;
    if (from == display || from.empty()) return truth;
    const double sx = static_cast<double>(display.width()) / from.width();
    const double sy = static_cast<double>(display.height()) / from.height();
    for (Stroke& s : truth.strokes)
        for (StrokeVertex& v : s.vertices) {
            v.x = display.x0 + sx * (v.x - from.x0);
            v.y = display.y0 + sy * (v.y - from.y0);
        }
    truth.display = truth.window = display;
    return truth;
}

// A scene goes on outside the picture, and nobody can draw there.
std::vector<Spot> spots_in_view(const Strokes& truth, const Rect& window) {
    std::vector<Spot> out = spots_of(truth);
    std::erase_if(out, [&](const Spot& s) {
        return s.x < window.x0 || s.x > window.x1 || s.y < window.y0 || s.y > window.y1;
    });
    return out;
}

// What lies beside each other, the closest first.
std::vector<Pair> pairs_of(const std::vector<Spot>& drawn, const std::vector<Spot>& truth,
                           const AccuracyOptions& options) {
    const SpotIndex index(truth);
    const double same_way = std::cos(options.angle * std::numbers::pi / 180);
    const double reach = options.within + kSpotLength;
    std::vector<Pair> out;
    for (std::size_t i = 0; i < drawn.size(); ++i)
        index.near(drawn[i].x, drawn[i].y, reach, [&](std::size_t t) {
            const OffLine off = off_line(truth[t], drawn[i].x, drawn[i].y);
            const double turn = cosine(drawn[i], truth[t]);
            if (std::fabs(off.across) > options.within || !is_beside(truth[t], off) ||
                std::fabs(turn) < same_way)
                return;
            out.push_back({std::fabs(off.across), i, t, turn > 0 ? off.across : -off.across});
        });
    std::ranges::sort(out, {}, [](const Pair& p) { return std::tuple(p.distance, p.drawn, p.truth); });
    return out;
}

// What each drawn spot is off; NaN where no true line is left for it.  A piece of a true line is for one
// stroke.
std::vector<double> offs_of(const std::vector<Spot>& drawn, std::size_t truth_spots,
                            const std::vector<Pair>& pairs) {
    constexpr std::size_t kFree = std::numeric_limits<std::size_t>::max();
    std::vector<std::size_t> taken_by(truth_spots, kFree);
    std::vector<double> out(drawn.size(), std::numeric_limits<double>::quiet_NaN());
    for (const Pair& p : pairs) {
        const std::size_t stroke = drawn[p.drawn].stroke;
        if (!std::isnan(out[p.drawn]) || (taken_by[p.truth] != kFree && taken_by[p.truth] != stroke))
            continue;
        taken_by[p.truth] = stroke;
        out[p.drawn] = p.outward;
    }
    return out;
}

// By kind, in the order of kinds; those that there are.
std::vector<KindOfLines> by_kind(const Strokes& strokes, const std::vector<Spot>& spots,
                                 const std::vector<double>& offs) {
    std::vector<KindOfLines> out;
    for (const auto& word : words(StrokeKind{})) {
        KindOfLines lines;
        lines.kind = word.value;
        std::vector<double> found;
        for (std::size_t i = 0; i < spots.size(); ++i) {
            if (strokes.strokes[spots[i].stroke].kind != word.value) continue;
            lines.length += spots[i].length;
            if (std::isnan(offs[i])) continue;
            lines.matched += spots[i].length;
            found.push_back(offs[i]);
        }
        lines.offsets = offsets_of(found);
        if (lines.length > 0) out.push_back(lines);
    }
    return out;
}

double share(const std::vector<KindOfLines>& kinds) {
    double all = 0, matched = 0;
    for (const KindOfLines& k : kinds) {
        all += k.length;
        matched += k.matched;
    }
    return all > 0 ? matched / all : 0;
}

// The runs of spots that nothing lies beside, as strokes.
Strokes unmatched(const Strokes& from, const std::vector<Spot>& spots, const std::vector<double>& offs) {
    Strokes out{from.display, from.window, from.names, {}};
    for (std::size_t i = 0; i < spots.size(); ++i) {
        if (!std::isnan(offs[i])) continue;
        const Stroke& of = from.strokes[spots[i].stroke];
        const bool goes_on = i > 0 && std::isnan(offs[i - 1]) && spots[i - 1].stroke == spots[i].stroke;
        if (!goes_on) {
            Stroke& run = out.strokes.emplace_back();
            run.kind = of.kind;
            run.near = of.near;
            run.far = of.far;
        }
        out.strokes.back().vertices.push_back({.x = spots[i].x, .y = spots[i].y});
    }
    arrange(out);
    return out;
}

}  // namespace

Accuracy accuracy_of(const Strokes& drawing, const Strokes& truth, const AccuracyOptions& options) {
    const Strokes lines = laid_over(truth, drawing.display);
    const std::vector<Spot> drawn = spots_of(drawing), true_spots = spots_in_view(lines, drawing.window);
    const std::vector<double> offs = offs_of(drawn, true_spots.size(), pairs_of(drawn, true_spots, options));
    // From the other side: of true lines in finer pieces than the drawn ones most have no drawn one beside
    // them.
    std::vector<double> found(true_spots.size(), std::numeric_limits<double>::quiet_NaN());
    for (const Pair& p : pairs_of(true_spots, drawn, options)) found[p.drawn] = 0;

    Accuracy out;
    out.drawn = by_kind(drawing, drawn, offs);
    out.truth = by_kind(lines, true_spots, found);
    std::vector<double> all = offs;
    std::erase_if(all, [](double off) { return std::isnan(off); });
    out.offsets = offsets_of(all);
    out.precision = share(out.drawn);
    out.recall = share(out.truth);
    out.extra = unmatched(drawing, drawn, offs);
    out.missed = unmatched(lines, true_spots, found);
    return out;
}

}  // namespace keyline
