// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/program/program.h"

#include <cstdlib>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <regex>

// Strokes in files: to scripts and back.

namespace keyline::test {

namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

constexpr const char* kThree = R"({
"strokes": 1, "display": [0, 0, 40, 30], "window": [0, 0, 40, 30],
"objects": { "0000000a": "cup" },
"lines": [
  { "kind": "outline", "near": "cup", "points": [[5, 5], [10, 5], [10, 10]], "closed": true, "width": 2 },
  { "kind": "crease", "near": "cup", "points": [[20, 5], [25, 6]], "width": [1, 2.5] },
  { "kind": "shadow", "points": [[20, 15], [25, 16]] }
]
})";

// What artists' scripts do: move, recolour, delete.
constexpr const char* kScript = R"(
import json, sys
with open(sys.argv[1]) as f:
    drawing = json.load(f)
drawing["lines"] = [line for line in drawing["lines"] if line["kind"] != "shadow"]
for line in drawing["lines"]:
    if line["kind"] == "crease":
        line["color"] = "#ff0000"
    if line.get("near") == "cup":
        line["points"] = [[x + 3, y - 2] for x, y in line["points"]]
with open(sys.argv[2], "w") as f:
    json.dump(drawing, f, indent=1)
)";

class StrokeFiles : public ProgramTest {
protected:
    // From one file to another, through the engine.
    Outcome copy(const std::string& from, const std::string& to) const {
        graph(fmt::format(R"("in":  {{ "type": "strokes_read", "file": "{}" }},
            "out": {{ "type": "strokes_write", "in": "in", "file": "{}" }})",
                          from, to));
        return keyline({"render", "graph.json"});
    }
};

TEST_F(StrokeFiles, SurviveAScriptThatMovesRecoloursAndDeletes) {
    write("three.json", kThree);
    write("edit.py", kScript);
    ASSERT_EQ(copy("three.json", "out/plain.json").status, 0);
    const std::string command =
        fmt::format("cd '{}' && python3 edit.py out/plain.json edited.json", folder().string());
    ASSERT_EQ(std::system(command.c_str()), 0) << "needs python3";
    const Outcome run = copy("edited.json", "again.json");
    ASSERT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(read(folder() / "again.json"), R"({
"strokes": 1,
"display": [0, 0, 40, 30],
"window": [0, 0, 40, 30],
"objects": {"0000000a": "cup"},
"lines": [
{"kind": "outline", "near": "cup", "closed": true, "points": [[8, 3], [13, 3], [13, 8]], "width": 2},
{"kind": "crease", "near": "cup", "color": [1, 0, 0], "points": [[23, 3], [28, 4]], "width": [1, 2.5]}
]
}
)");
    ASSERT_EQ(copy("again.json", "same.json").status, 0);
    EXPECT_EQ(read(folder() / "same.json"), read(folder() / "again.json"));
}

TEST_F(StrokeFiles, LinksPickKinds) {
    write("three.json", kThree);
    ASSERT_EQ(copy("three.json", "all.json").status, 0);
    const auto picked = [&](const std::string& kind) {
        graph(R"("in":  { "type": "strokes_read", "file": "three.json" },
            "out": { "type": "strokes_write", "in": "in:)" +
              kind + R"(", "file": "picked.json" })");
        return keyline({"render", "graph.json"});
    };
    ASSERT_EQ(picked("crease").status, 0);
    EXPECT_EQ(read(folder() / "picked.json"), R"({
"strokes": 1,
"display": [0, 0, 40, 30],
"window": [0, 0, 40, 30],
"objects": {"0000000a": "cup"},
"lines": [
{"kind": "crease", "near": "cup", "points": [[20, 5], [25, 6]], "width": [1, 2.5]}
]
}
)");
    ASSERT_EQ(picked("shadow").status, 0);
    EXPECT_THAT(read(folder() / "picked.json"), Not(HasSubstr("cup"))) << "names go with their strokes";
    ASSERT_EQ(picked("ridge").status, 0);
    EXPECT_THAT(read(folder() / "picked.json"), HasSubstr("\"lines\": [\n]"));
    const Outcome wrong = picked("creese");
    EXPECT_EQ(wrong.status, 2);
    EXPECT_THAT(wrong.err,
                HasSubstr("'in' gives strokes, of which none are 'creese'; did you mean 'crease'?"));
    EXPECT_THAT(picked("ink").err, HasSubstr("none are 'ink'; known are 'outline', 'occlusion'"));
}

