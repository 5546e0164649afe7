// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/run/execute.h"

#include "engine/plan/planner.h"
#include "tests/engine/test_nodes.h"
#include "tests/support/run.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <gmock/gmock.h>
#include <map>
#include <mutex>
#include <new>
#include <stdexcept>

namespace keyline::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

enum class Fault { kFailure, kForeign, kMemory };

constexpr auto words(Fault) {
    return std::array{Word<Fault>{"failure", Fault::kFailure, "Keyline's own"},
                      Word<Fault>{"foreign", Fault::kForeign, "someone else's"},
                      Word<Fault>{"memory", Fault::kMemory, "no memory"}};
}

[[noreturn]] void throw_fault(Fault fault) {
    if (fault == Fault::kMemory) throw std::bad_alloc();
    if (fault == Fault::kForeign) throw std::runtime_error("table missing");
    fail(ErrorKind::kFailed, "no solution", "try another");
}

// Throws on the pixel 20,20.
struct Broken {
    static constexpr Info info{"broken", "Throws."};
    struct Params {
        Input in;
        Fault fault = Fault::kFailure;
        static constexpr auto fields =
            declare(input(&Params::in, "in", "The image."), field(&Params::fault, "fault", "What."));
    };
    explicit Broken(const Params& p) : fault(p.fault) {}
    void compute(const View&, const MutView& out, Scratch&) const {
        if (out.rect.contains(20, 20)) throw_fault(fault);
    }
    const Fault fault;
};

// The same of a gather.
struct BrokenMap {
    static constexpr Info info{"broken_map", "Throws while it looks."};
    struct Params {
        Input in;
        static constexpr auto fields = declare(input(&Params::in, "in", "The image.", matte()));
    };
    explicit BrokenMap(const Params& p) : in(p.in) {}
    Stream expand(Builder& builder) const {
        const Stream stream = builder.input(in);
        return add_operation(builder, Draw{}, {stream, add_operation(builder, Throw{}, {stream})});
    }

    struct Throw : SumOfAll {
        static Partial map(const State&, const Inputs&, const Rect&, Scratch&) {
            throw_fault(Fault::kForeign);
        }
    };
    struct Draw {
        using Params = CountAbove::Params;
        static constexpr std::array outputs{"Y"};
        static void compute(const Inputs&, Outputs, Scratch&) {}
    };
    const Input in;
};

// Asks for an end after its first tiles, and counts all that it was called for.
struct Canceller {
    static constexpr Info info{"canceller", "Cancels."};
    struct Params {
        Input in;
        static constexpr auto fields = declare(input(&Params::in, "in", "The image."));
    };
    explicit Canceller(const Params&) {}
    void compute(const View&, const MutView&, Scratch&) const {
        if (++tiles() == 3) cancel() = true;
    }
    static std::atomic<int>& tiles() {
        static std::atomic<int> count = 0;
        return count;
    }
    static std::atomic<bool>& cancel() {
        static std::atomic<bool> flag = false;
        return flag;
    }
};

// Counts what is decoded of it: chunks of 16 × 8 pixels, four channels.
class CountedSource final : public ImageSource {
public:
    CountedSource() {
        header_.display_window = header_.data_window = {0, 0, 160, 80};
        header_.groups.push_back({{}, header_.data_window, 16, 8});
        for (const char* name : {"R", "G", "B", "Z"})
            header_.groups[0].channels.push_back({name, SampleType::kFloat});
    }
    const ImageHeader& header() const override { return header_; }
    std::size_t chunk_memory(std::size_t) const override { return 0; }
    void read_chunk(std::size_t, int column, int row, std::span<const Plane> planes) const override {
        const std::lock_guard lock(mutex_);
        for (std::size_t c = 0; c < planes.size(); ++c)
            if (planes[c].data) ++decoded_[{static_cast<int>(c), column, row}];
    }

    using Count = std::map<std::array<int, 3>, int>;  // by channel, column and row of chunks
    Count decoded() const { return decoded_; }

private:
    ImageHeader header_;
    mutable std::mutex mutex_;
    mutable Count decoded_;
};

struct Counted {
    static constexpr Info info{"counted", "Counts what is decoded of it."};
    struct Params {
        static constexpr auto fields = declare();
    };
    explicit Counted(const Params&) {}
    static Stream read(Builder& builder) {
        return builder.add_source(source() = std::make_shared<CountedSource>());
    }
    static std::shared_ptr<CountedSource>& source() {
        static std::shared_ptr<CountedSource> last;
        return last;
    }
};

