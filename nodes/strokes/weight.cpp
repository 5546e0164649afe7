// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/crowded_strokes.h"
#include "engine/kit/stroke_samples.h"
#include "engine/kit/stroke_sharpness.h"
#include "engine/kit/strokes.h"
#include "engine/kit/wildcard.h"
#include "engine/node/node_adaptor.h"
#include "engine/simd/elementary.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace keyline {

namespace {

enum class Units { kDisplay, kPixels };

constexpr auto words(Units) {
    return std::array{
        Word<Units>{"display", Units::kDisplay, "pixels of a display window 1080 high: the same at any size"},
        Word<Units>{"px", Units::kPixels, "pixels of the frame"}};
}

struct ByDepth {
    double reference = 5;
    double power = 1;
    std::array<double, 2> range{0.5, 1.6};

    static constexpr auto fields = declare(
        field(&ByDepth::reference, "reference", "The depth at which the factor is 1.",
              at_least(1e-6).tested_to(100)),
        field(&ByDepth::power, "power", "How fast it falls behind: 1 as perspective has it, 0 not at all.",
              between(0, 4)),
        field(&ByDepth::range, "range", "The least and the most that it can be.", at_least(0).tested_to(4)));
};

// Which lines a rule is for: "hair*", those of such objects; "hair* × face*", those between two.
struct Pattern {
    explicit Pattern(std::string_view text) {
        for (const std::string_view sign : {" × ", " x "})
            if (const std::size_t at = text.find(sign); at != std::string_view::npos) {
                near = text.substr(0, at);
                far = text.substr(at + sign.size());
                return;
            }
        near = text;
    }
    bool holds(std::string_view of_near, std::string_view of_far) const {
        return far ? matches(of_near, near) && matches(of_far, *far) : matches(of_near, near);
    }

    std::string near;
    std::optional<std::string> far;
};

struct WeightParams {
    Input in;
    double width = 2;
    Units units = Units::kDisplay;
    std::optional<ByDepth> by_depth;
    double by_curvature = 0;
    std::array<double, 2> by_angle{1, 1};
    std::optional<Input> normal;
    Map<double> by_kind, by_object;
    std::optional<Input> map;
    std::array<double, 2> by_map{0, 1};
    double min = 0.3;
    double smooth = 8;
    double as_thick = 0;
    std::optional<double> apart;

    static constexpr auto fields = declare(
        input(&WeightParams::in, "in", "The strokes; what their width is already is a factor, too.",
              data<Strokes>()),
        field(&WeightParams::width, "width", "Across, where all factors are 1.", between(0, 500)),
        field(&WeightParams::units, "units", "What lengths are measured in."),
        field(&WeightParams::by_depth, "by_depth", "What is nearer is wider: (reference / depth)^power."),
        field(&WeightParams::by_curvature, "by_curvature",
              "How much wider where a stroke bends: this much more, times the width, at a radius of 10.",
              between(-1, 4)),
        field(&WeightParams::by_angle, "by_angle",
              "The factors where the surfaces on both sides go on into each other, and where they are back "
              "to back.",
              at_least(0).tested_to(4)),
        input(
            &WeightParams::normal, "normal",
            "Normals, looked up beside the line on both sides, for 'by_angle': against nothing a surface is "
            "back to back. Without them it takes the 'sharpness' that the strokes have, which only files "
            "tell.",
            named("X", "Y", "Z")),
        field(&WeightParams::by_kind, "by_kind", "The factors of kinds: { \"crease\": 0.6 }.",
              at_least(0).tested_to(4)),
        field(&WeightParams::by_object, "by_object",
              "The factors of objects by name, in which * stands for any characters, and of pairs of the "
              "nearer and the farther: { \"hair*\": 0.5, \"hair* × face*\": 0 }. Of several, all count.",
              at_least(0).tested_to(4))
            .naming(Naming::kObject),
        input(&WeightParams::map, "map",
              "An image of one channel that widths follow, looked up beside the line on what it belongs to: "
              "light, or what somebody painted.",
              matte()),
        field(&WeightParams::by_map, "by_map",
              "The factors where the map is 0, and where it is 1: [1.5, 0.6] is heavy in the shade.",
              at_least(0).tested_to(4)),
        field(&WeightParams::min, "min",
              "No factors make a stroke narrower than this share, unless one is 0.", between(0, 1)),
        field(&WeightParams::smooth, "smooth", "The length along a stroke over which changes are evened out.",
              between(0, 200)),
        field(
            &WeightParams::as_thick, "as_thick",
            "How far the middle of something thin is drawn as thick as that is, whatever else: 0 not at all, "
            "1 wholly.",
            between(0, 1)),
        field(&WeightParams::apart, "apart",
              "Where less would be left between two strokes, the later grows thin and gives way: outlines "
              "stay, "
              "creases go. Where it is absent, what runs close flows into one.",
              between(0, 20)));
};

struct Weigh {
    struct Params {
        Input strokes, samples;
        static constexpr auto fields = declare(input(&Params::strokes, "strokes", "", data<Strokes>()),
                                               input(&Params::samples, "samples", "", data<StrokeSamples>()));
    };

    explicit Weigh(WeightParams p) : params(std::move(p)) {
        for (const auto& [pattern, factor] : params.by_object.entries)
            by_object.emplace_back(Pattern(pattern), factor);
    }

