// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/program/program.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <sstream>

// The commands that tell: check, plan, nodes, info, --version, --help.

namespace keyline::test {

namespace {

using testing::HasSubstr;
using testing::Not;
using Json = nlohmann::json;

class Report : public ProgramTest {
protected:
    std::string plate() const { return (plates() / "street.0001.exr").string(); }

    void sequence_graph() const {
        fs::copy(plates() / "street.0001.exr", folder() / "in.0007.exr");
        fs::copy(plates() / "street.0002.exr", folder() / "in.0009.exr");
        graph(R"("r":     { "type": "read", "file": "in.####.exr" },
                 "y":     { "type": "ycolor", "in": "r:Combined" },
                 "slope": { "type": "gradient", "in": "y" },
                 "edges": { "type": "hysteresis", "in": "slope", "low": 0.1, "high": 0.3 },
                 "out":   { "type": "write", "in": "edges", "file": "out.####.exr" })");
    }
};

TEST_F(Report, CheckShowsWhatEachNodeMakes) {
    sequence_graph();
    const Outcome run = keyline({"check", "graph.json", "--streams"});
    EXPECT_EQ(run.status, 0) << run.err;
    std::vector<std::string> lines;
    std::istringstream text(run.out);
    for (std::string line; std::getline(text, line);) lines.push_back(line);
    ASSERT_EQ(lines.size(), 6U) << run.out;
    EXPECT_EQ(lines[0], "frame 7");
    EXPECT_THAT(lines[1], testing::MatchesRegex("node   type        display +data +digest +channels"));
    EXPECT_THAT(lines[2],
                testing::StartsWith("r      read        480 × 270 at (0, 0)  480 × 270 at (0, 0)  "));
    EXPECT_THAT(lines[5], HasSubstr("  edge computed")) << run.out;
}

TEST_F(Report, CheckShowsItAsJson) {
    sequence_graph();
    const auto shown = [&](const std::string& gamma) {
        const Outcome run = keyline(
            {"check", "graph.json", "--streams", "--json", "--frames", "7,9", "--set", "y.gamma=" + gamma});
        EXPECT_EQ(run.status, 0) << run.err;
        return Json::parse(run.out);
    };
    const Json frames = shown("1.5");
    ASSERT_EQ(frames.size(), 2U);
    EXPECT_EQ(frames[0]["frame"], 7);
    const Json &read = frames[0]["nodes"][0], &edges = frames[0]["nodes"][3];
    EXPECT_EQ(read["id"], "r");
    EXPECT_EQ(read["type"], "read");
    EXPECT_EQ(read["dataWindow"], (Json{{"x", 0}, {"y", 0}, {"width", 480}, {"height", 270}}));
    EXPECT_EQ(read["channels"][0]["type"], "half");
    EXPECT_EQ(edges["channels"][0]["type"], "computed");
    EXPECT_EQ(edges["channels"][0]["madeBy"], "edges");
    EXPECT_NE(edges["digest"], frames[1]["nodes"][3]["digest"]);
    EXPECT_EQ(frames, shown("1.5")) << "digests are the same in every run";
    const Json other = shown("2")[0]["nodes"];
    EXPECT_EQ(other[0]["digest"], read["digest"]);
    EXPECT_NE(other[3]["digest"], edges["digest"]);
}

TEST_F(Report, CheckSaysWhatItLookedAt) {
    sequence_graph();
    const Outcome run = keyline({"check", "graph.json"});
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(run.out, "graph.json: ok: 5 nodes, 1 output, frame 7\n");
    EXPECT_THAT(run.err, HasSubstr("frame 7, the first on disk"));
    EXPECT_FALSE(exists("out.0007.exr"));
}

TEST_F(Report, CheckLooksAtAllFramesGiven) {
    sequence_graph();
    EXPECT_EQ(keyline({"check", "graph.json", "--frames", "7,9"}).status, 0);
    const Outcome run = keyline({"check", "graph.json", "--frames", "7-9"});
    EXPECT_EQ(run.status, 3);
    EXPECT_EQ(run.out, "");
    EXPECT_THAT(run.err, HasSubstr("in.0008.exr: no such file; on disk are frames 7, 9"));
}

TEST_F(Report, CheckTellsOfAFileWithNearlyTheNameOfOneThatIsNotThere) {
    sequence_graph();
    EXPECT_THAT(
        keyline({"check", "graph.json", "--set", "r.file=im.####.exr"}).err,
        HasSubstr("im.0001.exr: no such file; no frame of it is on disk; did you mean 'in.0007.exr'?"));
    EXPECT_THAT(keyline({"check", "graph.json", "--set", "r.file=in.007.exr"}).err,
                HasSubstr("in.007.exr: no such file; did you mean 'in.0007.exr'?"));
}

TEST_F(Report, CheckLooksAtEveryGraphGiven) {
    sequence_graph();
    write("wrong.json", "{}");
    const Outcome run = keyline({"check", "wrong.json", "graph.json", "missing.json"});
    EXPECT_EQ(run.status, 2);
    EXPECT_EQ(run.out, "graph.json: ok: 5 nodes, 1 output, frame 7\n");
    EXPECT_THAT(run.err, HasSubstr("wrong.json:1:1: error: "));
    EXPECT_THAT(run.err, HasSubstr("'missing.json'"));
}

TEST_F(Report, CheckReadsStandardInput) {
    sequence_graph();
    RunOptions options;
    options.in = folder() / "graph.json";
    EXPECT_EQ(keyline({"check", "-"}, options).out, "-: ok: 5 nodes, 1 output, frame 7\n");
    write("wrong.json", "{\n  1");
    options.in = folder() / "wrong.json";
    EXPECT_THAT(keyline({"check", "-"}, options).err, testing::StartsWith("-:2:3: error: "));
}

TEST_F(Report, AProfileIsATraceAndATable) {
    sequence_graph();
    const Outcome run =
        keyline({"render", "graph.json", "--frames", "7", "--tile", "64", "--profile", "trace.json"});
    EXPECT_EQ(run.status, 0) << run.err;
    for (const char* text :
         {"decode node 'r' (read), sweep 1", "compute node 'slope' (gradient), sweep 1",
          "encode node 'out' (write), sweep 2", "MiB read from files", "MiB of memory at most"})
        EXPECT_THAT(run.out, HasSubstr(text));
    int tiles = 0;
    const Json trace = Json::parse(read(folder() / "trace.json"));
    for (const Json& event : trace.at("traceEvents"))
        tiles += event.at("name") == "compute node 'slope' (gradient)" ? 1 : 0;
    EXPECT_EQ(tiles, 40);
}

TEST_F(Report, AProfileReplacesProfilesOnly) {
    sequence_graph();
    const std::vector<std::string> render{"render", "graph.json", "--frames", "7", "--profile"};
    const auto profile = [&](const std::string& file) {
        std::vector<std::string> arguments = render;
        arguments.push_back(file);
        return keyline(arguments);
    };
    for (const char* file : {"graph.json", "in.0007.exr"}) {
        const std::string before = read(folder() / file);
        const Outcome run = profile(file);
        EXPECT_EQ(run.status, 4);
        EXPECT_THAT(run.err, HasSubstr("is no profile"));
        EXPECT_EQ(read(folder() / file), before);
    }
    EXPECT_EQ(profile("trace.json").status, 0);
    EXPECT_EQ(profile("trace.json").status, 0);
}

TEST_F(Report, AProfileThatCantBeWrittenIsAnErrorBeforeTheRender) {
    sequence_graph();
    const Outcome run = keyline({"render", "graph.json", "--frames", "7", "--profile", "none/trace.json"});
    EXPECT_EQ(run.status, 4);
    EXPECT_THAT(run.err, HasSubstr("none/trace.json"));
    EXPECT_FALSE(exists("out.0007.exr"));
}

TEST_F(Report, PlanTellsSweepsWithoutWriting) {
    sequence_graph();
    const Outcome run = keyline({"plan", "graph.json", "--tile", "64", "--threads", "3"});
    EXPECT_EQ(run.status, 0) << run.err;
    for (const char* text : {"frame 7: 2 sweeps on 3 threads", "input in.0007.exr, node 'r' (read)",
                             "3 of 22 channels: ViewLayer.Combined: R G B half",
                             "480 × 270 at (0, 0), 40 tiles of 64 × 64", "gather   node 'edges' (hysteresis)",
                             "compute  node 'edges' (hysteresis)", "write    out.0007.exr"})
        EXPECT_THAT(run.out, HasSubstr(text));
    EXPECT_FALSE(exists("out.0007.exr"));
}

TEST_F(Report, PlanOfAGraphThatNeedsMoreMemoryFails) {
    sequence_graph();
    const Outcome run = keyline({"plan", "graph.json", "--memory", "1M"});
    EXPECT_EQ(run.status, 2);
    EXPECT_EQ(run.out, "");
}

TEST_F(Report, NodesListsEveryType) {
    const Outcome run = keyline({"nodes"});
    EXPECT_EQ(run.status, 0);
    for (const char* name : {"\n  read ", "\n  write ", "\n  gaussian ", "\n  hysteresis ", "\n  over "})
        EXPECT_THAT("\n" + run.out, HasSubstr(name));
}

TEST_F(Report, NodesTellsOneTypeInFull) {
    const Outcome run = keyline({"nodes", "gaussian"});
    EXPECT_EQ(run.status, 0);
    EXPECT_THAT(run.out, HasSubstr("sigma: a number or [x, y], from 0 to 500 pixels (default 1)"));
    EXPECT_THAT(run.out, HasSubstr("in: an input (required)"));
}

TEST_F(Report, NodesSuggestsANearName) {
    const Outcome run = keyline({"nodes", "hystersis"});
    EXPECT_EQ(run.status, 2);
    EXPECT_EQ(run.err, "error: there is no node type 'hystersis'; did you mean 'hysteresis'?\n");
}

TEST_F(Report, NodesAsJson) {
    const Json all = Json::parse(keyline({"nodes", "--json"}).out);
    const auto gaussian = std::ranges::find(all, "gaussian", [](const Json& t) { return t.at("name"); });
    ASSERT_NE(gaussian, all.end());
    EXPECT_EQ(Json::parse(keyline({"nodes", "gaussian", "--json"}).out), Json::array({*gaussian}));
    EXPECT_EQ(gaussian->at("gives"), "pixels");
    const Json& sigma = gaussian->at("takes").at(1);
    EXPECT_EQ(sigma.at("name"), "sigma");
    EXPECT_EQ(sigma.at("range"), "from 0 to 500 pixels");
    EXPECT_EQ(sigma.at("default"), 1);
    EXPECT_EQ(Json::parse(keyline({"nodes", "canny", "--json"}).out).at(0).at("kind"), "group");
}

TEST_F(Report, NodesAsMarkdownHasEveryTypeAndParameter) {
    const std::string text = keyline({"nodes", "--markdown"}).out;
    const Json schema = Json::parse(keyline({"schema"}).out);
    for (const auto& [name, type] : schema.at("$defs").items()) {
        if (name.starts_with("keyline.")) continue;  // kinds of values
        EXPECT_THAT(text, HasSubstr("\n### " + name + "\n"));
        for (const auto& [field, unused] : type.at("properties").items()) {
            if (field == "type" || field == "about" || field == "enabled" || field == "meant")
                continue;  // of every node
            EXPECT_THAT(text, HasSubstr("| `" + field + "` |"));
        }
    }
}

TEST_F(Report, TheManualsNodesAreWhatIsDeclared) {
    EXPECT_EQ(keyline({"nodes", "--markdown"}).out, read(fs::path(KEYLINE_DOCS) / "nodes.md"))
        << "write it anew with: keyline nodes --markdown > docs/nodes.md";
}

TEST_F(Report, TheSchemaKnowsTypesRangesAndWords) {
    const Json schema = Json::parse(keyline({"schema"}).out);
    EXPECT_EQ(schema.at("$schema"), "https://json-schema.org/draft/2020-12/schema");
    const Json& gaussian = schema.at("$defs").at("gaussian");
    EXPECT_EQ(gaussian.at("required"), Json::parse(R"(["in"])"));
    EXPECT_EQ(gaussian.at("additionalProperties"), false);
    const Json& sigma = gaussian.at("properties").at("sigma");
    EXPECT_EQ(sigma.at("default"), 1);
    EXPECT_EQ(sigma.at("anyOf").at(0), Json::parse(R"({ "type": "number", "minimum": 0, "maximum": 500 })"));
    const Json& depth = schema.at("$defs").at("write").at("properties").at("depth").at("anyOf").at(0);
    EXPECT_EQ(depth.at("const"), "auto");
    EXPECT_THAT(depth.at("description"), HasSubstr("the file's own type for what passed untouched"));
}

TEST_F(Report, InfoTellsAPlate) {
    const Outcome run = keyline({"info", "--all", plate()});
    EXPECT_EQ(run.status, 0) << run.err;
    for (const char* text : {"openexr, 1 part", "480 × 270 at (0, 0)", "scanline, zip",
                             "ViewLayer.Combined: R G B A half", "ViewLayer.Depth: Z float", "cryptomatte/"})
        EXPECT_THAT(run.out, HasSubstr(text));
}

// Names in files are others' text: what a terminal would obey is shown, not sent.
TEST_F(Report, NoFileSpeaksToTheTerminal) {
    graph(R"("c": { "type": "constant", "color": [0, 0, 0], "size": [4, 4] },
             "out": { "type": "write", "in": "c", "file": "a\u001b[31m.exr",
                      "layers": { "\u001b[31mred\u0007": "c", "turned\u202eback": "c" } })");
    ASSERT_EQ(keyline({"render", "graph.json"}).status, 0);
    graph(R"("r": { "type": "read", "file": "a\u001b[31m.exr" },
             "out": { "type": "write", "in": "r", "file": "b\u001b[32m.exr" })");
    for (const std::vector<std::string>& arguments :
         std::vector<std::vector<std::string>>{{"info", "a\x1b[31m.exr"},
                                               {"plan", "graph.json"},
                                               {"check", "graph.json", "--set", "out.in=r:nothing"},
                                               {"render", "graph.json", "--set", "out.file=b\x1b[32m.jpg"}}) {
        const Outcome run = keyline(arguments);
        SCOPED_TRACE(arguments[0]);
        EXPECT_THAT(run.out + run.err, HasSubstr("\\x1b["));
        // The last turns the direction of text.
        // NOLINTNEXTLINE(misc-misleading-bidirectional)
        for (const char* raw : {"\x1b", "\a", "\u202e"}) EXPECT_THAT(run.out + run.err, Not(HasSubstr(raw)));
    }
}

TEST_F(Report, InfoAsJson) {
    const Json all = Json::parse(keyline({"info", "--json", plate()}).out);
    ASSERT_EQ(all.size(), 1U);
    const Json& part = all.at(0).at("parts").at(0);
    EXPECT_EQ(part.at("dataWindow"), Json::parse(R"({ "x": 0, "y": 0, "width": 480, "height": 270 })"));
    EXPECT_EQ(part.at("compression"), "zip");
    EXPECT_EQ(part.at("channels").size(), 22U);
    EXPECT_EQ(part.at("channels").at(0),
              Json::parse(R"({ "name": "ViewLayer.Combined.A", "type": "half" })"));
    EXPECT_EQ(part.at("attributes").at("pixelAspectRatio").at("value"), 1);
}

TEST_F(Report, InfoOfSeveralFilesTellsThoseItCanRead) {
    write("none.exr", "no image");
    const Outcome run = keyline({"info", plate(), "none.exr", "missing.exr"});
    EXPECT_EQ(run.status, 3);
    EXPECT_THAT(run.out, HasSubstr("street.0001.exr: openexr"));
    EXPECT_THAT(run.err, HasSubstr("none.exr"));
    EXPECT_THAT(run.err, HasSubstr("missing.exr"));
}

TEST_F(Report, VersionNamesTheLibraries) {
    const Outcome run = keyline({"--version"});
    EXPECT_EQ(run.status, 0);
    EXPECT_TRUE(run.out.starts_with("keyline ")) << run.out;
    for (const char* name : {"OpenEXR", "Imath", "OpenColorIO", "oneTBB", "Highway", "libdeflate", "fmt"})
        EXPECT_THAT(run.out, testing::ContainsRegex(std::string(name) + " +[0-9]+\\."));
    EXPECT_EQ(run.err, "");
}

TEST_F(Report, HelpIsAResult) {
    for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
             {"--help"}, {"render", "--help"}, {"check", "-h"}, {"info", "--help"}}) {
        const Outcome run = keyline(arguments);
        EXPECT_EQ(run.status, 0);
        EXPECT_THAT(run.out, HasSubstr("Usage: keyline"));
        EXPECT_EQ(run.err, "");
    }
    EXPECT_THAT(keyline({"render", "--help"}).out, HasSubstr("--keep-going"));
    EXPECT_THAT(keyline({"check", "--help"}).out, Not(HasSubstr("--keep-going")));
}

TEST_F(Report, HelpIsACommandToo) {
    EXPECT_EQ(keyline({"help"}).out, keyline({"--help"}).out);
    EXPECT_EQ(keyline({"help", "render"}).out, keyline({"render", "--help"}).out);
    EXPECT_THAT(keyline({"help", "rendr"}).err, HasSubstr("did you mean 'render'?"));
}

// In Keyline's own words: arguments are named for what they are.
TEST_F(Report, HelpSpeaksPlainly) {
    for (const char* command : {"render", "check", "plan", "nodes", "info"}) {
        const std::string help = keyline({command, "--help"}).out;
        for (const char* leftover : {"REQUIRED", "Excludes", "Positionals", "SUBCOMMAND"})
            EXPECT_THAT(help, Not(HasSubstr(leftover)));
    }
}

}  // namespace

}  // namespace keyline::test
