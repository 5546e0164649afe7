// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/run/render.h"
#include "tests/engine/test_nodes.h"
#include "tests/io/exr_files.h"
#include "tests/support/render_files.h"

#include <fmt/format.h>
#include <fstream>
#include <gmock/gmock.h>
#include <map>
#include <mutex>

// What frames of a run leave for later ones: nothing is decoded or computed twice where memory allows, and
// nothing else is different.

namespace keyline::testing {
namespace {

using ::testing::AllOf;
using ::testing::Each;
using ::testing::ElementsAreArray;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Pair;
using ::testing::SizeIs;

constexpr int kFirst = 1, kLast = 24;
constexpr Rect kPicture{-2, 3, 88, 73};

// How often something was done, by whoever it was done for.
class Counter {
public:
    void add(const std::string& what, int64_t n = 1) {
        const std::lock_guard lock(mutex_);
        counts_[what] += n;
    }
    std::map<std::string, int64_t> take() {
        const std::lock_guard lock(mutex_);
        return std::exchange(counts_, {});
    }

private:
    std::mutex mutex_;
    std::map<std::string, int64_t> counts_;
};

Counter& decoded() {
    static Counter counter;
    return counter;
}
Counter& computed() {
    static Counter counter;
    return counter;
}

// A file that counts each chunk that is decoded, by file and chunk.
class CountedSource final : public ImageSource {
public:
    explicit CountedSource(std::shared_ptr<const ImageSource> source) : source_(std::move(source)) {
        set_digest(Digester("counted").add(source_->digest()).digest());
    }
    const ImageHeader& header() const override { return source_->header(); }
    std::size_t chunk_memory(std::size_t group) const override { return source_->chunk_memory(group); }
    bool rest() const override { return source_->rest(); }
    void read_chunk(std::size_t group, int column, int row, std::span<const Plane> planes) const override {
        decoded().add(fmt::format("{} {}", header().file.filename().string(), row));
        source_->read_chunk(group, column, row, planes);
    }

private:
    std::shared_ptr<const ImageSource> source_;
};

struct Counted {
    static constexpr Info info{"counted_file", "Reads an image, and counts."};
    struct Params {
        FileName file;
        static constexpr auto fields = declare(field(&Params::file, "file", "The file.").required());
    };
    explicit Counted(const Params& p) : params(p) {}
    Stream read(Builder& builder) const {
        const int frame = params.file.has_frame() ? builder.frame() : 0;
        return builder.add_source(
            std::make_shared<const CountedSource>(builder.open(params.file.at(frame), {})));
    }
    const Params params;
};

int inside(int frame) { return std::clamp(frame, kFirst, kLast); }

// The median of a picture's frames t − 2 … t + 2, of those that there are.
struct MedianOfFrames {
    static constexpr Info info{"median_of_frames", "The median of five frames."};
    struct Params {
        Input in;
        static constexpr auto fields = declare(input(&Params::in, "in", "A matte.", matte()));
    };
    explicit MedianOfFrames(const Params& p) : params(p) {}

    struct Middle {
        struct Params {
            Input a, b, c, d, e;
            static constexpr auto fields =
                declare(input(&Params::a, "a", "", matte()), input(&Params::b, "b", "", matte()),
                        input(&Params::c, "c", "", matte()), input(&Params::d, "d", "", matte()),
                        input(&Params::e, "e", "", matte()));
        };
        static constexpr std::array outputs{"Y"};
        void compute(const Inputs& in, Outputs out, Scratch&) const {
            for (int y = out[0].rect.y0; y < out[0].rect.y1; ++y)
                for (int i = 0; i < out[0].rect.width(); ++i) {
                    std::array<float, 5> samples{};
                    for (int s = 0; s < 5; ++s)
                        samples[static_cast<std::size_t>(s)] = in.slot(s)[0].row(y)[i];
                    std::ranges::nth_element(samples, samples.begin() + 2);
                    out[0].row(y)[i] = samples[2];
                }
        }
    };

    Stream expand(Builder& builder) const {
        const auto at = [&](int by) { return builder.input(params.in, inside(builder.frame() + by)); };
        return add_operation(builder, Middle{}, {at(-2), at(-1), at(0), at(1), at(2)});
    }
    const Params params;
};

// A stencil that counts its pixels.
struct CountedStencil {
    static constexpr Info info{"counted_stencil", "A mean of three, and counts."};
    struct Params {
        Input in;
        static constexpr auto fields = declare(input(&Params::in, "in", "The image."));
    };
    explicit CountedStencil(const Params&) {}
    static Halo halo() { return {1, 0}; }
    void compute(const View& in, const MutView& out, Scratch&) const {
        // Of a single pixel it is asked what it makes of zeros.
        if (out.rect.area() > 1) computed().add("pixels", out.rect.area());
        const auto at = [&](int x, int y) { return in.rect.contains(x, y) ? *in.at(x, y) : 0.0F; };
        for (int y = out.rect.y0; y < out.rect.y1; ++y)
            for (int x = out.rect.x0; x < out.rect.x1; ++x)
                *out.at(x, y) = (at(x - 1, y) + at(x, y) + at(x + 1, y)) / 3;
    }
};

// A picture, brighter by what its neighbours' data say.
struct BrightenBySums {
    static constexpr Info info{"brighten_by_sums", "Adds numbers of three frames."};
    struct Params {
        Input in, sums;
        static constexpr auto fields = declare(input(&Params::in, "in", "A matte.", matte()),
                                               input(&Params::sums, "sums", "", data<Numbers>()));
    };
    explicit BrightenBySums(const Params& p) : params(p) {}

