// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/support/run.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <unistd.h>

namespace keyline::testing {
namespace {

class ColourFiles : public ::testing::Test {
protected:
    ColourFiles() { std::filesystem::create_directories(folder_); }
    ~ColourFiles() override { std::filesystem::remove_all(folder_); }

    std::string write(const std::string& name, const std::string& text) const {
        std::ofstream(folder_ / name) << text;
        return (folder_ / name).string();
    }

private:
    std::filesystem::path folder_ =
        std::filesystem::temp_directory_path() / ("keyline-colour-" + std::to_string(getpid()));
};

Image grey() {
    Image image({0, 0, 3, 1}, {"R", "G", "B", "depth.Z"});
    for (Image::Channel& c : image.channels) c.samples = {0, 0.25F, 1};
    return image;
}

using Samples = std::vector<float>;

TEST_F(ColourFiles, ATableOfTwoEntriesIsALine) {
    const std::string file = write("half.cube", "LUT_1D_SIZE 2\n0 0 0\n0.5 0.25 1\n");
    const Image out = run("lut", {{"file", file}}, grey());
    EXPECT_EQ(out.channel("R").samples, (Samples{0, 0.125F, 0.5F}));
    EXPECT_EQ(out.channel("G").samples, (Samples{0, 0.0625F, 0.25F}));
    EXPECT_EQ(out.channel("B").samples, (Samples{0, 0.25F, 1}));
    EXPECT_EQ(out.channel("depth.Z").samples, (Samples{0, 0.25F, 1}));
    const Image back = run("lut", {{"file", file}, {"inverse", true}}, out);
    for (int x = 0; x < 3; ++x) EXPECT_NEAR(back.at("R", x, 0), grey().at("R", x, 0), 1e-6);
}

TEST_F(ColourFiles, ACorrectionIsChosenByItsId) {
    const auto correction = [](const char* id, const char* slope) {
        return std::string("<ColorCorrection id=\"") + id + "\"><SOPNode><Slope>" + slope +
               "</Slope><Offset>0 0 0</Offset><Power>1 1 1</Power></SOPNode></ColorCorrection>";
    };
    const std::string file = write("shots.ccc", "<ColorCorrectionCollection xmlns=\"urn:ASC:CDL:v1.2\">" +
                                                    correction("a", "2 2 2") + correction("b", "0.5 1 4") +
                                                    "</ColorCorrectionCollection>");
    EXPECT_EQ(run("lut", {{"file", file}}, grey()).channel("R").samples, (Samples{0, 0.5F, 2}));
    EXPECT_EQ(run("lut", {{"file", file}, {"id", "b"}}, grey()).channel("B").samples, (Samples{0, 1, 4}));
    EXPECT_NE(error_of("lut", {{"file", file}, {"id", "c"}}, grey()).find("shots.ccc"), std::string::npos);
}

TEST_F(ColourFiles, OneThatCantBeReadIsToldWithItsName) {
    EXPECT_NE(error_of("lut", {{"file", "/nowhere/a.cube"}}, grey()).find("/nowhere/a.cube: no such file"),
              std::string::npos);
    EXPECT_NE(error_of("lut", {{"file", write("a.cube", "LUT_1D_SIZE two\n")}}, grey()).find("a.cube"),
              std::string::npos);
}

TEST(Cdl, IsSlopeOffsetAndPowerThenSaturation) {
    const Image in = noise({0, 0, 40, 3}, {"R", "G", "B"}, 5, -0.5F, 2);
    const std::array slope{1.5, 0.5, 1.0}, offset{0.1, -0.2, 0.0}, power{0.8, 2.0, 1.0};
    const double saturation = 0.7;
    const Image out = run("cdl",
                          {{"slope", {1.5, 0.5, 1}},
                           {"offset", {0.1, -0.2, 0}},
                           {"power", {0.8, 2, 1}},
                           {"saturation", saturation}},
                          in);
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 40; ++x) {
            std::array<double, 3> v{};
            for (std::size_t c = 0; c < 3; ++c) {
                v[c] = double{in.channels[c].samples[static_cast<std::size_t>(y * 40 + x)]} * slope[c] +
                       offset[c];
                if (v[c] > 0) v[c] = std::pow(v[c], power[c]);
            }
            const double luma = 0.2126 * v[0] + 0.7152 * v[1] + 0.0722 * v[2];
            for (std::size_t c = 0; c < 3; ++c)
                EXPECT_NEAR(double{out.channels[c].samples[static_cast<std::size_t>(y * 40 + x)]},
                            luma + saturation * (v[c] - luma), 2e-5 * std::max(1.0, std::fabs(v[c])))
                    << x << ' ' << y << ' ' << c;
        }
}

TEST(Cdl, CanBeTakenBack) {
    const Image in = noise({0, 0, 30, 1}, {"R", "G", "B"}, 6, 0, 1);
    const Json decision{{"slope", {1.2, 0.9, 1.1}}, {"power", {0.9, 1.1, 1}}, {"saturation", 1.3}};
    const Image out = run("cdl", decision, in);
    Json inverse = decision;
    const Image back = run("cdl", inverse.set("inverse", true), out);
    for (int x = 0; x < 30; ++x) EXPECT_NEAR(back.at("G", x, 0), in.at("G", x, 0), 2e-5);
}

}  // namespace
}  // namespace keyline::testing