    Strokes derive(const Inputs& in) const {
        Strokes out = in.datum<Strokes>(0);
        const double unit = params.units == Units::kPixels ? 1 : display_unit(out);
        SampleReader samples(in.datum<StrokeSamples>(1));
        for (uint32_t s = 0; s < out.strokes.size(); ++s) {
            Stroke& stroke = out.strokes[s];
            const double whole = factor_of(out, stroke);
            for (uint32_t i = 0; i < stroke.vertices.size(); ++i) {
                StrokeVertex& v = stroke.vertices[i];
                double factor = whole * factor_at(v, unit);
                if (params.map) factor *= factor_of_map(double{samples.at(s, i).value_or(0)});
                v.width *= factor > 0 ? std::max(factor, params.min) : 0;
            }
            even_out(stroke, params.smooth * unit);
            for (StrokeVertex& v : stroke.vertices) {
                v.width *= params.width * unit;
                if (v.thickness > 0) v.width += params.as_thick * (v.thickness - v.width);
            }
        }
        if (params.apart) give_way(out, *params.apart * unit);
        return out;
    }
    static std::size_t datum_bytes() { return kUsualStrokes; }

    const WeightParams params;
    std::vector<std::pair<Pattern, double>> by_object;

private:
    // Of all of a stroke.
    double factor_of(const Strokes& all, const Stroke& s) const {
        const auto name = [&](uint32_t id) {
            const auto it = all.names.find(id);
            return it == all.names.end() ? std::string_view() : std::string_view(it->second);
        };
        double factor = 1;
        for (const auto& [kind, f] : params.by_kind.entries)
            if (kind == word_of(s.kind)) factor *= f;
        for (const auto& [pattern, f] : by_object)
            if (pattern.holds(name(s.near), name(s.far))) factor *= f;
        return factor;
    }

    double factor_at(const StrokeVertex& v, double unit) const {
        double factor = 1;
        if (params.by_depth && v.depth > 0) {
            const ByDepth& d = *params.by_depth;
            factor *= std::clamp(elementary::pow(d.reference / v.depth, d.power), d.range[0], d.range[1]);
        }
        factor *= std::max(0.0, 1 + params.by_curvature * std::min(1.0, std::fabs(v.curvature) * 10 * unit));
        if (params.by_angle[0] == params.by_angle[1]) return factor * params.by_angle[0];
        const double cosine = elementary::sin_cos_degrees(v.sharpness).cos;
        factor *= params.by_angle[0] + (params.by_angle[1] - params.by_angle[0]) / 2 * (1 - cosine);
        return factor;
    }

    // What is no number changes nothing.
    double factor_of_map(double value) const {
        if (value != value) return 1;
        return params.by_map[0] + (params.by_map[1] - params.by_map[0]) * std::clamp(value, 0.0, 1.0);
    }

    // The mean over a length along the stroke, what is near counting more.
    static void even_out(Stroke& s, double length) {
        const std::vector<StrokeVertex>& v = s.vertices;
        if (!(length > 0) || v.empty()) return;
        const std::size_t n = v.size(), round = s.closed ? n - 1 : 0;
        // Of a closed stroke there is each vertex once more, before the first and behind the last.
        std::vector<double> widths, arcs;
        const double whole = length_of(s);
        for (std::size_t i = 0; i < n + 2 * round; ++i) {
            const std::size_t k = (i + n - round) % n;
            widths.push_back(v[k].width);
            arcs.push_back(v[k].arc);
        }
        for (std::size_t i = round; i < round + n; ++i) {
            double sum = widths[i], weights = 1;
            const auto add = [&](std::size_t k) {
                double far = std::fabs(arcs[k] - arcs[i]);
                if (k < round || k >= round + n) far = whole - far;
                if (far >= length) return false;
                sum += (1 - far / length) * widths[k];
                weights += 1 - far / length;
                return true;
            };
            for (std::size_t k = i; k-- > i - std::min(i, n - 1) && add(k);) {
            }
            for (std::size_t k = i + 1; k < std::min(widths.size(), i + n) && add(k); ++k) {
            }
            s.vertices[i - round].width = sum / weights;
        }
    }
};

struct Weight {
    static constexpr Info info{"weight",
                               "How wide strokes are: a width, times what each is and where it is."};
    using Gives = Strokes;
    using Params = WeightParams;

    static void check(const Params& p, Check& c) {
        for (const auto& [kind, factor] : p.by_kind.entries)
            if (!kind_of_word(kind))
                c.error("by_kind", fmt::format("there is no kind {}", in_quotes(kind)),
                        did_you_mean(kind, kind_words()));
        if (p.by_depth && p.by_depth->range[0] > p.by_depth->range[1])
            c.error("by_depth",
                    fmt::format("'range' is from {} down to {}", p.by_depth->range[0], p.by_depth->range[1]));
    }

    explicit Weight(Params p) : params(std::move(p)) {}

    Stream expand(Builder& builder) const {
        Stream in = builder.input(params.in);
        if (params.normal) in = with_sharpness(builder, in, builder.input(*params.normal));
        const Stream samples = params.map ? add_operation(builder, SampleBeside{},
                                                          {builder.input(*params.map),
                                                           add_operation(builder, FindPlacesBeside{}, {in})})
                                          : add_operation(builder, NoSamples{}, {});
        return add_operation(builder, Weigh(params), {in, samples});
    }

    const Params params;

private:
    static std::vector<std::string> kind_words() {
        std::vector<std::string> out;
        for (const auto& w : words(StrokeKind{})) out.emplace_back(w.word);
        return out;
    }
    static std::optional<StrokeKind> kind_of_word(std::string_view word) {
        for (const auto& w : words(StrokeKind{}))
            if (w.word == word) return w.value;
        return {};
    }
};

}  // namespace

KEYLINE_NODE(weight, Weight)

}  // namespace keyline