    struct Add {
        struct Params {
            Input in, a, b, c;
            static constexpr auto fields = declare(
                input(&Params::in, "in", "", matte()), input(&Params::a, "a", "", data<Numbers>()),
                input(&Params::b, "b", "", data<Numbers>()), input(&Params::c, "c", "", data<Numbers>()));
        };
        static constexpr std::array outputs{"Y"};
        void compute(const Inputs& in, Outputs out, Scratch&) const {
            double sum = 0;
            for (int s = 1; s < 4; ++s) sum += in.datum<Numbers>(s).values[0];
            for (int y = out[0].rect.y0; y < out[0].rect.y1; ++y)
                for (int i = 0; i < out[0].rect.width(); ++i)
                    out[0].row(y)[i] = in.slot(0)[0].row(y)[i] + static_cast<float>(sum / 1e8);
        }
    };

    Stream expand(Builder& builder) const {
        const auto at = [&](int by) { return builder.input(params.sums, inside(builder.frame() + by)); };
        return add_operation(builder, Add{}, {builder.input(params.in), at(-1), at(0), at(1)});
    }
    const Params params;
};

std::vector<int> range(int first, int last) {
    std::vector<int> out;
    for (int f = first; first <= last ? f <= last : f >= last; f += first <= last ? 1 : -1) out.push_back(f);
    return out;
}

class Carry : public ::testing::Test {
protected:
    Carry() {
        register_test_nodes<Counted, MedianOfFrames, CountedStencil, BrightenBySums, SumOfAll>();
        for (int f = kFirst; f <= kLast; ++f)
            write_exr(in(f), noise(kPicture, {"Y"}, static_cast<unsigned>(f)));
        decoded().take();
        computed().take();
    }

    std::string in(int frame) const { return folder_ / fmt::format("in.{:04}.exr", frame); }
    std::string out(int frame) const { return folder_ / fmt::format("out.{:04}.exr", frame); }
    Json source(const std::string& file = "in.####.exr") const {
        return {{"type", "counted_file"}, {"file", (folder_ / file).string()}};
    }
    Json sink(const std::string& node) const {
        return {{"type", "write"}, {"in", node}, {"file", (folder_ / "out.####.exr").string()}};
    }
    Json median() const {
        return {{"in", source()},
                {"middle", {{"type", "median_of_frames"}, {"in", "in"}}},
                {"out", sink("middle")}};
    }
    Json median_of_stencils() const {
        return {{"in", source()},
                {"soft", {{"type", "counted_stencil"}, {"in", "in"}}},
                {"middle", {{"type", "median_of_frames"}, {"in", "soft"}}},
                {"out", sink("middle")}};
    }
    Json with_data() const {
        return {{"in", source()},
                {"sum", {{"type", "sum_of_all"}, {"in", "in"}}},
                {"bright", {{"type", "brighten_by_sums"}, {"in", "in"}, {"sums", "sum"}}},
                {"out", sink("bright")}};
    }

    static RenderOptions options(std::vector<int> frames, int threads = 1, std::size_t memory = 0) {
        RenderOptions out;
        out.frames = std::move(frames);
        out.threads = threads;
        out.memory = memory;
        out.keep_going = true;
        return out;
    }

    static std::string bytes(const std::string& file) {
        std::ifstream stream(file, std::ios::binary);
        return {std::istreambuf_iterator<char>(stream), {}};
    }

    struct Run {
        Rendered told;
        std::map<int, std::string> files;
        std::map<std::string, int64_t> decoded;
        int64_t computed = 0;  // pixels of stencils
    };
    Run run(const Json& nodes, const RenderOptions& chosen) const {
        for (int f = kFirst; f <= kLast; ++f) std::filesystem::remove(out(f));
        Run result;
        result.told = render_files(nodes, chosen);
        for (int f = kFirst; f <= kLast; ++f)
            if (std::filesystem::exists(out(f))) result.files[f] = bytes(out(f));
        result.decoded = decoded().take();
        for (const auto& [what, n] : computed().take()) result.computed += n;
        return result;
    }

