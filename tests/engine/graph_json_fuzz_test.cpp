// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/json/json_reader.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <random>
#include <string>
#include <vector>

namespace keyline {
namespace {

const std::string kGraph = R"({
  "keyline": 1, // the version
  "about": "Ink lines \u00fc\ud83d\ude00 \\ over ü the \"beauty\" pass",
  "variables": { "sigma": 1.4, "shot": "plates/street", "on": true, "off": false, "none": null },
  "nodes": {
    "render": { "type": "read", "file": "${shot}.####.exr" },
    "y":      { "type": "ycolor", "in": "render:Combined" }, /* grey */
    "smooth": { "type": "gaussian", "in": "y", "sigma": [-1.5e-3, 20E2, 0] },
    "out":    { "type": "write", "in": "smooth", "file": "out/toon.####.exr", "layers": {} }
  }
})";

// What a slip of the hand, an editor or a broken disk makes of a file.
std::string mutated(std::string text, std::mt19937& random) {
    static const std::vector<std::string> pieces{
        "{",   "}",        "[",    "]",    ",",  ":",  "\"", "'", "\\",       "\\u",    "\\ud83d",  "//",
        "/*",  "*/",       "\n",   "\r\n", "\r", "\t", "-",  "0", "1e999",    ".",      "nul",      "true",
        "NaN", "\xEF\xBB", "\xC3", "\x1b", "ü",  "#",  "a",  "e", "\"a\":1,", "[[[[[[", "\"type\":"};
    const auto below = [&random](std::size_t n) { return random() % std::max<std::size_t>(n, 1); };
    for (std::size_t n = 1 + below(3); n > 0; --n) {
        const std::size_t at = below(text.size());
        switch (below(4)) {
            case 0: text.erase(at, 1 + below(4)); break;
            case 1: text.insert(at, pieces[below(pieces.size())]); break;
            case 2: text.replace(at, 1, 1, static_cast<char>(below(256))); break;
            default: text.resize(below(8) == 0 ? at : text.size()); break;
        }
    }
    return text;
}

// The bytes of the text that stand at a place, found by counting as an editor would.
std::string_view at_place(std::string_view text, const Place& place) {
    std::size_t i = text.starts_with("\xEF\xBB\xBF") ? 3 : 0;
    for (int line = 1; line < place.line; ++line) {
        i = std::min(text.find_first_of("\r\n", i), text.size());
        i += text.substr(i, 2) == "\r\n" ? 2 : 1;
    }
    for (int column = 1; column < place.column && i < text.size(); ++column) do
            ++i;
        while (i < text.size() && (static_cast<unsigned char>(text[i]) & 0xC0U) == 0x80U);
    return i <= text.size() ? text.substr(i) : "beyond the end";
}

bool starts_as(const Value& value, std::string_view text) {
    switch (value.kind) {
        case Value::Kind::kNull: return text.starts_with("null");
        case Value::Kind::kBool: return text.starts_with(value.boolean ? "true" : "false");
        case Value::Kind::kNumber: return text.starts_with(value.text);
        case Value::Kind::kString: return text.starts_with('"');
        case Value::Kind::kArray: return text.starts_with('[');
        case Value::Kind::kObject: return text.starts_with('{');
    }
    return false;
}

void expect_places(const Value& value, std::string_view text) {
    EXPECT_TRUE(starts_as(value, at_place(text, value.place))) << value.place.text();
    for (const Value& item : value.items) expect_places(item, text);
    for (const Member& member : value.members) {
        EXPECT_TRUE(at_place(text, member.key_place).starts_with('"')) << member.key_place.text();
        expect_places(member.value, text);
    }
}

void expect_sound(const Error& error, std::string_view text) {
    EXPECT_EQ(error.kind, ErrorKind::kGraph);
    EXPECT_TRUE(error.place.line >= 1 && error.place.column >= 1);
    EXPECT_NE(at_place(text, error.place), "beyond the end");
    EXPECT_FALSE(error.what.empty());
    EXPECT_LT(error.what.size(), 400U);
    // An explanation that names what would have been right there is none.
    EXPECT_FALSE(error.what.starts_with("expected a value, found '\""));
    EXPECT_FALSE(error.what == "expected nothing more, found the end of the file");
    for (const std::string word : {"true", "false", "null"})
        EXPECT_NE(error.what, "'" + word + "' is not a JSON value");
}

TEST(GraphJsonFuzz, EveryMutantIsAValueWithPlacesOrAFailureWithOne) {
    std::mt19937 random(7);
    int good = 0, bad = 0;
    for (int i = 0; i < 20000 && !HasFailure(); ++i) {
        const std::string text = mutated(kGraph, random);
        SCOPED_TRACE(text);
        try {
            expect_places(parse_json(text, "g.json"), text);
            ++good;
        } catch (const Failure& f) {
            SCOPED_TRACE(f.what());
            expect_sound(f.error(), text);
            ++bad;
        }
    }
    EXPECT_GT(good, 1000);
    EXPECT_GT(bad, 1000);
}

}  // namespace
}  // namespace keyline
