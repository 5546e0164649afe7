// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/program/program.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

// Mistakes that no picture tells by itself: each has a warning with its code, each can be said to be meant,
// and what is right is not warned of.

namespace keyline::test {

namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

using Codes = std::vector<std::string>;

class Mistakes : public ProgramTest {
protected:
    Mistakes() { fs::copy(plates() / "street.0001.exr", folder() / "render.exr"); }

    // The codes of what `check` says of a graph that reads the render.
    Codes told(const std::string& nodes) const {
        graph(kRead + nodes);
        const Outcome run = keyline({"check", "graph.json", "--json"});
        EXPECT_EQ(run.status, 0) << run.out;
        Codes out;
        const auto checked = nlohmann::json::parse(run.out);
        for (const auto& message : checked[0]["messages"]) out.push_back(message["code"]);
        return out;
    }

    static constexpr const char* kRead = R"("render": { "type": "read", "file": "render.exr" },)";
};

TEST_F(Mistakes, SceneLinearColourInAFileForTheScreen) {
    const auto written = [](const std::string& more) {
        return R"("out": { "type": "write", "in": "render:Combined", )" + more + " }";
    };
    EXPECT_THAT(told(written(R"("file": "out.png")")), ElementsAre("linear-in-file"));
    EXPECT_THAT(told(written(R"("file": "out.tif", "depth": "uint8")")), ElementsAre("linear-in-file"));
    EXPECT_THAT(told(written(R"("file": "out.png", "colorspace": "ACEScg")")), ElementsAre("linear-in-file"));
    EXPECT_THAT(told(written(R"("file": "out.png", "meant": "linear-in-file")")), IsEmpty());
    EXPECT_THAT(told(written(R"("file": "out.png", "meant": ["shown-twice", "linear-in-file"])")), IsEmpty());
    EXPECT_THAT(told(written(R"("file": "out.png", "colorspace": "sRGB - Texture")")), IsEmpty());
    EXPECT_THAT(told(written(R"("file": "out.tif")")), IsEmpty()) << "a TIFF holds floats";
    EXPECT_THAT(told(written(R"("file": "out.exr")")), IsEmpty());
    EXPECT_THAT(told(R"("y": { "type": "ycolor", "in": "render:Combined" },
                        "out": { "type": "write", "in": "y", "file": "y.png" })"),
                IsEmpty())
        << "a map is no colour";
    // Through what leaves light what it is, under what nobody knows anything of.
    EXPECT_THAT(told(R"("ink": { "type": "ink", "in": "render:Combined.A" },
                        "soft": { "type": "gaussian", "in": "render:Combined", "sigma": 2 },
                        "comp": { "type": "over", "fg": "ink", "bg": "soft" },
                        "out": { "type": "write", "in": "comp", "file": "out.png" })"),
                ElementsAre("linear-in-file"));
    EXPECT_THAT(told(R"("paper": { "type": "constant", "color": "#ffffff", "like": "render" },
                        "ink": { "type": "ink", "in": "render:Combined.A" },
                        "comp": { "type": "over", "fg": "ink", "bg": "paper" },
                        "out": { "type": "write", "in": "comp", "file": "out.png" })"),
                IsEmpty())
        << "black and white are the same for both";
    EXPECT_THAT(told(R"("seen": { "type": "display", "in": "render:Combined" },
                        "comp": { "type": "over", "fg": "seen", "bg": "render:Combined" },
                        "out": { "type": "write", "in": "comp", "file": "out.png" })"),
                IsEmpty())
        << "of a mixture of both nobody knows what it is";
    EXPECT_THAT(told(R"("own": { "type": "grade", "in": "render:Combined", "gamma": 2.2 },
                        "out": { "type": "write", "in": "own", "file": "out.png" })"),
                IsEmpty())
        << "a gamma of one's own";
}

TEST_F(Mistakes, ColourMadeForADisplayTwice) {
    const std::string seen = R"("seen": { "type": "display", "in": "render:Combined" },)";
    const auto again = [&](const std::string& node) {
        return seen + fmt::format(R"("again": {{ {}, "in": "seen" }},
                        "out": {{ "type": "write", "in": "again", "file": "out.png" }})",
                                  node);
    };
    EXPECT_THAT(told(again(R"("type": "display")")), ElementsAre("shown-twice"));
    EXPECT_THAT(told(again(R"("type": "colorspace", "to": "sRGB - Texture")")), ElementsAre("shown-twice"));
    EXPECT_THAT(told(again(R"("type": "display", "meant": "shown-twice")")), IsEmpty());
    EXPECT_THAT(told(again(R"("type": "colorspace", "from": "sRGB - Display", "to": "P3-D65 - Display")")),
                IsEmpty());
    EXPECT_THAT(
        told(seen + R"("out": { "type": "write", "in": "seen", "file": "o.png", "colorspace": "sRGB" })"),
        ElementsAre("shown-twice"));
    EXPECT_THAT(told(seen + R"("out": { "type": "write", "in": "seen", "file": "out.png" })"), IsEmpty());
}

