// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/numbers.h"
#include "engine/node/node_adaptor.h"
#include "engine/node/pixel_loop.h"
#include "engine/node/registry.h"
#include "tests/contract/contract.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <gmock/gmock.h>

// Nodes that lie, each in one way: the promise that they break must say so, or it protects nobody.

namespace keyline::testing {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

struct OneInput {
    Input in;
    double amount = 1;
    static constexpr auto fields = declare(input(&OneInput::in, "in", "An image."),
                                           field(&OneInput::amount, "amount", "How much.", between(0, 4)));
};

// Calls f(x, y) for each pixel of a view and stores what it says.
template <class F>
void fill(const MutView& out, const F& f) {
    for (int y = out.rect.y0; y < out.rect.y1; ++y)
        for (int x = out.rect.x0; x < out.rect.x1; ++x) *out.at(x, y) = f(x, y);
}

struct Honest {
    static constexpr Info info{"honest", "The sum of a pixel and its neighbour to the left."};
    using Params = OneInput;
    explicit Honest(const Params& p) : amount(static_cast<float>(p.amount)) {}
    bool identity() const { return amount == 0; }
    Halo halo() const { return {amount == 0 ? 0 : 1, 0}; }
    void compute(const View& in, const MutView& out, Scratch&) const {
        fill(out, [&](int x, int y) {
            if (amount == 0) return *in.at(x, y);
            return with_one_nan(*in.at(x, y) + amount * (x > in.window.x0 ? *in.at(x - 1, y) : 0));
        });
    }
    const float amount;
};

struct TwoNans {
    static constexpr Info info{"two_nans", "Takes 1 away, and leaves a NaN as it came."};
    using Params = OneInput;
    explicit TwoNans(const Params&) {}
    void compute(const View& in, const MutView& out, Scratch&) const {
        fill(out, [&](int x, int y) { return *in.at(x, y) - 1; });
    }
};

struct HaloOneShort : Honest {
    static constexpr Info info{"halo_one_short", "Looks two pixels to the left and admits to one."};
    using Honest::Honest;
    bool identity() const { return false; }
    void compute(const View& in, const MutView& out, Scratch&) const {
        fill(out, [&](int x, int y) { return x > in.window.x0 + 1 ? *in.at(x - 2, y) : 0; });
    }
};

struct EndsAtTheTile : Honest {
    static constexpr Info info{"ends_at_the_tile", "Takes the tile's edge for the image's."};
    using Honest::Honest;
    bool identity() const { return false; }
    void compute(const View& in, const MutView& out, Scratch&) const {
        fill(out, [&](int x, int y) { return x > out.rect.x0 ? *in.at(x - 1, y) : 0; });
    }
};

struct TileRelative {
    static constexpr Info info{"tile_relative", "A ramp that begins anew in each tile."};
    using Params = OneInput;
    explicit TileRelative(const Params&) {}
    void compute(const View&, const MutView& out, Scratch&) const {
        fill(out, [&](int x, int) { return static_cast<float>(x - out.rect.x0); });
    }
};

struct RunningSum {
    static constexpr Info info{"running_sum", "Adds along the row from the tile's edge on."};
    using Params = OneInput;
    explicit RunningSum(const Params&) {}
    void compute(const View& in, const MutView& out, Scratch&) const {
        for (int y = out.rect.y0; y < out.rect.y1; ++y) {
            float sum = 0;
            for (int i = 0; i < out.rect.width(); ++i) out.row(y)[i] = sum += in.row(y)[i];
        }
    }
};

struct CountsCalls {
    static constexpr Info info{"counts_calls", "Another value each time that it is called."};
    using Params = OneInput;
    explicit CountsCalls(const Params&) {}
    void compute(const View&, const MutView& out, Scratch&) const {
        const auto n = static_cast<float>(++calls);
        fill(out, [&](int, int) { return n; });
    }
    mutable std::atomic<int> calls = 0;
};

struct WritesBeside {
    static constexpr Info info{"writes_beside", "Writes one pixel too many."};
    using Params = OneInput;
    explicit WritesBeside(const Params&) {}
    void compute(const View& in, const MutView& out, Scratch&) const {
        fill(out, [&](int x, int y) { return *in.at(x, y); });
        *out.at(out.rect.x1, out.rect.y0) = 1;
    }
};

struct SaysIdentity : Honest {
    static constexpr Info info{"says_identity", "Says that it changes nothing at small amounts."};
    using Honest::Honest;
    bool identity() const { return amount < 2; }
};

struct DislikesNan {
    static constexpr Info info{"dislikes_nan", "Gives up on a NaN."};
    using Params = OneInput;
    explicit DislikesNan(const Params&) {}
    void compute(const View& in, const MutView& out, Scratch&) const {
        fill(out, [&](int x, int y) {
            if (std::isnan(*in.at(x, y))) throw std::runtime_error("a NaN");
            return *in.at(x, y);
        });
    }
};

struct NeedsTwoPixels : Honest {
    static constexpr Info info{"needs_two_pixels", "Gives up on an image one pixel wide."};
    using Honest::Honest;
    void compute(const View& in, const MutView& out, Scratch& scratch) const {
        if (in.window.width() < 2) throw std::runtime_error("too narrow");
        Honest::compute(in, out, scratch);
    }
};

struct EndsAtTheData {
    static constexpr Info info{"ends_at_the_data", "Makes 1 of 0, inside the data window alone."};
    using Params = OneInput;
    explicit EndsAtTheData(const Params&) {}
    static Rect window(const std::vector<Port>& ports) { return ports[0].stream.window; }
    void compute(const View& in, const MutView& out, Scratch&) const {
        fill(out, [&](int x, int y) { return 1 - *in.at(x, y); });
    }
};

// Labels connected pixels block by block, and joins blocks where pixels meet side by side but not at corners.
struct SeamWithoutDiagonals {
    static constexpr Info info{"seam_without_diagonals", "The size of each pixel's component."};
    struct Params {
        Input in;
        static constexpr auto fields = declare(input(&Params::in, "in", "A matte.", matte()));
    };
    explicit SeamWithoutDiagonals(const Params& p) : in(p.in) {}

