// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/program/program.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

// What an output tells of its making, and whether it would be made so today.

namespace keyline::test {

namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using Json = nlohmann::json;

constexpr const char* kNodes = R"(
    "render": { "type": "read", "file": "in.#.exr" },
    "grade":  { "type": "grade", "about": "warmer", "in": "render:Combined", "multiply": "${gain}" },
    "smooth": { "type": "gaussian", "in": "grade", "sigma": 1.5 },
    "out":    { "type": "write", "in": "smooth", "file": "out.#.exr" },
    "other":  { "type": "write", "in": "render:Combined", "file": "other.#.png", "channels": ["R", "G", "B"] })";
constexpr const char* kTop = R"("variables": { "gain": 1.25, "unused": "x" },)";

class Verify : public ProgramTest {
protected:
    Verify() {
        graph(kNodes, kTop);
        for (const int frame : {1, 2})
            fs::copy(plates() / fmt::format("street.000{}.exr", frame),
                     folder() / fmt::format("in.{}.exr", frame));
        EXPECT_EQ(render({}).status, 0);
    }

    Outcome render(std::vector<std::string> more) const {
        more.insert(more.begin(), {"render", "graph.json", "--frames", "1-2"});
        return keyline(more);
    }
    Outcome verify(std::vector<std::string> more = {}) const {
        more.insert(more.begin(), {"verify", "graph.json", "--frames", "1-2"});
        return keyline(more);
    }
    // A graph in place of the first one, a text of it replaced.
    void change(const std::string& from, const std::string& to) const {
        std::string nodes = kNodes;
        nodes.replace(nodes.find(from), from.size(), to);
        graph(nodes, kTop);
    }
    // The file's last third lost.
    void cut(const std::string& name) const {
        const std::string whole = read(folder() / name);
        write(name, whole.substr(0, whole.size() * 2 / 3));
    }
};

TEST_F(Verify, WhatWasJustRenderedIsCurrent) {
    const Outcome run = verify();
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(run.out,
              "out.1.exr: current\nother.1.png: current\nout.2.exr: current\nother.2.png: current\n"
              "4 outputs: 4 current\n");
}

// Names, comments, the order of nodes and defaults that are written out make no other picture.
TEST_F(Verify, WhatMakesTheSamePictureIsCurrent) {
    std::string nodes = kNodes;
    for (auto at = nodes.find("smooth"); at != std::string::npos; at = nodes.find("smooth"))
        nodes.replace(at, 6, "soft");
    nodes.replace(nodes.find("\"warmer\""), 8, "\"still warmer\"");
    nodes.replace(nodes.find("1.5"), 3, "[1.50, 1.5]");
    graph(nodes, R"("variables": { "gain": 1.250 },)");
    EXPECT_EQ(verify().status, 0) << verify().out;
    // …and neither do other places and times of the inputs.
    fs::create_directory(folder() / "plates");
    for (const char* name : {"in.1.exr", "in.2.exr"}) {
        write(std::string("plates/") + name, read(folder() / name));
        fs::remove(folder() / name);
    }
    nodes.replace(nodes.find("in.#"), 4, "plates/in.#");
    graph(nodes, R"("variables": { "gain": 1.250 },)");
    EXPECT_EQ(verify().status, 0) << verify().out;
}

TEST_F(Verify, AParameterMakesItsOutputsStale) {
    change("1.5", "2");
    const Outcome run = verify();
    EXPECT_EQ(run.status, 1);
    EXPECT_THAT(run.out, HasSubstr("out.1.exr: stale: 'smooth.sigma' is 2, and was 1.5\n"));
    EXPECT_THAT(run.out, HasSubstr("other.1.png: current\n"));
    EXPECT_THAT(run.out, HasSubstr("4 outputs: 2 current, 2 stale\n"));
}

TEST_F(Verify, TheCommandLineCountsToo) {
    EXPECT_EQ(render({"--var", "gain=2"}).status, 0);
    EXPECT_THAT(verify().out, HasSubstr("out.1.exr: stale: 'variables.gain' is 1.25, and was 2\n"));
    EXPECT_EQ(verify({"--var", "gain=2"}).status, 0);
}

TEST_F(Verify, AnInputOfOtherBytesMakesItStale) {
    fs::copy(folder() / "in.2.exr", folder() / "in.1.exr", fs::copy_options::overwrite_existing);
    const Outcome run = verify();
    EXPECT_EQ(run.status, 1);
    EXPECT_THAT(run.out, HasSubstr("out.1.exr: stale: the input 'in.1.exr' of 'render' is another one\n"));
    EXPECT_THAT(run.out, HasSubstr("out.2.exr: current\n"));
}

