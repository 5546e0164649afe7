// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/stroke_doubles.h"
#include "engine/kit/stroke_joints.h"
#include "engine/kit/strokes.h"
#include "engine/node/node_adaptor.h"

#include <algorithm>

namespace keyline {

namespace {

// One list of strokes out of several.
struct Chain {
    static constexpr Info info{"chain",
                               "Joins strokes whose ends go on in each other; of doubles one stays."};

    struct Params {
        std::vector<Input> in;
        double gap = 4;
        double angle = 30;
        double dedupe = 1.5;
        double min_length = 4;
        std::vector<StrokeKind> priority;

        static constexpr auto fields = declare(
            field(&Params::in, "in", "Strokes, as many lists as there are.", Constraint{{}, data<Strokes>()})
                .required(),
            field(&Params::gap, "gap",
                  "The widest gap that two ends are joined across, and an end to a line ahead of it; twice "
                  "as wide "
                  "where a line ends straight.",
                  px(0, 50)),
            field(&Params::angle, "angle", "How much the line may turn at a gap.", between(0, 90, "degrees")),
            field(&Params::dedupe, "dedupe",
                  "Of two strokes that run along each other within this only one stays; 0: both do.",
                  px(0, 10)),
            field(
                &Params::min_length, "min_length",
                "What is shorter and has a loose end, or goes round in less, is left out; what has two loose "
                "ends must be half as long again.",
                at_least(0, "pixels")),
            field(
                &Params::priority, "priority",
                "Whose stays, the first first; kinds that are not named follow in the order of their list."));
    };

    static void check(const Params& p, Check& c) {
        if (p.in.empty()) c.error("in", "'in' is empty; there is nothing to join");
    }

    explicit Chain(Params p) : params(std::move(p)) {}

    Strokes derive(const Inputs& in) const {
        Strokes out;
        for (const Input& input : params.in) add(in.datum<Strokes>(input), out);
        arrange(out);
        // What will be too short must not cut another line before it goes.
        out.strokes = join_strokes(std::move(out.strokes), params.gap, params.angle);
        drop_short(out.strokes);
        std::ranges::stable_sort(out.strokes, {}, [&](const Stroke& s) { return rank(s.kind); });
        out.strokes = without_doubles(std::move(out.strokes), params.dedupe, params.min_length);
        out.strokes = join_strokes(std::move(out.strokes), params.gap, params.angle);
        meet_strokes(out.strokes, params.gap);
        drop_short(out.strokes);
        arrange(out);
        return out;
    }
    static std::size_t datum_bytes() { return std::size_t{4} << 20; }

    const Params params;

private:
    static void add(const Strokes& list, Strokes& to) {
        to.display = unite(to.display, list.display);
        to.window = unite(to.window, list.window);
        to.names.insert(list.names.begin(), list.names.end());
        to.strokes.insert(to.strokes.end(), list.strokes.begin(), list.strokes.end());
    }

    std::size_t rank(StrokeKind kind) const {
        const auto named = std::ranges::find(params.priority, kind);
        return named != params.priority.end() ? static_cast<std::size_t>(named - params.priority.begin())
                                              : params.priority.size() + static_cast<std::size_t>(kind);
    }

    void drop_short(std::vector<Stroke>& strokes) const {
        std::erase_if(strokes, [&](const Stroke& s) {
            const bool alone = !s.closed && s.ends[0] == StrokeEnd::kEnd && s.ends[1] == StrokeEnd::kEnd;
            return is_loose(s) && !stands_for_outlines(s) &&
                   length_of(s) < (alone ? kAlone : 1) * params.min_length;
        });
    }

    // The middle of something thin, which has no others any more.
    static bool stands_for_outlines(const Stroke& s) { return s.vertices.front().thickness > 0; }

    static constexpr double kAlone = 1.5;  // what hangs on nothing at both ends is noise more often
    static bool is_loose(const Stroke& s) {
        return s.closed || s.ends[0] == StrokeEnd::kEnd || s.ends[1] == StrokeEnd::kEnd;
    }
};

}  // namespace

KEYLINE_NODE(chain, Chain)

}  // namespace keyline
