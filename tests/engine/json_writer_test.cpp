// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/json/json_writer.h"

#include <gtest/gtest.h>
#include <limits>

namespace keyline {

namespace {

TEST(JsonWriter, OnOneLine) {
    JsonWriter json;
    json.begin_object().field("frame", 7).field("ok", true).field("half", 0.5).key("files").begin_array();
    json.value("a").value("b").end_array().key("none").begin_object().end_object().end_object();
    EXPECT_EQ(json.text(), R"({"frame": 7, "ok": true, "half": 0.5, "files": ["a", "b"], "none": {}})");
}

TEST(JsonWriter, Indented) {
    JsonWriter json(JsonWriter::Style::kIndented);
    json.begin_object().field("a", 1).key("b").list(std::vector{1, 2}).key("c").begin_array().end_array();
    EXPECT_EQ(json.end_object().text(), "{\n  \"a\": 1,\n  \"b\": [\n    1,\n    2\n  ],\n  \"c\": []\n}");
}

TEST(JsonWriter, TextIsEscapedAndAlwaysUtf8) {
    EXPECT_EQ(JsonWriter().value("\"\\\n\t\x01 é").text(), R"("\"\\\n\t\u0001 é")");
    EXPECT_EQ(JsonWriter().value("caf\xe9").text(), "\"caf\xef\xbf\xbd\"");
}

TEST(JsonWriter, NumbersComeBackAsTheyWere) {
    EXPECT_EQ(JsonWriter().value(0.1F).text(), "0.1");
    EXPECT_EQ(JsonWriter().value(0.1).text(), "0.1");
    EXPECT_EQ(JsonWriter().value(std::numeric_limits<double>::infinity()).text(), "null");
}

}  // namespace

}  // namespace keyline
