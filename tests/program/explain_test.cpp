// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/common/explanations.h"
#include "engine/base/error.h"
#include "tests/program/program.h"

#include <algorithm>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <set>

// keyline explain: each code is explained, and each example says what it is an example of.

namespace keyline::test {

namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

class Explain : public ProgramTest {
protected:
    Explain() { fs::copy(plates() / "street.0001.exr", folder() / "render.exr"); }
};

TEST_F(Explain, EachCodeIsExplainedOnce) {
    std::set<std::string_view> explained;
    for (const cli::Explanation& e : cli::explanations())
        EXPECT_TRUE(explained.insert(e.code).second) << e.code;
    for (const Code code : all_codes()) EXPECT_TRUE(explained.contains(code_name(code))) << code_name(code);
    for (const ErrorKind kind : {ErrorKind::kGraph, ErrorKind::kInput, ErrorKind::kOutput, ErrorKind::kFailed,
                                 ErrorKind::kInternal, ErrorKind::kCancelled})
        EXPECT_TRUE(explained.contains(kind_name(kind))) << kind_name(kind);
    for (int p = 1; p <= static_cast<int>(Passing::kMemory); ++p) {
        Error e;
        e.passing = static_cast<Passing>(p);
        EXPECT_TRUE(explained.contains(reason_of(e))) << reason_of(e);
    }
}

TEST_F(Explain, EachExampleIsToldByItsCodeAndNoOther) {
    for (const cli::Explanation& e : cli::explanations()) {
        if (e.example.empty()) continue;
        write("graph.json", e.example);
        std::vector<std::string> arguments{"check", "graph.json", "--json"};
        if (!e.option.empty()) arguments.emplace_back(e.option);
        const Outcome run = keyline(arguments);
        std::set<std::string> codes;
        const auto checked = nlohmann::json::parse(run.out);
        for (const auto& message : checked[0]["messages"]) codes.insert(message["code"].get<std::string>());
        EXPECT_EQ(codes, std::set<std::string>{std::string(e.code)}) << run.out;
    }
}

TEST_F(Explain, PrintsOneOrAll) {
    const Outcome one = keyline({"explain", "unknown-key"});
    EXPECT_EQ(one.status, 0);
    EXPECT_THAT(one.out, StartsWith("unknown-key: A key that nobody knows\n\nA node, the graph"));
    EXPECT_THAT(one.out, HasSubstr("'keyline check graph.json' says so"));
    EXPECT_THAT(one.out, HasSubstr("\"sgima\""));
    EXPECT_THAT(keyline({"explain"}).out, HasSubstr("\nlinear-in-file      Scene-linear colour in a file"));
    const Outcome unknown = keyline({"explain", "unknown-kye"});
    EXPECT_EQ(unknown.status, 2);
    EXPECT_EQ(unknown.err, "error: no message has the code 'unknown-kye'; did you mean 'unknown-key'?\n");
}

TEST_F(Explain, TheManualsMessagesAreTheProgramsOwn) {
    EXPECT_EQ(keyline({"explain", "--markdown"}).out, read(fs::path(KEYLINE_DOCS) / "messages.md"))
        << "write it anew with: keyline explain --markdown > docs/messages.md";
}

}  // namespace

}  // namespace keyline::test
