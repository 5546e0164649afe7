// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/lights.h"

#include <fmt/format.h>

namespace keyline {

namespace {

enum class CelModel { kMatte, kPlastic, kMetallic };

constexpr auto words(CelModel) {
    using W = Word<CelModel>;
    return std::array{
        W{"matte", CelModel::kMatte, "two tones"},
        W{"plastic", CelModel::kPlastic, "with a highlight in the colours of surface and lights"},
        W{"metallic", CelModel::kMetallic, "with a small white highlight"}};
}

// Each light parts the sphere of normals in two tones: v = ½ (1 + L·N), so that no point falls to black.
struct Cel {
    static constexpr Info info{"cel", "Shades a drawing in two tones a light, from passes of a render."};

    struct Params : Surface {
        std::optional<Input> position, shadow;
        std::vector<Light> lights;
        CelModel model = CelModel::kMatte;
        double ambient_factor = 1, diffuse = 1, light = 1, shade = 0.25, lit = 0.5, specular = 1;
        Color ambient;
        std::optional<std::array<double, 2>> transition = std::array{0.49, 0.51};

        static constexpr auto fields = declare_surface(
            input(&Params::position, "position", "In world space; for lights that have a position.",
                  named("X", "Y", "Z")),
            input(&Params::shadow, "shadow", "Where light arrives, of every light: 1 is lit.", matte()),
            field(&Params::lights, "lights", "Each has a direction or a position.").required(),
            field(&Params::model, "model", "What highlights there are."),
            field(&Params::ambient_factor, "Ka", "How much ambient light there is."),
            field(&Params::diffuse, "Kd", "How bright both tones are outside highlights."),
            field(&Params::light, "Kl", "How bright lights are."),
            field(&Params::shade, "Cshad", "How bright the dark tone is."),
            field(&Params::lit, "Cligh", "How bright the light tone is."),
            field(&Params::specular, "Cspec", "How bright plastic's highlights are."),
            field(&Params::ambient, "ambient", "The colour of light that comes from everywhere."),
            field(
                &Params::transition, "transition",
                "Where on v, from 0 facing away to 1 facing the light, the dark tone ends and the light one "
                "begins; null: all the way.",
                between(0, 1)));
    };
    static constexpr auto outputs = kShadedChannels;

    static void check(const Params& p, Check& c) {
        check_lights(p.lights, p.position.has_value(), c);
        if (p.transition && (*p.transition)[0] > (*p.transition)[1])
            c.error("transition",
                    fmt::format("'transition' begins at {} and ends before, at {}", (*p.transition)[0],
                                (*p.transition)[1]),
                    "give the lower number first");
    }

    explicit Cel(const Params& p) : params(p), lights(p.lights), tones(tones_of(p)) {}

    bool needs(const Input& in) const { return lights.need_position() || !is_input(params.position, in); }
    double cost() const { return 40 + 25.0 * static_cast<double>(lights.size()); }

    void compute(const Inputs& in, Outputs out, Scratch& scratch) const {
        SurfaceRun surface(params, in, scratch);
        LightRun light(lights, params.position, params.shadow, in, scratch);
        for_each_run(out[0].rect, [&](const RowPart& run) {
            surface.read(run);
            light.read(run, surface.normal());
            simd::cel_row(surface.rows(), light.rows(), tones, run.n, shaded_rows(out, run));
        });
    }

    const Params params;
    const Lighting lights;
    const simd::CelTones tones;

private:
    static simd::CelTones tones_of(const Params& p) {
        simd::CelTones t{};
        t.continuous = !p.transition;
        if (p.transition) t.transition = {(*p.transition)[0], (*p.transition)[1]};
        t.shade = p.shade;
        t.light = p.light * p.lit;
        t.ambient = {p.ambient_factor * p.ambient.r, p.ambient_factor * p.ambient.g,
                     p.ambient_factor * p.ambient.b};
        t.diffuse = p.diffuse;
        t.has_highlight = p.model != CelModel::kMatte;
        if (p.model == CelModel::kPlastic) {
            t.threshold = 0.925;
            t.highlight = {0.94, 0.985};
            t.tint = p.specular;
            t.shine = p.specular * p.light;
        } else {
            t.threshold = 0.975;
            t.highlight = {0.97, 0.99};
            t.gleam = 1;
        }
        return t;
    }
};

}  // namespace

KEYLINE_NODE(cel, Cel)

}  // namespace keyline