TEST_F(Mistakes, APictureForTheScreenThatIsTakenForLight) {
    graph(R"("c": { "type": "constant", "size": [8, 8] },
             "out": { "type": "write", "in": "c", "file": "flat.png" })");
    ASSERT_EQ(keyline({"render", "graph.json", "--progress", "none"}).status, 0);
    const auto shown = [](const std::string& read) {
        return fmt::format(R"("flat": {{ "type": "read", "file": "flat.png"{} }},
                "seen": {{ "type": "display", "in": "flat" }},
                "beauty": {{ "type": "write", "in": "render", "file": "b.exr" }},
                "out": {{ "type": "write", "in": "seen", "file": "out.png" }})",
                           read);
    };
    EXPECT_THAT(told(shown("")), ElementsAre("shown-twice"));
    EXPECT_THAT(told(shown(R"(, "colorspace": "sRGB - Texture")")), IsEmpty());
}

TEST_F(Mistakes, MeasuredChannelsThroughAColourConversion) {
    const auto shown = [](const std::string& more) {
        return fmt::format(
            R"("rgb": {{ "type": "shuffle", "in": "render:Normal", "channels": {{ "R": "X", "G": "Y", "B": "Z" }} }},
               "seen": {{ "type": "display", "in": "rgb"{} }},
               "out": {{ "type": "write", "in": "seen", "file": "out.png" }})",
            more);
    };
    EXPECT_THAT(told(shown("")), ElementsAre("data-converted"));
    EXPECT_THAT(told(shown(R"(, "meant": "data-converted")")), IsEmpty());
    EXPECT_THAT(told(R"("seen": { "type": "falsecolor", "in": "render:Normal" },
                        "out": { "type": "write", "in": "seen", "file": "out.png" })"),
                IsEmpty());
}

TEST_F(Mistakes, ColourDividedByItsAlphaTwice) {
    const std::string straight = R"("straight": { "type": "unpremultiply", "in": "render:Combined" },)";
    const auto then = [&](const std::string& node) {
        return straight + fmt::format(R"("then": {{ {} }},
                        "out": {{ "type": "write", "in": "then", "file": "out.exr" }})",
                                      node);
    };
    EXPECT_THAT(told(then(R"("type": "unpremultiply", "in": "straight")")), ElementsAre("divided-twice"));
    EXPECT_THAT(told(then(R"("type": "display", "in": "straight")")), ElementsAre("divided-twice"));
    EXPECT_THAT(told(then(R"("type": "display", "in": "straight", "meant": "divided-twice")")), IsEmpty());
    EXPECT_THAT(told(then(R"("type": "premultiply", "in": "straight")")), IsEmpty());
    EXPECT_THAT(told(straight + R"("out": { "type": "write", "in": "straight", "file": "out.png",
                                            "meant": "linear-in-file" })"),
                ElementsAre("divided-twice"))
        << "the format divides";
    EXPECT_THAT(told(straight + R"("graded": { "type": "grade", "in": "straight", "multiply": 2 },
                        "back": { "type": "premultiply", "in": "graded" },
                        "seen": { "type": "display", "in": "back" },
                        "out": { "type": "write", "in": "seen", "file": "out.png" })"),
                IsEmpty());
}

TEST_F(Mistakes, EdgesThatNothingHasThinned) {
    const std::string slope = R"("y": { "type": "ycolor", "in": "render:Combined" },
                                 "slope": { "type": "gradient", "in": "y" },)";
    const auto edges = [&](const std::string& nodes) {
        return slope + nodes + R"(, "out": { "type": "write", "in": "edges", "file": "out.exr" })";
    };
    EXPECT_THAT(told(edges(R"("edges": { "type": "hysteresis", "in": "slope", "low": 0.1 })")),
                ElementsAre("not-thinned"));
    EXPECT_THAT(told(edges(R"("more": { "type": "math", "in": "slope", "op": "multiply", "value": 2 },
                              "edges": { "type": "hysteresis", "in": "more", "low": 0.1 })")),
                ElementsAre("not-thinned"));
    EXPECT_THAT(
        told(
            edges(R"("edges": { "type": "hysteresis", "in": "slope", "low": 0.1, "meant": "not-thinned" })")),
        IsEmpty());
    EXPECT_THAT(told(edges(R"("thin": { "type": "nms", "in": "slope" },
                              "edges": { "type": "hysteresis", "in": "thin", "low": 0.1 })")),
                IsEmpty());
}

TEST_F(Mistakes, AnAlphaForTheStrengthOfAnEdgeIsAnError) {
    graph(std::string(kRead) + R"("edges": { "type": "hysteresis", "in": "render:Combined", "low": 0.1 },
                                  "out": { "type": "write", "in": "edges", "file": "out.exr" })");
    const Outcome run = keyline({"check", "graph.json"});
    EXPECT_EQ(run.status, 2);
    EXPECT_THAT(run.err, HasSubstr("the input is colour, and its A is none"));
    EXPECT_THAT(told(R"("edges": { "type": "hysteresis", "in": "render:Combined.A", "low": 0.1 },
                        "out": { "type": "write", "in": "edges", "file": "out.exr" })"),
                IsEmpty());
}

TEST_F(Mistakes, ADepthInHalf) {
    const auto far = [](const std::string& more) {
        return fmt::format(
            R"("far": {{ "type": "math", "in": "render:Depth", "op": "multiply", "value": 100000 }},
               "out": {{ "type": "write", "in": "far", "file": "out.exr"{} }})",
            more);
    };
    EXPECT_THAT(told(far(R"(, "depth": "half")")), ElementsAre("depth-in-half"));
    EXPECT_THAT(told(far(R"(, "depth": "half", "meant": "depth-in-half")")), IsEmpty());
    EXPECT_THAT(told(far("")), IsEmpty());
    // By itself it is written as float, and nothing overflows.
    const Outcome run = keyline({"render", "graph.json"});
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_THAT(run.err, Not(HasSubstr("warning")));
    EXPECT_THAT(keyline({"info", "out.exr"}).out, HasSubstr("float"));
    EXPECT_THAT(
        told(R"("out": { "type": "write", "in": "render:Normal", "file": "out.exr", "depth": "half" })"),
        IsEmpty())
        << "a direction fits";
}

