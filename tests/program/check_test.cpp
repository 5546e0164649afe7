// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/io/exr_files.h"
#include "tests/program/program.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

// keyline check: of many graphs and whole shots, for people and for programs.

namespace keyline::test {

namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* kSound =
    R"("c": { "type": "constant", "size": [8, 8] }, "out": { "type": "write", "in": "c", "file": "out.exr" })";

class CheckCommand : public ProgramTest {
protected:
    Outcome check(std::vector<std::string> arguments) const {
        arguments.insert(arguments.begin(), "check");
        return keyline(arguments);
    }
    std::string text_of(std::string_view nodes) const {
        return fmt::format(R"({{ "keyline": 1, "nodes": {{ {} }} }})", nodes);
    }
    // Frames of a shot, each a plate.
    void shot(const std::vector<std::pair<int, std::string>>& frames) const {
        for (const auto& [frame, plate] : frames)
            fs::copy(plates() / plate, folder() / fmt::format("shot.{:04}.exr", frame));
        graph(R"("r": { "type": "read", "file": "shot.####.exr" },
                 "out": { "type": "write", "in": "r:Combined", "file": "out.####.exr" })");
    }
};

TEST_F(CheckCommand, AFolderStandsForTheGraphsBelowIt) {
    write("shots/a.json", text_of(kSound));
    write("shots/deep/b.json", text_of(R"("c": { "type": "constnt" })"));
    write("shots/group.json",
          R"({ "keyline": 1, "outputs": { "out": "n" }, "nodes": { "n": { "type": "constant" } } })");
    write("shots/other.json", R"({ "name": "other" })");
    const Outcome run = check({"shots"});
    EXPECT_EQ(run.status, 2);
    EXPECT_EQ(run.out, "shots/a.json: ok: 2 nodes, 1 output, frame 1\n");
    EXPECT_THAT(run.err,
                HasSubstr("shots/deep/b.json:1:43: error: node 'c': there is no node type 'constnt'"));
    EXPECT_THAT(run.err, Not(HasSubstr("group.json")));
    fs::create_directory(folder() / "empty");
    EXPECT_EQ(check({"empty"}).err,
              "error: empty: there is no graph in this folder; graphs are files .json with \"keyline\" and "
              "\"nodes\"\n");
}

TEST_F(CheckCommand, OneThatIsWrongKeepsNoOtherFromBeingChecked) {
    write("a.json", "{");
    write("b.json", text_of(kSound));
    const Outcome run = check({"a.json", "b.json"});
    EXPECT_EQ(run.status, 2);
    EXPECT_THAT(run.out, HasSubstr("b.json: ok"));
    const fs::path text = write("in.json", text_of(kSound));
    EXPECT_EQ(keyline({"check", "-"}, {.in = text}).out, "-: ok: 2 nodes, 1 output, frame 1\n");
}

TEST_F(CheckCommand, ForPrograms) {
    write(
        "a.json",
        text_of(
            R"("c": { "type": "constant", "sise": [8, 8] }, "out": { "type": "write", "in": "c", "file": "o.exr" })"));
    write("b.json", text_of(kSound));
    const Outcome run = check({"a.json", "b.json", "--json"});
    EXPECT_EQ(run.status, 2);
    EXPECT_EQ(run.err, "");
    const auto told = nlohmann::json::parse(run.out);
    ASSERT_EQ(told.size(), 2U);
    EXPECT_EQ(told[0]["graph"], "a.json");
    EXPECT_EQ(told[0]["ok"], false);
    const auto& message = told[0]["messages"][0];
    EXPECT_EQ(message["severity"], "error");
    EXPECT_EQ(message["kind"], "graph");
    EXPECT_EQ(message["place"], (nlohmann::json{{"file", "a.json"}, {"line", 1}, {"column", 55}}));
    EXPECT_EQ(message["node"], "node 'c' (constant)");
    EXPECT_EQ(message["code"], "unknown-key");
    EXPECT_EQ(message["what"], "unknown key 'sise'");
    EXPECT_EQ(message["hint"], "did you mean 'size'?");
    EXPECT_EQ(told[1],
              (nlohmann::json{{"graph", "b.json"}, {"ok", true}, {"messages", nlohmann::json::array()}}));
}

TEST_F(CheckCommand, ForCodeReview) {
    write(
        "a b.json",
        text_of(
            R"("c": { "type": "constant", "sise": [8, 8] }, "out": { "type": "write", "in": "c", "file": "o.exr" })"));
    const Outcome run = check({"a b.json", "--sarif"});
    EXPECT_EQ(run.status, 2);
    const auto log = nlohmann::json::parse(run.out);
    EXPECT_EQ(log["version"], "2.1.0");
    const auto& only = log["runs"][0];
    EXPECT_EQ(only["tool"]["driver"]["name"], "keyline");
    EXPECT_EQ(only["columnKind"], "unicodeCodePoints");
    const auto& result = only["results"][0];
    EXPECT_EQ(result["level"], "error");
    EXPECT_EQ(result["message"]["text"], "node 'c' (constant): unknown key 'sise'; did you mean 'size'?");
    EXPECT_EQ(result["locations"][0]["physicalLocation"]["artifactLocation"]["uri"], "a%20b.json");
    EXPECT_EQ(result["locations"][0]["physicalLocation"]["region"],
              (nlohmann::json{{"startLine", 1}, {"startColumn", 55}}));
    EXPECT_EQ(check({"a b.json", "--sarif", "--json"}).status, 2);
}

TEST_F(CheckCommand, FramesThatDifferAreTold) {
    shot({{1, "street.0001.exr"}, {2, "street.0002.exr"}, {4, "street_passes.0024.exr"}});
    const Outcome run = check({"graph.json", "--frames", "all"});
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_THAT(
        run.err,
        HasSubstr("--frames all: warning: between frames 1 and 4, 3 is not on disk; say which frames"));
    EXPECT_THAT(run.err,
                HasSubstr("warning: node 'r' (read), frame 4: the display window is 640 × 360 at (0, 0), and "
                          "480 × 270 at (0, 0) in frame 2; 'keyline info' tells of both files"));
    EXPECT_THAT(run.err, HasSubstr("are missing, which were there in frame 2"));
    EXPECT_THAT(run.err, HasSubstr("are new, which were not there in frame 2"));
    EXPECT_THAT(run.err, HasSubstr("'ViewLayer.UV.V' are float, and half before in frame 2"));
    EXPECT_EQ(check({"graph.json", "--frames", "1-2"}).err, "");
}

TEST_F(CheckCommand, AColourSpaceThatChangesIsTold) {
    const auto frame = [&](int number, std::vector<float> chromaticities) {
        SinkSpec spec;
        spec.display_window = spec.data_window = {0, 0, 8, 8};
        if (!chromaticities.empty())
            spec.metadata.set({"chromaticities", "chromaticities", std::move(chromaticities)});
        Image image;
        for (const char* name : {"R", "G", "B"}) image[name] = Pixels(SampleType::kHalf, spec.data_window);
        write_with_keyline(folder() / fmt::format("s.{:04}.exr", number), std::move(image), spec);
    };
    const std::vector<float> rec709{0.64F, 0.33F, 0.3F, 0.6F, 0.15F, 0.06F, 0.3127F, 0.329F};
    frame(1, rec709);
    frame(2, rec709);
    frame(3, {});
    graph(R"("r": { "type": "read", "file": "s.####.exr" },
             "out": { "type": "write", "in": "r", "file": "out.####.exr" })");
    EXPECT_EQ(check({"graph.json", "--frames", "1-2"}).err, "");
    EXPECT_THAT(
        check({"graph.json", "--frames", "1-3"}).err,
        HasSubstr("node 'r' (read), frame 3: the colour space, by 'chromaticities', is another than in "
                  "frame 2; 'keyline info' tells of both files"));
}

// More than any disk has.
TEST_F(CheckCommand, ADiskThatWillNotDoIsTold) {
    graph(R"("c": { "type": "constant", "size": [300000, 300000] },
             "out": { "type": "write", "in": "c", "file": "deep/out.####.exr" })");
    const Outcome run = check({"graph.json", "--frames", "1-1000"});
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_THAT(run.err, HasSubstr("warning: 1000 outputs take up to "));
    EXPECT_THAT(run.err, HasSubstr(" free; make room, or write elsewhere"));
    EXPECT_EQ(check({"graph.json", "--frames", "1", "--set", "c.size=[8,8]"}).err, "");
}

TEST_F(CheckCommand, AFrameOfTheShotThatIsNotThereIsAnError) {
    shot({{1, "street.0001.exr"}, {3, "street.0002.exr"}});
    const Outcome run = check({"graph.json", "--frames", "1-3", "--json"});
    EXPECT_EQ(run.status, 3);
    const auto told = nlohmann::json::parse(run.out);
    EXPECT_EQ(told[0]["messages"][0]["kind"], "input");
    EXPECT_THAT(std::string(told[0]["messages"][0]["what"]), HasSubstr("shot.0002.exr"));
}

}  // namespace

}  // namespace keyline::test
