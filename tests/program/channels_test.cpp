// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/cryptomatte.h"
#include "tests/io/exr_files.h"
#include "tests/program/program.h"
#include "tests/support/image.h"

#include <bit>
#include <fmt/format.h>
#include <fstream>
#include <gmock/gmock.h>

// What a channel holds, from file to file: ids stay ids, whatever their channels are called on the way, and
// what a file says of channels goes where they go.

namespace keyline::test {

namespace {

using keyline::testing::Image;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr Rect kWindow{0, 0, 16, 8};

float id_of(const char* name) { return std::bit_cast<float>(cryptomatte_id(name)); }

std::string manifest() {
    return fmt::format(R"({{"a":"{:08x}","b":"{:08x}"}})", cryptomatte_id("a"), cryptomatte_id("b"));
}

void set_text(Image& image, const std::string& name, const std::string& text) {
    image.metadata.set({name, "string", text});
}

const Attribute::Value* find_text(const Image& image, const std::string& name) {
    const Attribute* a = image.metadata.find(name);
    return a ? &a->value : nullptr;
}

// Object a on the left half, b on the right, under a picture.  `rgba`: how the Cryptomatte spells its
// channels.
Image two_objects(const std::vector<std::string>& rgba = {"R", "G", "B", "A"},
                  const std::string& name = "Crypto") {
    std::vector<std::string> names{"R", "G", "B", "A"};
    for (const std::string& c : rgba) names.push_back(name + "00." + c);
    Image image(kWindow, names);
    for (const char* c : {"R", "G", "B"})
        image.fill(c, [](int x, int y) { return 0.25 + x * 0.01 + y * 0.03; });
    image.fill("A", [](int, int) { return 1; });
    image.fill(names[4], [](int x, int) { return id_of(x < 8 ? "a" : "b"); });
    image.fill(names[5], [](int, int) { return 1; });
    for (Image::Channel& c : image.channels)
        if (c.name.size() == 1) c.type = SampleType::kHalf;
    set_text(image, "cryptomatte/abc1234/name", name);
    set_text(image, "cryptomatte/abc1234/manifest", manifest());
    return image;
}

class Channels : public ProgramTest {
protected:
    void input(const Image& image, const std::string& name = "in.exr") const {
        keyline::testing::write_exr(folder() / name, image);
    }
    Image output(const std::string& name = "out.exr") const {
        return keyline::testing::read_exr(folder() / name);
    }

