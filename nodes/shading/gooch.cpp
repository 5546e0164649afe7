// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/lights.h"

namespace keyline {

namespace {

// For technical drawings: shapes are told by temperature, and no tone is so dark that lines vanish in it.
struct Gooch {
    static constexpr Info info{"gooch", "Shades from a cool tone away from the light to a warm one."};

    struct Params : Surface {
        std::optional<Input> position;
        std::vector<LightPlace> lights;
        Color cool{0, 0, 0.55}, warm{0.3, 0.3, 0};
        double alpha = 0.25, beta = 0.5;

        static constexpr auto fields =
            declare_surface(input(&Params::position, "position",
                                  "In world space; for lights that have a position.", named("X", "Y", "Z")),
                            field(&Params::lights, "lights",
                                  "Each has a direction or a position; there is neither colour nor shadow.")
                                .required(),
                            field(&Params::cool, "cool", "The tone of what faces away."),
                            field(&Params::warm, "warm", "The tone of what faces the light."),
                            field(&Params::alpha, "alpha", "How much of the albedo the cool tone gets."),
                            field(&Params::beta, "beta", "How much of the albedo the warm tone gets."));
    };
    static constexpr auto outputs = kShadedChannels;

    static void check(const Params& p, Check& c) { check_lights(p.lights, p.position.has_value(), c); }

    explicit Gooch(const Params& p)
        : params(p),
          lights(p.lights),
          tones{{p.cool.r, p.cool.g, p.cool.b}, {p.warm.r, p.warm.g, p.warm.b}, p.alpha, p.beta} {}

    bool needs(const Input& in) const { return lights.need_position() || !is_input(params.position, in); }
    double cost() const { return 40 + 12.0 * static_cast<double>(lights.size()); }

    void compute(const Inputs& in, Outputs out, Scratch& scratch) const {
        SurfaceRun surface(params, in, scratch);
        LightRun light(lights, params.position, {}, in, scratch);
        for_each_run(out[0].rect, [&](const RowPart& run) {
            surface.read(run);
            light.read(run, surface.normal());
            simd::gooch_row(surface.rows(), light.rows(), tones, run.n, shaded_rows(out, run));
        });
    }

    const Params params;
    const Lighting lights;
    const simd::GoochTones tones;
};

}  // namespace

KEYLINE_NODE(gooch, Gooch)

}  // namespace keyline