    // Each frame in a run of its own: nothing can be carried.
    Run one_by_one(const Json& nodes) const {
        Run all;
        for (int f = kFirst; f <= kLast; ++f) {
            Run one = run(nodes, options({f}));
            all.files.merge(one.files);
            for (const auto& [what, n] : one.decoded) all.decoded[what] += n;
            all.computed += one.computed;
            std::ranges::copy(one.told.warnings, std::back_inserter(all.told.warnings));
            std::ranges::copy(one.told.errors, std::back_inserter(all.told.errors));
        }
        return all;
    }

    // Of all frames: the least that each can be computed in.
    static std::size_t least_memory(const Json& nodes) {
        std::size_t least = 0;
        plans(nodes, options(range(kFirst, kLast)),
              [&](const Plan& plan) { least = std::max(least, plan.weighed.back().memory_bytes); });
        return least;
    }

    static void plans(const Json& nodes, const RenderOptions& chosen,
                      const std::function<void(const Plan&)>& hear) {
        Diagnostics diagnostics;
        const Json json{{"keyline", 1}, {"nodes", nodes}};
        const auto graph = Graph::parse(json.text(), "test.json", ".", {}, diagnostics);
        plan_frames(*graph, chosen.frames, chosen, diagnostics, hear);
        EXPECT_TRUE(diagnostics.ok());
    }

