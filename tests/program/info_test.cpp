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

// keyline info: what is in files.

namespace keyline::test {

namespace {

using keyline::testing::Image;
using Json = nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr Rect kWindow{4, 2, 12, 6};
constexpr float kInfinity = std::numeric_limits<float>::infinity();

float id_of(const char* name) { return std::bit_cast<float>(cryptomatte_id(name)); }

// Ball over the left half, half covered in one column; floor over the rest.  One name covers nothing, one has
// none.
Image two_objects() {
    Image image(kWindow, {"R", "Crypto00.R", "Crypto00.G", "Crypto00.B", "Crypto00.A"});
    image.channel("R").type = SampleType::kHalf;
    image.fill("Crypto00.R", [](int x, int) { return id_of(x < 8 ? "ball" : "floor"); });
    image.fill("Crypto00.G", [](int x, int) { return x == 7 ? 0.75 : 1; });
    image.fill("Crypto00.B", [](int x, int) { return x == 7 ? id_of("floor") : 0; });
    image.fill("Crypto00.A", [](int x, int) { return x == 7 ? 0.25 : 0; });
    image.metadata.set({"cryptomatte/abc1234/name", "string", "Crypto"});
    image.metadata.set({"cryptomatte/abc1234/manifest", "string",
                        fmt::format(R"({{"ball":"{:08x}","none":"{:08x}"}})", cryptomatte_id("ball"),
                                    cryptomatte_id("none"))});
    return image;
}

class Info : public ProgramTest {
protected:
    void input(const std::string& name, const Image& image) const {
        keyline::testing::write_exr(folder() / name, image);
    }
    std::string told(const std::vector<std::string>& arguments) const {
        std::vector<std::string> all = arguments;
        all.insert(all.begin(), "info");
        const Outcome run = keyline(all);
        EXPECT_EQ(run.status, 0) << run.err;
        EXPECT_EQ(run.err, "");
        return run.out;
    }
    Json json(std::vector<std::string> arguments) const {
        arguments.emplace_back("--json");
        return Json::parse(told(arguments));
    }
};

TEST_F(Info, IsALineALayer) {
    Image image(kWindow, {"R", "G", "B", "depth.Z"});
    image.channel("depth.Z").type = SampleType::kFloat;
    for (const char* c : {"R", "G", "B"}) image.channel(c).type = SampleType::kHalf;
    image.display = {0, 0, 20, 10};
    input("a.exr", image);
    EXPECT_EQ(told({"a.exr"}),
              "a.exr: openexr, 20 × 10 at (0, 0), data 8 × 4 at (4, 2), 4 channels\n"
              "  R G B half\n"
              "  depth: Z float\n");
}

TEST_F(Info, FoldsSequencesAndTellsWhatIsMissing) {
    for (const int frame : {1, 2, 4, 7}) input(fmt::format("a.{:04}.exr", frame), Image(kWindow, {"Y"}));
    for (const int frame : {1, 2}) input(fmt::format("b{}.exr", frame), Image(kWindow, {"Y"}));
    EXPECT_EQ(told({"a.0001.exr", "a.0002.exr", "a.0004.exr", "a.0007.exr", "b1.exr", "b2.exr"}),
              "a.####.exr 1, 2, 4, 7: openexr, 8 × 4 at (4, 2), 1 channel, 3 missing: 3, 5, 6\n"
              "  Y float\n"
              "\n"
              "b#.exr 1, 2: openexr, 8 × 4 at (4, 2), 1 channel\n"
              "  Y float\n");
}

TEST_F(Info, TellsTheFrameThatIsUnlikeTheOthers) {
    for (const int frame : {1, 2, 3})
        input(fmt::format("a.{:04}.exr", frame), Image(kWindow, {frame == 2 ? "Z" : "Y"}));
    const std::string out = told({"a.####.exr"});
    EXPECT_THAT(out, HasSubstr("a.####.exr 1, 3: openexr"));
    EXPECT_THAT(out, HasSubstr("a.####.exr 2: openexr"));
    EXPECT_THAT(out, Not(HasSubstr("missing")));
}

TEST_F(Info, ASequenceWithoutFramesIsAnErrorOfTheInput) {
    const Outcome run = keyline({"info", "a.####.exr"});
    EXPECT_EQ(run.status, 3);
    EXPECT_EQ(run.err, "error: a.####.exr: no such file; no frame of it is on disk\n");
}

TEST_F(Info, AFileThatIsNotThereIsToldWithOneOfNearlyItsName) {
    input("street.0001.exr", Image(kWindow, {"Y"}));
    EXPECT_EQ(keyline({"info", "stret.0001.exr"}).err,
              "error: stret.0001.exr: no such file; did you mean 'street.0001.exr'?\n");
    EXPECT_EQ(
        keyline({"info", "stret.####.exr"}).err,
        "error: stret.####.exr: no such file; no frame of it is on disk; did you mean 'street.0001.exr'?\n");
    EXPECT_EQ(keyline({"info", "house.exr"}).err, "error: house.exr: no such file\n");
}

TEST_F(Info, TypesAreThoseInTheFile) {
    graph(R"("c":   { "type": "constant", "color": [0.5, 0.5, 0.5], "size": [4, 4] },
             "p8":  { "type": "write", "in": "c", "file": "8.png", "depth": "uint8" },
             "p16": { "type": "write", "in": "c", "file": "16.png", "depth": "uint16" },
             "tif": { "type": "write", "in": "c", "file": "f.tif", "depth": "float" })");
    ASSERT_EQ(keyline({"render", "graph.json"}).status, 0);
    EXPECT_THAT(told({"8.png"}), HasSubstr(" uint8\n"));
    EXPECT_THAT(told({"16.png"}), HasSubstr(" uint16\n"));
    EXPECT_THAT(told({"f.tif"}), HasSubstr(" float\n"));
    EXPECT_EQ(json({"8.png"}).at(0).at("parts").at(0).at("channels").at(0).at("type"), "uint8");
}

TEST_F(Info, StatisticsAreOfTheFiniteSamples) {
    Image image(kWindow, {"Y", "bad"});
    image.fill("Y", [](int x, int y) { return y == 2 && x < 8 ? x - 5 : 0; });  // -1 0 1 2
    image.fill("bad", [](int, int) { return std::nanf(""); });
    image.at("Y", 4, 3) = kInfinity;
    image.at("Y", 5, 3) = -kInfinity;
    image.at("Y", 6, 3) = std::nanf("");
    input("a.exr", image);
    const std::string out = told({"a.exr", "--stats"});
    EXPECT_THAT(out, HasSubstr("    Y        -1     0.0689655  2        2         2         1\n"));
    EXPECT_THAT(out, HasSubstr("    bad      -      -          -        0         0         32\n"));
    const Json all = json({"a.exr", "--stats"});
    EXPECT_EQ(all.at(0).at("pixels").at(0).at("statistics").at(0),
              Json::parse(R"({ "channel": "Y", "samples": 32, "least": -1, "mean": 0.06896551724137931,
                               "largest": 2, "negative": 2, "infinite": 2, "nan": 1 })"));
    EXPECT_FALSE(all.at(0).at("pixels").at(0).at("statistics").at(1).contains("least"));
}

// What a float can't hold is told exactly.
TEST_F(Info, StatisticsOfWholeNumbersAreExact) {
    TestPart part;
    part.channels = {{"id", SampleType::kUint}};
    write_with_openexr(folder() / "ids.exr", {part});
    const Pixels ids = read_with_openexr(folder() / "ids.exr").at("id");
    double largest = 0;
    for (int y = 0; y < ids.window.y1; ++y)
        for (int x = 0; x < ids.window.x1; ++x) largest = std::max(largest, ids.at(x, y));
    EXPECT_EQ(json({"ids.exr", "--stats"}).at(0).at("pixels").at(0).at("statistics").at(0).at("largest"),
              largest);
}

TEST_F(Info, ObjectsWithPixelsAreaAndWindow) {
    input("a.exr", two_objects());
    EXPECT_THAT(told({"a.exr", "--objects"}),
                HasSubstr(fmt::format("  2 objects of Crypto\n"
                                      "    pixels  area  window           name\n"
                                      "    20      17.0  5 × 4 at (7, 2)  {:08x}\n"
                                      "    16      15.0  4 × 4 at (4, 2)  ball\n"
                                      "    1 more name of the manifest cover nothing\n",
                                      cryptomatte_id("floor"))));
    const Json matte = json({"a.exr", "--objects"}).at(0).at("pixels").at(0).at("cryptomattes").at(0);
    EXPECT_EQ(matte.at("unseen"), 1);
    EXPECT_EQ(matte.at("objects").at(1),
              Json::parse(fmt::format(R"({{ "name": "ball", "id": "{:08x}", "pixels": 16, "area": 15,
                                            "window": {{ "x": 4, "y": 2, "width": 4, "height": 4 }} }})",
                                      cryptomatte_id("ball"))));
}

