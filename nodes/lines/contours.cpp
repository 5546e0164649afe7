// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/contours.h"

#include "engine/kit/object_ids.h"
#include "engine/node/node_adaptor.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>

namespace keyline {

namespace {

using Names = std::map<uint32_t, std::string>;

// All crossings of the frame, linked.
struct LinkCrossings {
    struct Params {
        Input crossings;
        static constexpr auto fields = declare(input(&Params::crossings, "crossings", "", any_channels()));
    };
    struct State {
        Rect extent;
        std::vector<Crossing> crossings;
    };
    using Partial = std::vector<Crossing>;

    static State start(const Rect& window) { return {window, {}}; }
    static Partial map(const State&, const Inputs& in, const Rect& block, Scratch&) {
        return crossings_in(in.slot(0), block);
    }
    static void fold(State& state, Partial&& found) {
        state.crossings.insert(state.crossings.end(), found.begin(), found.end());
    }
    Strokes finish(State state) const {
        Strokes out{display, window, names, {}};
        out.strokes = strokes_of(link_borders(std::move(state.crossings), state.extent), options);
        if (kind)
            for (Stroke& s : out.strokes) s.kind = *kind;
        arrange(out);
        return out;
    }

    // A pixel in a hundred with a border is a busy picture.
    static constexpr std::size_t kBusy = 100;
    static std::size_t state_bytes(const Rect& window) {
        return static_cast<std::size_t>(window.area()) / kBusy *
               (3 * sizeof(Crossing) + sizeof(StrokeVertex));
    }
    static std::size_t partial_bytes(const Rect& block) {
        return static_cast<std::size_t>(2 * block.area()) * sizeof(Crossing);
    }
    static std::size_t datum_bytes(const Rect& window) {
        return static_cast<std::size_t>(window.area()) / kBusy * sizeof(StrokeVertex);
    }

    const ContourOptions options;
    const std::optional<StrokeKind> kind;  // of all; else each has its own
    const Rect display, window;
    const Names names;
};

struct Contours {
    static constexpr Info info{"contours",
                               "The outlines of objects and the lines where they meet, as strokes."};

    struct Params {
        Input in;
        std::string layer;
        std::optional<Input> depth;
        double sigma = 0.7;
        std::array<double, 2> step{1, 3};
        double min_length = 4;
        std::optional<StrokeKind> kind;

        static constexpr auto fields = declare(
            input(&Params::in, "in",
                  "An image with a Cryptomatte, all of its layers; or one channel of ids, whose lines are "
                  "less exact."),
            field(&Params::layer, "layer", "The Cryptomatte's name; empty where there is but one.")
                .naming(Naming::kCryptomatte),
            input(&Params::depth, "depth",
                  "Where objects are nearer, smaller: says whose a line is, and where objects touch.  "
                  "Without it all lines are outlines, of the larger id.",
                  matte("Z")),
            field(&Params::sigma, "sigma",
                  "Standard deviation of the blur that takes the noise of sampling out of the coverage.",
                  px(0.4, 2).tested_to(1)),
            field(
                &Params::step, "step",
                "How far objects are from each other, in pixels of the nearer, where they meet and where one "
                "is before the other; between both a line is what it hangs on.",
                at_least(0, "pixels")),
            field(&Params::min_length, "min_length", "Closed lines that are shorter are left out.",
                  at_least(0, "pixels")),
            field(&Params::kind, "kind",
                  "What the strokes are called, as \"material\" for a CryptoMaterial; when absent each is "
                  "called after the depth on both sides."));
    };
    static constexpr const char* gives = Strokes::kind;

    static void check(const Params& p, Check& c) {
        if (p.step[0] > p.step[1])
            c.error("step", fmt::format("'step' is {} and {}; the second must not be below the first",
                                        p.step[0], p.step[1]));
    }

    explicit Contours(Params p) : params(std::move(p)) {}

    Stream expand(Builder& builder) const {
        const Stream in = builder.input(params.in);
        const ObjectIds ids = find_object_ids(builder, in, params.layer);
        std::vector<Link> links{{in, ids.values}, {}};
        if (params.depth) links[1] = link_depth(builder, *params.depth);
        const double pixel_angle = 1.0 / std::max(in.display.width(), 1);
        const auto find = std::make_shared<const FindCrossings>(
            FindCrossings::Options{params.sigma, ids.integers, pixel_angle});
        Stream crossings = in;
        crossings.channels.clear();
        crossings.window = result_window(*find, links, FindCrossings::kOutputs);
        for (const ValueRef v :
             builder.add(find, std::move(links), crossings.window, FindCrossings::kOutputs))
            crossings.channels.push_back({fmt::format("{}", v.output), v, Holds::kData});
        const ContourOptions options{params.sigma, pixel_angle, params.step, params.min_length,
                                     ids.crypto ? kOfCoverage : kOfIds};
        return add_operation(builder,
                             LinkCrossings{options, params.kind, in.display, in.window,
                                           ids.crypto ? names_of(builder, *ids.crypto->info) : Names{}},
                             {crossings});
    }

    const Params params;

private:
    // How exact lines are, measured on edges at random and coverage of 64 samples, and on ids at centres.
    static constexpr double kOfCoverage = 0.05, kOfIds = 0.25;

    static Names names_of(Builder& builder, const CryptomatteInfo& of) {
        Names out;
        std::vector<std::string> faults;
        const auto manifest = CryptomatteManifest::find(builder, of, faults);
        for (const std::string& fault : faults)
            builder.warn(fmt::format("the Cryptomatte '{}': {}", of.layers, fault));
        if (manifest)
            for (const auto& [name, id] : manifest->entries()) out.emplace(id, name);
        return out;
    }
};

}  // namespace

KEYLINE_NODE(contours, Contours)

}  // namespace keyline
