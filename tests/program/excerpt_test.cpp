// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/program/program.h"

#include <gmock/gmock.h>

// What messages look like on a terminal, and that they are one line everywhere else.

namespace keyline::test {

namespace {

using testing::HasSubstr;
using testing::Not;

class Excerpts : public ProgramTest {
protected:
    // What `check` says of the text to a terminal, without the returns that it puts before line feeds.
    std::string told(const std::string& text, std::vector<std::string> environment = {"TERM=dumb"}) const {
        write("g.json", text);
        std::string out =
            keyline({"check", "g.json"}, {.environment = std::move(environment), .through = KEYLINE_TERMINAL})
                .err;
        std::erase(out, '\r');
        return out;
    }
};

constexpr const char* kWrong = R"({
  "keyline": 1,
  "nodes": {
    "c": { "type": "constant", "colour": "#000000", "size": [4, -4] },
    "out": { "type": "write", "in": "c", "file": "out.exr" }
  }
})";

TEST_F(Excerpts, ShowTheLineAndWhatIsWrongInIt) {
    EXPECT_EQ(
        told(kWrong),
        R"(g.json:4:32: error: node 'c' (constant): unknown key 'colour'; did you mean 'color'? [unknown-key]
 4 |     "c": { "type": "constant", "colour": "#000000", "size": [4, -4] },
   |                                ^~~~~~~~
g.json:4:65: error: node 'c' (constant): 'size' is -4; it must be from 1 to 1048576 pixels [wrong-value]
 4 |     "c": { "type": "constant", "colour": "#000000", "size": [4, -4] },
   |                                                                 ^~
)");
}

TEST_F(Excerpts, HaveColoursWhereTheTerminalHas) {
    const std::string told_in_colour = told(kWrong, {"TERM=xterm", "NO_COLOR="});
    EXPECT_THAT(told_in_colour, HasSubstr("g.json:4:32: \x1b[1;31merror:\x1b[0m node 'c'"));
    EXPECT_THAT(told_in_colour, HasSubstr("\x1b[1;31m^~~~~~~~\x1b[0m\n"));
    EXPECT_THAT(told(kWrong, {"TERM=xterm", "NO_COLOR=1"}), Not(HasSubstr("\x1b")));
}

TEST_F(Excerpts, AreOfFilesAndTerminalsOnly) {
    write("g.json", kWrong);
    EXPECT_THAT(keyline({"check", "g.json"}).err, Not(HasSubstr(" | ")));
    const Outcome of_option = keyline({"check", "g.json", "--set", "c.size=0"},
                                      {.environment = {"TERM=dumb"}, .through = KEYLINE_TERMINAL});
    EXPECT_THAT(of_option.err, HasSubstr("--set c.size=0: error: "));
}

TEST_F(Excerpts, OfLongLinesAreCutAndOfControlCharactersEscaped) {
    const std::string blanks(120, ' ');
    EXPECT_THAT(told("{ \"keyline\": 1, \"nodes\": {\t" + blanks + "\"a b\": 1" + blanks + "} }"),
                HasSubstr("\n 1 | …" + blanks.substr(0, 90) + "\"a b\": 1" + blanks.substr(0, 37) +
                          "…\n   | " + " " + blanks.substr(0, 90) + "^~~~~\n"));
    EXPECT_THAT(told("{ \"keyline\":\t2 }"),
                HasSubstr("\n 1 | { \"keyline\":\\t2 }\n   |               ^\n"));
}

}  // namespace

}  // namespace keyline::test