// A file whose first chunk takes its time: until others can't get farther ahead of it, and a little longer.
class SlowSink final : public ImageSink {
public:
    static constexpr int kThreads = 3;

    explicit SlowSink(const SinkSpec& spec) : window_(spec.data_window), channels_(spec.channels) {}
    Rect region() const override { return window_; }
    int chunk_height() const override { return 4; }
    const std::vector<ChannelInfo>& channels() const override { return channels_; }
    EncodedChunk encode(int index, std::span<const Plane>) const override {
        std::unique_lock lock(mutex_);
        if (is_first_under_way_) farthest() = std::max(farthest().load(), index);
        if (index == 0) {
            is_first_under_way_ = true;
            changed_.wait_for(lock, std::chrono::seconds(20), [] { return farthest() >= kThreads - 1; });
            changed_.wait_for(lock, std::chrono::milliseconds(50), [] { return farthest() >= kThreads; });
            is_first_under_way_ = false;
        }
        changed_.notify_all();
        return {index, {}};
    }
    void commit(EncodedChunk) override {}
    void finish() override {}

    static std::atomic<int>& farthest() {  // chunk, while the first was encoded
        static std::atomic<int> index = 0;
        return index;
    }

private:
    Rect window_;
    std::vector<ChannelInfo> channels_;
    mutable std::mutex mutex_;
    mutable std::condition_variable changed_;
    mutable bool is_first_under_way_ = false;
};

struct WriteSlowly {
    static constexpr Info info{"write_slowly", "Takes its time."};
    struct Params {
        Input in;
        static constexpr auto fields = declare(input(&Params::in, "in", "The image."));
    };
    explicit WriteSlowly(const Params& p) : in(p.in) {}
    void write(Builder& builder) const {
        SinkRequest request;
        request.stream = builder.input(in);
        request.spec.display_window = request.stream.display;
        request.spec.data_window = request.stream.window;
        for (const StreamChannel& c : request.stream.channels)
            request.spec.channels.push_back({c.name, SampleType::kFloat});
        request.create = [](const SinkSpec& spec) { return std::make_unique<SlowSink>(spec); };
        builder.add_sink(std::move(request));
    }
    const Input in;
};

CountedSource::Count decoded_for(Json nodes, const std::string& id, const PlanOptions& options = {2, 0, 0}) {
    register_test_nodes<Counted, Crop>();
    nodes.set("in", {{"type", "counted"}});
    render(make_plan(resolve_graph(nodes, {id}, {}), options));
    return Counted::source()->decoded();
}

Error error_of_run(const Json& node, int threads) {
    register_test_nodes<Broken, BrokenMap>();
    try {
        run_graph({{"n", node}}, "n", Sequences{{"in", {Image({0, 0, 64, 64}, {"Y"})}}},
                  {.threads = threads, .tile = 16, .frame = 7});
    } catch (const Failure& f) {
        return f.error();
    }
    return {};
}

TEST(Execute, DecodesOnlyTheChannelsAndChunksInUse) {
    const Json nodes{{"wide", {{"type", "dilate"}, {"in", "in:Z"}, {"radius", 1}}},
                     {"part", {{"type", "cut_out"}, {"in", "wide"}, {"window", {40, 17, 49, 23}}}}};
    // With the halo x from 39 to 50 and y from 16 to 24: columns 2 and 3, row 2.
    EXPECT_THAT(decoded_for(nodes, "part"),
                ::testing::ElementsAre(std::pair(std::array{3, 2, 2}, 1), std::pair(std::array{3, 3, 2}, 1)));
}

TEST(Execute, DecodesEachChunkOnceWhereThereIsMemory) {
    const Json nodes{{"grey", {{"type", "ycolor"}, {"in", "in"}}},
                     {"edges", {{"type", "hysteresis"}, {"in", "grey"}, {"low", 0.1}, {"units", "max"}}},
                     {"ink", {{"type", "ink"}, {"in", "edges"}}},
                     {"comp", {{"type", "over"}, {"fg", "ink"}, {"bg", "in"}}}};
    for (const int tile : {0, 5, 32}) {
        const CountedSource::Count counted = decoded_for(nodes, "comp", {3, tile, 0});
        EXPECT_EQ(counted.size(), 4U * 10 * 10);
        for (const auto& [where, times] : counted)
            EXPECT_EQ(times, 1) << where[0] << ' ' << where[1] << ' ' << where[2];
    }
}

