// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/strokes_json.h"

#include "tests/support/strokes.h"

#include <gmock/gmock.h>

namespace keyline::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* kHead = R"({"strokes": 1, "display": [0, 0, 8, 8], "window": [0, 0, 8, 8], )";

std::string file_with(const std::string& rest) { return kHead + rest + "}"; }
std::string file_of_line(const std::string& line) { return file_with(R"("lines": [{)" + line + "}]"); }

std::string error_in(const std::string& text) {
    try {
        parse_strokes(text, "a.json");
        return "";
    } catch (const Failure& f) {
        EXPECT_EQ(f.error().kind, ErrorKind::kInput);
        return f.error().text();
    }
}

TEST(StrokesJson, IsLossless) {
    for (unsigned seed = 0; seed < 20; ++seed) {
        const Strokes strokes = random_strokes(seed, {-3, 5, 60, 45});
        const std::string text = strokes_json(strokes);
        EXPECT_EQ(parse_strokes(text, "a.json"), strokes) << text;
        EXPECT_EQ(strokes_json(parse_strokes(text, "a.json")), text);
    }
}

TEST(StrokesJson, KeepsTheLastBitOfANumberAndTheSignOfZero) {
    Stroke s = stroke({{0.1, 1.0 / 3}, {1e-300, -0.0}});
    s.vertices[1].depth = 5e-324;
    const Strokes strokes = strokes_in({0, 0, 8, 8}, {s});
    EXPECT_EQ(parse_strokes(strokes_json(strokes), "a.json"), strokes);
}

TEST(StrokesJson, LeavesOutWhatIsAsUsual) {
    const std::string text = strokes_json(strokes_in({0, 0, 8, 8}, {stroke({{1, 2}, {3, 4}}, 2)}));
    EXPECT_EQ(text, R"({
"strokes": 1,
"display": [0, 0, 8, 8],
"window": [0, 0, 8, 8],
"objects": {},
"lines": [
{"kind": "outline", "points": [[1, 2], [3, 4]], "width": 2}
]
}
)");
}

TEST(StrokesJson, CallsObjectsByNameWhereThatIsClear) {
    std::vector<Stroke> strokes{stroke({{1, 2}, {3, 4}}), stroke({{2, 2}, {3, 4}}), stroke({{3, 2}, {3, 4}})};
    strokes[0].near = 1;
    strokes[1].near = 2;
    strokes[2].near = 3;
    strokes[2].far = 0xABCDEF01;
    Strokes all = strokes_in({0, 0, 8, 8}, strokes);
    all.names = {{1, "twin"}, {2, "twin"}, {3, "only"}};
    const std::string text = strokes_json(all);
    EXPECT_THAT(text, HasSubstr(R"("near": "only", "far": "abcdef01")"));
    EXPECT_THAT(text, HasSubstr(R"("near": "00000001")"));
    EXPECT_EQ(parse_strokes(text, "a.json"), all);
}

TEST(StrokesJson, PutsInOrderWhatAScriptAdded) {
    const Strokes strokes = parse_strokes(
        file_with(
            R"("lines": [{"points": [[5, 5], [6, 6]]}, {"kind": "outline", "points": [[1, 1], [2, 2]]}])"),
        "a.json");
    ASSERT_EQ(strokes.strokes.size(), 2U);
    EXPECT_EQ(strokes.strokes[0].kind, StrokeKind::kOutline);
    EXPECT_EQ(strokes.strokes[1].kind, StrokeKind::kUser) << "the kind of a line without one";
    EXPECT_EQ(strokes.strokes[1].vertices[1].u, 1);
}

