// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/lights.h"

namespace keyline {

namespace {

// The realistic baseline to hold a drawn look against.
struct Phong {
    static constexpr Info info{"phong", "Shades as a smooth plastic under lights would look."};

    struct Params : Surface {
        Input position;
        std::optional<Input> shadow;
        std::vector<Light> lights;
        std::array<double, 3> eye{};
        double ambient_factor = 1, diffuse = 1, specular = 1, exponent = 30;
        Color ambient;

        static constexpr auto fields = declare_surface(
            input(&Params::position, "position", "In world space.", named("X", "Y", "Z")),
            input(&Params::shadow, "shadow", "Where light arrives, of every light: 1 is lit.", matte()),
            field(&Params::lights, "lights", "Each has a direction or a position.").required(),
            field(&Params::eye, "eye", "Where the camera is, in world space.").required(),
            field(&Params::ambient_factor, "Ka", "How much ambient light there is."),
            field(&Params::diffuse, "Kd", "How much the surface scatters."),
            field(&Params::specular, "Ks", "How much it mirrors."),
            field(&Params::exponent, "exponent", "The larger, the smaller a highlight.", between(0.01, 1e5)),
            field(&Params::ambient, "ambient", "The colour of light that comes from everywhere."));
    };
    static constexpr auto outputs = kShadedChannels;

    static void check(const Params& p, Check& c) { check_lights(p.lights, true, c); }

    explicit Phong(const Params& p)
        : params(p),
          lights(p.lights),
          tones{{p.ambient_factor * p.ambient.r, p.ambient_factor * p.ambient.g,
                 p.ambient_factor * p.ambient.b},
                p.diffuse,
                p.specular,
                p.exponent} {}

    double cost() const { return 60 + 120.0 * static_cast<double>(lights.size()); }

    void compute(const Inputs& in, Outputs out, Scratch& scratch) const {
        SurfaceRun surface(params, in, scratch);
        LightRun light(lights, params.position, params.shadow, in, scratch);
        const simd::UnitRows eye = take_vectors(scratch);
        const auto distance = scratch.take<double>(kRunLength), normal_eye = scratch.take<double>(kRunLength);
        for_each_run(out[0].rect, [&](const RowPart& run) {
            surface.read(run);
            simd::toward_row(xyz_rows(in[params.position], run), params.eye, run.n, eye, distance.data());
            simd::dot_row(surface.normal(), eye, run.n, normal_eye.data());
            light.read(run, surface.normal(), &eye);
            simd::phong_row(surface.rows(), light.rows(), normal_eye.data(), tones, run.n,
                            shaded_rows(out, run));
        });
    }

    const Params params;
    const Lighting lights;
    const simd::PhongTones tones;
};

}  // namespace

KEYLINE_NODE(phong, Phong)

}  // namespace keyline
