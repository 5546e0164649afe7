// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/params/frames.h"

#include "engine/base/error.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace keyline {
namespace {

using Frames = std::vector<int>;

TEST(Frames, AreParsed) {
    const std::vector<std::pair<std::string, Frames>> cases{
        {"7", {7}},
        {"1-4", {1, 2, 3, 4}},
        {"1-10x3", {1, 4, 7, 10}},
        {"1-9x3", {1, 4, 7}},
        {"5-5", {5}},
        {"-5", {-5}},
        {"-2-2", {-2, -1, 0, 1, 2}},
        {"-10--8", {-10, -9, -8}},
        {"-10--8x2", {-10, -8}},
        {"0001-0003", {1, 2, 3}},
        {"7,1-3,9", {7, 1, 2, 3, 9}},
        {"1-4, 7", {1, 2, 3, 4, 7}},
        {" 3 , 2 ", {3, 2}},
        {"1 - 4", {1, 2, 3, 4}},
        {"1-10:3", {1, 4, 7, 10}},
        {" 1 -\t10 : 3 ", {1, 4, 7, 10}},
        {"-2 - -1", {-2, -1}},
        {"4-1", {4, 3, 2, 1}},
        {"10-1x3", {10, 7, 4, 1}},
        {"-8--10", {-8, -9, -10}},
        {"3-1,1-5", {3, 2, 1, 4, 5}},
        {"3,1-4,3", {3, 1, 2, 4}},
        {"2147483646-2147483647", {2147483646, 2147483647}}};
    for (const auto& [spec, frames] : cases) EXPECT_EQ(parse_frames(spec), frames) << spec;
}

TEST(Frames, MayBeFarApart) {
    EXPECT_EQ(parse_frames("-2147483648-2147483647x2147483647"), (Frames{-2147483648, -1, 2147483646}));
    EXPECT_EQ(parse_frames("1-1000000").size(), 1'000'000U);
}

TEST(Frames, FaultsQuoteTheSpec) {
    const auto fault = [](const std::string& spec) -> std::string {
        try {
            parse_frames(spec);
        } catch (const Failure& f) {
            EXPECT_EQ(f.error().kind, ErrorKind::kGraph);
            return f.what();
        }
        return "no failure";
    };
    EXPECT_EQ(fault("9-3:0"), "error: frames '9-3:0': the step of '9-3:0' is 0; the least is 1");
    EXPECT_EQ(fault("1-4x0"), "error: frames '1-4x0': the step of '1-4x0' is 0; the least is 1");
    EXPECT_EQ(fault("1-4x-1"), "error: frames '1-4x-1': the step of '1-4x-1' is -1; the least is 1");
    const std::vector<std::pair<std::string, std::string>> parts{{"", ""},
                                                                 {"1,", ""},
                                                                 {",1", ""},
                                                                 {"1,,2", ""},
                                                                 {"1-", "1-"},
                                                                 {"-", "-"},
                                                                 {"a", "a"},
                                                                 {"1-b", "1-b"},
                                                                 {"1x2", "1x2"},
                                                                 {"1-4x", "1-4x"},
                                                                 {"1-4x2x", "1-4x2x"},
                                                                 {"1-4-6", "1-4-6"},
                                                                 {"1 4", "1 4"},
                                                                 {"1-4x:2", "1-4x:2"},
                                                                 {"+1", "+1"},
                                                                 {"1.5", "1.5"},
                                                                 {"1:4", "1:4"},
                                                                 {"2147483648", "2147483648"},
                                                                 {"1-99999999999", "1-99999999999"}};
    for (const auto& [spec, part] : parts)
        EXPECT_EQ(
            fault(spec),
            fmt::format(
                "error: frames '{}': '{}' is no frame or range; write A, A-B or A-BxS, joined by commas",
                spec, part));
    EXPECT_EQ(fault("1-1000001"), "error: frames '1-1000001': more than 1000000 frames");
    EXPECT_EQ(fault("1-600000,1-600000"), "error: frames '1-600000,1-600000': more than 1000000 frames");
    EXPECT_EQ(fault("-2147483648-2147483647"),
              "error: frames '-2147483648-2147483647': more than 1000000 frames");
}

TEST(Frames, AreFormattedBriefly) {
    const std::vector<std::pair<Frames, std::string>> cases{
        {{}, ""},
        {{7}, "7"},
        {{1, 2}, "1, 2"},
        {{1, 2, 3, 4, 7}, "1-4, 7"},
        {{1, 3, 5, 6, 7}, "1-5x2, 6, 7"},
        {{1, 3, 4, 5}, "1, 3-5"},
        {{3, 2, 1}, "3-1"},
        {{9, 6, 3, 0, 1}, "9-0x3, 1"},
        {{2147483647, 0, -2147483647}, "2147483647--2147483647x2147483647"},
        {{-3, -2, -1}, "-3--1"},
        {{5, 5, 5}, "5, 5, 5"},
        {{-2147483647, 0, 2147483647}, "-2147483647-2147483647x2147483647"}};
    for (const auto& [frames, spec] : cases) EXPECT_EQ(format_frames(frames), spec);
}

TEST(Frames, AreParsedAsFormatted) {
    const std::vector<Frames> cases{{1, 3, 5, 6, 7}, {1, 3, 4, 5},    {3, 2, 1},
                                    {9, 6, 3, 0, 1}, {-3, -2, -1, 9}, {-2147483647, 0, 2147483647}};
    for (const Frames& frames : cases) EXPECT_EQ(parse_frames(format_frames(frames)), frames);
}

}  // namespace
}  // namespace keyline
