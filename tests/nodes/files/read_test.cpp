// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/io/exr_files.h"
#include "tests/support/render_files.h"

#include <cmath>
#include <gmock/gmock.h>

namespace keyline::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class Read : public ::testing::Test {
protected:
    std::string file(const std::string& name) const { return folder_ / name; }

    // What the node makes of a file, and what is told of it.
    Image read(const std::string& name, Json params = {}, int frame = 1) const {
        params.set("file", file(name));
        return run("read", params, std::map<std::string, Image>{}, {.frame = frame});
    }
    Rendered rendered(const std::string& name, Json params = {}, int frame = 1) const {
        params.set("file", file(name)).set("type", "read");
        return render_files(
            {{"in", params},
             {"out", {{"type", "write"}, {"in", "in"}, {"file", file("out/####.exr")}, {"depth", "float"}}}},
            frame);
    }

    const TemporaryFolder folder_;
};

Image flat(float value, const Rect& window = {0, 0, 4, 3}) {
    return Image(window, {"R", "G", "B"}).fill("R", [&](int, int) { return value; });
}

TEST_F(Read, GivesWindowsTypesSamplesAndMetadata) {
    Image image = noise({-3, 2, 40, 31}, {"A", "B", "G", "R", "depth.Z"}, 1);
    image.display = {0, 0, 32, 32};
    image.channels[4].type = SampleType::kUint;
    for (float& s : image.channels[4].samples) s = std::floor(s * 1000);
    image.metadata.set({"artist", "string", std::string("me")});
    write_exr(file("a.exr"), image);
    const Image out = read("a.exr");
    EXPECT_IMAGE(out, image);
    EXPECT_EQ(out.channel("depth.Z").type, SampleType::kUint);
    EXPECT_NE(out.metadata.find("artist"), nullptr);
}

TEST_F(Read, TakesOnePartByNameOrIndex) {
    TestPart beauty, depth;
    beauty.name = "beauty";
    depth.name = "depth";
    depth.channels = {{"Z", SampleType::kFloat}};
    depth.data = {5, 5, 30, 20};
    write_with_openexr(file("parts.exr"), {beauty, depth});
    EXPECT_TRUE(read("parts.exr").has("R"));
    EXPECT_TRUE(read("parts.exr").has("depth.Z"));
    EXPECT_EQ(read("parts.exr").window, beauty.data);
    for (const Json& part : {Json("depth"), Json(1)}) {
        const Image out = read("parts.exr", {{"part", part}});
        EXPECT_EQ(out.channels.size(), 1U);
        EXPECT_EQ(out.window, depth.data);
    }
    const Rendered wrong = rendered("parts.exr", {{"part", "dept"}});
    EXPECT_EQ(wrong.status, 3);
    ASSERT_FALSE(wrong.errors.empty());
    EXPECT_THAT(wrong.errors.front(), HasSubstr("depth"));
}

TEST_F(Read, TakesOneView) {
    TestPart left, right;
    left.name = "rgba_left";
    left.view = "left";
    right.name = "rgba_right";
    right.view = "right";
    right.data = {0, 0, 10, 10};
    write_with_openexr(file("stereo.exr"), {left, right});
    EXPECT_EQ(read("stereo.exr").window, left.data) << "the first part's view is the default";
    EXPECT_EQ(read("stereo.exr", {{"view", "right"}}).window, right.data);
    EXPECT_EQ(rendered("stereo.exr", {{"view", "middle"}}).status, 3);
}

TEST_F(Read, TakesAnotherFrame) {
    for (const int f : {3, 4, 5})
        write_exr(file("a.000" + std::to_string(f) + ".exr"), flat(static_cast<float>(f)));
    EXPECT_EQ(read("a.####.exr", {}, 4).at("R", 0, 0), 4);
    EXPECT_EQ(read("a.####.exr", {{"frame", "-1"}}, 4).at("R", 0, 0), 3);
    EXPECT_EQ(read("a.####.exr", {{"frame", "+1"}}, 4).at("R", 0, 0), 5);
    EXPECT_EQ(read("a.####.exr", {{"frame", 5}}, 3).at("R", 0, 0), 5);
    EXPECT_THAT(rendered("a.####.exr", {{"frame", "next"}}, 4).errors,
                ElementsAre(HasSubstr("'frame' is 'next'")));
}

TEST_F(Read, AMissingFrameFailsUnlessSaidOtherwise) {
    write_exr(file("a.0002.exr"), flat(2));
    write_exr(file("a.0009.exr"), flat(9, {1, 1, 6, 6}));
    const Rendered failed = rendered("a.####.exr", {}, 5);
    EXPECT_EQ(failed.status, 3);
    EXPECT_THAT(failed.errors, ElementsAre(HasSubstr("a.0005.exr")));

    const auto value = [&](const char* missing, int frame) {
        return read("a.####.exr", {{"missing", missing}}, frame).at("R", 2, 2);
    };
    EXPECT_EQ(value("hold", 5), 2) << "the nearest earlier";
    EXPECT_EQ(value("hold", 20), 9);
    EXPECT_EQ(value("hold", 1), 2) << "else the nearest later";
    EXPECT_EQ(value("hold", 9), 9);
    EXPECT_EQ(value("black", 20), 0);
    EXPECT_EQ(value("black", 9), 9);
    EXPECT_EQ(read("a.####.exr", {{"missing", "black"}}, 7).window, (Rect{1, 1, 6, 6})) << "like the nearest";
    EXPECT_EQ(read("a.####.exr", {{"missing", "black"}}, 3).window, (Rect{0, 0, 4, 3}));
    EXPECT_THAT(rendered("a.####.exr", {{"missing", "hold"}}, 5).warnings,
                ElementsAre(HasSubstr("frame 5 is missing; frame 2 stands in")));
}

