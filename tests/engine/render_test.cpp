// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/render.h"

#include "tests/engine/test_nodes.h"
#include "tests/io/exr_files.h"
#include "tests/support/render_files.h"

#include <fmt/format.h>
#include <fstream>
#include <gmock/gmock.h>
#include <iterator>

namespace keyline::testing {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

class RenderFrames : public ::testing::Test {
protected:
    RenderFrames() {
        register_test_nodes<Change>();
        for (int f = 1; f <= 5; ++f)
            write_exr(in(f), noise({f, -f, 90, 70}, {"A", "B", "G", "R"}, static_cast<unsigned>(f)));
    }

    std::string in(int frame) const { return folder_ / fmt::format("in.{:04}.exr", frame); }
    std::string out(int frame) const { return folder_ / fmt::format("out.{:04}.exr", frame); }

    // Edges of what changed since the frame before.
    Json nodes() const {
        return {{"in", {{"type", "read"}, {"file", (folder_ / "in.####.exr").string()}, {"missing", "hold"}}},
                {"grey", {{"type", "ycolor"}, {"in", "in"}}},
                {"change", {{"type", "change"}, {"in", "grey"}}},
                {"soft", {{"type", "gaussian"}, {"in", "change"}}},
                {"slope", {{"type", "gradient"}, {"in", "soft"}}},
                {"edges", {{"type", "hysteresis"}, {"in", "slope"}, {"low", 0.1}, {"units", "max"}}},
                {"ink", {{"type", "ink"}, {"in", "edges"}}},
                {"comp", {{"type", "over"}, {"fg", "ink"}, {"bg", "in"}}},
                {"out", {{"type", "write"}, {"in", "comp"}, {"file", (folder_ / "out.####.exr").string()}}}};
    }

    static std::string bytes(const std::string& file) {
        std::ifstream stream(file, std::ios::binary);
        return {std::istreambuf_iterator<char>(stream), {}};
    }

    // The files of frames 1 to 5 after a render of those frames.
    std::vector<std::string> rendered(const std::vector<int>& frames, int threads,
                                      std::size_t memory = 0) const {
        for (int f = 1; f <= 5; ++f) std::filesystem::remove(out(f));
        RenderOptions options;
        options.frames = frames;
        options.threads = threads;
        options.memory = memory;
        EXPECT_THAT(render_files(nodes(), options).errors, IsEmpty());
        std::vector<std::string> files;
        for (int f = 1; f <= 5; ++f) files.push_back(bytes(out(f)));
        return files;
    }

    const TemporaryFolder folder_;
};

TEST_F(RenderFrames, FilesDoNotDependOnTheOtherFramesNorTheirOrder) {
    const std::vector<std::string> expected = rendered({1, 2, 3, 4, 5}, 1);
    EXPECT_THAT(expected, Each(::testing::Not("")));
    EXPECT_TRUE(rendered({1, 2, 3, 4, 5}, 4) == expected);
    EXPECT_TRUE(rendered({5, 2, 4, 1, 3}, 3) == expected);
    EXPECT_TRUE(rendered({1, 2, 3, 4, 5}, 2, std::size_t{40} << 20) == expected);
    EXPECT_TRUE(rendered({4}, 2)[3] == expected[3]);
}

TEST_F(RenderFrames, AFrameThatFailsLeavesNothingAndTheOthersStay) {
    std::filesystem::resize_file(in(3), std::filesystem::file_size(in(3)) / 2);
    RenderOptions options;
    options.frames = {1, 3, 5};
    options.threads = 2;
    options.keep_going = true;
    const Rendered result = render_files(nodes(), options);
    EXPECT_EQ(result.status, 3);
    EXPECT_FALSE(result.errors.empty());
    EXPECT_NE(bytes(out(1)), "");
    EXPECT_EQ(bytes(out(3)), "");
    EXPECT_NE(bytes(out(5)), "");
}

TEST_F(RenderFrames, WarningsOfAnotherFrameNameIt) {
    Image image = noise({0, 0, 9, 9}, {"A", "B", "G", "R"}, 1);
    image.at("R", 3, 3) = std::nanf("");
    write_exr(in(1), image);
    EXPECT_THAT(render_files(nodes(), 2).warnings,
                ElementsAre(AllOf(::testing::HasSubstr("node 'in' (read), frame 1"),
                                  ::testing::HasSubstr("mended"))));
}

}  // namespace
}  // namespace keyline::testing
