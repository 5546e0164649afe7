// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/run/one_tile.h"
#include "tests/engine/test_nodes.h"
#include "tests/io/exr_files.h"
#include "tests/support/render_files.h"

#include <fmt/format.h>
#include <fstream>
#include <gmock/gmock.h>
#include <iterator>
#include <stdexcept>

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
                {"edges",
                 {{"type", "hysteresis"},
                  {"in", "slope"},
                  {"low", 0.1},
                  {"units", "max"},
                  {"meant", "not-thinned"}}},
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
    EXPECT_EQ(result.status, 75) << "it may be that it is still being copied";
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

// Breaks its promise on the pixel 40,30.
struct Fragile {
    static constexpr Info info{"fragile", "Throws what nobody expects."};
    struct Params {
        Input in;
        static constexpr auto fields = declare(input(&Params::in, "in", "The image."));
    };
    explicit Fragile(const Params&) {}
    static Halo halo() { return {2, 2}; }
    void compute(const View&, const MutView& out, Scratch&) const {
        if (out.rect.contains(40, 30)) throw std::runtime_error("table missing");
    }
};

TEST_F(RenderFrames, AnInternalErrorSaysHowToSeeItAgain) {
    register_test_nodes<Fragile>();
    Json all = nodes();
    all.set("slope", {{"type", "gradient"}, {"in", "broken"}});
    all.set("broken", {{"type", "fragile"}, {"in", "soft"}});
    RenderOptions options;
    options.frames = {3};
    options.threads = 2;
    options.tile = 16;
    options.command = "keyline render toon.json --set a.b=1";
    const std::vector<std::string> errors = render_files(all, options).errors;
    ASSERT_THAT(errors, ::testing::SizeIs(1));
    // The tile of 16 × 16 with what the gradient looks at around it.
    EXPECT_EQ(
        errors[0],
        "error: internal: node 'broken' (fragile), frame 3: table missing in 18 × 18 at (31, 15); 'keyline "
        "render toon.json --set a.b=1 --only-tile broken@31,15,18,18 --frames=3' runs this alone; please "
        "report it with that");
    Diagnostics diagnostics;
    const Json json{{"keyline", 1}, {"nodes", all}};
    const auto graph = Graph::parse(json.text(), "test.json", ".", {}, diagnostics);
    EXPECT_THROW(render_one_tile(*graph, {"broken", 3, {31, 15, 49, 33}}, options, diagnostics), Failure);
    EXPECT_THAT(render_one_tile(*graph, {"broken", 3, {0, 0, 16, 16}}, options, diagnostics),
                ::testing::SizeIs(1));
    EXPECT_TRUE(diagnostics.ok());
}

}  // namespace
}  // namespace keyline::testing
