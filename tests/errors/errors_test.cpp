// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/program/program.h"

#include <algorithm>
#include <fmt/format.h>
#include <fstream>
#include <sstream>

// Graphs that must fail, each with the text of its failure to the letter.

namespace keyline::test {

namespace {

std::vector<std::string> case_names() {
    std::vector<std::string> out;
    for (const auto& entry : fs::directory_iterator(KEYLINE_ERROR_CASES))
        if (entry.path().extension() == ".json") out.push_back(entry.path().stem().string());
    std::ranges::sort(out);
    return out;
}

std::string text_of(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
}

class Errors : public testing::TestWithParam<std::string> {};

TEST_P(Errors, AreToldAsExpected) {
    const fs::path folder = KEYLINE_ERROR_CASES;
    std::vector<std::string> arguments{"check", GetParam() + ".json"};
    std::ifstream more(folder / (GetParam() + ".args"));
    for (std::string line; std::getline(more, line);) arguments.push_back(line);
    const Outcome run = Process(arguments, {.folder = folder}).wait();
    EXPECT_EQ(fmt::format("exit {}\n{}", run.status, run.err), text_of(folder / (GetParam() + ".expected")));
}

INSTANTIATE_TEST_SUITE_P(Cases, Errors, testing::ValuesIn(case_names()),
                         [](const auto& one) { return one.param; });

}  // namespace

}  // namespace keyline::test
