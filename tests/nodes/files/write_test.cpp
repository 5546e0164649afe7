// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/io/exr_files.h"
#include "tests/support/render_files.h"

#include <cmath>
#include <fstream>
#include <gmock/gmock.h>

namespace keyline::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::vector<std::string> names(const Image& image) {
    std::vector<std::string> out;
    for (const Image::Channel& c : image.channels) out.push_back(c.name);
    return out;
}

class Write : public ::testing::Test {
protected:
    std::string file(const std::string& name) const { return folder_ / name; }

    // Writes what a file holds, perhaps with nodes between that make `from`.
    Rendered rewritten(const Json& params, const Json& between = {}, const std::string& from = "in") const {
        Json nodes = between, write = params;
        nodes.set("in", {{"type", "read"}, {"file", file("in.exr")}});
        nodes.set("out", write.set("type", "write").set("in", from).set("file", file("out.exr")));
        return render_files(nodes);
    }
    Image result() const { return read_exr(file("out.exr")); }

    const TemporaryFolder folder_;
};

Image passes() {
    Image image =
        noise({-3, 2, 40, 31}, {"A", "B", "G", "R", "depth.Z", "id.X", "key.B", "key.G", "key.R"}, 1);
    image.display = {0, 0, 32, 32};
    for (const std::size_t c : {0U, 1U, 2U, 3U}) image.channels[c].type = SampleType::kHalf;
    return image;
}

TEST_F(Write, UntouchedSamplesKeepTypeAndBits) {
    write_exr(file("in.exr"), passes());
    const Image before = read_exr(file("in.exr"));
    EXPECT_THAT(rewritten({}).warnings, IsEmpty());
    const Image after = result();
    EXPECT_IMAGE(after, before);
    for (std::size_t c = 0; c < before.channels.size(); ++c)
        EXPECT_EQ(after.channels[c].type, before.channels[c].type);
}

TEST_F(Write, UntouchedUintsAboveWhatAFloatHoldsKeepTheirBits) {
    Pixels ids(SampleType::kUint, {0, 0, 60, 20});
    for (std::size_t i = 0; i < 1200; ++i) {
        const auto id = static_cast<uint32_t>(0xFFFFFFFFU - 7 * i);
        std::memcpy(ids.bytes.data() + 4 * i, &id, 4);
    }
    SinkSpec spec;
    spec.display_window = spec.data_window = ids.window;
    write_with_keyline(file("in.exr"), {{"id", ids}}, spec);
    const Rendered out = rewritten({});
    EXPECT_TRUE(read_with_keyline(file("out.exr")).at("id") == ids);
    EXPECT_THAT(out.warnings, ElementsAre(HasSubstr("uint samples above 2^24")));
}

TEST_F(Write, ComputedSamplesAreHalf) {
    write_exr(file("in.exr"), passes());
    rewritten({}, {{"y", {{"type", "ycolor"}, {"in", "in:key"}}}}, "y");
    EXPECT_EQ(result().channel("Y").type, SampleType::kHalf);
    rewritten({{"depth", "float"}}, {{"y", {{"type", "ycolor"}, {"in", "in:key"}}}}, "y");
    EXPECT_EQ(result().channel("Y").type, SampleType::kFloat);
    EXPECT_IMAGE(result(), run("ycolor", {}, layer_of(read_exr(file("in.exr")), "key")));
}

TEST_F(Write, ADepthAskedForHoldsForAll) {
    write_exr(file("in.exr"), passes());
    rewritten({{"depth", "half"}});
    for (const Image::Channel& c : result().channels)  // half would destroy ids
        EXPECT_EQ(c.type, c.name == "id.X" ? SampleType::kFloat : SampleType::kHalf) << c.name;
    EXPECT_THAT(rewritten({{"depth", "uint8"}}).errors, ElementsAre(HasSubstr("uint8")));
}

TEST_F(Write, ChannelsAndLayersMayBeChosen) {
    write_exr(file("in.exr"), passes());
    rewritten({{"channels", {"key", "depth.Z", "A"}}});
    EXPECT_THAT(names(result()), ElementsAre("A", "depth.Z", "key.B", "key.G", "key.R"));
    EXPECT_THAT(rewritten({{"channels", Json::array({"keys"})}}).errors,
                ElementsAre(AllOf(HasSubstr("'keys'"), HasSubstr("test.json"))));
}

TEST_F(Write, FurtherInputsBecomeLayers) {
    write_exr(file("in.exr"), passes());
    const Json between{{"y", {{"type", "ycolor"}, {"in", "in:key"}}}};
    rewritten({{"layers", {{"grey", "y"}, {"more.depth", "in:depth"}}}}, between, "in:key");
    EXPECT_THAT(names(result()), ElementsAre("B", "G", "R", "grey.Y", "more.depth.Z"));
    EXPECT_THAT(rewritten({{"layers", {{"key", "in:key"}}}}).errors, ElementsAre(HasSubstr("written twice")));
}

