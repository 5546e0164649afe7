// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/json/json_reader.h"

#include <cmath>
#include <gtest/gtest.h>
#include <ostream>
#include <string>
#include <vector>

namespace keyline {
namespace {

std::string error_of(std::string_view json) {
    try {
        parse_json(json, "g.json");
    } catch (const Failure& f) {
        EXPECT_EQ(f.error().kind, ErrorKind::kGraph);
        return f.what();
    }
    return "no error";
}

TEST(GraphJson, KeepsValuesAndTheirOrder) {
    const Value v =
        parse_json(R"({"z": [true, false, null], "a": "x\u00fc\ud83d\ude00\/", "n": {}})", "g.json");
    ASSERT_TRUE(v.is(Value::Kind::kObject));
    ASSERT_EQ(v.members.size(), 3U);
    EXPECT_EQ(v.members[0].key, "z");
    EXPECT_EQ(v.members[1].key, "a");
    EXPECT_EQ(v.members[1].value.text, "xü😀/");
    const Value& list = v.members[0].value;
    ASSERT_EQ(list.items.size(), 3U);
    EXPECT_TRUE(list.items[0].is(Value::Kind::kBool) && list.items[0].boolean);
    EXPECT_TRUE(list.items[1].is(Value::Kind::kBool) && !list.items[1].boolean);
    EXPECT_TRUE(list.items[2].is(Value::Kind::kNull));
    EXPECT_TRUE(v.members[2].value.is(Value::Kind::kObject));
}

TEST(GraphJson, NumbersKeepTheirTextAndAreTheNearestDouble) {
    const Value v =
        parse_json("[1, -0, 1.50, 1E3, 9007199254740993, 18446744073709551616, -0.0, 1e-999]", "g");
    const std::vector<std::pair<std::string, double>> expected{
        {"1", 1},
        {"-0", -0.0},
        {"1.50", 1.5},
        {"1E3", 1000},
        {"9007199254740993", 9007199254740992},
        {"18446744073709551616", 18446744073709551616.0},
        {"-0.0", -0.0},
        {"1e-999", 0}};
    ASSERT_EQ(v.items.size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) {
        EXPECT_EQ(v.items[i].text, expected[i].first);
        EXPECT_EQ(v.items[i].number, expected[i].second) << expected[i].first;
        EXPECT_EQ(std::signbit(v.items[i].number), std::signbit(expected[i].second)) << expected[i].first;
    }
}

TEST(GraphJson, PlacesAreFirstCharacters) {
    const Value v =
        parse_json("// c\n{\n  /* , : { */ \"a\" : [ 1,\t-2.5 ] ,\"b\\\"\": \"x\"\n}\n", "dir/g.json");
    EXPECT_EQ(v.place.text(), "dir/g.json:2:1");
    EXPECT_EQ(v.members[0].key_place.text(), "dir/g.json:3:15");
    EXPECT_EQ(v.members[0].value.place.text(), "dir/g.json:3:21");
    EXPECT_EQ(v.members[0].value.items[0].place.text(), "dir/g.json:3:23");
    EXPECT_EQ(v.members[0].value.items[1].place.text(), "dir/g.json:3:26");
    EXPECT_EQ(v.members[1].key_place.text(), "dir/g.json:3:34");
    EXPECT_EQ(v.members[1].value.place.text(), "dir/g.json:3:41");
}

TEST(GraphJson, ColumnsCountCodePoints) {
    EXPECT_EQ(parse_json("[\"ü😀\", /* ü */ 1]", "g").items[1].place.text(), "g:1:16");
}

TEST(GraphJson, LinesEndAtLfCrLfAndCr) {
    EXPECT_EQ(parse_json("[\n\n1]", "g").items[0].place.text(), "g:3:1");
    EXPECT_EQ(parse_json("[\r\n\r\n1]", "g").items[0].place.text(), "g:3:1");
    EXPECT_EQ(parse_json("[\r\r1]", "g").items[0].place.text(), "g:3:1");
    EXPECT_EQ(parse_json("[// a\r1]", "g").items[0].place.text(), "g:2:1");
}

TEST(GraphJson, ToleratesAByteOrderMark) {
    EXPECT_EQ(parse_json("\xEF\xBB\xBF[1]", "g").items[0].place.text(), "g:1:2");
    EXPECT_EQ(error_of("\xEF\xBB\xBF\xEF\xBB\xBF[1]"),
              "g.json:1:1: error: expected a value, found '\xEF\xBB\xBF'");
}

TEST(GraphJson, AllowsNestingTo64) {
    const std::string deep = std::string(64, '[') + std::string(64, ']');
    EXPECT_EQ(error_of(deep), "no error");
    EXPECT_EQ(error_of("[" + deep + "]"), "g.json:1:65: error: this is nested deeper than 64 levels");
    EXPECT_EQ(error_of(std::string(10'000'000, '[')),
              "g.json:1:65: error: this is nested deeper than 64 levels");
    std::string objects;
    for (int i = 0; i < 65; ++i) objects += "{\"a\":";
    EXPECT_EQ(error_of(objects), "g.json:1:321: error: this is nested deeper than 64 levels");
}

TEST(GraphJson, RefusesAKeyGivenTwice) {
    EXPECT_EQ(error_of("{\n\"a\": {},\n\"sigma\": 1,\n  \"b\": {\"sigma\": 2},\n  \"sigma\": 2}"),
              "g.json:5:3: error: key 'sigma' is given twice; it was first given at line 3");
    EXPECT_EQ(error_of(R"({"a": 1, "\u0061": 1})"),
              "g.json:1:10: error: key 'a' is given twice; it was first given at line 1");
}

struct Case {
    std::string json, error;
};

// gtest's own printer shows bytes.
void PrintTo(const Case& c, std::ostream* out) { *out << c.json; }

class BadJson : public testing::TestWithParam<Case> {};

TEST_P(BadJson, IsExplained) { EXPECT_EQ(error_of(GetParam().json), "g.json:" + GetParam().error); }

INSTANTIATE_TEST_SUITE_P(
    Ends, BadJson,
    testing::Values(
        Case{"", "1:1: error: expected a value, found the end of the file"},
        Case{" // nothing\n", "2:1: error: expected a value, found the end of the file"},
        Case{"{\n\"a\": [1,",
             "2:9: error: expected a value, found the end of the file; the '[' at line 2 is not closed"},
        Case{"{\n\n",
             "3:1: error: expected a key in double quotes, found the end of the file; the '{' at line 1 is "
             "not closed"},
        Case{"{\"a\": 1",
             "1:8: error: expected ',' or '}' after a value, found the end of the file; the '{' at line 1 is "
             "not closed"},
        Case{"{\"a\"",
             "1:5: error: expected ':' after a key, found the end of the file; the '{' at line 1 is not "
             "closed"},
        Case{"{} {}", "1:4: error: expected nothing more, found '{'"},
        Case{"{}}", "1:3: error: expected nothing more, found '}'"},
        Case{"1 2", "1:3: error: expected nothing more, found '2'"}));

INSTANTIATE_TEST_SUITE_P(
    Commas, BadJson,
    testing::Values(
        Case{"{\"a\": 1\n \"in\": 2}", "2:2: error: expected ',' or '}' after a value, found '\"in\"'"},
        Case{"[1 2]", "1:4: error: expected ',' or ']' after a value, found '2'"},
        Case{"[1}", "1:3: error: expected ',' or ']' after a value, found '}'"},
        Case{"{\"a\": {}]", "1:9: error: expected ',' or '}' after a value, found ']'"},
        Case{"{\"a\": 1;}", "1:8: error: expected ',' or '}' after a value, found ';'"},
        Case{"{\"a\": 1 /*x*/ , // y\n }", "1:15: error: there is a ',' too many before the '}'"},
        Case{"[1, ]", "1:3: error: there is a ',' too many before the ']'"},
        Case{"[1,, 2]", "1:4: error: expected a value, found ','"},
        Case{"[,1]", "1:2: error: expected a value, found ','"},
        Case{"{\"a\": 1,, \"b\": 2}", "1:9: error: expected a key in double quotes, found ','"},
        Case{"{\"a\": 1 # x\n}",
             "1:9: error: expected ',' or '}' after a value, found '#'; comments are written as // or /* */"},
        Case{"[1] / 2", "1:5: error: expected nothing more, found '/'"},
        Case{"[1, /* x ]", "1:5: error: the comment is not closed; it ends with '*/'"}));

INSTANTIATE_TEST_SUITE_P(
    Keys, BadJson,
    testing::Values(
        Case{"{a: 1}", "1:2: error: the key 'a' stands without quotes; keys stand in double quotes"},
        Case{"{\"b\": 1, a-b: 1}",
             "1:10: error: the key 'a-b' stands without quotes; keys stand in double quotes"},
        Case{"{'a': 1}", "1:2: error: 'a' stands in single quotes; JSON's are double"},
        Case{"{\"a\" 1}", "1:6: error: expected ':' after a key, found '1'"},
        Case{"{\"a\", 1}", "1:5: error: expected ':' after a key, found ','"},
        Case{"{\"a\":: 1}", "1:6: error: expected a value, found ':'"},
        Case{"{\"a\": }", "1:7: error: expected a value, found '}'"},
        Case{"{1: 2}", "1:2: error: expected a key in double quotes, found '1'"},
        Case{"{ü: 2}", "1:2: error: expected a key in double quotes, found 'ü'"},
        Case{"{null: 2}", "1:2: error: the key 'null' stands without quotes; keys stand in double quotes"}));

INSTANTIATE_TEST_SUITE_P(
    Strings, BadJson,
    testing::Values(
        Case{"[\"abc", "1:2: error: the string '\"abc' is not closed; a string ends on its line, with '\"'"},
        Case{"[\"abc\n\"]",
             "1:2: error: the string '\"abc' is not closed; a string ends on its line, with '\"'"},
        Case{"[\"abc\\",
             "1:2: error: the string '\"abc\\' is not closed; a string ends on its line, with '\"'"},
        Case{"{\"abc\r\n: 1}",
             "1:2: error: the string '\"abc' is not closed; a string ends on its line, with '\"'"},
        Case{"[\"a\tb\"]", "1:4: error: a string holds the control character U+0009; write it as '\\t'"},
        Case{"[\"ü\x1b\"]", "1:4: error: a string holds the control character U+001B; write it as '\\u001b'"},
        Case{"[\"C:\\plates\"]", "1:5: error: '\\p' is no escape; a backslash itself is written as '\\\\'"},
        Case{"[\"\\ü\"]", "1:3: error: '\\ü' is no escape; a backslash itself is written as '\\\\'"},
        Case{"[\"\\u12\"]",
             "1:3: error: '\\u12' stands for no character; '\\u' takes four hexadecimal digits, and "
             "surrogates come in pairs"},
        Case{"[\"\\u+123\"]",
             "1:3: error: '\\u+123' stands for no character; '\\u' takes four hexadecimal digits, and "
             "surrogates come in pairs"},
        Case{"[\"a\\ud83dx\"]",
             "1:4: error: '\\ud83d' stands for no character; '\\u' takes four hexadecimal digits, and "
             "surrogates come in pairs"},
        Case{"{\"\\ude00\": 1}",
             "1:3: error: '\\ude00' stands for no character; '\\u' takes four hexadecimal digits, and "
             "surrogates come in pairs"},
        Case{"['abc']", "1:2: error: 'abc' stands in single quotes; JSON's are double"},
        Case{"['abc\n']", "1:2: error: 'abc' stands in single quotes; JSON's are double"}));

INSTANTIATE_TEST_SUITE_P(
    Words, BadJson,
    testing::Values(
        Case{"[NaN]", "1:2: error: 'NaN' is not a JSON number; a number is finite"},
        Case{"{\"a\": Infinity}", "1:7: error: 'Infinity' is not a JSON number; a number is finite"},
        Case{"[-Infinity]",
             "1:2: error: '-Infinity' is not a JSON number; numbers are written as 12, -0.5 or 1e-3"},
        Case{"[1, 1e999]", "1:5: error: '1e999' is beyond the range of numbers"},
        Case{"[-1e999]", "1:2: error: '-1e999' is beyond the range of numbers"},
        Case{"[01]", "1:2: error: '01' is not a JSON number; numbers are written as 12, -0.5 or 1e-3"},
        Case{"[.5]", "1:2: error: '.5' is not a JSON number; numbers are written as 12, -0.5 or 1e-3"},
        Case{"[5.]", "1:2: error: '5.' is not a JSON number; numbers are written as 12, -0.5 or 1e-3"},
        Case{"[+5]", "1:2: error: '+5' is not a JSON number; numbers are written as 12, -0.5 or 1e-3"},
        Case{"[1, 5px]", "1:5: error: '5px' is not a JSON number; numbers are written as 12, -0.5 or 1e-3"},
        Case{"{\"a\": 0x10}",
             "1:7: error: '0x10' is not a JSON number; numbers are written as 12, -0.5 or 1e-3"},
        Case{"[True]", "1:2: error: 'True' is not a JSON value; did you mean 'true'?"},
        Case{"[nulls]", "1:2: error: 'nulls' is not a JSON value; did you mean 'null'?"},
        Case{"[tru]", "1:2: error: 'tru' is not a JSON value; did you mean 'true'?"},
        Case{"{\"type\": read}", "1:10: error: 'read' is not a JSON value; strings stand in double quotes"}));

INSTANTIATE_TEST_SUITE_P(
    Encoding, BadJson,
    testing::Values(
        Case{"[\n\"\xE9\"]", "2:2: error: the byte 0xe9 is not UTF-8; save the file as UTF-8 text"},
        Case{"// \xE9\n[]", "1:4: error: the byte 0xe9 is not UTF-8; save the file as UTF-8 text"},
        Case{"\xFF\xFE[", "1:1: error: the byte 0xff is not UTF-8; save the file as UTF-8 text"},
        Case{"\"\xC0\x80\"", "1:2: error: the byte 0xc0 is not UTF-8; save the file as UTF-8 text"},
        Case{"\"\xED\xA0\x80\"", "1:2: error: the byte 0xed is not UTF-8; save the file as UTF-8 text"},
        Case{"\"\xF4\x90\x80\x80\"", "1:2: error: the byte 0xf4 is not UTF-8; save the file as UTF-8 text"},
        Case{"\"\xE2\x82", "1:2: error: the byte 0xe2 is not UTF-8; save the file as UTF-8 text"},
        // The parser alone would take a NUL for the end.
        Case{std::string("[]\0]", 4),
             "1:3: error: a NUL byte; this is no text; 'keyline info' tells what is in an image"}));

TEST(OptionValue, IsJsonWhereItIsJson) {
    const std::string option = "--set a.b=x";
    EXPECT_EQ(parse_option_value("-3", option).number, -3);
    EXPECT_EQ(parse_option_value("true", option).kind, Value::Kind::kBool);
    EXPECT_EQ(parse_option_value("null", option).kind, Value::Kind::kNull);
    EXPECT_EQ(parse_option_value("\"007\"", option).text, "007");
    EXPECT_EQ(parse_option_value("\"\"", option).text, "");
    EXPECT_EQ(parse_option_value("[1, 2]", option).items.size(), 2U);
    for (const std::string text :
         {"007", "abc", "", " ", "[1,", "/*x*/ 1", "C:\\x", "render:Normal", "NaN", "\xE9"}) {
        const Value v = parse_option_value(text, option);
        EXPECT_EQ(v.kind, Value::Kind::kString) << text;
        EXPECT_EQ(v.text, text);
    }
}

TEST(OptionValue, KeepsWhatWasTyped) {
    for (const std::string text : {"7.50", "true", "null", "[1, 2]", "{ \"a\": 1 }"})
        EXPECT_EQ(parse_option_value(text, "--var x").text, text);
}

TEST(OptionValue, PlacesAreTheOption) {
    const Value v = parse_option_value("{\"a\":\n[1]}", "--set a.b=…");
    EXPECT_EQ(v.place.text(), "--set a.b=…");
    EXPECT_EQ(v.members[0].key_place.text(), "--set a.b=…");
    EXPECT_EQ(v.members[0].value.items[0].place.text(), "--set a.b=…");
}

TEST(OptionValue, RefusesJsonThatCantBeTaken) {
    const auto error = [](const std::string& text) -> std::string {
        try {
            parse_option_value(text, "--set a.b=…");
        } catch (const Failure& f) {
            return f.what();
        }
        return "no error";
    };
    EXPECT_EQ(error("1e999"), "--set a.b=…: error: '1e999' is beyond the range of numbers");
    EXPECT_EQ(error("{\"x\":1,\"x\":2}"), "--set a.b=…: error: key 'x' is given twice");
    EXPECT_EQ(error(std::string(65, '[') + std::string(65, ']')),
              "--set a.b=…: error: this is nested deeper than 64 levels");
}

}  // namespace
}  // namespace keyline