// Each kind by itself, and all of them together again.
TEST_F(StrokeFiles, KindsTogetherAreTheWhole) {
    write("three.json", kThree);
    ASSERT_EQ(copy("three.json", "all.json").status, 0);
    graph(R"("in":  { "type": "strokes_read", "file": "three.json" },
        "both": { "type": "chain", "in": ["in:shadow", "in:crease", "in:outline"], "gap": 0, "min_length": 0 },
        "out": { "type": "strokes_write", "in": "both", "file": "again.json" })");
    const Outcome run = keyline({"render", "graph.json"});
    ASSERT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(read(folder() / "again.json"), read(folder() / "all.json"));
}

TEST_F(StrokeFiles, AreReadByFrame) {
    write("lines.0007.json", kThree);
    graph(R"("in":  { "type": "strokes_read", "file": "lines.####.json" },
        "out": { "type": "strokes_write", "in": "in", "file": "out.####.json" })");
    EXPECT_EQ(keyline({"render", "graph.json", "--frames", "7"}).status, 0);
    EXPECT_THAT(files(),
                ElementsAre("graph.json", "lines.0007.json", "out.0007.json", "out.0007.json.origin.json"));
    const Outcome run = keyline({"render", "graph.json", "--frames", "8"});
    EXPECT_EQ(run.status, 3);
    EXPECT_THAT(run.err, HasSubstr("lines.0008.json: no such file; on disk are frames 7"));
}

TEST_F(StrokeFiles, AreToldWithThePlaceOfWhatIsWrong) {
    write("bad.json",
          "{\"strokes\": 1, \"display\": [0, 0, 40, 30], \"window\": [0, 0, 40, 30],\n\"lines\": 3}");
    const Outcome run = copy("bad.json", "out.json");
    EXPECT_EQ(run.status, 3) << run.err;
    EXPECT_THAT(run.err, HasSubstr("bad.json:2:10: error: node 'in' (strokes_read)"));
    EXPECT_THAT(run.err, HasSubstr("'lines' is 3, a number; it must be"));
    EXPECT_THAT(files(), ElementsAre("bad.json", "graph.json")) << "and nothing was written";
}

// Reads it as any XML program does, and says what a person would see.
constexpr const char* kLook = R"(
import sys, xml.etree.ElementTree as tree
svg, inkscape = "{http://www.w3.org/2000/svg}", "{http://www.inkscape.org/namespaces/inkscape}"
root = tree.parse(sys.argv[1]).getroot()
assert root.tag == svg + "svg", root.tag
print(root.get("viewBox"))
for layer in root.findall(svg + "g"):
    assert layer.get(inkscape + "groupmode") == "layer"
    print(layer.get("id"), layer.get(inkscape + "label"), *(f'{p.get("id")} of "{p.get("data-owner")}"' for p in layer))
)";

class SvgFiles : public StrokeFiles {
protected:
    // What a pattern's group matches in a text, one after the other.
    static std::vector<std::string> found(const std::string& text, const std::string& pattern) {
        const std::regex regex(pattern);
        std::vector<std::string> out;
        for (std::sregex_iterator it(text.begin(), text.end(), regex), end; it != end; ++it)
            out.push_back((*it)[1]);
        return out;
    }

    // Writes the lines as SVG and says what is in it.
    std::string look_at(const std::string& parameters) const {
        graph(fmt::format(R"("in":  {{ "type": "strokes_read", "file": "three.json" }},
            "out": {{ "type": "svg", "in": "in", "file": "three.svg" {} }})",
                          parameters));
        const Outcome run = keyline({"render", "graph.json"});
        EXPECT_EQ(run.status, 0) << run.err;
        write("look.py", kLook);
        const std::string command =
            fmt::format("cd '{}' && python3 look.py three.svg > seen.txt", folder().string());
        EXPECT_EQ(std::system(command.c_str()), 0);
        return read(folder() / "seen.txt");
    }
};

