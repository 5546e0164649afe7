// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/base/text.h"

#include "engine/base/error.h"

#include <gtest/gtest.h>

namespace keyline {
namespace {

TEST(Escaped, LeavesTextAsItIs) {
    EXPECT_EQ(escaped("ViewLayer.Combined.R, 24 × 36 …, café, 日本, 🙂, \"a\\b\""),
              "ViewLayer.Combined.R, 24 × 36 …, café, 日本, 🙂, \"a\\b\"");
}

TEST(Escaped, WhatATerminalWouldObey) {
    EXPECT_EQ(escaped("a\x1b[31m\r\n\tb\x7f"), "a\\x1b[31m\\x0d\\n\\tb\\x7f");
    EXPECT_EQ(escaped("\xc2\x9b"
                      "31m"),  // the same as "\x1b[", in one character
              "\\u009b31m");
    EXPECT_EQ(escaped(std::string_view("a\0b", 3)), "a\\x00b");
    EXPECT_EQ(escaped("gnp.\u202etxt\u2028\u2066\u200f"), "gnp.\\u202etxt\\u2028\\u2066\\u200f");
}

TEST(Escaped, BytesThatAreNoText) {
    EXPECT_EQ(escaped("caf\xe9 \xff\xfe"), "caf\\xe9 \\xff\\xfe");
    EXPECT_EQ(escaped("\xc0\x80\xed\xa0\x80\xf4\x90\x80\x80"),
              "\\xc0\\x80\\xed\\xa0\\x80\\xf4\\x90\\x80\\x80");
    EXPECT_EQ(escaped("\xe6\x97"), "\\xe6\\x97");
}

TEST(Escaped, ForJson) {
    EXPECT_EQ(escaped("\"\\\n\x01\x7f\xc2\x9b\xe9", Escapes::kJson),
              "\\\"\\\\\\n\\u0001\\u007f\\u009b\xef\xbf\xbd");
}

// Names and libraries' texts come into errors without quotes too.
TEST(ForXml, HoldsNothingThatXmlWouldReadAsItsOwn) {
    EXPECT_EQ(for_xml("a < b & \"c\" > \x01é"), "a &lt; b &amp; &quot;c&quot; &gt; \\x01é");
}

TEST(Escaped, AnErrorIsOneLineOfText) {
    const Error e{ErrorKind::kInput, {"g\x1b.json", 1, 2}, "node 'a'", "a\nb\xe9.png: bad\x9b", "do\rso"};
    EXPECT_EQ(e.text(), "g\\x1b.json:1:2: error: node 'a': a\\nb\\xe9.png: bad\\x9b; do\\x0dso");
    EXPECT_EQ(e.warning_text(), "g\\x1b.json:1:2: warning: node 'a': a\\nb\\xe9.png: bad\\x9b; do\\x0dso");
}

TEST(Escaped, AQuoteCountsCharactersOfTheText) {
    EXPECT_EQ(in_quotes(std::string(60, '\xe9')).size(), 2 + 60 * 4U);
    EXPECT_EQ(in_quotes(std::string(61, '\xe9')).size(), 2 + 60 * 4 + std::string("…").size());
}

}  // namespace
}  // namespace keyline
