// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/base/sanitized.h"
#include "tests/program/program.h"

#include <fmt/format.h>
#include <string>
#include <utility>

// What `plan` says of memory against what the kernel counts.

namespace keyline::test {

namespace {

constexpr bool kCounted = !kIsSanitized;  // a sanitizer's own memory is beyond any estimate

class MemoryOfTheProgram : public ProgramTest {
protected:
    // Mebibytes, from "frame 1: 3 sweeps on 2 threads, 61M of memory".
    std::size_t estimate(const std::vector<std::string>& options) const {
        std::vector<std::string> arguments{"plan", "graph.json", "--threads", "2"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        const Outcome run = keyline(arguments);
        const auto end = run.out.find("M of memory");
        if (end == std::string::npos) return 0;
        const auto begin = run.out.rfind(' ', end) + 1;
        return std::stoul(run.out.substr(begin, end - begin));
    }

    // Of a graph that reads a picture of 3840 × 2160 with four channels of 8 bits, which it makes before.
    std::size_t estimate_of_reading(const char* file) const {
        graph(
            fmt::format(R"("in": {{ "type": "constant", "color": [0.2, 0.4, 0.6, 1], "size": [3840, 2160] }},
                             "out": {{ "type": "write", "in": "in", "file": "{}", "depth": "uint8" }})",
                        file));
        EXPECT_EQ(keyline({"render", "graph.json"}).status, 0);
        graph(fmt::format(R"("in": {{ "type": "read", "file": "{}" }},
                             "out": {{ "type": "write", "in": "in", "file": "out.exr" }})",
                          file));
        return estimate({});
    }

    std::size_t peak(const std::vector<std::string>& options) const {
        std::vector<std::string> arguments{"render", "graph.json", "--threads", "2"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        const Outcome run = keyline(arguments, {.through = KEYLINE_COUNTED});
        EXPECT_EQ(run.status, 0) << run.err;
        return std::stoul(run.out.substr(run.out.rfind('\n', run.out.size() - 2) + 1)) >> 20;
    }

    // Never below the peak, and not more than a tenth and a little above it.
    void expect_close(const std::vector<std::string>& options, const std::string& what) const {
        const std::size_t said = estimate(options), counted = peak(options);
        EXPECT_GE(said, counted) << what;
        EXPECT_LE(said, counted + counted / 10 + 12) << what;
    }

    void make_plate(int width, int height) const {
        graph(fmt::format(R"("in": {{ "type": "constant", "color": [0.2, 0.5, 0.7], "size": [{}, {}] }},
                             "out": {{ "type": "write", "in": "in", "file": "plate.exr", "depth": "float" }})",
                          width, height));
        ASSERT_EQ(keyline({"render", "graph.json"}).status, 0);
    }
};

// The whole picture is kept from the sweep that finds the largest value to the one that needs it.
TEST_F(MemoryOfTheProgram, IsEstimatedAtTwoSizes) {
    if (!kCounted) GTEST_SKIP();
    for (const auto& [width, height] : {std::pair{960, 540}, std::pair{1920, 1080}}) {
        make_plate(width, height);
        graph(R"("in": { "type": "read", "file": "plate.exr" },
                 "edges": { "type": "hysteresis", "in": "in:R", "low": 0.1, "high": 0.9, "units": "max" },
                 "ink": { "type": "ink", "in": "edges" },
                 "comp": { "type": "over", "fg": "ink", "bg": "in" },
                 "out": { "type": "write", "in": "comp", "file": "out.exr" })");
        expect_close({}, fmt::format("{} × {}", width, height));
    }
}

// Two frames more than the one that is made lie in memory, and each file is decoded once.
TEST_F(MemoryOfTheProgram, WhatFramesLeaveForLaterOnesCounts) {
    if (!kCounted) GTEST_SKIP();
    make_plate(1920, 1080);
    for (int f = 0; f <= 5; ++f)
        fs::copy_file(folder() / "plate.exr", folder() / fmt::format("in.{:04}.exr", f));
    graph(R"("before": { "type": "read", "file": "in.####.exr", "frame": "-1" },
             "now": { "type": "read", "file": "in.####.exr" },
             "after": { "type": "read", "file": "in.####.exr", "frame": "+1" },
             "two": { "type": "math", "in": "before", "op": "add", "b": "now" },
             "three": { "type": "math", "in": "two", "op": "add", "b": "after" },
             "out": { "type": "write", "in": "three", "file": "out.####.exr" })");
    const std::size_t alone = estimate({"--frames", "3"}), first = estimate({"--frames", "1-4"});
    EXPECT_GE(first, alone + 48) << "two pictures of floats in four channels, or parts of them";
    const std::string limit = fmt::format("{}M", first);
    const std::size_t carrying = peak({"--frames", "1-4", "--memory", limit});
    EXPECT_LE(carrying, first);
    EXPECT_GE(carrying + carrying / 5, first) << "it is carried";
    EXPECT_LE(peak({"--frames", "1-4", "--memory", fmt::format("{}M", alone)}), alone);
}

// DWA is packed by helper processes, one a thread: they belong to what --memory limits.
TEST_F(MemoryOfTheProgram, HelperProcessesCount) {
    make_plate(960, 540);
    const auto with = [&](const char* compression) {
        graph(fmt::format(R"("in": {{ "type": "read", "file": "plate.exr" }},
                             "out": {{ "type": "write", "in": "in", "file": "out.exr", "compression": "{}" }})",
                          compression));
        return estimate({});
    };
    const std::size_t zip = with("zip"), dwaa = with("dwaa"), dwab = with("dwab");
    EXPECT_GE(dwaa, zip + 2 * std::size_t{10});
    EXPECT_GT(dwab, dwaa);
}

// Where a picture can only be decoded from the top, what threads have passed is kept for those that come for
// it.
TEST_F(MemoryOfTheProgram, WhatAReaderKeepsCounts) {
    // Strips of a TIFF are read in any order.
    EXPECT_GE(estimate_of_reading("plate.png"), estimate_of_reading("plate.tif") + 30);
}

// Some libraries hold the whole picture until it is finished.
TEST_F(MemoryOfTheProgram, WholeFramesOfOtherFormatsCount) {
    make_plate(1920, 1080);
    const auto with = [&](const char* file) {
        graph(fmt::format(R"("in": {{ "type": "read", "file": "plate.exr" }},
                             "out": {{ "type": "write", "in": "in", "file": "{}", "channels": ["R", "G", "B"],
                                       "depth": "uint8" }})",
                          file));
        return estimate({});
    };
    EXPECT_GE(with("out.gif"), with("out.png") + 30);
}

TEST_F(MemoryOfTheProgram, WholeFramesOfOtherFormatsCountWhereTheyAreRead) {
    EXPECT_GE(estimate_of_reading("plate.tga"),
              estimate_of_reading("plate.sgi") + 30);  // a frame is 31.6 MiB
}

}  // namespace

}  // namespace keyline::test
