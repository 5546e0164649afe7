// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/nodes/shading_reference.h"

#include <gmock/gmock.h>

namespace keyline::testing {
namespace {

struct GoochFormula {
    V3 cool{0, 0, 0.55}, warm{0.3, 0.3, 0};
    double alpha = 0.25, beta = 0.5;

    Json json() const {
        return {{"cool", {cool[0], cool[1], cool[2]}},
                {"warm", {warm[0], warm[1], warm[2]}},
                {"alpha", alpha},
                {"beta", beta}};
    }
    V3 operator()(const PixelHere& p) const {
        V3 C{};
        for (std::size_t c = 0; c < 3; ++c)
            for (const LightHere& light : p.lights)
                C[c] += mix(cool[c] + alpha * p.Cs[c], warm[c] + beta * p.Cs[c], light.v);
        return C;
    }
};

const GoochFormula kOther{{0.1, 0.2, 0.3}, {0.6, 0.4, 0.1}, 0.1, 0.8};

// Lights without colour or shadow.
ShadedScene plain(ShadedScene scene) {
    scene.colored_lights = false;
    scene.images.erase("shadow");
    if (scene.lights.empty()) scene.lights = {{.direction = V3{1, 2, 3}}, {.position = V3{0.2, -3, 0.1}}};
    return scene;
}

TEST(Gooch, AgreesWithTheFormula) {
    for (const bool premultiplied : {false, true}) {
        const ShadedScene scene = plain(random_scene({-19, 7, 51, 40}, 1, premultiplied));
        EXPECT_IMAGE_NEAR(scene.run("gooch", {}), scene.shaded(GoochFormula{}), 1e-5);
        EXPECT_IMAGE_NEAR(scene.run("gooch", kOther.json()), scene.shaded(kOther), 1e-5);
    }
}

TEST(Gooch, AgreesOnARender) {
    ShadedScene scene = plain(plate_scene());
    for (TestLight& light : scene.lights) light.intensity = 1;
    EXPECT_IMAGE_NEAR(scene.run("gooch", {}), scene.shaded(GoochFormula{}), 1e-5);
    EXPECT_IMAGE(scene.run("gooch", {}, {2, 37}), scene.run("gooch", {}, {1, 1000}));
}

TEST(Gooch, AgreesWhereverTheWindowIs) {
    for (const Rect& window :
         {Rect{0, 0, 1, 1}, Rect{-7, 3, -6, 40}, Rect{100, -200, 901, -199}, Rect{0, 0, 0, 0}}) {
        const ShadedScene scene = plain(random_scene(window, 3, true));
        EXPECT_IMAGE_NEAR(scene.run("gooch", {}), scene.shaded(GoochFormula{}), 1e-5);
    }
}

TEST(Gooch, RefusesWhatItWouldNotShow) {
    ShadedScene scene = plain(random_scene({0, 0, 2, 2}, 1, false));
    scene.colored_lights = true;
    EXPECT_THAT(scene.error("gooch"), ::testing::HasSubstr("'color'"));
    scene.lights.clear();
    EXPECT_THAT(scene.error("gooch"), ::testing::HasSubstr("'lights' is empty"));
}

}  // namespace
}  // namespace keyline::testing