TEST_F(Write, TheDataWindowHoldsAllThatIsWritten) {
    write_exr(file("in.exr"), passes());
    const Json between{{"page", {{"type", "constant"}, {"color", {1, 1, 1}}, {"size", {50, 5}}}}};
    rewritten({{"layers", {{"page", "page"}}}, {"channels", {"page", "depth"}}}, between);
    const Image out = result();
    EXPECT_EQ(out.window, (Rect{-3, 0, 50, 31}));
    EXPECT_EQ(out.display, (Rect{0, 0, 32, 32}));
    EXPECT_EQ(out.at("page.R", 49, 4), 1);
    EXPECT_EQ(out.at("page.R", 49, 5), 0);
    EXPECT_EQ(out.at("depth.Z", 49, 4), 0);
    EXPECT_EQ(out.at("depth.Z", 0, 4), read_exr(file("in.exr")).at("depth.Z", 0, 4));
}

TEST_F(Write, ValuesBeyondHalfAreCounted) {
    write_exr(file("in.exr"), passes());
    const Json between{{"page", {{"type", "constant"}, {"color", {70000, 1, -70000}}, {"size", {10, 10}}}}};
    const Rendered out = rewritten({}, between, "page");
    EXPECT_THAT(out.warnings, ElementsAre(HasSubstr("200 values beyond half's range became infinity")));
    EXPECT_EQ(result().at("R", 0, 0), HUGE_VALF);
    EXPECT_THAT(rewritten({{"depth", "float"}}, between, "page").warnings, IsEmpty());
}

TEST_F(Write, ConvertsEveryLayerOfColour) {
    write_exr(file("in.exr"), passes());
    rewritten({{"colorspace", "sRGB - Texture"}, {"depth", "float"}});
    const Image in = read_exr(file("in.exr")), out = result();
    const double v = in.at("key.G", 9, 9);
    EXPECT_NEAR(out.at("key.G", 9, 9), v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055,
                1e-5);
    EXPECT_EQ(out.at("depth.Z", 9, 9), in.at("depth.Z", 9, 9));
}

TEST_F(Write, AnEmptyWindowIsOneZeroPixelAtTheDisplaysCorner) {
    Image empty({0, 0, 0, 0}, {"Y"});
    empty.display = {5, 6, 20, 20};
    write_exr(file("out.exr"), empty);
    EXPECT_EQ(result().window, (Rect{5, 6, 6, 7}));
    EXPECT_EQ(result().at("Y", 5, 6), 0);
}

TEST_F(Write, ToAFormatOfOtherTypesSamplesAreConverted) {
    Image image = noise({0, 0, 20, 10}, {"B", "G", "R"}, 1);
    for (Image::Channel& c : image.channels) c.type = SampleType::kHalf;
    write_exr(file("in.exr"), image);
    const Rendered out = render_files(
        {{"in", {{"type", "read"}, {"file", file("in.exr")}}},
         {"out", {{"type", "write"}, {"in", "in"}, {"file", file("out.png")}, {"depth", "uint16"}}}});
    ASSERT_THAT(out.errors, IsEmpty());
    const Image back = run("read", {{"file", file("out.png")}}, std::map<std::string, Image>{});
    for (const char* c : {"R", "G", "B"})
        for (int x = 0; x < 20; ++x) EXPECT_NEAR(back.at(c, x, 7), image.at(c, x, 7), 6e-4) << c << ' ' << x;
}

// Computed samples become half, but half would round the bits that ids are.
// They have no tile that would bring them on their way.
TEST_F(Write, RowsOutsideTheDataWindowAreTheSameWhoeverEncodesThem) {
    Image image = noise({0, 1500, 40, 1650}, {"B", "G", "R"}, 1, 0, 1);
    image.display = {0, 0, 40, 4000};
    write_exr(file("in.exr"), image);
    const auto written = [&](int threads) {
        RenderOptions options;
        options.frames = {1};
        options.threads = threads;
        const Json nodes{{"in", {{"type", "read"}, {"file", file("in.exr")}}},
                         {"out", {{"type", "write"}, {"in", "in"}, {"file", file("out.tif")}}}};
        EXPECT_THAT(render_files(nodes, options).errors, IsEmpty());
        std::ifstream in(file("out.tif"), std::ios::binary);
        return std::string(std::istreambuf_iterator<char>(in), {});
    };
    const std::string one = written(1);
    ASSERT_GT(one.size(), 10'000U);
    for (int i = 0; i < 10; ++i) EXPECT_TRUE(written(4) == one) << "with four threads it is another file";
}

TEST_F(Write, IdsOfACryptomatteStayWhole) {
    const Json nodes{{"in", {{"type", "read"}, {"file", KEYLINE_PASSES}}},
                     {"lines", {{"type", "idedge"}, {"in", "in"}, {"layer", "CryptoObject"}}},
                     {"out", {{"type", "write"}, {"in", "lines"}, {"file", file("out.exr")}}}};
    EXPECT_EQ(render_files(nodes).status, 0);
    EXPECT_EQ(result().channel("ViewLayer.CryptoObject00.r").type, SampleType::kFloat);
    EXPECT_EQ(result().channel("edge").type, SampleType::kHalf);
}

}  // namespace
}  // namespace keyline::testing