    Outcome render(const std::string& nodes) const {
        graph(R"("r": { "type": "read", "file": "in.exr" }, )" + nodes);
        return keyline({"render", "graph.json"});
    }
    Outcome write_of(const std::string& in, const std::string& more = "",
                     const std::string& nodes = "") const {
        return render(
            nodes + fmt::format(R"("w": {{ "type": "write", "in": "{}", "file": "out.exr" {} }})", in, more));
    }
    Outcome matte_of(const std::string& object, const std::string& nodes = "",
                     const std::string& in = "r") const {
        return write_of(
            "m", "",
            nodes + fmt::format(R"("m": {{ "type": "cryptomatte", "in": "{}", "objects": ["{}"] }}, )", in,
                                object));
    }
    double sum(const std::string& channel) const {
        const Image image = output();
        double sum = 0;
        for (const float s : image.channel(channel).samples) sum += double{s};
        return sum;
    }
};

TEST_F(Channels, IdsAreNoColour) {
    input(two_objects());
    const Image in = output("in.exr");
    for (const char* where : {"read", "write"}) {
        SCOPED_TRACE(where);
        const std::string space = R"(, "colorspace": "sRGB - Texture")";
        const bool read = where == std::string("read");
        graph(fmt::format(R"("r": {{ "type": "read", "file": "in.exr" {} }},
                             "w": {{ "type": "write", "in": "r", "file": "out.exr" {} }})",
                          read ? space : "", read ? "" : space));
        const Outcome run = keyline({"render", "graph.json"});
        EXPECT_EQ(run.status, 0) << run.err;
        EXPECT_EQ(output().channel("Crypto00.R").samples, in.channel("Crypto00.R").samples);
        EXPECT_EQ(output().channel("Crypto00.R").type, SampleType::kFloat);
        EXPECT_NE(output().channel("R").samples, in.channel("R").samples);
    }
    const Outcome asked =
        write_of("c", "", R"("c": { "type": "colorspace", "in": "r:Crypto00", "to": "ACEScg" }, )");
    EXPECT_EQ(asked.status, 2);
    EXPECT_THAT(asked.err, HasSubstr("hold ids, which are no colour"));
}

TEST_F(Channels, NormalsInRgbAreNoColour) {
    Image image = keyline::testing::noise(kWindow, {"B", "G", "N.B", "N.G", "N.R", "R"}, 1);
    input(image);
    EXPECT_EQ(write_of("r", R"(, "colorspace": "sRGB - Texture")").status, 0);
    EXPECT_EQ(output().channel("N.R").samples, image.channel("N.R").samples);
    EXPECT_NE(output().channel("R").samples, image.channel("R").samples);
}

TEST_F(Channels, LossyCompressionOfIdsIsRefused) {
    input(two_objects());
    for (const char* lossy : {"dwaa", "dwab", "pxr24"}) {
        const Outcome run = write_of("r", fmt::format(R"(, "compression": "{}")", lossy));
        EXPECT_EQ(run.status, 2) << lossy;
        EXPECT_THAT(run.err, HasSubstr("ids and their coverage must stay whole"));
        EXPECT_THAT(run.err, HasSubstr("use zip"));
        EXPECT_FALSE(exists("out.exr"));
        graph(fmt::format(R"("r": {{ "type": "read", "file": "in.exr" }},
            "w": {{ "type": "write", "in": "r:.", "file": "out.exr", "compression": "{}" }})",
                          lossy));
        EXPECT_EQ(keyline({"check", "graph.json"}).status, 0) << lossy;
    }
    for (const char* exact : {"none", "rle", "zips", "zip", "piz", "b44", "b44a"}) {
        EXPECT_EQ(write_of("r", fmt::format(R"(, "compression": "{}")", exact)).status, 0) << exact;
        EXPECT_EQ(output().channel("Crypto00.R").samples, output("in.exr").channel("Crypto00.R").samples);
    }
}

TEST_F(Channels, HalfIsNotForIds) {
    input(two_objects());
    const Outcome run = write_of("r", R"(, "depth": "half")");
    EXPECT_EQ(run.status, 0);
    EXPECT_THAT(run.err, HasSubstr("ids keep their 32 bits"));
    EXPECT_EQ(output().channel("Crypto00.R").type, SampleType::kFloat);
    graph(R"("r": { "type": "read", "file": "in.exr" },
             "w": { "type": "write", "in": "r:Crypto00", "file": "out.png" })");
    const Outcome png = keyline({"render", "graph.json"});
    EXPECT_EQ(png.status, 2);
    EXPECT_THAT(png.err, HasSubstr("can't hold the ids"));
}

TEST_F(Channels, LinesWrittenAsALayerAreACryptomatteOfTheirOwn) {
    input(two_objects());
    const std::string lines = R"("e": { "type": "idedge", "in": "r" }, )";
    EXPECT_EQ(write_of("r", R"(, "layers": { "lines": "e" })", lines).status, 0);
    const Image out = output();
    EXPECT_EQ(out.channel("lines.Crypto00.r").type, SampleType::kFloat);
    EXPECT_EQ(out.channel("lines.owner").type, SampleType::kFloat);
    EXPECT_EQ(out.channel("lines.edge").type, SampleType::kHalf);
    const std::string prefix =
        fmt::format("cryptomatte/{:08x}", murmur3_32("lines.Crypto")).substr(0, 19) + "/";
    ASSERT_NE(find_text(out, prefix + "name"), nullptr);
    EXPECT_EQ(*find_text(out, prefix + "name"), Attribute::Value("lines.Crypto"));
    EXPECT_EQ(*find_text(out, prefix + "manifest"), Attribute::Value(manifest()));
    EXPECT_EQ(*find_text(out, "cryptomatte/abc1234/name"), Attribute::Value("Crypto"));
    fs::rename(folder() / "out.exr", folder() / "in.exr");
    const Outcome again = write_of(
        "m", "", R"("m": { "type": "cryptomatte", "in": "r", "layer": "lines.Crypto", "objects": ["*"] }, )");
    EXPECT_EQ(again.status, 0) << again.err;
    EXPECT_EQ(sum("matte"), 16);
}