TEST(StrokesJson, TakesColoursAsGraphsDo) {
    const Strokes strokes =
        parse_strokes(file_of_line(R"("points": [[5, 5], [6, 6]], "color": "#ff0000")"), "a.json");
    EXPECT_EQ(strokes.strokes[0].color, (Color{1, 0, 0}));
}

TEST(StrokesJson, TellsWhatIsWrongAndWhere) {
    EXPECT_EQ(
        error_in("{\n\"strokes\": 2, \"display\": [0, 0, 8, 8], \"window\": [0, 0, 8, 8], \"lines\": []}"),
        "a.json:2:12: error: these are strokes of version 2; this build reads version 1");
    EXPECT_THAT(error_in("{"), HasSubstr("a.json:1:2: error:"));
    EXPECT_THAT(error_in("[]"), HasSubstr("a.json:1:1: error:"));
    EXPECT_THAT(error_in(file_with("\"lines\": [],\n\"liens\": []")),
                HasSubstr("a.json:2:1: error: unknown key 'liens'; did you mean 'lines'?"));
    EXPECT_THAT(error_in(file_of_line(R"("points": [[1, 1]])")), HasSubstr("'points' has 1; a line has two"));
    EXPECT_THAT(error_in(file_of_line(R"("kind": "outlin", "points": [[1, 1], [2, 2]])")),
                HasSubstr("did you mean 'outline'?"));
    EXPECT_THAT(error_in(file_of_line(R"("points": [[1, 1], [2, 2, 3]])")), HasSubstr("a.json:1:95: error:"));
    EXPECT_THAT(error_in(file_of_line(R"("points": [[1, 1], [2, 2]], "width": [1])")),
                HasSubstr("'width' has 1 items, 'points' has 2; give one for each point"));
    EXPECT_THAT(error_in(file_of_line(R"("points": [[1, 1], [2, 2]], "width": -1)")),
                HasSubstr("'width' is -1; it must be"));
    EXPECT_THAT(error_in(file_of_line(R"("points": [[1, 1], [2, 2]], "opacity": [1, 2])")),
                HasSubstr("'opacity' is 2; it must be"));
    EXPECT_THAT(error_in(file_of_line(R"("points": [[1, 1], [2, 2]], "anchor": "uv")")),
                HasSubstr("'anchors' has 0 items, 'points' has 2"));
    EXPECT_THAT(error_in(file_of_line(R"("points": [[1, 1], [2, 2]], "anchors": [[0, 0, 0], [0, 0, 0]])")),
                HasSubstr("no 'anchor' that says what they are"));
    EXPECT_THAT(error_in(file_of_line(R"("points": [[1, 1], [2, 2]], "ends": ["end"])")),
                HasSubstr("'ends' has 1 items; it must have two"));
}

TEST(StrokesJson, TellsWhichObjectsThereAre) {
    const auto with = [](const std::string& near) {
        return file_with(R"("objects": {"00000001": "Suzanne", "00000002": "twin", "00000003": "twin"},
            "lines": [{"near": ")" +
                         near + R"(", "points": [[1, 1], [2, 2]]}])");
    };
    EXPECT_EQ(error_in(with("Suzanne")), "");
    EXPECT_EQ(error_in(with("deadbeef")), "");
    EXPECT_THAT(error_in(with("Susanne")),
                HasSubstr("a.json:2:32: error: 'Susanne' is not among the objects; "
                          "did you mean 'Suzanne'?"));
    EXPECT_THAT(error_in(with("twin")), HasSubstr("is the name of 2 objects; write an id, as '00000002'"));
    EXPECT_THAT(error_in(file_with(R"("objects": {"1": "a"}, "lines": [])")),
                HasSubstr("the id of 'a' is '1'; it must be 8 hexadecimal digits"));
}

TEST(StrokesJson, HasNoNumbersThatAreNone) {
    EXPECT_THAT(error_in(file_of_line(R"("points": [[1, 1], [1e999, 2]])")), HasSubstr("beyond the range"));
    EXPECT_THAT(error_in(file_of_line(R"("points": [[1, 1], [null, 2]])")), Not(""));
}

}  // namespace
}  // namespace keyline::testing
