// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/contours.h"

#include "engine/kit/middles.h"
#include "engine/kit/object_ids.h"
#include "engine/kit/wanted_objects.h"
#include "engine/node/node_adaptor.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace keyline {

namespace {

using Names = std::map<uint32_t, std::string>;

// All crossings and thin parts of the frame, linked.
struct LinkCrossings {
    struct Params {
        Input crossings, thin;
        static constexpr auto fields = declare(input(&Params::crossings, "crossings", "", any_channels()),
                                               input(&Params::thin, "thin", "", any_channels()));
    };
    struct Found {
        std::vector<Crossing> crossings;
        std::vector<ThinPoint> thin;
    };
    struct State {
        Rect extent;
        Found found;
    };
    using Partial = Found;

    static State start(const Rect& window) { return {window, {}}; }
    static Partial map(const State&, const Inputs& in, const Rect& block, Scratch&) {
        return {crossings_in(in.slot(0), block), thin_points_in(in.slot(1), block)};
    }
    static void fold(State& state, Partial&& found) {
        Found& all = state.found;
        all.crossings.insert(all.crossings.end(), found.crossings.begin(), found.crossings.end());
        all.thin.insert(all.thin.end(), found.thin.begin(), found.thin.end());
    }
    Strokes finish(State state) const {
        Strokes out{display, window, names, {}};
        out.strokes = strokes_of(link_borders(std::move(state.found.crossings), state.extent), options);
        Middles middles = middles_of(std::move(state.found.thin), {thin, options.min_length, state.extent});
        out.strokes = outlines_beside(std::move(out.strokes), middles, options.min_length);
        for (const auto& list : {middles.things, middles.gaps})
            out.strokes.insert(out.strokes.end(), list.begin(), list.end());
        if (kind)
            for (Stroke& s : out.strokes) s.kind = *kind;
        if (owners) std::erase_if(out.strokes, [&](const Stroke& s) { return !is_wanted(s.near); });
        arrange(out);
        return out;
    }

    // A pixel in a hundred with a border is a busy picture.
    static constexpr std::size_t kBusy = 100;
    static std::size_t state_bytes(const Rect& window) {
        return static_cast<std::size_t>(window.area()) / kBusy *
               (3 * sizeof(Crossing) + 3 * sizeof(ThinPoint) + sizeof(StrokeVertex));
    }
    static std::size_t partial_bytes(const Rect& block) {
        return static_cast<std::size_t>(block.area()) * (2 * sizeof(Crossing) + sizeof(ThinPoint));
    }
    static std::size_t datum_bytes(const Rect& window) {
        return static_cast<std::size_t>(window.area()) / kBusy * sizeof(StrokeVertex);
    }

    bool is_wanted(uint32_t id) const { return std::ranges::binary_search(*owners, id); }

    const ContourOptions options;
    const double thin;
    const std::optional<StrokeKind> kind;               // of all; else each has its own
    const std::optional<std::vector<uint32_t>> owners;  // whose lines stay, sorted; else all
    const Rect display, window;
    const Names names;
};

struct Contours {
    static constexpr Info info{"contours",
                               "The outlines of objects and the lines where they meet, as strokes."};

    struct Params {
        Input in;
        std::string layer;
        std::vector<std::string> objects{"*"};
        std::optional<Input> depth;
        double sigma = 0.7;
        std::array<double, 2> step{1, 3};
        double thin = 1.5;
        double min_length = 4;
        std::optional<StrokeKind> kind;

        static constexpr auto fields = declare(
            input(&Params::in, "in",
                  "An image with a Cryptomatte, all of its layers; or one channel of ids, whose lines are "
                  "less exact."),
            field(&Params::layer, "layer", "The Cryptomatte's name; empty where there is but one.")
                .naming(Naming::kCryptomatte),
            field(&Params::objects, "objects",
                  "Whose lines stay, by name: * stands for any characters, \\* for a star. A line belongs to "
                  "the nearer of "
                  "two objects.")
                .naming(Naming::kObject),
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
            field(&Params::thin, "thin",
                  "What is thinner, as whiskers and wires, is one stroke along its middle, called \"ridge\", "
                  "that "
                  "knows how thick it is; so is a gap between nearer things. 0: all have outlines.",
                  px(0, 4)),
            field(&Params::min_length, "min_length",
                  "Closed lines and middles that are shorter are left out.", at_least(0, "pixels")),
            field(&Params::kind, "kind",
                  "What the strokes are called, as \"material\" for a CryptoMaterial; when absent each is "
                  "called after the depth on both sides."));
    };
    using Gives = Strokes;

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
        const Stream crossings =
            found(builder, FindCrossings({params.sigma, ids.integers, pixel_angle}), in, links);
        const Stream thin = found(builder, FindThinParts({kWider * params.thin, ids.integers}), in, links);
        const ContourOptions options{params.sigma, pixel_angle, params.step, params.min_length,
                                     ids.crypto ? kOfCoverage : kOfIds};
        const auto manifest = ids.crypto ? manifest_of(builder, *ids.crypto->info) : nullptr;
        return add_operation(builder,
                             LinkCrossings{options, params.thin, params.kind,
                                           owners(builder, ids.crypto.has_value(), manifest), in.display,
                                           in.window, names_in(manifest)},
                             {crossings, thin});
    }

    const Params params;

private:
    // How exact lines are, measured on edges at random and coverage of 64 samples, and on ids at centres.
    static constexpr double kOfCoverage = 0.05, kOfIds = 0.25;
    static constexpr double kWider =
        1.3;  // points are found up to more than what is thin, so that noise does not cut

    template <class Find>
    static Stream found(Builder& builder, const Find& find, Stream in, std::vector<Link> links) {
        const auto node = std::make_shared<const Find>(find);
        in.channels.clear();
        in.window = result_window(*node, links, Find::kOutputs);
        for (const ValueRef v : builder.add(node, std::move(links), in.window, Find::kOutputs))
            in.channels.push_back({fmt::format("{}", v.output), v, Holds::kData});
        return in;
    }

    static std::shared_ptr<const CryptomatteManifest> manifest_of(Builder& builder,
                                                                  const CryptomatteInfo& of) {
        std::vector<std::string> faults;
        auto manifest = CryptomatteManifest::find(builder, of, faults);
        for (const std::string& fault : faults)
            builder.warn(fmt::format("the Cryptomatte '{}': {}", of.layers, fault));
        return manifest;
    }

    static Names names_in(const std::shared_ptr<const CryptomatteManifest>& manifest) {
        Names out;
        if (manifest)
            for (const auto& [name, id] : manifest->entries()) out.emplace(id, name);
        return out;
    }

    // Nothing where all stay.
    std::optional<std::vector<uint32_t>> owners(
        Builder& builder, bool has_names, const std::shared_ptr<const CryptomatteManifest>& manifest) const {
        if (std::ranges::count(params.objects, "*") > 0) return {};
        if (!has_names)
            builder.bad_parameter("objects", "the input is ids, which have no names",
                                  "give it a Cryptomatte, or leave 'objects' out");
        std::vector<uint32_t> out;
        for (const WantedObject& o : wanted_objects(builder, manifest, params.objects)) out.push_back(o.id);
        return out;
    }
};

}  // namespace

KEYLINE_NODE(contours, Contours)

}  // namespace keyline
