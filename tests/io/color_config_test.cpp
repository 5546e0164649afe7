// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/base/error.h"
#include "engine/color/color.h"
#include "tests/support/failure.h"

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string>
#include <unistd.h>

namespace keyline {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

// A folder of its own for each case, removed with what is in it.
class ColorConfigFile : public ::testing::Test {
protected:
    void SetUp() override { std::filesystem::create_directories(folder_); }
    void TearDown() override { std::filesystem::remove_all(folder_); }

    std::filesystem::path write(const std::string& name, const std::string& text) const {
        std::ofstream(folder_ / name) << text;
        return folder_ / name;
    }

    const std::filesystem::path folder_ = std::filesystem::path(::testing::TempDir()) /
                                          ("keyline_color_" + std::to_string(getpid()) +
                                           ::testing::UnitTest::GetInstance()->current_test_info()->name());
};

constexpr const char* kSmallConfig = R"yaml(ocio_profile_version: 2
roles: {scene_linear: lin, default: lin}
displays:
  tv:
    - !<View> {name: plain, colorspace: dark}
colorspaces:
  - !<ColorSpace> {name: lin, aliases: [linear]}
  - !<ColorSpace>
    name: dark
    from_scene_reference: !<MatrixTransform> {matrix: [0.5, 0, 0, 0, 0, 0.5, 0, 0, 0, 0, 0.5, 0, 0, 0, 0, 1]}
)yaml";

