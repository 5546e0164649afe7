// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/json/value.h"

#include "engine/json/json_reader.h"

#include <gtest/gtest.h>

namespace keyline {
namespace {

std::string shown(std::string_view json) { return parse_json(json, "g.json").shown(); }

TEST(Value, IsShownAsCompactJson) {
    EXPECT_EQ(shown(R"({ "a" : [ 1, -0.50, 1E3 ], "b" : { "c" : null }, "d" : [], "e" : {}, "f" : true })"),
              R"({"a":[1,-0.50,1E3],"b":{"c":null},"d":[],"e":{},"f":true})");
    EXPECT_EQ(shown(R"("a\"b\\c\n\u0001\u00fc")"), R"("a\"b\\c\n\u0001ü")");
}

TEST(Value, IsShownInSixtyCharacters) {
    EXPECT_EQ(shown('"' + std::string(58, 'x') + '"'), '"' + std::string(58, 'x') + '"');
    EXPECT_EQ(shown('"' + std::string(59, 'x') + '"'), '"' + std::string(59, 'x') + "…");
    std::string umlauts;
    for (int i = 0; i < 59; ++i) umlauts += "ü";
    EXPECT_EQ(shown('"' + umlauts + "x\""), '"' + umlauts + "…");
    std::string long_array = "[0";
    for (int i = 0; i < 1000; ++i) long_array += ",0";
    EXPECT_EQ(shown(long_array + "]"), long_array.substr(0, 60) + "…");
}

TEST(Value, FindsItsMembers) {
    const Value v = parse_json(R"({"a": 1, "b": 2})", "g.json");
    ASSERT_NE(v.find("b"), nullptr);
    EXPECT_EQ(v.find("b")->number, 2);
    EXPECT_EQ(v.find("c"), nullptr);
}

TEST(Value, KindsHaveNames) {
    EXPECT_EQ(kind_name(Value::Kind::kNull), "null");
    EXPECT_EQ(kind_name(Value::Kind::kBool), "a boolean");
    EXPECT_EQ(kind_name(Value::Kind::kNumber), "a number");
    EXPECT_EQ(kind_name(Value::Kind::kString), "a string");
    EXPECT_EQ(kind_name(Value::Kind::kArray), "an array");
    EXPECT_EQ(kind_name(Value::Kind::kObject), "an object");
}

}  // namespace
}  // namespace keyline
