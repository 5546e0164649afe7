// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/cryptomatte.h"
#include "tests/io/exr_files.h"
#include "tests/program/program.h"
#include "tests/support/image.h"

#include <bit>
#include <cmath>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <limits>
#include <nlohmann/json.hpp>

// keyline diff: what two files differ in.

namespace keyline::test {

namespace {

using keyline::testing::Image;
using Json = nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr Rect kWindow{0, 0, 10, 10};

class Diff : public ProgramTest {
protected:
    void input(const std::string& name, const Image& image) const {
        keyline::testing::write_exr(folder() / name, image);
    }
    // Of a.exr and b.exr.
    Outcome diff(const std::vector<std::string>& options = {}) const {
        std::vector<std::string> arguments{"diff", "a.exr", "b.exr"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        return keyline(arguments);
    }
    Json json(std::vector<std::string> options = {}) const {
        options.emplace_back("--json");
        return Json::parse(diff(options).out);
    }
};

Image grey() {
    Image image(kWindow, {"R", "G", "B"});
    for (const char* c : {"R", "G", "B"}) image.fill(c, [](int, int) { return 0.5; });
    return image;
}

TEST_F(Diff, TheSameIsNothing) {
    input("a.exr", grey());
    input("b.exr", grey());
    const Outcome run = diff();
    EXPECT_EQ(run.status, 0);
    EXPECT_EQ(run.out, "a.exr and b.exr are the same\n");
}

TEST_F(Diff, TellsHowFarAndWhere) {
    Image other = grey();
    other.at("G", 3, 7) = 0.75F;
    other.at("G", 4, 7) = 0.375F;
    input("a.exr", grey());
    input("b.exr", other);
    const Outcome run = diff();
    EXPECT_EQ(run.status, 1);
    EXPECT_EQ(run.err, "");
    EXPECT_EQ(run.out,
              "a.exr and b.exr differ\n"
              "  channel  different  largest  at      mean     50 %  95 %  99 %\n"
              "  G        2          0.25     (3, 7)  0.00375  0     0     0.125\n"
              "  2 more are the same\n");
    const Json pictures = json();
    EXPECT_EQ(pictures.at("same"), false);
    const Json g = pictures.at("pictures").at(0).at("channels").at(1);
    EXPECT_EQ(g, Json::parse(R"({ "channel": "G", "samples": 100, "different": 2, "ids": false, "infinite": 0,
                                  "largest": 0.25, "mean": 0.00375, "p50": 0, "p95": 0, "p99": 0.125,
                                  "x": 3, "y": 7 })"));
}

TEST_F(Diff, WhatIsTolerableIsTheSame) {
    Image other = grey();
    other.at("G", 3, 7) = 0.5625F;
    input("a.exr", grey());
    input("b.exr", other);
    EXPECT_EQ(diff({"--tolerance", "0.0625"}).status, 0);
    EXPECT_EQ(diff({"--tolerance", "0.0624"}).status, 1);
    EXPECT_EQ(diff({"--relative", "0.12"}).status, 0);
    EXPECT_EQ(diff({"--relative", "0.11"}).status, 1);
    EXPECT_THAT(diff({"--tolerance", "1"}).out, HasSubstr("are the same\n  channel"));
}

TEST_F(Diff, NanIsLikeNanAndNothingElse) {
    Image a = grey(), b = grey();
    a.at("R", 1, 1) = b.at("R", 1, 1) = std::nanf("");
    input("a.exr", a);
    input("b.exr", b);
    EXPECT_EQ(diff().status, 0);
    b.at("R", 2, 1) = std::numeric_limits<float>::infinity();
    input("b.exr", b);
    const Outcome run = diff({"--tolerance", "1000"});
    EXPECT_EQ(run.status, 1);
    EXPECT_THAT(run.out, HasSubstr("R        1          infinite  (2, 1)"));
}

// An id that is near another is another object.
TEST_F(Diff, IdsAreTheSameOrNot) {
    Image a(kWindow, {"Crypto00.R", "Crypto00.G", "Crypto00.B", "Crypto00.A"}), b;
    a.fill("Crypto00.R", [](int, int) { return 1.0; });
    a.metadata.set({"cryptomatte/abc1234/name", "string", "Crypto"});
    b = a;
    b.at("Crypto00.R", 0, 0) = std::nextafterf(1, 2);
    input("a.exr", a);
    input("b.exr", b);
    const Outcome run = diff({"--tolerance", "1"});
    EXPECT_EQ(run.status, 1);
    EXPECT_THAT(run.out, HasSubstr("Crypto00.R  1          -        -   -     -     -     ids\n"));
}

TEST_F(Diff, WindowsChannelsTypesAndAttributes) {
    Image a = grey(), b(Rect{0, 0, 9, 10}, {"R", "G", "Z"});
    for (const char* c : {"R", "G"}) b.fill(c, [](int, int) { return 0.5; });
    b.channel("R").type = SampleType::kHalf;
    b.metadata.set({"owner", "string", "me"});
    input("a.exr", a);
    input("b.exr", b);
    const Outcome run = diff();
    EXPECT_EQ(run.status, 1);
    for (const char* text :
         {"display windows: 10 × 10 at (0, 0), and 9 × 10 at (0, 0)", "data windows: 10 × 10",
          "only in a.exr: 'B'", "only in b.exr: 'Z'", "types of R: float, and half", "attributes: 'owner'",
          "R        10         0.5      (9, 0)"})
        EXPECT_THAT(run.out, HasSubstr(text));
}

TEST_F(Diff, AttributesCountWhereTheyAreMeantTo) {
    Image other = grey();
    other.metadata.set({"owner", "string", "me"});
    input("a.exr", grey());
    input("b.exr", other);
    EXPECT_EQ(diff().status, 0);
    EXPECT_THAT(diff().out, HasSubstr("are the same\n  attributes: 'owner'\n"));
    EXPECT_EQ(diff({"--metadata"}).status, 1);
}

TEST_F(Diff, OfOneLayer) {
    Image a(kWindow, {"x.R", "y.R"}), b = a;
    b.at("y.R", 1, 1) = 1;
    input("a.exr", a);
    input("b.exr", b);
    EXPECT_EQ(diff({"--layer", "x"}).status, 0);
    EXPECT_EQ(diff({"--layer", "y"}).status, 1);
    const Outcome run = diff({"--layer", "z"});
    EXPECT_EQ(run.status, 2);
    EXPECT_THAT(run.err, HasSubstr("'z'"));
}

TEST_F(Diff, TheHeatMapIsBlackWhereNothingIs) {
    Image other = grey();
    other.at("G", 3, 7) = 0.75F;
    input("a.exr", grey());
    input("b.exr", other);
    for (const char* file : {"heat.exr", "heat.png"}) {
        const Outcome run = diff({"--heat", file});
        EXPECT_EQ(run.status, 1);
        EXPECT_THAT(run.out, HasSubstr(fmt::format("{}: white is an error of 0.25\n", file)));
    }
    const Image heat = keyline::testing::read_exr(folder() / "heat.exr");
    EXPECT_EQ(heat.at("R", 3, 7), 1);
    double sum = 0;
    for (const float v : heat.channel("R").samples) sum += double{v};
    EXPECT_EQ(sum, 1);
}

TEST_F(Diff, FlipOfWhatLooksTheSameIsNothing) {
    Image other = grey();
    for (const char* c : {"R", "G", "B"}) other.fill(c, [](int x, int) { return x < 5 ? 0.5 : 0.9; });
    input("a.exr", grey());
    input("b.exr", grey());
    EXPECT_EQ(json({"--flip"}).at("pictures").at(0).at("flip").at("mean"), 0);
    input("b.exr", other);
    EXPECT_THAT(diff({"--flip"}).out, HasSubstr("  FLIP: mean 0."));
    const Json flip = json({"--flip"}).at("pictures").at(0).at("flip");
    EXPECT_GT(flip.at("largest"), 0.1);
    EXPECT_GE(flip.at("x"), 4);
}

TEST_F(Diff, WhatCantBeReadIsAnErrorOfTheInput) {
    input("a.exr", grey());
    const Outcome run = diff();
    EXPECT_EQ(run.status, 3);
    EXPECT_THAT(run.err, HasSubstr("b.exr"));
    input("b.exr", grey());
    EXPECT_EQ(diff({"--tolerance", "much"}).status, 2);
    EXPECT_EQ(diff({"--heat", "none/"}).status, 2);
}

TEST_F(Diff, LooksAtEveryView) {
    TestPart both;
    both.channels = {{"R"}, {"right.R"}};
    both.multi_view = {"left", "right"};
    write_with_openexr(folder() / "a.exr", {both});
    write_with_openexr(folder() / "b.exr", {both});
    EXPECT_EQ(diff().status, 0);
    EXPECT_EQ(json().at("pictures").size(), 2U);
}

}  // namespace

}  // namespace keyline::test