    const TemporaryFolder folder_;
};

TEST_F(Carry, AMedianOfFiveFramesDecodesEachFileOnce) {
    const Run alone = one_by_one(median());
    EXPECT_THAT(alone.files, SizeIs(24));
    EXPECT_THAT(alone.decoded, ::testing::Contains(Pair("in.0012.exr 0", 5)));
    for (const int threads : {1, 4})
        for (const auto& frames : {range(kFirst, kLast), range(kLast, kFirst)}) {
            const Run together = run(median(), options(frames, threads));
            EXPECT_THAT(together.told.errors, IsEmpty());
            EXPECT_THAT(together.decoded, Each(Pair(::testing::_, 1))) << threads;
            EXPECT_TRUE(together.files == alone.files) << threads;
            EXPECT_EQ(together.decoded.size(), alone.decoded.size());
        }
}

TEST_F(Carry, FramesInAnyOrderAreTheSame) {
    const Run alone = one_by_one(median());
    std::vector<int> frames;
    for (int i = 0; i < 24; ++i) frames.push_back(1 + i * 7 % 24);
    const Run together = run(median(), options(frames, 3));
    EXPECT_TRUE(together.files == alone.files);
    const Run gaps = run(median(), options({1, 5, 2, 24, 3}, 2));
    EXPECT_THAT(gaps.files, SizeIs(5));
    for (const auto& [frame, file] : gaps.files) EXPECT_TRUE(file == alone.files.at(frame)) << frame;
    EXPECT_EQ(gaps.decoded.at("in.0003.exr 0"), 1) << "of frames 1, 5, 2 and 3";
}

TEST_F(Carry, StencilsAreComputedOnce) {
    const Run alone = one_by_one(median_of_stencils());
    EXPECT_EQ(alone.computed, (5 * 24 - 6) * kPicture.area()) << "less those that stand in at the ends";
    for (const int threads : {1, 4}) {
        const Run together = run(median_of_stencils(), options(range(kFirst, kLast), threads));
        EXPECT_THAT(together.decoded, Each(Pair(::testing::_, 1)));
        EXPECT_EQ(together.computed, 24 * kPicture.area());
        EXPECT_TRUE(together.files == alone.files) << threads;
    }
}

TEST_F(Carry, DataAreMadeOnce) {
    const Run alone = one_by_one(with_data());
    for (const int threads : {1, 4}) {
        const int before = SumOfAll::finished();
        const Run together = run(with_data(), options(range(kFirst, kLast), threads));
        EXPECT_EQ(SumOfAll::finished() - before, 24) << threads;
        EXPECT_THAT(together.decoded, Each(Pair(::testing::_, 1)));
        EXPECT_TRUE(together.files == alone.files) << threads;
    }
}

// With too little memory it is done again, and nothing else is different.
TEST_F(Carry, WithinTheMemoryOrNotAtAll) {
    for (const Json& nodes : {median(), median_of_stencils(), with_data()}) {
        const Run alone = one_by_one(nodes);
        const Run small = run(nodes, options(range(kFirst, kLast), 1, least_memory(nodes)));
        EXPECT_THAT(small.told.errors, IsEmpty());
        EXPECT_TRUE(small.files == alone.files);
        EXPECT_GT(small.decoded.at("in.0012.exr 0"), 1);
    }
}

TEST_F(Carry, AFrameThatFailsLeavesTheOthersAsTheyAre) {
    for (const Json& nodes : {median(), median_of_stencils()}) {
        const std::string whole = bytes(in(12));
        std::filesystem::resize_file(in(12), whole.size() - 300);
        const Run alone = one_by_one(nodes);
        EXPECT_THAT(alone.files, SizeIs(19));
        for (const int threads : {1, 4}) {
            const Run together = run(nodes, options(range(kFirst, kLast), threads));
            EXPECT_TRUE(together.files == alone.files) << threads;
            EXPECT_THAT(together.told.errors, ElementsAreArray(alone.told.errors));
        }
        std::ofstream(in(12), std::ios::binary) << whole;
    }
}

// What was found in a file is told by every frame that uses it.
TEST_F(Carry, WarningsAreTheSame) {
    Image image = noise(kPicture, {"Y"}, 12);
    image.at("Y", 20, 20) = std::nanf("");
    write_exr(in(12), image);
    for (Json nodes : {median(), median_of_stencils(), with_data()}) {
        nodes.set("in", {{"type", "read"}, {"file", (folder_ / "in.####.exr").string()}});
        const Run alone = one_by_one(nodes);
        EXPECT_GE(alone.told.warnings.size(), 3U);
        for (const int threads : {1, 4})
            EXPECT_THAT(run(nodes, options(range(kFirst, kLast), threads)).told.warnings,
                        ElementsAreArray(alone.told.warnings));
    }
}

TEST_F(Carry, AStillIsDecodedOnceForTheWholeRun) {
    const Json nodes{{"in", source()},
                     {"paper", source("in.0001.exr")},
                     {"comp", {{"type", "math"}, {"in", "in"}, {"b", "paper"}, {"op", "add"}}},
                     {"out", sink("comp")}};
    const Run alone = one_by_one(nodes);
    ASSERT_THAT(alone.told.errors, IsEmpty());
    const Run together = run(nodes, options(range(2, kLast), 2));
    EXPECT_EQ(together.decoded.at("in.0001.exr 0"), 1);
    for (const auto& [frame, file] : together.files) EXPECT_TRUE(file == alone.files.at(frame)) << frame;
}

TEST_F(Carry, NothingIsHeldThatNobodyWants) {
    const Json nodes{{"in", source()}, {"soft", {{"type", "gaussian"}, {"in", "in"}}}, {"out", sink("soft")}};
    plans(nodes, options(range(kFirst, kLast)),
          [](const Plan& plan) { EXPECT_EQ(plan.carrying.held_bytes() + plan.carried_bytes(), 0U); });
    plans(median(), options(range(kFirst, kLast)), [](const Plan& plan) {
        EXPECT_LE(plan.carrying.held.size(), 5U);
        EXPECT_TRUE(plan.frame.frame != kLast || plan.carried_bytes() == 0);
    });
}

TEST_F(Carry, ThePlanSaysWhatIsCarriedAndUntilWhen) {
    std::map<int, std::string> texts;
    std::map<int, std::size_t> memory;
    plans(median(), options({10, 11, 12}), [&](const Plan& plan) {
        texts[plan.frame.frame] = plan.text();
        memory[plan.frame.frame] = plan.memory_bytes;
    });
    EXPECT_THAT(texts[10],
                AllOf(HasSubstr("carried from frame to frame"), HasSubstr("in.0012.exr, 1M, until frame 12"),
                      HasSubstr("in.0009.exr, 1M, until frame 11")));
    EXPECT_THAT(texts[10], ::testing::Not(HasSubstr("in.0008.exr, 1M, until")));
    EXPECT_THAT(texts[12], ::testing::Not(HasSubstr("decode   " + in(13))));
    EXPECT_THAT(texts[12], HasSubstr("decode   " + in(14)));
    std::map<int, std::size_t> alone;
    plans(median(), options({10}), [&](const Plan& plan) { alone[10] = plan.memory_bytes; });
    const std::size_t picture = static_cast<std::size_t>(kPicture.area()) * sizeof(float) / 2;
    EXPECT_GE(memory[10] + 4 * picture, alone[10] + 4 * picture);
}

// Finished outputs are left alone: what only they would want is not held.
TEST_F(Carry, SkippedFramesWantNothing) {
    const Run alone = one_by_one(median());
    for (const int f : {3, 4, 5, 6, 20}) std::filesystem::remove(out(f));
    RenderOptions chosen = options(range(kFirst, kLast), 2);
    chosen.skip_existing = true;
    decoded().take();
    EXPECT_THAT(render_files(median(), chosen).errors, IsEmpty());
    EXPECT_THAT(decoded().take(), Each(Pair(::testing::_, 1)));
    for (const auto& [frame, file] : alone.files) EXPECT_TRUE(bytes(out(frame)) == file) << frame;
}

}  // namespace
}  // namespace keyline::testing