TEST_F(Channels, AttributesGoWhereTheirChannelsGo) {
    Image both = two_objects(), beauty = both, crypto = both;
    beauty.channels.resize(4);
    beauty.metadata = {};
    set_text(beauty, "artist", "me");
    crypto.channels.erase(crypto.channels.begin(), crypto.channels.begin() + 4);
    input(beauty);
    input(crypto, "crypto.exr");
    const std::string c = R"("c": { "type": "read", "file": "crypto.exr" }, )";
    const auto expect_both = [&](const Outcome& run) {
        EXPECT_EQ(run.status, 0) << run.err;
        ASSERT_NE(find_text(output(), "cryptomatte/abc1234/manifest"), nullptr);
        EXPECT_EQ(*find_text(output(), "cryptomatte/abc1234/manifest"), Attribute::Value(manifest()));
        EXPECT_NE(find_text(output(), "artist"), nullptr);
        EXPECT_EQ(output().channel("Crypto00.R").samples, both.channel("Crypto00.R").samples);
    };
    expect_both(write_of("r", R"(, "layers": { "Crypto00": "c:Crypto00" })", c));
    expect_both(write_of(
        "p", "", c + R"("p": { "type": "pack", "layers": { "": "r", "Crypto00": "c:Crypto00" } }, )"));
    expect_both(write_of("p", "", c + R"("p": { "type": "shuffle", "in": "q", "channels":
        { "R": "R", "Crypto00.R": "Crypto00.R", "Crypto00.G": "Crypto00.G" } },
        "q": { "type": "pack", "layers": { "": "r", "Crypto00": "c:Crypto00" } }, )"));
    EXPECT_EQ(write_of("c:.", "", c).status, 2);  // it has none
    EXPECT_EQ(write_of("r", "", c).status, 0);
    EXPECT_EQ(find_text(output(), "cryptomatte/abc1234/manifest"), nullptr);
    const Outcome lost = write_of("r", R"(, "layers": { "odd": "c:Crypto00" })", c);
    EXPECT_EQ(lost.status, 0);
    EXPECT_THAT(lost.err, HasSubstr("written without its attributes"));
}

TEST_F(Channels, AManifestBesideTheImageComesIntoACopyElsewhere) {
    Image image = two_objects();
    image.metadata.erase("cryptomatte/abc1234/manifest");
    set_text(image, "cryptomatte/abc1234/manif_file", "names.json");
    input(image);
    write("names.json", manifest());
    EXPECT_EQ(write_of("r").status, 0);
    EXPECT_NE(find_text(output(), "cryptomatte/abc1234/manif_file"), nullptr);
    graph(
        R"("r": { "type": "read", "file": "in.exr" }, "w": { "type": "write", "in": "r", "file": "far/out.exr" })");
    EXPECT_EQ(keyline({"render", "graph.json"}).status, 0);
    EXPECT_EQ(find_text(output("far/out.exr"), "cryptomatte/abc1234/manif_file"), nullptr);
    EXPECT_EQ(*find_text(output("far/out.exr"), "cryptomatte/abc1234/manifest"),
              Attribute::Value(manifest()));
    fs::remove(folder() / "names.json");
    const Outcome without = keyline({"render", "graph.json"});
    EXPECT_EQ(without.status, 0);
    EXPECT_THAT(without.err, HasSubstr("'names.json' is not there"));
}

TEST_F(Channels, AnImageNamesNoOtherFileToBeRead) {
    Image image = two_objects();
    image.metadata.erase("cryptomatte/abc1234/manifest");
    write("secret.txt", "the secret");
    for (const std::string& name :
         {(folder() / "secret.txt").string(), std::string("/dev/zero"), std::string("..")}) {
        set_text(image, "cryptomatte/abc1234/manif_file", name);
        input(image);
        const Outcome run = matte_of("a");
        EXPECT_EQ(run.status, 0) << run.err;
        EXPECT_THAT(run.err, HasSubstr("is not read"));
        EXPECT_THAT(run.err, Not(HasSubstr("the secret")));
        EXPECT_EQ(sum("matte"), 64);
    }
}