TEST_F(Verify, ANodeMoreAndANodeLess) {
    change(R"("in": "smooth")", R"("in": "grade")");
    EXPECT_THAT(verify().out, HasSubstr("the node 'smooth' is gone"));
    EXPECT_EQ(render({}).status, 0);
    graph(kNodes, kTop);
    EXPECT_THAT(verify().out, HasSubstr("the node 'smooth' is new"));
}

TEST_F(Verify, WhatIsMissingDamagedOrForeign) {
    fs::remove(folder() / "out.1.exr");
    cut("other.1.png");
    fs::copy(folder() / "in.2.exr", folder() / "out.2.exr", fs::copy_options::overwrite_existing);
    const Outcome run = verify();
    EXPECT_EQ(run.status, 1);
    EXPECT_THAT(run.out, HasSubstr("out.1.exr: missing\n"));
    EXPECT_THAT(run.out, HasSubstr("other.1.png: damaged: other.1.png: "));
    EXPECT_THAT(run.out, HasSubstr("out.2.exr: foreign\n"));
    EXPECT_THAT(run.out, HasSubstr("other.2.png: current\n"));
}

// A byte in the middle of the samples: every structure is sound.
TEST_F(Verify, WhatOnlyDecodingFindsIsDamaged) {
    std::string bytes = read(folder() / "out.1.exr");
    for (std::size_t i = bytes.size() / 2; i < bytes.size() / 2 + 16; ++i) bytes[i] = '\x5a';
    write("out.1.exr", bytes);
    EXPECT_THAT(verify().out, HasSubstr("out.1.exr: damaged: out.1.exr: rows "));
}

TEST_F(Verify, ItsListGoesBackIntoFrames) {
    fs::remove(folder() / "out.2.exr");
    EXPECT_EQ(verify({"--list", "missing"}).out, "2\n");
    EXPECT_EQ(verify({"--list", "stale,damaged"}).out, "");
    EXPECT_EQ(verify({"--list", "current"}).out, "1, 2\n");
    EXPECT_EQ(verify({"--list", "missing,stle"}).status, 2);
    const fs::path list = write("list", verify({"--list", "missing"}).out);
    EXPECT_EQ(keyline({"render", "graph.json", "--frames", "-"}, {.in = list}).status, 0);
    EXPECT_EQ(verify().status, 0);
}

TEST_F(Verify, RenderStaleMakesWhatIsNotCurrent) {
    cut("out.1.exr");
    Outcome run = render({"--stale", "--progress", "lines"});
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_THAT(run.err, HasSubstr("frame 1: done"));
    EXPECT_THAT(run.err, HasSubstr("frame 2: skipped"));
    EXPECT_EQ(verify().status, 0);
    change("1.5", "2");
    run = render({"--stale", "--progress", "lines"});
    EXPECT_THAT(run.err, HasSubstr("frame 1: done"));
    EXPECT_THAT(run.err, HasSubstr("frame 2: done"));
    EXPECT_EQ(verify().status, 0);
}

TEST_F(Verify, JsonTellsTheSame) {
    change("1.5", "2");
    fs::remove(folder() / "out.2.exr");
    const Json told = Json::parse(verify({"--json", "--hashes"}).out);
    EXPECT_EQ(told.at("stale"), 1);
    EXPECT_EQ(told.at("missing"), 1);
    EXPECT_EQ(told.at("current"), 2);
    const Json& first = told.at("outputs").at(0);
    EXPECT_EQ(first.at("file"), "out.1.exr");
    EXPECT_EQ(first.at("frame"), 1);
    EXPECT_EQ(first.at("node"), "out");
    EXPECT_EQ(first.at("state"), "stale");
    EXPECT_EQ(first.at("reasons").at(0), "'smooth.sigma' is 2, and was 1.5");
    EXPECT_EQ(first.at("hashes").size(), 4U);
}

// Whoever wrote them, and however they are packed: the samples count.
TEST_F(Verify, HashesAreOfSamples) {
    const auto hashes = [&] {
        return Json::parse(verify({"--json", "--hashes"}).out)["outputs"][0]["hashes"];
    };
    const Json zip = hashes();
    EXPECT_EQ(render({"--set", "out.compression=none", "--threads", "1", "--tile", "7"}).status, 0);
    EXPECT_EQ(hashes(), zip);
    EXPECT_EQ(render({"--set", "smooth.sigma=1.6"}).status, 0);
    EXPECT_NE(hashes(), zip);
}

TEST_F(Verify, AFrameThatCanNotBeMadeIsAnError) {
    fs::remove(folder() / "in.1.exr");
    const Outcome run = verify();
    EXPECT_EQ(run.status, 3);
    EXPECT_THAT(run.err, HasSubstr("in.1.exr"));
    EXPECT_THAT(run.out, HasSubstr("out.2.exr: current\n"));
}

