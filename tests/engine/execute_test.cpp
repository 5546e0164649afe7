// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/execute.h"

#include "tests/engine/test_nodes.h"
#include "tests/support/run.h"

#include <atomic>
#include <gmock/gmock.h>
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

// The same of a whole-frame node.
struct BrokenMap {
    static constexpr Info info{"broken_map", "Throws while it looks."};
    struct Params {
        Input in;
        static constexpr auto fields = declare(input(&Params::in, "in", "The image.", matte()));
    };
    static constexpr std::array outputs{"Y"};
    explicit BrokenMap(const Params&) {}
    using State = int;
    using Partial = int;
    static int rounds() { return 1; }
    static State start(const Rect&) { return 0; }
    static std::size_t state_bytes(const Rect&) { return 0; }
    static Partial map(const State&, const Inputs&, const Rect&, Scratch&) { throw_fault(Fault::kForeign); }
    static void fold(State&, Partial) {}
    static void finish(State&) {}
    static void compute(const State&, Outputs, Scratch&) {}
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
    EXPECT_THAT(e.what, HasSubstr("table missing in tile [16,16 – 32,32)"));
}

TEST(Execute, MemoryThatRunsOutIsTold) {
    const Error e = error_of_run({{"type", "broken"}, {"in", "in"}, {"fault", "memory"}}, 2);
    EXPECT_EQ(e.kind, ErrorKind::kFailed);
    EXPECT_EQ(e.node, "node 'n' (broken), frame 7");
    EXPECT_THAT(e.what, HasSubstr("out of memory"));
}

TEST(Execute, SoIsWhatAWholeFrameNodeThrows) {
    const Error e = error_of_run({{"type", "broken_map"}, {"in", "in"}}, 2);
    EXPECT_EQ(e.kind, ErrorKind::kInternal);
    EXPECT_EQ(e.node, "node 'n' (broken_map), frame 7");
    EXPECT_THAT(e.what, StartsWith("table missing in tile "));
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
        auto frame = std::make_unique<FrameRun>(
            make_plan(resolve_graph({{"n", {{"type", "canceller"}, {"in", "in"}}}}, {"n"},
                                    {{"in", {Image({0, 0, 200, 200}, {"Y"})}}}),
                      {threads, 10, 0}));
        try {
            Executor(threads).run(std::move(frame), Canceller::cancel());
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
    auto frame =
        std::make_unique<FrameRun>(make_plan(resolve_graph({{"n", {{"type", "canceller"}, {"in", "in"}}}},
                                                           {"n"}, {{"in", {Image({0, 0, 20, 20}, {"Y"})}}}),
                                             {2, 10, 0}));
    EXPECT_THROW(Executor(2).run(std::move(frame), true), Failure);
    EXPECT_EQ(Canceller::tiles(), 0);
}

}  // namespace
}  // namespace keyline::testing