TEST_F(Read, MendsWhatIsNoNumberAndCountsIt) {
    Image image = noise({0, 0, 50, 40}, {"R", "Z"}, 1);
    image.channels[0].type = SampleType::kHalf;
    image.at("R", 3, 3) = image.at("Z", 7, 30) = std::nanf("");
    image.at("R", 4, 3) = HUGE_VALF;
    image.at("Z", 4, 3) = -HUGE_VALF;
    write_exr(file("a.exr"), image);
    const Image out = read("a.exr");
    EXPECT_EQ(out.at("R", 3, 3), 0);
    EXPECT_EQ(out.at("Z", 7, 30), 0);
    EXPECT_EQ(out.at("R", 4, 3), 65504);
    EXPECT_EQ(out.at("Z", 4, 3), -1e10F);
    EXPECT_THAT(rendered("a.exr").warnings, ElementsAre(HasSubstr("4 NaN or infinite samples mended")));
    EXPECT_THAT(rendered("a.exr", {{"nan", "keep"}}).warnings, IsEmpty());
    EXPECT_TRUE(std::isnan(read("a.exr", {{"nan", "keep"}}).at("Z", 7, 30)));
    const Rendered failed = rendered("a.exr", {{"nan", "error"}});
    EXPECT_EQ(failed.status, 3);
    EXPECT_THAT(failed.errors, ElementsAre(HasSubstr("NaN or infinite sample")));
}

TEST_F(Read, CountsEachSampleOnceHoweverOftenItIsRead) {
    Image image = noise({0, 0, 50, 40}, {"Y"}, 1);
    image.at("Y", 5, 5) = std::nanf("");
    write_exr(file("a.exr"), image);
    const Rendered out = render_files(
        {{"in", {{"type", "read"}, {"file", file("a.exr")}}},
         {"edges", {{"type", "hysteresis"}, {"in", "in"}, {"low", 1}, {"high", 2}, {"units", "percentile"}}},
         {"both",
          {{"type", "write"}, {"in", "edges"}, {"file", file("o.exr")}, {"layers", {{"raw", "in"}}}}}});
    EXPECT_THAT(out.warnings, ElementsAre(HasSubstr("1 NaN or infinite sample mended")));
}

// With little memory the file is decoded for each sweep anew, and for each a region of its own.
TEST_F(Read, WhatIsCountedDoesNotDependOnThePlan) {
    Image image = noise({0, 0, 500, 400}, {"Y", "Z"}, 1);
    for (int x = 0; x < 500; x += 7) image.at("Y", x, 3 + x / 2) = std::nanf("");
    image.at("Z", 5, 350) = std::nanf("");
    write_exr(file("a.exr"), image);
    const Json nodes{
        {"in", {{"type", "read"}, {"file", file("a.exr")}}},
        {"top", {{"type", "crop"}, {"in", "in:Y"}, {"region", {0, 0, 500, 40}}}},
        {"deep", {{"type", "crop"}, {"in", "in:Z"}, {"region", {0, 0, 500, 60}}}},
        {"edges", {{"type", "hysteresis"}, {"in", "top"}, {"low", 1}, {"high", 2}, {"units", "percentile"}}},
        {"out",
         {{"type", "write"},
          {"in", "edges"},
          {"file", file("o.exr")},
          {"layers", {{"raw", "in:Y"}, {"deep", "deep"}}}}}};
    RenderOptions options;
    options.frames = {1};
    options.threads = 2;
    Diagnostics diagnostics;
    const Json graph{{"keyline", 1}, {"nodes", nodes}};
    const auto loaded = Graph::parse(graph.text(), "test.json", ".", {}, diagnostics);
    ASSERT_TRUE(loaded) << diagnostics.errors().front().text();
    const std::optional<Plan> plan = plan_frame(*loaded, 1, options, diagnostics);
    ASSERT_TRUE(plan);
    for (const Weighed& w : plan->weighed) {
        options.memory = w.memory_bytes;
        EXPECT_THAT(render_files(nodes, options).warnings,
                    ElementsAre(HasSubstr("72 NaN or infinite samples mended")))
            << w.keep_sources << w.keep_computed << ' ' << w.tile_width << ' ' << w.tile_height;
    }
}

TEST_F(Read, OnlyWhatIsDemandedIsCounted) {
    Image image = noise({0, 0, 50, 40}, {"R", "Z"}, 1);
    image.at("Z", 5, 5) = std::nanf("");
    write_exr(file("a.exr"), image);
    const Rendered out = render_files({{"in", {{"type", "read"}, {"file", file("a.exr")}}},
                                       {"o", {{"type", "write"}, {"in", "in:R"}, {"file", file("o.exr")}}}});
    EXPECT_THAT(out.warnings, IsEmpty());
}

TEST_F(Read, ConvertsEveryLayerOfColour) {
    Image image = noise({0, 0, 9, 9}, {"R", "G", "B", "Z", "key.R", "key.G", "key.B"}, 1, 0.1F, 0.9F);
    write_exr(file("a.exr"), image);
    const Image out = read("a.exr", {{"colorspace", "sRGB - Texture"}});
    const auto decoded = [](float v) { return std::pow((static_cast<double>(v) + 0.055) / 1.055, 2.4); };
    for (const char* c : {"R", "G", "B", "key.R", "key.G", "key.B"})
        EXPECT_NEAR(out.at(c, 4, 4), decoded(image.at(c, 4, 4)), 1e-5) << c;
    EXPECT_EQ(out.at("Z", 4, 4), image.at("Z", 4, 4));
}

}  // namespace
}  // namespace keyline::testing