// What a config says of shots: a correction each, and one for those that have none.
TEST_F(ColorConfigFile, HasVariablesInTheNamesOfItsFiles) {
    write("sh010.spi1d", "Version 1\nFrom 0 1\nLength 2\nComponents 1\n{\n0\n2\n}\n");
    write("none.spi1d", "Version 1\nFrom 0 1\nLength 2\nComponents 1\n{\n0\n1\n}\n");
    const auto config = ColorConfig::load(write("show.ocio", R"yaml(ocio_profile_version: 2
environment: {SHOT: none}
search_path: .
roles: {default: lin}
looks:
  - !<Look> {name: grade, process_space: lin, transform: !<FileTransform> {src: $SHOT.spi1d}}
colorspaces:
  - !<ColorSpace> {name: lin}
named_transforms:
  - !<NamedTransform> {name: half, inverse_transform: !<MatrixTransform> {matrix: [2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1]}}
)yaml"));
    const auto red = [](const ColorTransform& transform) {
        float r = 0.25F, g = 0, b = 0;
        transform.apply(&r, &g, &b, nullptr, 1);
        return r;
    };
    EXPECT_EQ(red(config->look("lin", "grade", false)), 0.25F);
    const auto shot = config->in_context({{"SHOT", "sh010"}});
    EXPECT_EQ(red(shot->look("lin", "grade", false)), 0.5F);
    EXPECT_NE(shot->digest(), config->digest());
    EXPECT_EQ(config->in_context({})->digest(), config->digest());
    EXPECT_THAT(error_of([&] {
                    config->in_context({{"SHOTT", "a"}});
                }).what,
                HasSubstr("there is no context variable 'SHOTT' in OCIO config"));

    EXPECT_EQ(red(config->named("half", false)), 0.125F) << "of the inverse, which is all that is said";
    EXPECT_EQ(red(config->named("half", true)), 0.5F);
}

TEST(BuiltinColorConfig, HasTheSpacesDisplaysAndViewsThatItPromises) {
    const auto config = ColorConfig::builtin();
    EXPECT_THAT(config->color_spaces(),
                ElementsAre("sRGB - Display", "Rec.1886 Rec.709 - Display", "P3-D65 - Display",
                            "Linear Rec.709 (sRGB)", "ACEScg", "ACES2065-1", "sRGB - Texture",
                            "Gamma 2.2 Rec.709 - Texture", "Gamma 2.4 Rec.709 - Texture", "ACEScct", "ACEScc",
                            "Raw"));
    EXPECT_THAT(config->displays(),
                ElementsAre("sRGB - Display", "Rec.1886 Rec.709 - Display", "P3-D65 - Display"));
    EXPECT_THAT(config->views("sRGB - Display"),
                ElementsAre("ACES 1.0 - SDR Video", "Un-tone-mapped", "Raw"));
    EXPECT_TRUE(config->views("nothing").empty());
}

float converted(const std::string& from, const std::string& to, float grey) {
    float r = grey, g = grey, b = grey;
    ColorConfig::builtin()->convert(from, to).apply(&r, &g, &b, nullptr, 1);
    EXPECT_NEAR(r, g, 1e-5F);
    EXPECT_NEAR(b, g, 1e-5F);
    return g;
}

// Figures of the specifications: S-2016-001 for ACEScct, S-2014-003 for ACEScc.
TEST(BuiltinColorConfig, SpacesAreWhatTheyAreCalled) {
    EXPECT_NEAR(converted("scene_linear", "ACEScct", 0.18F), 0.4135884, 1e-5);
    EXPECT_NEAR(converted("scene_linear", "ACEScct", 0), 0.0729055, 1e-5);
    EXPECT_NEAR(converted("scene_linear", "ACEScc", 1), 0.5547945, 1e-5);
    EXPECT_NEAR(converted("Gamma 2.2 Rec.709 - Texture", "scene_linear", 0.5F), 0.2176376, 1e-5);
    EXPECT_NEAR(converted("Gamma 2.4 Rec.709 - Texture", "scene_linear", 0.5F), 0.1894646, 1e-5);
    for (const auto& [display, gamma] :
         {std::pair("Rec.1886 Rec.709 - Display", 2.4), std::pair("P3-D65 - Display", 2.6)}) {
        float r = 0.18F, g = 0.18F, b = 0.18F;
        ColorConfig::builtin()
            ->display("scene_linear", display, "Un-tone-mapped")
            .apply(&r, &g, &b, nullptr, 1);
        EXPECT_NEAR(double{g}, std::pow(0.18, 1 / gamma), 1e-4) << display;
    }
}

TEST(BuiltinColorConfig, NamesThatPeopleKnowStandForThem) {
    for (const auto& [name, space] :
         {std::pair("linear", "Linear Rec.709 (sRGB)"), std::pair("sRGB", "sRGB - Texture"),
          std::pair("srgb_tx", "sRGB - Texture"), std::pair("lin_ap1", "ACEScg"),
          std::pair("ACES - ACES2065-1", "ACES2065-1"), std::pair("Utility - Raw", "Raw")})
        EXPECT_TRUE(ColorConfig::builtin()->convert(name, space).identity()) << name;
}

TEST(BuiltinColorConfig, AnUnknownSpaceListsThoseThereAre) {
    const auto config = ColorConfig::builtin();
    const Error e = error_of([&] { config->convert("scene_linear", "ACESgc"); });
    EXPECT_EQ(e.kind, ErrorKind::kGraph);
    EXPECT_EQ(e.what,
              "there is no colour space 'ACESgc' in the built-in OCIO config; it has 'sRGB - Display', "
              "'Rec.1886 Rec.709 - Display', 'P3-D65 - Display', 'Linear Rec.709 (sRGB)', 'ACEScg', "
              "'ACES2065-1', 'sRGB - Texture', 'Gamma 2.2 Rec.709 - Texture', 'Gamma 2.4 Rec.709 - Texture', "
              "'ACEScct', 'ACEScc' and 'Raw'; roles 'data' and 'scene_linear'");
    EXPECT_EQ(e.hint, "did you mean 'ACEScg'?");
    EXPECT_EQ(error_of([&] { config->convert("", "ACEScg"); }).kind, ErrorKind::kGraph);
    EXPECT_EQ(error_of([&] { config->display("scene-linear", "", ""); }).hint,
              "did you mean 'scene_linear'?");
}

TEST(BuiltinColorConfig, AnUnknownDisplayOrViewListsThoseThereAre) {
    const auto config = ColorConfig::builtin();
    const Error display = error_of([&] { config->display("ACEScg", "sRGB Display", ""); });
    EXPECT_EQ(display.kind, ErrorKind::kGraph);
    EXPECT_EQ(display.what,
              "there is no display 'sRGB Display' in the built-in OCIO config; it has 'sRGB - Display', "
              "'Rec.1886 Rec.709 - Display' and 'P3-D65 - Display'");
    EXPECT_EQ(display.hint, "did you mean 'sRGB - Display'?");
    const Error view = error_of([&] { config->display("ACEScg", "", "Filmic"); });
    EXPECT_EQ(view.kind, ErrorKind::kGraph);
    EXPECT_EQ(
        view.what,
        "there is no view 'Filmic' of display 'sRGB - Display' in the built-in OCIO config; it has 'ACES "
        "1.0 - SDR Video', 'Un-tone-mapped' and 'Raw'");
    EXPECT_EQ(view.hint, "");
}

TEST_F(ColorConfigFile, IsUsedByItsOwnNamesAliasesAndRoles) {
    const auto config = ColorConfig::load(write("a.ocio", kSmallConfig));
    EXPECT_THAT(config->color_spaces(), ElementsAre("lin", "dark"));
    float r = 1, g = 2, b = 4;
    config->convert("scene_linear", "dark").apply(&r, &g, &b, nullptr, 1);
    EXPECT_THAT((std::array{r, g, b}), ElementsAre(0.5F, 1.0F, 2.0F));
    config->convert("DARK", "linear").apply(&r, &g, &b, nullptr, 1);
    EXPECT_THAT((std::array{r, g, b}), ElementsAre(1.0F, 2.0F, 4.0F));
    config->display("lin", "", "").apply(&r, &g, &b, nullptr, 1);
    EXPECT_THAT((std::array{r, g, b}), ElementsAre(0.5F, 1.0F, 2.0F));
    EXPECT_EQ(error_of([&] { config->convert("lin", "Raw"); }).what,
              "there is no colour space 'Raw' in " + config->name() +
                  "; it has 'lin' and 'dark'; roles 'default' and 'scene_linear'");
}

TEST_F(ColorConfigFile, ThatIsNotThereListsThoseBesideIt) {
    const auto missing = folder_ / "show.ocio";
    const Error none = error_of([&] { ColorConfig::load(missing); });
    EXPECT_EQ(none.kind, ErrorKind::kInput);
    EXPECT_THAT(none.what, HasSubstr("show.ocio'"));
    EXPECT_THAT(none.what, HasSubstr("holds no .ocio file"));
    EXPECT_EQ(none.hint, "without one, the built-in config is used");
    write("b.ocio", kSmallConfig);
    write("a.ocio", kSmallConfig);
    EXPECT_THAT(error_of([&] { ColorConfig::load(missing); }).what, HasSubstr("holds 'a.ocio' and 'b.ocio'"));
    EXPECT_EQ(error_of([] { ColorConfig::load("no/where.ocio"); }).what,
              "there is no OCIO config 'no/where.ocio'; there is no folder 'no' either");
    EXPECT_THAT(error_of([&] { ColorConfig::load(folder_); }).what, HasSubstr("is not a file"));
}

TEST_F(ColorConfigFile, OfALaterVersionNamesTheVersion) {
    for (const std::string version : {"9", "2.7", "'3.1'"}) {
        const auto file = write("later.ocio", "ocio_profile_version: " + version + "\n");
        const Error e = error_of([&] { ColorConfig::load(file); });
        EXPECT_EQ(e.kind, ErrorKind::kInput);
        const std::string plain = version == "9" ? "9.0" : version == "2.7" ? "2.7" : "3.1";
        EXPECT_THAT(e.what, HasSubstr("later.ocio' is of version " + plain +
                                      ", which is later than this build knows; OpenColorIO "));
    }
}

TEST_F(ColorConfigFile, ThatIsNoConfigSaysWhatIsWrongOnOneLine) {
    for (const char* text : {"", "hello", "ocio_profile_version: 2\n a: [\n", "PK\x03\x04\xff", "\n\n{"}) {
        const auto file = write("bad.ocio", text);
        const Error e = error_of([&] { ColorConfig::load(file); });
        EXPECT_EQ(e.kind, ErrorKind::kInput);
        EXPECT_THAT(e.what, testing::StartsWith("can't read OCIO config '"));
        EXPECT_EQ(e.what.find('\n'), std::string::npos) << e.what;
    }
}

TEST_F(ColorConfigFile, ALookUpTableThatIsNotThereIsAnInputError) {
    std::string text = kSmallConfig;
    text +=
        "  - !<ColorSpace>\n    name: film\n    from_scene_reference: !<FileTransform> {src: film.cube}\n";
    const auto config = ColorConfig::load(write("a.ocio", text));
    const Error e = error_of([&] { config->convert("lin", "film"); });
    EXPECT_EQ(e.kind, ErrorKind::kInput);
    EXPECT_THAT(e.what,
                testing::StartsWith("can't prepare the conversion from 'lin' to 'film' in OCIO config"));
    EXPECT_THAT(e.what, HasSubstr("film.cube"));
}

TEST(OcioEnvironment, SwitchesAreClearedAndTheConfigsNameStays) {
    setenv("OCIO_OPTIMIZATION_FLAGS", "0", 1);
    setenv("OCIO_INACTIVE_COLORSPACES", "ACEScg", 1);
    setenv("OCIO", "/show/config.ocio", 1);
    clear_ocio_environment();
    EXPECT_EQ(std::getenv("OCIO_OPTIMIZATION_FLAGS"), nullptr);
    EXPECT_EQ(std::getenv("OCIO_INACTIVE_COLORSPACES"), nullptr);
    EXPECT_STREQ(std::getenv("OCIO"), "/show/config.ocio");
    unsetenv("OCIO");
    EXPECT_THAT(ColorConfig::builtin()->color_spaces(), testing::Contains("ACEScg"));
}

}  // namespace
}  // namespace keyline
