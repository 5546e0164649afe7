// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/graph/animation.h"

#include "engine/json/json_reader.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace keyline {
namespace {

// The value at each of some frames, one after the other.
std::string at(std::string_view json, const std::vector<int>& frames) {
    std::string out;
    for (const int frame : frames) {
        Diagnostics diagnostics;
        const auto value = animated(parse_json(json, "g.json"), frame, diagnostics);
        out += (out.empty() ? "" : " ") + (value ? value->shown() : diagnostics.errors().at(0).text());
    }
    return out;
}

double number(std::string_view json, int frame) {
    Diagnostics diagnostics;
    const auto value = animated(parse_json(json, "g.json"), frame, diagnostics);
    EXPECT_TRUE(value);
    return value ? value->number : 0;
}

std::string fault(std::string_view json) {
    Diagnostics diagnostics;
    EXPECT_FALSE(animated(parse_json(json, "g.json"), 1, diagnostics));
    return diagnostics.errors().size() == 1 ? diagnostics.errors()[0].text() : "not one error";
}

TEST(Animation, IsKnownByItsKeys) {
    EXPECT_TRUE(is_animation(parse_json(R"({"keys": [[1, 2]]})", "g.json")));
    EXPECT_FALSE(is_animation(parse_json(R"({"keys": "a node"})", "g.json")));
    EXPECT_FALSE(is_animation(parse_json(R"([[1, 2]])", "g.json")));
}

TEST(Animation, GoesStraightOrSmoothlyOrNotAtAll) {
    EXPECT_EQ(at(R"({"keys": [[10, 0], [14, 8]]})", {10, 11, 12, 13, 14}), "0 2 4 6 8");
    EXPECT_EQ(at(R"({"keys": [[10, 0, "smooth"], [14, 32]]})", {10, 11, 12, 13, 14}), "0 5 16 27 32");
    EXPECT_EQ(at(R"({"keys": [[10, 0, "hold"], [14, 8]]})", {10, 13, 14}), "0 0 8");
    EXPECT_EQ(at(R"({"keys": [[10, 0, "hold"], [12, 8, "linear"], [14, 4]]})", {11, 12, 13, 14}), "0 8 6 4");
}

TEST(Animation, MovesPairsColoursAndLists) {
    EXPECT_EQ(at(R"({"keys": [[0, [0, 8]], [4, [4, 0]]]})", {1}), "[1,6]");
    EXPECT_EQ(at(R"({"keys": [[0, [[0], 1]], [2, [[4], 3]]]})", {1}), "[[2],2]");
    EXPECT_EQ(at(R"({"keys": [[0, "#000000"], [2, "#ffffff"]]})", {0, 1, 2}),
              R"([0,0,0] [0.5,0.5,0.5] "#ffffff")");
    EXPECT_EQ(at(R"({"keys": [[0, [0, 0, 2]], [2, "#ffffff"]]})", {1}), "[0.5,0.5,1.5]");
}

TEST(Animation, HoldsWhatHasNothingBetween) {
    EXPECT_EQ(at(R"({"keys": [[1, "disk"], [5, "square"]]})", {1, 4, 5, 9}),
              R"("disk" "disk" "square" "square")");
    EXPECT_EQ(at(R"({"keys": [[1, true], [5, false]]})", {4, 5}), "true false");
    EXPECT_EQ(at(R"({"keys": [[1, [1, 2]], [5, 3]]})", {4, 5}), "[1,2] 3");
}

TEST(Animation, EndsAsItSays) {
    const std::string keys = R"({"keys": [[10, 0], [12, 4], [14, 5]])";
    EXPECT_EQ(at(keys + "}", {-5, 9, 15, 99}), "0 0 5 5");
    EXPECT_EQ(at(keys + R"(, "before": "extend", "after": "extend"})", {9, 8, 15, 16}), "-2 -4 5.5 6");
    EXPECT_EQ(at(keys + R"(, "before": "loop", "after": "loop"})", {9, 8, 6, 14, 15, 17, 18}),
              "4.5 4 0 5 2 4.5 0");
    EXPECT_EQ(at(R"({"keys": [[1, "a"], [3, "b"]], "after": "extend"})", {9}), R"("b")");
    EXPECT_EQ(at(R"({"keys": [[5, 7]], "before": "loop", "after": "extend"})", {1, 5, 9}), "7 7 7");
}

TEST(Animation, StandsForSomeFrames) {
    EXPECT_EQ(at(R"({"keys": [[1001, 0], [1009, 8]], "on": 2})", {1001, 1002, 1003, 1004, 1009, 1010}),
              "0 0 2 2 8 8");
    EXPECT_EQ(at(R"({"keys": [[1, 0], [9, 8]], "on": 3, "before": "extend"})", {-2, -1, 0, 1}), "-3 -3 -3 0");
}

TEST(Animation, CurvesByTangents) {
    const std::string gently = R"({"keys": [[0, 0, {"out": [4, 0]}], [8, 16, {"in": [-4, 0]}]]})";
    EXPECT_EQ(at(gently, {-1, 0, 4, 8, 9}), "0 0 8 16 16");
    EXPECT_LT(number(gently, 1), 0.6);   // straight is 2
    EXPECT_GT(number(gently, 7), 15.4);  // straight is 14

    // Without one on the other side it goes straight there; that a third of the way off is no tangent at all.
    const double third = 8.0 / 3;
    EXPECT_NEAR(number(fmt::format(R"({{"keys": [[0, 0, {{"out": [{0}, {0}]}}], [8, 8]]}})", third), 5), 5,
                1e-12);
    EXPECT_NEAR(number(fmt::format(R"({{"keys": [[0, 0], [8, 8, {{"in": [-{0}, -{0}]}}]]}})", third), 5), 5,
                1e-12);

    // A ball that is thrown: up and down again between equal keys.
    EXPECT_EQ(at(R"({"keys": [[0, 1, {"out": [4, 8]}], [8, 1, {"in": [-4, 8]}]]})", {4}), "7");
    EXPECT_EQ(at(R"({"keys": [[0, [0, 1], {"out": [4, [0, 4]]}], [8, [8, 1], {"in": [-4, [0, 4]]}]]})", {4}),
              "[4,4]");
    EXPECT_EQ(
        at(R"({"keys": [[0, "#000000", {"out": [1, "#000000"]}], [2, "#ffffff", {"in": [-1, "#000000"]}]]})",
           {1}),
        "[0.5,0.5,0.5]");
    EXPECT_EQ(at(R"({"keys": [[0, 0, {"out": [4, 0]}], [8, 16, {"in": [-4, 0]}]], "after": "loop"})", {12}),
              "8");
}

TEST(Animation, TangentsLeadSomewhere) {
    EXPECT_EQ(fault(R"({"keys": [[0, 0, {"out": [5, 0]}], [4, 8]]})"),
              "g.json:1:26: error: 'out' goes 5 frames; it must be from 0 to 4, which is the next key there");
    EXPECT_EQ(fault(R"({"keys": [[0, 0], [4, 8, {"in": [1, 0]}]]})"),
              "g.json:1:33: error: 'in' goes 1 frames; it must be from -4 to 0, which is the next key there");
    EXPECT_EQ(fault(R"({"keys": [[0, 0, {"in": [-1, 0]}], [4, 8]]})"),
              "g.json:1:25: error: 'in' leads nowhere: there is no key on that side");
    EXPECT_EQ(fault(R"({"keys": [[0, 0], [4, 8, {"out": [1, 0]}]]})"),
              "g.json:1:34: error: 'out' leads nowhere: there is no key on that side");
    EXPECT_EQ(fault(R"({"keys": [[0, 0, {"out": 3}], [4, 8]]})"),
              "g.json:1:26: error: 'out' is 3; it must be [FRAMES, RISE], seen from the key");
    EXPECT_EQ(fault(R"({"keys": [[0, 0, {"uot": [1, 3]}], [4, 8]]})"),
              "g.json:1:19: error: unknown key 'uot'; a key's tangents are 'in' and 'out'");
    EXPECT_EQ(fault(R"({"keys": [[0, 0, "hold"], [4, 8, {"in": [-1, 0]}]]})"),
              "g.json:1:41: error: the curve arrives here, and the key before goes on \"hold\"; write "
              "{ \"out\": [FRAMES, RISE] } there, or nothing");
    EXPECT_EQ(fault(R"({"keys": [[0, 0, {"out": [1, [2, 3]]}], [4, 8]]})"),
              "g.json:1:30: error: a tangent rises by [2,3], and the value is 0; they must be alike");
    EXPECT_EQ(fault(R"({"keys": [[0, 5], [1, 0], [4, 8, {"in": [-1, [0, 0]]}]]})"),
              "g.json:1:46: error: a tangent rises by [0,0], and the value is 0; they must be alike")
        << "whatever the frame";
    EXPECT_EQ(fault(R"({"keys": [[0, "disk", {"out": [1, 3]}], [4, "square"]]})"),
              "g.json:1:31: error: there is nothing between \"disk\" and \"square\"; write \"hold\"");
}

TEST(Animation, FaultsAreTold) {
    EXPECT_EQ(fault(R"({"keys": [[1, "a", "smooth"], [2, 3]]})"),
              "g.json:1:20: error: there is nothing between \"a\" and 3; write \"hold\"");
    EXPECT_EQ(
        fault(R"({"keys": [[2, 1], [2, 3]]})"),
        "g.json:1:20: error: the key of frame 2 stands after that of frame 2; keys stand in the order of "
        "their frames");
    EXPECT_EQ(fault(R"({"keys": [[2, 1]], "on": 0.5})"),
              "g.json:1:26: error: 'on' is 0.5; it must be a whole number of frames");
}

}  // namespace
}  // namespace keyline