TEST_F(Channels, NodesThatComputeLetIdsPassAndSaySo) {
    input(two_objects());
    const Image in = output("in.exr");
    for (const char* node : {R"("type": "gaussian", "sigma": 2)", R"("type": "dilate", "radius": 2)",
                             R"("type": "math", "op": "multiply", "value": 0.5)"}) {
        SCOPED_TRACE(node);
        const std::string nodes = fmt::format(R"("x": {{ {}, "in": "r" }}, )", node);
        const Outcome run = matte_of("a", nodes, "x");
        EXPECT_EQ(run.status, 0) << run.err;
        EXPECT_THAT(run.err, HasSubstr("hold ids, which can't be computed with"));
        EXPECT_EQ(sum("matte"), 64);
    }
}

TEST_F(Channels, IdsAreResampledToTheNearest) {
    input(two_objects());
    const auto run_of = [&](const std::string& node) {
        return matte_of("a", R"("x": { "in": "r", )" + node + " }, ", "x");
    };
    const Outcome resized = run_of(R"("type": "reformat", "size": [8, 4])");
    EXPECT_THAT(resized.err, HasSubstr("each pixel takes the nearest"));
    EXPECT_EQ(sum("matte"), 16);
    EXPECT_THAT(run_of(R"("type": "transform", "translate": [0.5, 0])").err, HasSubstr("the nearest"));
    const Image moved = output();
    for (const float s : moved.channel("matte").samples) EXPECT_TRUE(s == 0 || s == 1);
    for (const char* exact :
         {R"("type": "transform", "translate": [3, -2])", R"("type": "crop", "region": [0, 0, 16, 8])",
          R"("type": "reformat", "size": [8, 4], "filter": "nearest")"})
        EXPECT_THAT(run_of(exact).err, Not(HasSubstr("warning"))) << exact;
}

// All 32 bits of integers count, from the file through nodes to the file.
TEST_F(Channels, IntegerIdsAreComparedAsIntegers) {
    const std::vector<std::pair<uint32_t, uint32_t>> pairs{{16777216, 16777217},
                                                           {4000000000, 4000000100},
                                                           {0x80000000, 0},
                                                           {0xFFFFFFFF, 0xFFFFFFFE},
                                                           {0x7F800001, 0x7F800002}};
    for (const auto& [left, right] : pairs) {
        SCOPED_TRACE(fmt::format("{} | {}", left, right));
        Pixels ids(SampleType::kUint, kWindow);
        for (std::size_t i = 0; i < 128; ++i)
            std::memcpy(ids.bytes.data() + 4 * i, i % 16 < 8 ? &left : &right, 4);
        SinkSpec spec;
        spec.display_window = spec.data_window = kWindow;
        write_with_keyline(folder() / "in.exr", {{"id", ids}}, spec);
        EXPECT_EQ(write_of("e", "", R"("e": { "type": "idedge", "in": "r" }, )").status, 0);
        EXPECT_EQ(sum("edge"), 16);
        const uint32_t larger = std::max(left, right);
        const Pixels owner = read_with_keyline(folder() / "out.exr").at("owner");
        ASSERT_EQ(owner.type, SampleType::kUint);
        EXPECT_EQ(std::memcmp(owner.bytes.data() + 4 * 7, &larger, 4), 0);
        EXPECT_EQ(write_of("t", "", R"("c": { "type": "crop", "in": "r", "region": [0, 0, 16, 8] },
            "s": { "type": "transform", "in": "c", "translate": [1, 0] },
            "t": { "type": "transform", "in": "s", "translate": [-1, 0] }, )")
                      .status,
                  0);
        const Pixels moved = read_with_keyline(folder() / "out.exr").at("id");
        EXPECT_EQ(moved.type, SampleType::kUint);
        for (int x = 0; x < 16; ++x) EXPECT_EQ(moved.at(x, 5), ids.at(x, 5)) << x;
    }
}

