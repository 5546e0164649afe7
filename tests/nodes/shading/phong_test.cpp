// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/nodes/shading_reference.h"

#include <gmock/gmock.h>

namespace keyline::testing {
namespace {

struct PhongFormula {
    V3 eye{3, -4, 2};
    double Ka = 1, Kd = 1, Ks = 1, exponent = 30;
    V3 ambient{};

    Json json() const {
        return {{"eye", {eye[0], eye[1], eye[2]}},
                {"Ka", Ka},
                {"Kd", Kd},
                {"Ks", Ks},
                {"exponent", exponent},
                {"ambient", {ambient[0], ambient[1], ambient[2]}}};
    }
    V3 operator()(const PixelHere& p) const {
        const V3 V = unit(minus(eye, p.P));
        V3 C{};
        for (std::size_t c = 0; c < 3; ++c) C[c] = Ka * ambient[c] * p.Cs[c];
        for (const LightHere& light : p.lights) {
            const double facing = dot(light.L, p.N);
            V3 R{};
            for (std::size_t a = 0; a < 3; ++a) R[a] = 2 * facing * p.N[a] - light.L[a];
            const double specular = std::pow(std::max(0.0, dot(R, V)), exponent);
            for (std::size_t c = 0; c < 3; ++c)
                C[c] += light.C[c] * (Kd * p.Cs[c] * std::max(0.0, facing) + Ks * specular);
        }
        return C;
    }
};

std::vector<PhongFormula> formulas() {
    return {{},
            {.exponent = 0.01},
            {.exponent = 1},
            {.exponent = 5000},
            {{0, 0, 9}, 0.5, 0.7, 0.3, 12, {0.2, 0.3, 0.4}}};
}

TEST(Phong, AgreesWithTheFormula) {
    for (const bool premultiplied : {false, true}) {
        ShadedScene scene = random_scene({-19, 7, 51, 40}, 1, premultiplied);
        scene.lights = mixed_lights();
        for (const PhongFormula& formula : formulas())
            EXPECT_IMAGE_NEAR(scene.run("phong", formula.json()), scene.shaded(formula), 1e-5);
    }
}

TEST(Phong, AgreesOnARender) {
    ShadedScene scene = plate_scene();
    scene.images["position"] = noise(scene.images["albedo"].window, {"X", "Y", "Z"}, 7, -2, 2);
    for (const PhongFormula& formula : formulas())
        EXPECT_IMAGE_NEAR(scene.run("phong", formula.json()), scene.shaded(formula), 1e-5);
    const Json params = PhongFormula{}.json();
    EXPECT_IMAGE(scene.run("phong", params, {2, 37}), scene.run("phong", params, {1, 1000}));
}

TEST(Phong, AgreesWhereverTheWindowIs) {
    for (const Rect& window :
         {Rect{0, 0, 1, 1}, Rect{-7, 3, -6, 40}, Rect{100, -200, 901, -199}, Rect{0, 0, 0, 0}}) {
        ShadedScene scene = random_scene(window, 3, true);
        scene.lights = mixed_lights();
        EXPECT_IMAGE_NEAR(scene.run("phong", PhongFormula{}.json()), scene.shaded(PhongFormula{}), 1e-5);
    }
}

TEST(Phong, NanMirrorsNothing) {
    ShadedScene scene = random_scene({0, 0, 1, 1}, 1, false);
    scene.images.erase("shadow");
    scene.images["normal"].at("X", 0, 0) = std::numeric_limits<float>::quiet_NaN();
    scene.lights = {{.direction = V3{0, 0, 1}}};
    const Image out = scene.run("phong", PhongFormula{.ambient = {0.5, 0.5, 0.5}}.json());
    EXPECT_EQ(out.at("R", 0, 0), 0.5F * scene.images["albedo"].at("R", 0, 0));
    EXPECT_EQ(out.at("A", 0, 0), 1);
}

TEST(Phong, NeedsPositionsAndAnEye) {
    ShadedScene scene = random_scene({0, 0, 1, 1}, 1, false);
    scene.lights = {{.direction = V3{0, 0, 1}}};
    EXPECT_THAT(scene.error("phong"), ::testing::HasSubstr("'eye'"));
    scene.images.erase("position");
    EXPECT_THAT(scene.error("phong", PhongFormula{}.json()), ::testing::HasSubstr("'position'"));
}

}  // namespace
}  // namespace keyline::testing