TEST_F(Verify, AnOutputTellsTheGraphThatMakesItAgain) {
    const Json told = Json::parse(keyline({"provenance", "out.1.exr", "--json"}).out);
    EXPECT_EQ(told.at("output"), "out");
    EXPECT_EQ(told.at("frame"), 1);
    EXPECT_EQ(told.at("inputs").size(), 1U);
    EXPECT_TRUE(told.at("libraries").contains("OpenEXR"));
    EXPECT_EQ(told.at("graph").at("variables").at("gain"), 1.25);
    EXPECT_FALSE(told.at("graph").at("nodes").contains("other")) << "the output does not need it";
    const Outcome run = keyline({"provenance", "out.1.exr"});
    EXPECT_EQ(run.status, 0);
    EXPECT_THAT(run.out, HasSubstr("  output    out, frame 1\n"));
    EXPECT_THAT(run.out, HasSubstr(" in.1.exr of render\n"));

    const std::string before = read(folder() / "out.2.exr");
    fs::remove(folder() / "out.2.exr");
    write("again.json", keyline({"provenance", "out.1.exr", "--graph"}).out);
    EXPECT_EQ(keyline({"render", "again.json", "--frames", "2"}).status, 0);
    EXPECT_EQ(keyline({"verify", "graph.json", "--only", "out", "--frames", "2"}).status, 0);
    EXPECT_EQ(read(folder() / "out.2.exr").size(), before.size());
}

TEST_F(Verify, WhatAnOutputInheritsIsNotItsOwn) {
    graph(R"("r":   { "type": "read", "file": "out.1.exr" },
             "out": { "type": "write", "in": "r", "file": "copy.exr" })");
    EXPECT_EQ(keyline({"render", "graph.json"}).status, 0);
    EXPECT_EQ(keyline({"verify", "graph.json"}).status, 0);
    const Json told = Json::parse(keyline({"provenance", "copy.exr", "--json"}).out);
    EXPECT_EQ(told.at("inputs").at(0).at("file"), "out.1.exr");
}

TEST_F(Verify, AnOutputOfTheCommandLineTellsItsOriginToo) {
    const std::vector<std::string> look{"graph.json", "--frames", "1", "--output", "grade=look.exr"};
    const auto with = [&](const char* command) {
        std::vector<std::string> all = look;
        all.insert(all.begin(), command);
        return keyline(all);
    };
    EXPECT_EQ(with("render").status, 0);
    EXPECT_EQ(with("verify").status, 0);
    write("again.json", keyline({"provenance", "look.exr", "--graph"}).out);
    EXPECT_EQ(keyline({"check", "again.json", "--frames", "1"}).status, 0);
}

TEST_F(Verify, WhatTellsNothingIsSaidToTellNothing) {
    const Outcome run = keyline({"provenance", "in.1.exr"});
    EXPECT_EQ(run.status, 3);
    EXPECT_THAT(run.err, HasSubstr("in.1.exr: it does not tell what made it"));
}

// Formats without a place for it have it beside them.
TEST_F(Verify, WhatHasNoPlaceForItsOriginHasItBeside) {
    const std::vector<std::string> tif{"--only", "other", "--set", "other.file=other.#.tif"};
    EXPECT_EQ(render(tif).status, 0);
    EXPECT_TRUE(exists("other.1.tif.origin.json"));
    EXPECT_EQ(verify(tif).status, 0) << verify(tif).out;
    EXPECT_THAT(keyline({"provenance", "other.1.tif"}).out, HasSubstr("  output    other, frame 1\n"));
    std::vector<std::string> shallow = tif;
    shallow.insert(shallow.end(), {"--set", "other.depth=uint8"});
    EXPECT_THAT(verify(shallow).out, HasSubstr("other.1.tif: stale: "));
    // It tells of those bytes alone.
    fs::copy(folder() / "other.2.tif", folder() / "other.1.tif", fs::copy_options::overwrite_existing);
    EXPECT_THAT(verify(tif).out, HasSubstr("other.1.tif: foreign\n"));
}

// Bytes depend on what made them and on nothing else.
TEST_F(Verify, NeitherPlaceNorTimeIsInIt) {
    const std::string here = read(folder() / "out.1.exr");
    EXPECT_THAT(here, HasSubstr("keyline/provenance"));
    EXPECT_THAT(here, Not(HasSubstr(folder().string())));
    const fs::path there = folder() / "there";
    fs::create_directory(there);
    for (const char* name : {"graph.json", "in.1.exr"})
        write(std::string("there/") + name, read(folder() / name));
    EXPECT_EQ(keyline({"render", (there / "graph.json").string(), "--frames", "1", "--threads", "1"}).status,
              0);
    EXPECT_TRUE(read(there / "out.1.exr") == here);
}

}  // namespace

}  // namespace keyline::test