TEST_F(Channels, TwoDigitsMakeNoCryptomatte) {
    Image light = keyline::testing::noise(kWindow, {"B", "G", "R", "light01.B", "light01.G", "light01.R"}, 1);
    input(light);
    const Outcome none = write_of("e", "", R"("e": { "type": "idedge", "in": "r" }, )");
    EXPECT_EQ(none.status, 2);
    EXPECT_THAT(none.err, HasSubstr("'light01' is none"));
    Image both = two_objects();
    for (const char* c : {"light01.B", "light01.G", "light01.R", "light01.A"}) {
        both.channels.push_back(light.channel("light01.R"));
        both.channels.back().name = c;
    }
    input(both);
    EXPECT_EQ(matte_of("a").status, 0);
    EXPECT_EQ(sum("matte"), 64);
}

TEST_F(Channels, HalfIdsAreRefusedByAllWhoCompareThem) {
    Image image = two_objects();
    for (Image::Channel& c : image.channels) c.type = SampleType::kHalf;
    input(image);
    for (const Outcome& run : {matte_of("a"), write_of("e", "", R"("e": { "type": "idedge", "in": "r" }, )"),
                               write_of("e", "", R"("e": { "type": "idedge", "in": "r:Crypto00.R" }, )")}) {
        EXPECT_EQ(run.status, 3);
        EXPECT_THAT(run.err, HasSubstr("stored as half"));
    }
}

TEST_F(Channels, AManifestThatIsNotWholeIsUsedAsFarAsItGoes) {
    const std::string a = manifest().substr(0, 15);
    for (const std::string& text :
         {a + R"(,"b":"12)", a + R"(,"a":)" + a.substr(5) + "}", a + ",\"\xe4\xf3\xe1\":\"12\"}"}) {
        SCOPED_TRACE(text);
        Image image = two_objects();
        set_text(image, "cryptomatte/abc1234/manifest", text);
        input(image);
        for (const char* object : {"a", "b"}) {
            const Outcome run = matte_of(object);
            EXPECT_EQ(run.status, 0) << run.err;
            EXPECT_THAT(run.err, HasSubstr("the manifest is not whole"));
            EXPECT_EQ(sum("matte"), 64);
        }
    }
}

TEST_F(Channels, ANameThatNoPixelShowsIsTold) {
    Image image = two_objects();
    image.metadata.erase("cryptomatte/abc1234/manifest");
    input(image);
    const Outcome there = matte_of("a"), misspelt = matte_of("aa");
    EXPECT_THAT(there.err, Not(HasSubstr("no pixel shows")));
    EXPECT_EQ(misspelt.status, 0);
    EXPECT_THAT(misspelt.err, HasSubstr("no pixel shows 'aa'"));
    input(two_objects());
    const Outcome unknown = matte_of("zebra");
    EXPECT_EQ(unknown.status, 2);
    EXPECT_THAT(unknown.err, HasSubstr("there are 'a' and 'b'"));
}

TEST_F(Channels, OneLevelOfSeveralIsTold) {
    Image image = two_objects();
    for (const char* c : {"R", "G", "B", "A"}) {
        image.channels.push_back(image.channel(std::string("Crypto00.") + c));
        image.channels.back().name = std::string("Crypto01.") + c;
    }
    input(image);
    const Outcome run = matte_of("a", "", "r:Crypto00");
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_THAT(run.err, HasSubstr("1 of the 2 levels of the Cryptomatte 'Crypto'"));
    EXPECT_EQ(sum("matte"), 64);
}

TEST_F(Channels, ComponentsHaveSynonyms) {
    for (const auto& rgba :
         {std::vector<std::string>{"r", "g", "b", "a"}, {"red", "green", "blue", "alpha"}}) {
        input(two_objects(rgba));
        EXPECT_EQ(matte_of("a").status, 0);
        EXPECT_EQ(sum("matte"), 64);
        std::vector<std::string> names;
        for (const std::string& c : rgba) names.push_back("diffuse." + c);
        Image colour = keyline::testing::noise(kWindow, names, 1);
        input(colour);
        EXPECT_EQ(write_of("y", "", R"("y": { "type": "ycolor", "in": "r:diffuse" }, )").status, 0);
        const Outcome graded =
            write_of("g", "", R"("g": { "type": "grade", "in": "r:diffuse", "multiply": 2 }, )");
        EXPECT_EQ(graded.status, 0) << graded.err;
        std::vector<std::string> written;
        for (const Image::Channel& c : output().channels) written.push_back(c.name);
        EXPECT_THAT(written, ::testing::UnorderedElementsAreArray(rgba));
        EXPECT_NEAR(output().at(rgba[0], 3, 3), 2 * colour.at(names[0], 3, 3), 2e-3);
        EXPECT_EQ(write_of("r", R"(, "colorspace": "sRGB - Texture")").status, 0);
        EXPECT_NE(output().channel(names[0]).samples, colour.channel(names[0]).samples);
    }
}

