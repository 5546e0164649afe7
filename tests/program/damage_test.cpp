// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/program/program.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

// Outputs that lost a part of themselves: found by decoding, whatever the format, and made again.

namespace keyline::test {

namespace {

struct Loss {
    const char* name;
    std::string (*of)(const std::string& whole);
};

const std::vector<Loss> kLosses = {
    {"a tenth is left", [](const std::string& s) { return s.substr(0, s.size() / 10); }},
    {"half is left", [](const std::string& s) { return s.substr(0, s.size() / 2); }},
    {"a hundredth is gone", [](const std::string& s) { return s.substr(0, s.size() * 99 / 100); }},
    {"half is zeros",
     [](const std::string& s) {
         return s.substr(0, s.size() / 2) + std::string(s.size() - s.size() / 2, '\0');
     }},
    {"one byte is another",
     [](const std::string& s) {
         std::string out = s;
         out[s.size() * 3 / 5] = static_cast<char>(out[s.size() * 3 / 5] ^ 0x55);
         return out;
     }},
};

class Damage : public ProgramTest, public testing::WithParamInterface<const char*> {};

TEST_P(Damage, IsFoundAndMadeAgain) {
    graph(fmt::format(R"("r":   {{ "type": "read", "file": "{}" }},
                         "out": {{ "type": "write", "in": "r:Combined", "channels": ["R", "G", "B"],
                                   "file": "out.#.{}" }})",
                      (plates() / "street.0001.exr").string(), GetParam()));
    const auto frames = fmt::format("1-{}", kLosses.size());
    ASSERT_EQ(keyline({"render", "graph.json", "--frames", frames}).status, 0);
    const auto file = [&](std::size_t frame) { return fmt::format("out.{}.{}", frame, GetParam()); };
    const std::string whole = read(folder() / file(1));
    for (std::size_t i = 0; i < kLosses.size(); ++i) write(file(i + 1), kLosses[i].of(whole));
    const Outcome found = keyline({"verify", "graph.json", "--frames", frames});
    EXPECT_EQ(found.status, 1);
    for (std::size_t i = 0; i < kLosses.size(); ++i)
        EXPECT_EQ(found.out.find(file(i + 1) + ": current"), std::string::npos)
            << kLosses[i].name << found.out;
    ASSERT_EQ(keyline({"render", "graph.json", "--frames", frames, "--stale"}).status, 0);
    EXPECT_EQ(keyline({"verify", "graph.json", "--frames", frames}).status, 0);
}

INSTANTIATE_TEST_SUITE_P(Formats, Damage, testing::Values("exr", "png", "tif", "jpg"),
                         [](const auto& test) { return std::string(test.param); });

}  // namespace

}  // namespace keyline::test