TEST_F(Info, APixelInEveryChannelAndItsObjects) {
    Image image = two_objects();
    image.at("R", 7, 3) = 0.25F;
    input("a.exr", image);
    const std::string out = told({"a.exr", "--at", "7,3"});
    EXPECT_THAT(out, HasSubstr("R 0.25"));
    EXPECT_THAT(out, HasSubstr("'ball' covers 0.75\n"));
    EXPECT_THAT(out, HasSubstr(fmt::format("'{:08x}' covers 0.25\n", cryptomatte_id("floor"))));
    EXPECT_THAT(told({"a.exr", "--at=0,0"}), HasSubstr("R 0 (outside the data window)"));
    const Json pixel = json({"a.exr", "--at", "7,3"}).at(0).at("pixels").at(0).at("pixel");
    EXPECT_EQ(pixel.at("objects").at(0),
              Json::parse(R"({ "cryptomatte": "Crypto", "object": "ball", "coverage": 0.75 })"));
}

TEST_F(Info, APointIsTwoWholeNumbers) {
    input("a.exr", two_objects());
    const Outcome run = keyline({"info", "a.exr", "--at", "7"});
    EXPECT_EQ(run.status, 2);
    EXPECT_EQ(run.err, "--at 7: error: it must be X,Y\n");
}

// Every part of every view: what a graph would read of the file is one of them.
TEST_F(Info, LooksIntoEveryPartOfEveryView) {
    TestPart left, right, both;
    left.name = left.view = "left";
    right.name = right.view = "right";
    both.channels = {{"R"}, {"right.R"}};
    both.multi_view = {"left", "right"};
    write_with_openexr(folder() / "a.exr", {left, right});
    write_with_openexr(folder() / "b.exr", {both});
    EXPECT_THAT(told({"a.exr", "--stats"}), HasSubstr("of part 'right' in view 'right'"));
    const std::string out = told({"b.exr", "--stats"});
    EXPECT_THAT(out, HasSubstr("in view 'left'"));
    EXPECT_THAT(out, HasSubstr("in view 'right'"));
}

}  // namespace

}  // namespace keyline::test
