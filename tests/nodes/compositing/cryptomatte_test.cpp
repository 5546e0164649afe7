// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/cryptomatte.h"

#include "engine/kit/manifest_text.h"
#include "tests/nodes/plate.h"

#include <bit>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <sys/stat.h>

namespace keyline::testing {
namespace {

const std::vector<std::string> kLevel{"r", "g", "b", "a"};

float id_of(const std::string& name) { return std::bit_cast<float>(cryptomatte_id(name)); }

// One row of pixels; each lists what covers it.
Image cryptomatte(const std::vector<std::vector<std::pair<std::string, float>>>& pixels,
                  const std::string& manifest) {
    Image image({3, -2, 3 + static_cast<int>(pixels.size()), -1},
                {"Crypto00.r", "Crypto00.g", "Crypto00.b", "Crypto00.a", "Crypto01.r", "Crypto01.g"});
    for (std::size_t x = 0; x < pixels.size(); ++x)
        for (std::size_t rank = 0; rank < pixels[x].size(); ++rank) {
            image.channels[2 * rank].samples[x] = id_of(pixels[x][rank].first);
            image.channels[2 * rank + 1].samples[x] = pixels[x][rank].second;
        }
    image.metadata.set({"cryptomatte/abc/name", "string", std::string("Crypto")});
    if (!manifest.empty()) image.metadata.set({"cryptomatte/abc/manifest", "string", manifest});
    return image;
}

std::string manifest_of(const std::vector<std::string>& names) {
    std::string out = "{";
    for (const std::string& name : names)
        out += fmt::format(R"({}"{}":"{:08x}")", out.size() > 1 ? "," : "", name, cryptomatte_id(name));
    return out + "}";
}

const Image& three_objects() {
    static const Image image = cryptomatte({{{"ball", 1}},
                                            {{"ball", 0.5F}, {"box", 0.25F}, {"ball2", 0.125F}},
                                            {{"box", 0.75F}, {"ball", 0.25F}},
                                            {}},
                                           manifest_of({"ball", "box", "ball2"}));
    return image;
}

TEST(CryptomatteHash, IsMurmurHash3) {
    EXPECT_EQ(murmur3_32(""), 0U);
    EXPECT_EQ(murmur3_32("hello"), 0x248bfa47U);
    EXPECT_EQ(murmur3_32("hello, world"), 0x149bbb7fU);
    EXPECT_EQ(murmur3_32("The quick brown fox jumps over the lazy dog"), 0x2e4ff723U);
}

TEST(CryptomatteHash, IsWhatRenderersWrite) {
    EXPECT_EQ(cryptomatte_id("floor"), 0x7819c83cU);
    EXPECT_EQ(cryptomatte_id("suzanne"), 0xa0083e7fU);
    EXPECT_EQ(cryptomatte_id("default_background"), 0xdba7ec85U);
}

TEST(CryptomatteHash, IsAlwaysAnOrdinaryFloat) {
    for (int i = 0; i < 20000; ++i) ASSERT_TRUE(std::isnormal(id_of(fmt::format("object{}", i)))) << i;
}

TEST(Cryptomatte, SumsTheCoverageOfAllRanks) {
    const auto matte = [&](const Json& objects) {
        return run("cryptomatte", {{"objects", objects}}, three_objects()).channel("matte").samples;
    };
    EXPECT_EQ(matte({"ball"}), (std::vector<float>{1, 0.5F, 0.25F, 0}));
    EXPECT_EQ(matte({"ball2"}), (std::vector<float>{0, 0.125F, 0, 0}));
    EXPECT_EQ(matte({"ball*"}), (std::vector<float>{1, 0.625F, 0.25F, 0}));
    EXPECT_EQ(matte({"b*x", "ball"}), (std::vector<float>{1, 0.75F, 1, 0}));
    EXPECT_EQ(matte({"*"}), (std::vector<float>{1, 0.875F, 1, 0}));
    EXPECT_EQ(matte(Json::array()), (std::vector<float>{0, 0, 0, 0}));
}

TEST(Cryptomatte, SuggestsTheNearestName) {
    const std::string error = error_of("cryptomatte", {{"objects", {"bal"}}}, three_objects());
    EXPECT_NE(error.find("none of the 3 objects of the Cryptomatte is 'bal'; did you mean 'ball'?"),
              std::string::npos)
        << error;
    EXPECT_NE(error_of("cryptomatte", {{"objects", {"x*"}}}, three_objects()).find("'x*'"),
              std::string::npos);
}

TEST(Cryptomatte, FindsItsLayer) {
    const std::string other =
        error_of("cryptomatte", {{"objects", {"ball"}}, {"layer", "Material"}}, three_objects());
    EXPECT_NE(other.find("there is no Cryptomatte 'Material'; there is 'Crypto'"), std::string::npos)
        << other;
    const std::string none =
        error_of("cryptomatte", {{"objects", {"ball"}}}, noise({0, 0, 2, 2}, {"a.X", "a.Z"}, 1));
    EXPECT_NE(none.find("no Cryptomatte"), std::string::npos) << none;
}

TEST(Cryptomatte, WithoutAManifestHashesTheName) {
    const Image in = cryptomatte({{{"ball", 0.5F}}}, "");
    EXPECT_EQ(run("cryptomatte", {{"objects", {"ball"}}}, in).channel("matte").samples[0], 0.5F);
    EXPECT_NE(error_of("cryptomatte", {{"objects", {"b*"}}}, in).find("no manifest"), std::string::npos);
}

TEST(Cryptomatte, AgreesWithTheDefinitionOnARender) {
    const Image level = plate("ViewLayer.CryptoObject00", kLevel);
    Image expected(level.window, {"matte"});
    expected.display = level.display;
    const float wall = id_of("wall"), post = id_of("post03");
    expected.fill("matte", [&](int x, int y) {
        double sum = 0;
        for (const auto& [id, coverage] : {std::pair("r", "g"), std::pair("b", "a")})
            if (level.at(id, x, y) == wall || level.at(id, x, y) == post)
                sum += double{level.at(coverage, x, y)};
        return sum;
    });
    const Json nodes{
        {"r", {{"type", "read"}, {"file", KEYLINE_PLATE}}},
        {"all", {{"type", "cryptomatte"}, {"in", "r"}, {"objects", {"wall", "post03"}}}},
        {"level", {{"type", "cryptomatte"}, {"in", "r:CryptoObject00"}, {"objects", {"wall", "post03"}}}}};
    const Image all = run_graph(nodes, "all", std::map<std::string, Image>{});
    EXPECT_IMAGE_NEAR(all, expected, 1e-6);
    EXPECT_IMAGE(run_graph(nodes, "level", std::map<std::string, Image>{}), all);
    float most = 0;
    for (const float s : all.channel("matte").samples) most = std::max(most, s);
    EXPECT_GT(most, 0.99F);
}

// Where an object covers a pixel whole, the renderer's pass of object numbers says the same.
TEST(Cryptomatte, AgreesWithTheIdPassWhereCoverageIsWhole) {
    const Image file = read_exr(KEYLINE_PASSES);
    const Image::Channel& numbers = file.channel("ViewLayer.IndexOB.X");
    const std::map<std::string, float> objects{{"floor", 1}, {"wall", 2}, {"door", 3},    {"crate", 4},
                                               {"ball", 5},  {"ring", 6}, {"suzanne", 7}, {"cone", 22}};
    for (const auto& [name, number] : objects) {
        const Json nodes{{"r", {{"type", "read"}, {"file", KEYLINE_PASSES}}},
                         {"m", {{"type", "cryptomatte"}, {"in", "r"}, {"objects", {name}}}}};
        const Image matte = run_graph(nodes, "m", std::map<std::string, Image>{});
        const Image::Channel& covered = matte.channel("matte");
        int whole = 0;
        for (std::size_t i = 0; i < numbers.samples.size(); ++i) {
            const bool is_whole = covered.samples[i] > 0.9999F, is_its = numbers.samples[i] == number;
            ASSERT_TRUE(is_its || !is_whole) << name << ' ' << i;
            ASSERT_TRUE(covered.samples[i] > 0 || !is_its) << name << ' ' << i;
            whole += is_whole ? 1 : 0;
        }
        EXPECT_GT(whole, 20) << name;
    }
}

TEST(CryptomatteManifest, ReadsEscapes) {
    const auto manifest =
        CryptomatteManifest::parse("{ \"a\\\"b\\u00e9\\ud83d\\ude00\" : \"0000ff00\",\n\"/x\":\"1\"}");
    ASSERT_EQ(manifest.size(), 2U);
    EXPECT_EQ(manifest.ids("a\"bé😀"), (std::vector<uint32_t>{0xff00}));
    EXPECT_EQ(manifest.ids("/x"), (std::vector<uint32_t>{1}));
    EXPECT_EQ(CryptomatteManifest::parse(" {} ").size(), 0U);
}

TEST(CryptomatteManifest, UsesWhatOfADamagedOneCanBeRead) {
    const auto ids = [](const char* text) { return CryptomatteManifest::parse(text).ids("a"); };
    for (const char* text :
         {R"({"a":"1","b":"12)", R"({"a":"1")", R"({"a":"1",)", R"({"a":"1"} x)", R"({"b":"xyz","a":"1"})",
          R"({"b":"000000001","a":"1"})", R"({"\q":"2","a":"1"})", R"({"\ud83d":"2","a":"1"})",
          "{\"\xe4\xf3\xe1\":\"2\",\"a\":\"1\"}", R"({"a":"1","a":"1"})"}) {
        SCOPED_TRACE(text);
        EXPECT_EQ(ids(text), (std::vector<uint32_t>{1}));
        EXPECT_NE(CryptomatteManifest::parse(text).fault(), "");
    }
    EXPECT_EQ(ids(R"({"a":"1","a":"2"})"), (std::vector<uint32_t>{1, 2}));
    for (const char* text : {"", "[]", "{", R"({"a")", R"({"a":})", R"({"a":1})"}) {
        SCOPED_TRACE(text);
        EXPECT_EQ(CryptomatteManifest::parse(text).size(), 0U);
        EXPECT_NE(CryptomatteManifest::parse(text).fault(), "");
    }
    EXPECT_EQ(CryptomatteManifest::parse(R"({"a":"1", "b":"2"})").fault(), "");
}

TEST(CryptomatteManifest, AStarCanBeMeantItself) {
    const auto manifest = CryptomatteManifest::parse(R"({"a*b":"1","axb":"2","a*":"3"})");
    EXPECT_EQ(manifest.ids("a*b"), (std::vector<uint32_t>{1, 2}));
    EXPECT_EQ(manifest.ids("a\\*b"), (std::vector<uint32_t>{1}));
    EXPECT_EQ(manifest.ids("a\\**"), (std::vector<uint32_t>{3, 1}));
}

TEST(CryptomatteManifest, HoldsAHundredThousandNames) {
    std::vector<std::string> names;
    for (int i = 0; i < 100000; ++i) names.push_back(fmt::format("/world/city/block{}/window{}", i / 100, i));
    const auto manifest = CryptomatteManifest::parse(manifest_of(names));
    EXPECT_EQ(manifest.size(), 100000U);
    EXPECT_EQ(manifest.ids("/world/city/block7/*").size(), 100U);
    EXPECT_EQ(manifest.ids(names[54321]), (std::vector<uint32_t>{cryptomatte_id(names[54321])}));
}

class Sidecar : public ::testing::Test {
protected:
    Sidecar() : folder_(std::filesystem::path(::testing::TempDir()) / "keyline-manifest") {
        std::filesystem::create_directories(folder_ / "below");
    }
    ~Sidecar() override { std::filesystem::remove_all(folder_); }

    std::optional<CryptomatteManifest> find(const std::string& name) {
        CryptomatteInfo info;
        info.file = folder_ / "plate.exr";
        info.attributes = {{"manif_file", "string", name}};
        faults_.clear();
        const std::optional<std::string> text = manifest_text(info, faults_);
        if (!text) return {};
        return CryptomatteManifest::parse(*text);
    }

    const std::filesystem::path folder_;
    std::vector<std::string> faults_;
};

TEST_F(Sidecar, StandsBesideTheImage) {
    std::ofstream(folder_ / "names.json") << manifest_of({"ball", "box"});
    const auto manifest = find("names.json");
    ASSERT_TRUE(manifest);
    EXPECT_TRUE(faults_.empty());
    EXPECT_EQ(manifest->ids("box"), (std::vector<uint32_t>{cryptomatte_id("box")}));
}

// An image comes from anywhere: it says no other file of the machine to be read, and none that never ends.
TEST_F(Sidecar, IsNoOtherFile) {
    std::ofstream(folder_ / "below" / "names.json") << manifest_of({"ball"});
    std::ofstream(folder_ / "large.json") << manifest_of({"ball"});
    std::filesystem::resize_file(folder_ / "large.json", (std::uintmax_t{64} << 20) + 1);
    ASSERT_EQ(mkfifo((folder_ / "pipe.json").c_str(), 0600), 0);
    for (const std::string& name :
         {std::string("below/names.json"), (folder_ / "names.json").string(), std::string("../x"),
          std::string(".."), std::string("below"), std::string("pipe.json"), std::string("large.json"),
          std::string("/dev/zero"), std::string("none.json"), std::string("a\0b", 3)}) {
        SCOPED_TRACE(name);
        EXPECT_FALSE(find(name));
        EXPECT_EQ(faults_.size(), 1U);
    }
}

}  // namespace
}  // namespace keyline::testing
