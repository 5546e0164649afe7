// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/cryptomatte.h"
#include "tests/support/run.h"

#include <bit>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <unistd.h>

namespace keyline::testing {
namespace {

// Four pixels: the ball; half the ball, a quarter the box and an eighth nothing in the manifest; the box's
// three quarters; nothing.
Image objects(bool with_manifest = true) {
    const auto id = [](const char* name) { return std::bit_cast<float>(cryptomatte_id(name)); };
    Image image({3, -2, 7, -1},
                {"Crypto00.r", "Crypto00.g", "Crypto00.b", "Crypto00.a", "Crypto01.r", "Crypto01.g"});
    image.channels[0].samples = {id("ball"), id("ball"), id("box"), 0};
    image.channels[1].samples = {1, 0.5F, 0.75F, 0};
    image.channels[2].samples = {0, id("box"), 0, 0};
    image.channels[3].samples = {0, 0.25F, 0, 0};
    image.channels[4].samples = {0, id("stranger"), 0, 0};
    image.channels[5].samples = {0, 0.125F, 0, 0};
    image.metadata.set({"cryptomatte/abc/name", "string", std::string("Crypto")});
    if (with_manifest)
        image.metadata.set({"cryptomatte/abc/manifest", "string",
                            fmt::format(R"({{"ball":"{:08x}","box":"{:08x}"}})", cryptomatte_id("ball"),
                                        cryptomatte_id("box"))});
    return image;
}

using Samples = std::vector<float>;

TEST(Palette, EachObjectHasItsColourByHowMuchItCovers) {
    const Image out = run("palette", {{"colors", {{"ball", {1, 0.5, 0.25}}, {"box", {0, 2, 4}}}}}, objects());
    EXPECT_EQ(out.channel("R").samples, (Samples{1, 0.5F, 0, 0}));
    EXPECT_EQ(out.channel("G").samples, (Samples{0.5F, 0.25F + 0.5F, 1.5F, 0}));
    EXPECT_EQ(out.channel("B").samples, (Samples{0.25F, 0.125F + 1, 3, 0}));
    EXPECT_EQ(out.channel("A").samples, (Samples{1, 0.75F, 0.75F, 0}));
}

TEST(Palette, NumbersMakeOneChannel) {
    const Image out = run("palette", {{"values", {{"ball", 8}, {"box", -4}}}}, objects());
    ASSERT_EQ(out.channels.size(), 1U);
    EXPECT_EQ(out.channel("value").samples, (Samples{8, 3, -3, 0}));
}

TEST(Palette, TheFirstPatternThatMatchesCounts) {
    const auto values = [](const Json& table) {
        return run("palette", {{"values", table}}, objects()).channel("value").samples;
    };
    EXPECT_EQ(values({{"b*", 1}, {"box", 8}}), (Samples{1, 0.75F, 0.75F, 0}));
    EXPECT_EQ(values({{"box", 8}, {"b*", 1}}), (Samples{1, 2.5F, 6, 0}));
    // What the manifest does not know is for "*" alone, and so is an image without one.
    EXPECT_EQ(values({{"box", 8}, {"*", 1}}), (Samples{1, 2.625F, 6, 0}));
}

TEST(Palette, WithoutAManifestNamesAreHashed) {
    const Json table{{"box", 8}, {"*", 1}};
    EXPECT_EQ(run("palette", {{"values", table}}, objects(false)).channel("value").samples,
              (Samples{1, 2.625F, 6, 0}));
    EXPECT_NE(error_of("palette", {{"values", {{"b*", 1}}}}, objects(false))
                  .find("the input has no manifest to look 'b*' up in; give whole names"),
              std::string::npos);
}

class PaletteTable : public ::testing::Test {
protected:
    PaletteTable() { std::filesystem::create_directories(folder_); }
    ~PaletteTable() override { std::filesystem::remove_all(folder_); }

    Json table(const std::string& name, const std::string& text) const {
        std::ofstream(folder_ / name) << text;
        return {{"table", (folder_ / name).string()}};
    }
    Samples red(const std::string& name, const std::string& text) const {
        return run("palette", table(name, text), objects()).channel("R").samples;
    }
    std::string fault(const std::string& text, const std::string& name = "t.csv") const {
        const std::string told = error_of("palette", table(name, text), objects());
        const std::size_t at = told.find(name);
        if (at == std::string::npos) return told;
        std::string out = told.substr(at, told.find('\n', at) - at);
        const std::string_view node = "node 'node' (palette): ";
        if (const std::size_t title = out.find(node); title != std::string::npos)
            out.erase(title, node.size());
        return out;
    }

private:
    std::filesystem::path folder_ =
        std::filesystem::temp_directory_path() / fmt::format("keyline-palette-{}", getpid());
};

TEST_F(PaletteTable, AFileSaysTheSameAsJsonAndAsCsv) {
    const Samples wanted =
        run("palette", {{"colors", {{"ball", {1, 0.5, 0.25}}, {"*", "#ffffff"}}}}, objects())
            .channel("R")
            .samples;
    EXPECT_EQ(red("t.json", R"({"ball": [1, 0.5, 0.25], "*": "#ffffff"})"), wanted);
    EXPECT_EQ(red("t.csv", "ball,1,0.5,0.25\n*,#ffffff\n"), wanted);
    EXPECT_EQ(red("t.csv", "\xEF\xBB\xBFname,color\r\n\r\n \"ball\" , 1, 0.5 ,0.25\r\n*,#ffffff"), wanted);
    EXPECT_EQ(run("palette", table("n.csv", "object,value\nb*,8"), objects()).channel("value").samples,
              (Samples{8, 6, 6, 0}));
    EXPECT_EQ(run("palette", table("n.json", R"({"b*": 8})"), objects()).channel("value").samples,
              (Samples{8, 6, 6, 0}));
}

TEST_F(PaletteTable, FaultsStandAtTheirPlacesInTheFile) {
    EXPECT_EQ(
        fault("ball,#ffffff\nbäl,#12345"),
        "t.csv:2:5: error: 'bäl' is \"#12345\", a string; it must be a colour, [r, g, b] or \"#rrggbb\"");
    EXPECT_EQ(fault("ball,1,2"),
              "t.csv:1:1: error: the line has 3 cells; it must be NAME,#rrggbb or NAME,R,G,B or NAME,NUMBER");
    EXPECT_EQ(
        fault("ball;#ffffff"),
        "t.csv:1:1: error: the line has 1 cell; it must be NAME,#rrggbb or NAME,R,G,B or NAME,NUMBER; cells "
        "are parted by ','");
    EXPECT_EQ(fault("ball,1\nbox,red"), "t.csv:2:5: error: 'box' is \"red\", a string; it must be a number");
    EXPECT_EQ(fault("ball,1\nbox,2\nball,3"), "t.csv:3:1: error: 'ball' stands in line 1 already");
    EXPECT_EQ(fault("\"ball,1\n"), "t.csv:1:1: error: the cell has no closing '\"'");
    EXPECT_EQ(fault("\"ball\"x,1\n"), "t.csv:1:7: error: expected ',' or the end of the line after the cell");
    EXPECT_EQ(
        fault("name,color\n"),
        "t.csv:1:1: error: a table is names with a colour or a number each; as { \"hair*\": \"#302018\" }");
    EXPECT_EQ(fault("{\"ball\": 1,}", "t.json"),
              "t.json:1:11: error: there is a ',' too many before the '}'");
    EXPECT_NE(fault("ball,1", "t.xls").find("is no table; a table is a .json or a .csv"), std::string::npos);
}

}  // namespace
}  // namespace keyline::testing