TEST_F(SvgFiles, HaveLayersByKindWithTheFirstOnTop) {
    write("three.json", kThree);
    EXPECT_EQ(look_at(""), R"(0 0 40 30
shadow shadow stroke2 of ""
crease crease stroke1 of "cup"
outline outline stroke0 of "cup"
)");
    EXPECT_THAT(read(folder() / "three.svg"), HasSubstr("fill-rule=\"nonzero\""));
}

TEST_F(SvgFiles, HaveLayersByObjectWhateverItsName) {
    std::string three = kThree;
    for (std::size_t at = 0; (at = three.find("cup", at)) != std::string::npos; at += 10)
        three.replace(at, 3, R"(c<u>&\"p)");
    write("three.json", three);
    EXPECT_EQ(look_at(R"(, "layers": "object")"), R"(0 0 40 30
nobody nobody stroke2 of ""
c_u___p c<u>&"p stroke1 of "c<u>&"p" stroke0 of "c<u>&"p"
)");
}

TEST_F(SvgFiles, HavePathsWithAWidth) {
    write("three.json", kThree);
    look_at(R"(, "width": "stroke", "color": "#804020")");
    const std::string svg = read(folder() / "three.svg");
    EXPECT_THAT(svg, HasSubstr("stroke=\"#804020\" stroke-opacity=\"1\" stroke-width=\"1.75\""));
    EXPECT_THAT(svg, HasSubstr("d=\"M20,5 C21.67,5.33 23.33,5.67 25,6\""));
}

TEST_F(SvgFiles, HaveALayerForEachOfNamesThatAreAlike) {
    write("three.json", R"({
"strokes": 1, "display": [0, 0, 40, 30], "window": [0, 0, 40, 30],
"objects": { "0000000a": "a b", "0000000b": "a/b", "0000000c": "stroke1", "0000000d": "3" },
"lines": [
  { "kind": "outline", "near": "a b", "points": [[5, 5], [10, 5]] },
  { "kind": "outline", "near": "a/b", "points": [[5, 5], [10, 5]] },
  { "kind": "outline", "near": "stroke1", "points": [[5, 5], [10, 5]] },
  { "kind": "outline", "near": "3", "points": [[5, 5], [10, 5]] }
]
})");
    EXPECT_EQ(look_at(R"(, "layers": "object")"), R"(0 0 40 30
_3 3 stroke3 of "3"
_stroke1 stroke1 stroke2 of "stroke1"
a_b a/b stroke1 of "a/b"
_a_b a b stroke0 of "a b"
)") << "as ids no two are the same, and all are names as XML has them";
}

TEST_F(SvgFiles, ArePathsOfOneWidthEachWhereWidthsAreSplit) {
    write("three.json", R"({
"strokes": 1, "display": [0, 0, 40, 30], "window": [0, 0, 40, 30],
"lines": [
  { "kind": "crease", "points": [[0, 5], [10, 5], [20, 5], [30, 5]], "width": [2, 2, 4, 4] },
  { "kind": "crease", "points": [[5, 9], [25, 9]], "width": 0 },
  { "kind": "crease", "points": [[5, 10], [25, 10], [25, 20]], "closed": true, "width": [2, 2.2, 2] }
]
})");
    EXPECT_EQ(look_at(R"(, "width": "split")"), "0 0 40 30\ncrease crease stroke2 of \"\" stroke0 of \"\"\n");
    const std::string svg = read(folder() / "three.svg");
    const std::vector<std::string> widths = found(svg, "stroke-width=.([0-9.]*)"),
                                   begins = found(svg, "d=.M([^ ]*)"),
                                   ends = found(svg, "([0-9.]+,[0-9.]+)./>");
    EXPECT_EQ(widths.front(), "2.07") << "the closed one is even enough";
    EXPECT_THAT(svg, HasSubstr(" Z\"/>"));
    EXPECT_THAT(widths, testing::SizeIs(testing::AllOf(testing::Ge(4), testing::Le(6))));
    for (std::size_t i = 2; i < widths.size(); ++i) {
        EXPECT_EQ(begins[i], ends[i - 2]) << "where the one before ends";
        EXPECT_GT(std::stod(widths[i]), std::stod(widths[i - 1]));
        EXPECT_LT(std::stod(widths[i]), 1.35 * std::stod(widths[i - 1]));
    }
}

}  // namespace

}  // namespace keyline::test