TEST_F(Mistakes, MeantOfAGroupIsMeantOfAllInIt) {
    write("twice.json", R"({ "keyline": 1, "inputs": { "in": {} }, "outputs": { "out": "b" }, "nodes": {
        "a": { "type": "display", "in": "in" }, "b": { "type": "display", "in": "a" } } })");
    const auto used = [](const std::string& more) {
        return fmt::format(R"("g": {{ "type": "twice.json", "in": "render:Combined"{} }},
                              "out": {{ "type": "write", "in": "g", "file": "out.png" }})",
                           more);
    };
    EXPECT_THAT(told(used("")), ElementsAre("shown-twice"));
    EXPECT_THAT(told(used(R"(, "meant": "shown-twice")")), IsEmpty());
}

TEST_F(Mistakes, AreToldOnceByRenderAndCheckWithTheirPlaceAndTheWayToMeanThem) {
    fs::copy(plates() / "street.0001.exr", folder() / "s.0001.exr");
    fs::copy(plates() / "street.0002.exr", folder() / "s.0002.exr");
    graph(R"("s": { "type": "read", "file": "s.####.exr" },
             "out": { "type": "write", "in": "s:Combined", "file": "out.####.png" })");
    const std::string expected =
        "node 'out' (write): scene-linear colour goes into 'out.0001.png', which is looked at as it is: it "
        "will "
        "be too dark; put a 'display' before it, or give the file's 'colorspace'; \"meant\": "
        "\"linear-in-file\" "
        "says that it is right so\n";
    const Outcome render = keyline({"render", "graph.json", "--frames", "1-2", "--progress", "none"});
    EXPECT_EQ(render.status, 0) << render.err;
    EXPECT_THAT(render.err, HasSubstr(expected));
    EXPECT_THAT(render.err, Not(HasSubstr("out.0002.png"))) << "the first frame has told it";
    EXPECT_THAT(keyline({"check", "graph.json"}).err, HasSubstr("graph.json:"));
    const auto log = nlohmann::json::parse(keyline({"check", "graph.json", "--sarif"}).out);
    const auto& result = log["runs"][0]["results"][0];
    EXPECT_EQ(result["ruleId"], "linear-in-file");
    EXPECT_EQ(result["level"], "warning");
}

TEST_F(Mistakes, OnlyKnownOnesCanBeMeant) {
    graph(R"("c": { "type": "constant", "size": [8, 8], "meant": "shown-twise" },
             "out": { "type": "write", "in": "c", "file": "out.exr", "meant": ["cycle"] })");
    const Outcome run = keyline({"check", "graph.json"});
    EXPECT_EQ(run.status, 2);
    EXPECT_THAT(run.err,
                HasSubstr("'meant' is \"shown-twise\"; it must be one of 'unused', 'linear-in-file'"));
    EXPECT_THAT(run.err, HasSubstr("did you mean 'shown-twice'?"));
    EXPECT_THAT(run.err, HasSubstr("'meant' is \"cycle\""));
}

TEST_F(Mistakes, ANodeInReserve) {
    const auto kept = [](const std::string& more) {
        return fmt::format(R"("soft": {{ "type": "gaussian", "in": "render:Combined", "sigma": 2{} }},
                              "out": {{ "type": "write", "in": "render", "file": "out.exr" }})",
                           more);
    };
    EXPECT_THAT(told(kept("")), ElementsAre("unused"));
    EXPECT_THAT(told(kept(R"(, "meant": "unused")")), IsEmpty());
}

// The graphs that come with Keyline are right.
TEST_F(Mistakes, AreNoneInTheShippedGraphs) {
    for (const auto& entry : fs::directory_iterator(plates().parent_path())) {
        if (entry.path().extension() != ".json") continue;
        const Outcome run = keyline({"check", entry.path().string()});
        EXPECT_EQ(run.status, 0) << run.err;
        EXPECT_THAT(run.err, Not(HasSubstr("\"meant\""))) << entry.path();
    }
}

}  // namespace

}  // namespace keyline::test