    struct Pixel {
        int block = -1;
        bool set = false;
        float size = 0;
    };
    struct State {
        Rect window;
        std::vector<Pixel> pixels;
        int blocks = 0;
        Pixel& at(int x, int y) {
            return pixels[static_cast<std::size_t>((y - window.y0) * window.width() + x - window.x0)];
        }
        const Pixel& at(int x, int y) const { return const_cast<State*>(this)->at(x, y); }
    };
    struct Partial {
        Rect rect;
        std::vector<float> samples;
    };
    static State start(const Rect& w) {
        return {w, std::vector<Pixel>(static_cast<std::size_t>(w.area())), 0};
    }
    static std::size_t state_bytes(const Rect& w) {
        return static_cast<std::size_t>(w.area()) * sizeof(Pixel);
    }
    static std::size_t partial_bytes(const Rect& b) {
        return static_cast<std::size_t>(b.area()) * sizeof(float);
    }
    static std::size_t datum_bytes(const Rect& w) {
        return static_cast<std::size_t>(w.area()) * sizeof(double);
    }
    Partial map(const State&, const Inputs& inputs, const Rect& block, Scratch&) const {
        Partial out{block, {}};
        const View& v = inputs[in][0];
        for (int y = block.y0; y < block.y1; ++y)
            out.samples.insert(out.samples.end(), v.row(y), v.row(y) + block.width());
        return out;
    }
    static void fold(State& s, Partial&& p) {
        std::size_t i = 0;
        for (int y = p.rect.y0; y < p.rect.y1; ++y)
            for (int x = p.rect.x0; x < p.rect.x1; ++x) s.at(x, y) = {s.blocks, p.samples[i++] > 0.4F, 0};
        ++s.blocks;
    }
    static Numbers finish(State s) {
        Numbers sizes;
        for (int y = s.window.y0; y < s.window.y1; ++y)
            for (int x = s.window.x0; x < s.window.x1; ++x)
                if (s.at(x, y).set && s.at(x, y).size == 0) flood(s, x, y);
        for (const Pixel& p : s.pixels) sizes.values.push_back(p.size);
        return sizes;
    }
    static void flood(State& s, int x0, int y0) {
        std::vector<std::pair<int, int>> found{{x0, y0}};
        s.at(x0, y0).size = -1;
        for (std::size_t i = 0; i < found.size(); ++i)
            for (int d = 0; d < 9; ++d) {
                const int x = found[i].first + d % 3 - 1, y = found[i].second + d / 3 - 1;
                if (!s.window.contains(x, y) || !s.at(x, y).set || s.at(x, y).size != 0) continue;
                const bool corner = d % 2 == 0;
                if (corner && s.at(x, y).block != s.at(found[i].first, found[i].second).block) continue;
                s.at(x, y).size = -1;
                found.emplace_back(x, y);
            }
        for (const auto& [x, y] : found) s.at(x, y).size = static_cast<float>(found.size());
    }
    const Input in;
};

// The mean as each tile's float sum, added in order: another rounding for other tiles.
struct MeanOfTiles {
    static constexpr Info info{"mean_of_tiles", "The frame's mean."};
    using Params = SeamWithoutDiagonals::Params;
    explicit MeanOfTiles(const Params& p) : in(p.in) {}
    struct State {
        float sum = 0, count = 0;
    };
    using Partial = float;
    static State start(const Rect& w) { return {0, static_cast<float>(w.area())}; }
    static std::size_t state_bytes(const Rect&) { return sizeof(State); }
    static std::size_t partial_bytes(const Rect&) { return sizeof(Partial); }
    static std::size_t datum_bytes(const Rect&) { return sizeof(double); }
    float map(const State&, const Inputs& inputs, const Rect& block, Scratch&) const {
        float sum = 0;
        for (int y = block.y0; y < block.y1; ++y)
            for (int i = 0; i < block.width(); ++i) sum += inputs[in][0].row(y)[i];
        return sum;
    }
    static void fold(State& s, float partial) { s.sum += partial; }
    static Numbers finish(State s) { return {{s.sum / s.count}}; }
    const Input in;
};

// A sum of whole numbers, which knows no order.
struct CountsBright : MeanOfTiles {
    static constexpr Info info{"counts_bright", "How many samples of the frame are above 0.4."};
    using MeanOfTiles::MeanOfTiles;
    using State = int64_t;
    using Partial = int64_t;
    static State start(const Rect&) { return 0; }
    int64_t map(State, const Inputs& inputs, const Rect& block, Scratch&) const {
        int64_t count = 0;
        for (int y = block.y0; y < block.y1; ++y)
            for (int i = 0; i < block.width(); ++i) count += inputs[in][0].row(y)[i] > 0.4F ? 1 : 0;
        return count;
    }
    static void fold(State& s, Partial partial) { s += partial; }
    static Numbers finish(State s) { return {{static_cast<double>(s)}}; }
};

// A number that is another in each order of the blocks: folding must not care which of two comes first.
struct FoldsInOrder : MeanOfTiles {
    static constexpr Info info{"folds_in_order", "What the last block begins with."};
    using MeanOfTiles::MeanOfTiles;
    float map(const State&, const Inputs& inputs, const Rect& block, Scratch&) const {
        return *inputs[in][0].at(block.x0, block.y0);
    }
    static void fold(State& s, float partial) { s.sum = partial; }
    static Numbers finish(State s) { return {{s.sum}}; }
};

// Draws what it is given twice over: once as its own input says, and once as the call before left it.
struct ForgetsItsDatum {
    static constexpr Info info{"forgets_its_datum", "A number of the frame, added up over the tiles."};
    struct Params {
        Input in, number;
        static constexpr auto fields =
            declare(input(&Params::in, "in", "A matte.", matte()),
                    input(&Params::number, "number", "A number.", data<Numbers>()));
    };
    static constexpr std::array outputs{"Y"};
    explicit ForgetsItsDatum(const Params& p) : in(p.in), number(p.number) {}
    void compute(const Inputs& inputs, Outputs out, Scratch&) const {
        sum = sum + static_cast<float>(inputs.datum<Numbers>(number).values[0]);
        fill(out[0], [&](int x, int y) { return *inputs[in][0].at(x, y) + sum; });
    }
    const Input in, number;
    mutable std::atomic<float> sum = 0;
};

struct Unexplained : Honest {
    static constexpr Info info{"unexplained", ""};
    using Honest::Honest;
};

struct BadDefault {
    static constexpr Info info{"bad_default", "Its default is out of its range."};
    struct Params {
        double amount = 7;
        static constexpr auto fields = declare(field(&Params::amount, "amount", "How much.", between(0, 4)));
    };
    explicit BadDefault(const Params&) {}
    static Stream expand(Builder&) { return {}; }
};

// Reads back an output that nobody may have asked for.
struct ReadsBack : Honest {
    static constexpr Info info{"reads_back", "Computes its second channel from what it wrote of the first."};
    static constexpr std::array outputs{"one", "other"};
    explicit ReadsBack(const Params& p) : Honest(p), in(p.in) {}
    bool identity() const { return false; }
    Halo halo() const { return {}; }
    void compute(const Inputs& inputs, Outputs out, Scratch&) const {
        const View& image = inputs[in].front();
        fill(out[0], [&](int x, int y) { return *image.at(x, y); });
        fill(out[1], [&](int x, int y) { return 2 * *out[0].at(x, y); });
    }
    const Input in;
};

std::unique_ptr<const Node> make_from_input(const std::vector<FieldInfo>& fields, const Value& object,
                                            ParamReader& reader) {
    Value cleaned = object;
    std::erase_if(cleaned.members, [](const Member& m) { return m.key != "in"; });
    return make_node<Honest>(fields, cleaned, reader);
}

template <class T>
const NodeType& registered() {
    if (!registry().find(T::info.name)) registry().add(make_node_type<T>());
    return *registry().find(T::info.name);
}

#define EXPECT_CAUGHT(check, Node, text) EXPECT_THAT(check(registered<Node>()), Contains(HasSubstr(text)))

TEST(Mutants, AnHonestNodePassesAll) {
    for (const Promise& promise : promises())
        EXPECT_THAT(promise.check(registered<Honest>()), IsEmpty()) << promise.name;
}

TEST(Mutants, AHaloOneShortIsCaught) {
    EXPECT_CAUGHT(check_halo, HaloOneShort, "around the demanded pixels");
}

TEST(Mutants, AnEdgeAtTheTileIsCaught) {
    EXPECT_CAUGHT(check_schedules, EndsAtTheTile, "with tiles of 1 and 1 threads");
    EXPECT_CAUGHT(check_halo, EndsAtTheTile, "in the whole");
}

TEST(Mutants, ATileRelativeValueIsCaught) {
    EXPECT_CAUGHT(check_schedules, TileRelative, "differs at");
    EXPECT_CAUGHT(check_halo, TileRelative, "in the whole");
}

TEST(Mutants, ARunningSumIsCaught) { EXPECT_CAUGHT(check_schedules, RunningSum, "differs at"); }

TEST(Mutants, AStateBetweenCallsIsCaught) { EXPECT_CAUGHT(check_schedules, CountsCalls, "differs at"); }

TEST(Mutants, WritingBesideTheRegionIsCaught) {
    EXPECT_CAUGHT(check_halo, WritesBeside, "outside the region");
}

TEST(Mutants, AFalseIdentityIsCaught) {
    EXPECT_CAUGHT(check_identity, SaysIdentity, "changes nothing, and does");
}

TEST(Mutants, ANodeThatANanBreaksIsCaught) { EXPECT_CAUGHT(check_special_values, DislikesNan, "a NaN"); }

TEST(Mutants, AResultThatEndsAtTheDataWindowIsCaught) {
    EXPECT_CAUGHT(check_extent, EndsAtTheData, "of the whole");
}

TEST(Mutants, ASecondNanIsCaught) {
    EXPECT_CAUGHT(check_special_values, TwoNans, "not the one that computed pixels have");
}

TEST(Mutants, ANodeThatANarrowImageBreaksIsCaught) {
    EXPECT_CAUGHT(check_windows, NeedsTwoPixels, "too narrow");
}

TEST(Mutants, ASeamWithoutDiagonalsIsCaught) {
    EXPECT_CAUGHT(check_schedules, SeamWithoutDiagonals, "the datum is another");
    EXPECT_CAUGHT(check_halo, SeamWithoutDiagonals, "in blocks of");
}

TEST(Mutants, AMeanOfTilesIsCaught) {
    EXPECT_CAUGHT(check_schedules, MeanOfTiles, "the datum is another");
    EXPECT_CAUGHT(check_halo, MeanOfTiles, "in blocks of");
}

TEST(Mutants, AFoldThatDependsOnTheOrderIsCaught) {
    EXPECT_CAUGHT(check_schedules, FoldsInOrder, "the datum is another");
    EXPECT_CAUGHT(check_halo, FoldsInOrder, "in blocks of");
}

TEST(Mutants, AStateBesideADatumIsCaught) {
    registered<CountsBright>();  // gives what it takes
    EXPECT_CAUGHT(check_schedules, ForgetsItsDatum, "differs at");
}

TEST(Mutants, AnHonestGatherPassesAll) {
    for (const Promise& promise : promises())
        EXPECT_THAT(promise.check(registered<CountsBright>()), IsEmpty()) << promise.name;
}

TEST(Mutants, AnOutputThatNeedsAnotherIsCaught) {
    EXPECT_CAUGHT(check_outputs, ReadsBack, "output 1 is another");
}

TEST(Mutants, ANodeWithoutHelpIsCaught) { EXPECT_CAUGHT(check_declaration, Unexplained, "has no help"); }

TEST(Mutants, ADefaultOutOfRangeIsCaught) {
    EXPECT_CAUGHT(check_declaration, BadDefault, "the default of 'amount'");
}

TEST(Mutants, ANodeThatForgetsItsParametersIsCaught) {
    NodeType careless = registered<Honest>();
    careless.make = &make_from_input;
    EXPECT_THAT(check_round_trip(careless), Not(IsEmpty()));
}

}  // namespace
}  // namespace keyline::testing
