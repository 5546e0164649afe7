// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/plan/planner.h"
#include "engine/plan/resolve.h"
#include "tests/nodes/shading_reference.h"

#include <gmock/gmock.h>

namespace keyline::testing {
namespace {

using ::testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// The parameters, and C from them.
struct CelFormula {
    std::string model = "matte";
    double Ka = 1, Kd = 1, Kl = 1, Cshad = 0.25, Cligh = 0.5, Cspec = 1;
    V3 ambient{};
    std::optional<std::array<double, 2>> transition = std::array{0.49, 0.51};

    Json json() const {
        Json out{{"model", model}, {"Ka", Ka},
                 {"Kd", Kd},       {"Kl", Kl},
                 {"Cshad", Cshad}, {"Cligh", Cligh},
                 {"Cspec", Cspec}, {"ambient", {ambient[0], ambient[1], ambient[2]}}};
        return out.set("transition", transition ? Json::array({(*transition)[0], (*transition)[1]})
                                                : Json::verbatim("null"));
    }

    V3 operator()(const PixelHere& p) const {
        V3 C{};
        for (std::size_t c = 0; c < 3; ++c) C[c] = channel(p, c);
        return C;
    }

    double channel(const PixelHere& p, std::size_t c) const {
        double brightness = 0, h = 0, S = Cspec * p.Cs[c];
        for (const LightHere& light : p.lights) {
            const double t = transition ? smoothstep((*transition)[0], (*transition)[1], light.v) : light.v;
            brightness += mix(Cshad * p.Cs[c], Kl * light.C[c] * Cligh * p.Cs[c], t);
            if (light.v > (model == "plastic" ? 0.925 : 0.975)) h += light.v * light.v;
            S += Cspec * Kl * light.C[c];
        }
        if (model == "plastic" && h > 0) return mix(brightness, S, smoothstep(0.94, 0.985, h));
        if (model == "metallic" && h > 0) return mix(brightness, 1, smoothstep(0.97, 0.99, h));
        return p.Cs[c] * Ka * ambient[c] + Kd * brightness;
    }
};

std::vector<CelFormula> formulas() {
    std::vector<CelFormula> out;
    for (const char* model : {"matte", "plastic", "metallic"}) {
        out.push_back({.model = model});
        out.push_back({.model = model, .transition = {}});
        out.push_back({.model = model, .transition = std::array{0.2, 0.9}});
        out.push_back({.model = model, .transition = std::array{0.6, 0.6}});
        out.push_back({model, 0.7, 0.6, 0.9, 0.1, 0.4, 0.8, {0.3, 0.2, 0.1}, std::array{0.3, 0.5}});
    }
    return out;
}

TEST(Cel, AgreesWithTheFormulas) {
    ShadedScene scene = random_scene({-19, 7, 51, 40}, 1, false);
    scene.lights = mixed_lights();
    for (const CelFormula& formula : formulas())
        EXPECT_IMAGE_NEAR(scene.run("cel", formula.json()), scene.shaded(formula), 1e-5);
}

TEST(Cel, AgreesOnPremultipliedAlbedo) {
    ShadedScene scene = random_scene({5, -8, 45, 20}, 2, true);
    scene.lights = mixed_lights();
    scene.images["albedo"].fill(
        "A", [&](int x, int y) { return (x + y) % 7 == 0 ? 0 : scene.images["albedo"].at("A", x, y); });
    for (const CelFormula& formula : formulas())
        EXPECT_IMAGE_NEAR(scene.run("cel", formula.json()), scene.shaded(formula), 1e-5);
    scene.images["coverage"] = noise({5, -8, 45, 20}, {"A"}, 9, 0.2F, 1);
    EXPECT_IMAGE_NEAR(scene.run("cel", {}), scene.shaded(CelFormula{}), 1e-5);
}

TEST(Cel, AgreesOnARender) {
    const ShadedScene scene = plate_scene();
    for (const CelFormula& formula : formulas())
        EXPECT_IMAGE_NEAR(scene.run("cel", formula.json()), scene.shaded(formula), 1e-5);
}

TEST(Cel, AgreesWhereverTheWindowsAre) {
    for (const Rect& window :
         {Rect{0, 0, 1, 1}, Rect{-7, 3, -6, 40}, Rect{100, -200, 901, -199}, Rect{0, 0, 0, 0}}) {
        ShadedScene scene = random_scene(window, 3, true);
        scene.lights = mixed_lights();
        EXPECT_IMAGE_NEAR(scene.run("cel", {}), scene.shaded(CelFormula{}), 1e-5);
    }
    ShadedScene scene = random_scene({0, 0, 30, 30}, 4, true);
    scene.lights = mixed_lights();
    scene.images["normal"] = noise({5, 10, 20, 30}, {"X", "Y", "Z"}, 5, -1, 1);
    scene.images["shadow"] = noise({10, 0, 30, 20}, {"A"}, 6);
    EXPECT_IMAGE_NEAR(scene.run("cel", {}), scene.shaded(CelFormula{}), 1e-5);
}

TEST(Cel, DoesNotDependOnTheTile) {
    const ShadedScene scene = plate_scene();
    const Json plastic{{"model", "plastic"}};
    EXPECT_IMAGE(scene.run("cel", plastic, {2, 37}), scene.run("cel", plastic, {1, 1000}));
}

ShadedScene one_pixel(const V3& albedo, const V3& normal) {
    ShadedScene scene;
    scene.images["albedo"] = Image({0, 0, 1, 1}, {"R", "G", "B"});
    scene.images["normal"] = Image({0, 0, 1, 1}, {"X", "Y", "Z"});
    const char *colours[] = {"R", "G", "B"}, *axes[] = {"X", "Y", "Z"};
    for (std::size_t c = 0; c < 3; ++c) {
        scene.images["albedo"].at(colours[c], 0, 0) = static_cast<float>(albedo[c]);
        scene.images["normal"].at(axes[c], 0, 0) = static_cast<float>(normal[c]);
    }
    scene.lights = {{.direction = V3{0, 0, 2}}};
    return scene;
}

TEST(Cel, NothingIsWhereThereIsNoNormal) {
    const Image out = one_pixel({kNan, 1, 1}, {0, -0.0, 0}).run("cel", {});
    for (const char* name : {"R", "G", "B", "A", "Y"}) EXPECT_EQ(out.at(name, 0, 0), 0) << name;
}

TEST(Cel, NanStaysInItsChannelAndDoesNotFaceTheLight) {
    const Image albedo = one_pixel({kNan, 1, 1}, {0, 0, 1}).run("cel", {});
    EXPECT_TRUE(std::isnan(albedo.at("R", 0, 0)));
    EXPECT_EQ(albedo.at("G", 0, 0), 0.5F);
    EXPECT_TRUE(std::isnan(albedo.at("Y", 0, 0)));
    EXPECT_EQ(one_pixel({1, 1, 1}, {0, 0, kNan}).run("cel", {}).at("R", 0, 0), 0.25F);
}

TEST(Cel, NormalsOfAnyLengthAreTheSame) {
    for (const double length : {1e-38, 0.3, 1.0, 1e38})
        EXPECT_EQ(one_pixel({1, 1, 1}, {0, length, length})
                      .run("cel", {{"transition", Json::verbatim("null")}})
                      .at("R", 0, 0),
                  static_cast<float>(mix(0.25, 0.5, 0.5 + std::sqrt(0.125))));
}

TEST(Cel, ALightInThePixelItselfIsSeenFromTheSide) {
    ShadedScene scene = one_pixel({1, 1, 1}, {0, 0, 1});
    scene.images["position"] = Image({0, 0, 1, 1}, {"X", "Y", "Z"});
    scene.lights = {{.position = V3{0, 0, 0}, .falloff = 2}};
    EXPECT_EQ(scene.run("cel", {{"transition", Json::verbatim("null")}}).at("R", 0, 0), 0.125F);
}

// What no light asks for is not decoded.
TEST(Cel, PositionsAreReadForLightsThatHaveOneOnly) {
    const ShadedScene scene = random_scene({0, 0, 20, 20}, 1, false);
    Sequences inputs;
    for (const char* name : {"albedo", "normal", "position"}) inputs[name] = {scene.images.at(name)};
    const auto channels_read = [&](const char* lights) {
        const Json nodes{{"n",
                          {{"type", "cel"},
                           {"albedo", "albedo"},
                           {"normal", "normal"},
                           {"position", "position"},
                           {"lights", Json::verbatim(lights)}}}};
        std::size_t read = 0;
        for (const Store& store : make_plan(resolve_graph(nodes, {"n"}, inputs), {}).stores)
            read += store.values.size();
        return read;
    };
    EXPECT_EQ(channels_read(R"([{ "direction": [0, 0, 1] }])"), 6U);
    EXPECT_EQ(channels_read(R"([{ "direction": [0, 0, 1] }, { "position": [0, 0, 1] }])"), 9U);
}

TEST(Cel, RefusesLightsThatAreNowhereOrInTwoPlaces) {
    ShadedScene scene = one_pixel({1, 1, 1}, {0, 0, 1});
    const auto error = [&](const std::string& lights) {
        try {
            run("cel", {{"lights", Json::verbatim(lights)}}, scene.images);
        } catch (const Failure& f) {
            return std::string(f.what());
        }
        return std::string();
    };
    EXPECT_THAT(error("[]"), HasSubstr("'lights' is empty; give one light at least"));
    EXPECT_THAT(error("[{}]"), HasSubstr("light 1 has neither a 'direction' nor a 'position'; give it one"));
    EXPECT_THAT(error(R"([{"direction": [0, 0, 1]}, {"direction": [0, 0, 1], "position": [1, 1, 1]}])"),
                HasSubstr("light 2 has both a 'direction' and a 'position'; leave one of them out"));
    EXPECT_THAT(error(R"([{"direction": [0, 0, 0]}])"), HasSubstr("the 'direction' of light 1 is [0, 0, 0]"));
    EXPECT_THAT(error(R"([{"position": [0, 0, 1]}])"),
                HasSubstr("light 1 has a 'position', but the node's input 'position' is missing"));
    EXPECT_THAT(error(R"([{"direction": [0, 0, 1], "falloff": 2}])"),
                HasSubstr("no place to measure distances"));
    EXPECT_THAT(error(R"([{"direction": [0, 0, 1], "falloff": 1}])"), HasSubstr("it must be 0 or 2"));
    EXPECT_THAT(error(R"([{"direction": [0, 0, 1], "colour": 1}])"), HasSubstr("did you mean 'color'?"));
    EXPECT_THAT(scene.error("cel", {{"transition", {0.6, 0.4}}}),
                HasSubstr("'transition' begins at 0.6 and ends before, at 0.4"));
}

}  // namespace
}  // namespace keyline::testing