TEST_F(Channels, ADistortedPictureHasOtherPixels) {
    Image image = two_objects();
    image.metadata.set({"pixelAspectRatio", "float", std::vector<float>{2}});
    input(image);
    for (const auto& [resize, ratio] :
         std::vector<std::pair<const char*, float>>{{"distort", 1.0F}, {"none", 2.0F}, {"fit", 2.0F}}) {
        EXPECT_EQ(write_of("x", "",
                           fmt::format(R"("x": {{ "type": "reformat", "in": "r", "size": [32, 8],
            "resize": "{}", "filter": "nearest" }}, )",
                                       resize))
                      .status,
                  0);
        EXPECT_EQ(output().metadata.find("pixelAspectRatio")->value,
                  Attribute::Value(std::vector<float>{ratio}));
    }
}

TEST_F(Channels, AnAlphaIsNoMagnitude) {
    input(two_objects());
    const Outcome run = write_of("h", "", R"("h": { "type": "hysteresis", "in": "r:.", "low": 0.1 }, )");
    EXPECT_EQ(run.status, 2);
    EXPECT_THAT(run.err, HasSubstr("there is no channel 'magnitude'; the input is colour"));
    EXPECT_EQ(write_of("h", "", R"("h": { "type": "hysteresis", "in": "r:A", "low": 0.1 }, )").status, 0);
}

TEST_F(Channels, APaletteTellsWhatItForgets) {
    graph(fmt::format(R"("r": {{ "type": "read", "file": "{}" }},
                         "p": {{ "type": "palette", "in": "r", "layer": "CryptoObject",
                                 "values": {{ "post*": 1, "post03": 2, "suzane": 3 }} }},
                         "out": {{ "type": "write", "in": "p", "file": "out.exr" }})",
                      (plates() / "street_passes.0024.exr").string()));
    const Outcome run = keyline({"check", "graph.json"});
    EXPECT_EQ(run.status, 0);
    EXPECT_THAT(run.err,
                HasSubstr("graph.json:3:26: warning: node 'p' (palette): 'values': all that 'post03' matches "
                          "has an entry before it"));
    EXPECT_THAT(run.err,
                HasSubstr("none of the 22 objects of the Cryptomatte is 'suzane'; did you mean 'suzanne'?"));
    EXPECT_THAT(run.err, HasSubstr("'values' has nothing for 8 of 22 objects: 'ball', "));
    EXPECT_THAT(run.err, HasSubstr("an entry \"*\" is for all others"));
}

// Damaged files have attributes without a type.
TEST_F(Channels, WhatNoFileCanHoldIsDroppedAndTold) {
    Image image = two_objects();
    set_text(image, "note", "x");
    input(image);
    std::string bytes = read(folder() / "in.exr");
    const std::size_t at = bytes.find(std::string("note\0string\0\x01\0\0\0x", 17));
    ASSERT_NE(at, std::string::npos);
    bytes.replace(at, 17, std::string("notestring\0\0\x01\0\0\0x", 17));
    write("in.exr", bytes);
    const Outcome run = write_of("r");
    EXPECT_EQ(run.status, 3) << "the fault is the input's, whose pixels OpenEXRCore does not find";
    EXPECT_THAT(run.err, HasSubstr("no file can hold 1 of the input's attributes"));
    EXPECT_THAT(run.err, HasSubstr("'notestring'"));
    const std::string long_name(300, 'n');
    EXPECT_EQ(write_of("r", fmt::format(R"(, "layers": {{ "{}": "r" }})", long_name)).status, 2);
}

}  // namespace

}  // namespace keyline::test