// What is encoded before its turn waits in memory: as many chunks as there are threads, which is what the
// estimate of memory says.
TEST(Execute, NobodyGetsFarAheadOfAChunkThatIsBeingEncoded) {
    register_test_nodes<WriteSlowly>();
    SlowSink::farthest() = 0;
    Plan plan = make_plan(resolve_graph({{"n", {{"type", "write_slowly"}, {"in", "in"}}}}, {},
                                        {{"in", {Image({0, 0, 8, 400}, {"Y"})}}}),
                          {SlowSink::kThreads, 8, 0});
    Executor(SlowSink::kThreads, 0).run(std::make_unique<FrameRun>(std::move(plan)), false);
    EXPECT_EQ(SlowSink::farthest(), SlowSink::kThreads - 1);
}

TEST(Execute, ANodesFailureNamesNodeAndFrame) {
    for (const int threads : {1, 4}) {
        const Error e = error_of_run({{"type", "broken"}, {"in", "in"}}, threads);
        EXPECT_EQ(e.kind, ErrorKind::kFailed);
        EXPECT_EQ(e.text(), "error: node 'n' (broken), frame 7: no solution; try another");
    }
}

TEST(Execute, AForeignExceptionIsAnInternalErrorThatNamesTheTile) {
    const Error e = error_of_run({{"type", "broken"}, {"in", "in"}, {"fault", "foreign"}}, 2);
    EXPECT_EQ(e.kind, ErrorKind::kInternal);
    EXPECT_EQ(e.node, "node 'n' (broken), frame 7");
    EXPECT_THAT(e.what, HasSubstr("table missing in 16 × 16 at (16, 16)"));
}

TEST(Execute, MemoryThatRunsOutIsTold) {
    const Error e = error_of_run({{"type", "broken"}, {"in", "in"}, {"fault", "memory"}}, 2);
    EXPECT_EQ(e.kind, ErrorKind::kFailed);
    EXPECT_EQ(e.node, "node 'n' (broken), frame 7");
    EXPECT_THAT(e.what, HasSubstr("out of memory"));
}

TEST(Execute, SoIsWhatAGatherThrows) {
    const Error e = error_of_run({{"type", "broken_map"}, {"in", "in"}}, 2);
    EXPECT_EQ(e.kind, ErrorKind::kInternal);
    EXPECT_EQ(e.node, "node 'n' (broken_map), frame 7");
    EXPECT_THAT(e.what, StartsWith("table missing in 16 × 16 at ("));
}

TEST(Execute, AnExecutorRunsAFrameAfterOneThatFailed) {
    EXPECT_NE(error_of_run({{"type", "broken"}, {"in", "in"}}, 2).what, "");
    EXPECT_IMAGE(run("dilate", {}, ascii({"...", ".2.", "..."})), ascii({".2.", "222", ".2."}));
}

TEST(Execute, StopsSoonAfterItIsCancelled) {
    register_test_nodes<Canceller>();
    for (const int threads : {1, 3}) {
        Canceller::tiles() = 0;
        Canceller::cancel() = false;
        Plan plan = make_plan(resolve_graph({{"n", {{"type", "canceller"}, {"in", "in"}}}}, {"n"},
                                            {{"in", {Image({0, 0, 200, 200}, {"Y"})}}}),
                              {threads, 10, 0});
        try {
            Executor(threads, 0).run(std::make_unique<FrameRun>(std::move(plan)), Canceller::cancel());
            FAIL() << "it ran to the end";
        } catch (const Failure& f) {
            EXPECT_EQ(f.error().kind, ErrorKind::kCancelled);
        }
        EXPECT_LE(Canceller::tiles(), 3 + threads) << "of 400: those under way and no more";
    }
}

TEST(Execute, CancelledBeforeItBeginsItComputesNothing) {
    register_test_nodes<Canceller>();
    Canceller::tiles() = 0;
    Plan plan = make_plan(resolve_graph({{"n", {{"type", "canceller"}, {"in", "in"}}}}, {"n"},
                                        {{"in", {Image({0, 0, 20, 20}, {"Y"})}}}),
                          {2, 10, 0});
    Canceller::tiles() = 0;  // it was asked what it makes of nothing, while it was resolved
    EXPECT_THROW(Executor(2, 0).run(std::make_unique<FrameRun>(std::move(plan)), true), Failure);
    EXPECT_EQ(Canceller::tiles(), 0);
}

}  // namespace
}  // namespace keyline::testing
