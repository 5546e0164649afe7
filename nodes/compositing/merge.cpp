// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/node/node_adaptor.h"
#include "engine/node/pixel_loop.h"

#include <cmath>

namespace keyline {

namespace {

enum class MergeOperation {
    kOver,
    kUnder,
    kIn,
    kOut,
    kAtop,
    kXor,
    kPlus,
    kMinus,
    kMultiply,
    kScreen,
    kOverlay,
    kSoftlight,
    kHardlight,
    kDarken,
    kLighten,
    kMin,
    kMax,
    kDifference,
    kDivide,
    kAverage
};

// a and b are channels, α and β the A of either.  The ones that name no α are the same on A.
constexpr auto words(MergeOperation) {
    using enum MergeOperation;
    using W = Word<MergeOperation>;
    return std::array{W{"over", kOver, "a + b (1 − α)"},
                      W{"under", kUnder, "a (1 − β) + b"},
                      W{"in", kIn, "a β"},
                      W{"out", kOut, "a (1 − β)"},
                      W{"atop", kAtop, "a β + b (1 − α)"},
                      W{"xor", kXor, "a (1 − β) + b (1 − α)"},
                      W{"plus", kPlus, "a + b, A too"},
                      W{"minus", kMinus, "a − b, A too"},
                      W{"multiply", kMultiply, "a b + a (1 − β) + b (1 − α)"},
                      W{"screen", kScreen, "a + b − a b"},
                      W{"overlay", kOverlay, "hardlight with a and b exchanged"},
                      W{"softlight", kSoftlight, "as W3C Compositing defines it, on premultiplied colour"},
                      W{"hardlight", kHardlight,
                        "2 a b where 2 a ≤ α, else α β − 2 (β − b) (α − a); + a (1 − β) + b (1 − α)"},
                      W{"darken", kDarken, "min(a β, b α) + a (1 − β) + b (1 − α)"},
                      W{"lighten", kLighten, "max(a β, b α) + a (1 − β) + b (1 − α)"},
                      W{"min", kMin, "the smaller, A too"},
                      W{"max", kMax, "the larger, A too"},
                      W{"difference", kDifference, "a + b − 2 min(a β, b α)"},
                      W{"divide", kDivide, "a ÷ b, 0 where b is 0, A too"},
                      W{"average", kAverage, "(a + b) ÷ 2, A too"}};
}

// One pixel of a channel of each input, and their A.
struct Pair {
    float a, alpha, b, beta;

    // What each shows where the other is not.
    float alone() const { return a * (1 - beta) + b * (1 - alpha); }
};

float hardlight(const Pair& p) {
    const float dark = 2 * p.a * p.b, light = p.alpha * p.beta - 2 * (p.beta - p.b) * (p.alpha - p.a);
    return (2 * p.a <= p.alpha ? dark : light) + p.alone();
}

float softlight(const Pair& p) {
    const float lightness = 2 * p.a - p.alpha;  // α (2 Cs − 1)
    const float backdrop = p.beta == 0 ? 0 : p.b / p.beta;
    const float curve =
        backdrop <= 0.25F ? ((16 * backdrop - 12) * backdrop + 4) * backdrop : std::sqrt(backdrop);
    const float toward = lightness <= 0 ? backdrop * (1 - backdrop) : curve - backdrop;
    return p.b * p.alpha + p.beta * lightness * toward + p.alone();
}

// The formula of each operation, as a type, so that its loop is compiled for it alone.
template <MergeOperation kOperation>
struct Formula {
    float operator()(float a, float alpha, float b, float beta) const {
        using enum MergeOperation;
        const Pair p{a, alpha, b, beta};
        switch (kOperation) {
            case kOver: return a + b * (1 - alpha);
            case kUnder: return a * (1 - beta) + b;
            case kIn: return a * beta;
            case kOut: return a * (1 - beta);
            case kAtop: return a * beta + b * (1 - alpha);
            case kXor: return p.alone();
            case kPlus: return a + b;
            case kMinus: return a - b;
            case kMultiply: return a * b + p.alone();
            case kScreen: return a + b - a * b;
            case kOverlay: return hardlight({b, beta, a, alpha});
            case kSoftlight: return softlight(p);
            case kHardlight: return hardlight(p);
            case kDarken: return smaller(a * beta, b * alpha) + p.alone();
            case kLighten: return larger(a * beta, b * alpha) + p.alone();
            case kMin: return smaller(a, b);
            case kMax: return larger(a, b);
            case kDifference: return a + b - 2 * smaller(a * beta, b * alpha);
            case kDivide: return b == 0 ? 0 : a / b;
            case kAverage: break;
        }
        return (a + b) * 0.5F;
    }
};

using Rgba = std::span<const View>;

template <MergeOperation kOperation>
void merge(Rgba a, Rgba b, Outputs out) {
    for (std::size_t c = 0; c < 3; ++c) for_each_pixel(out[c], Formula<kOperation>{}, a[c], a[3], b[c], b[3]);
    // Two colours that are alike differ by nothing, but what they cover stays covered.
    constexpr auto kOnAlpha =
        kOperation == MergeOperation::kDifference ? MergeOperation::kScreen : kOperation;
    for_each_pixel(out[3], Formula<kOnAlpha>{}, a[3], a[3], b[3], b[3]);
}

using Merger = void (*)(Rgba a, Rgba b, Outputs out);

template <std::size_t... kIndices>
constexpr auto make_mergers(std::index_sequence<kIndices...>) {
    return std::array<Merger, sizeof...(kIndices)>{&merge<static_cast<MergeOperation>(kIndices)>...};
}
constexpr auto kMergers = make_mergers(std::make_index_sequence<words(MergeOperation{}).size()>());

// The operation on two inputs that have an A.
struct MergeColour {
    struct Params {
        Input a, b;
        static constexpr auto fields =
            declare(input(&Params::a, "a", "", named("R", "G", "B", "A")),
                    input(&Params::b, "b", "", named("R", "G", "B", "A")).leading());
    };
    static constexpr std::array outputs{"R", "G", "B", "A"};
    static constexpr bool passes_others = true;

    static Rect window(const std::vector<Port>& ports) {
        return unite(ports[0].stream.window, ports[1].stream.window);
    }
    double cost() const { return 30; }

    void compute(const Inputs& in, Outputs out, Scratch&) const { merger(in.slot(0), in.slot(1), out); }

    Merger merger;
};

struct Merge {
    static constexpr Info info{"merge", "Combines two premultiplied colours; other channels of b pass."};

    struct Params : Mixed {
        Input a, b;
        MergeOperation operation = MergeOperation::kOver;

        static constexpr auto fields = declare_mixed(
            input(&Params::a, "a",
                  "What lies on top; without an A it is opaque inside its data window, outside it is 0.",
                  colour()),
            input(&Params::b, "b", "What lies below; likewise.", colour()).leading(),
            field(&Params::operation, "operation", "How the two make one, a first."));
    };
    static constexpr std::array outputs{"R", "G", "B", "A"};

    explicit Merge(const Params& p) : params(p) {}

    Stream expand(Builder& builder) const {
        const MergeColour operation{kMergers[static_cast<std::size_t>(params.operation)]};
        return add_operation(
            builder, operation,
            {with_alpha(builder, builder.input(params.a)), with_alpha(builder, builder.input(params.b))});
    }

    const Params params;
};

}  // namespace

KEYLINE_NODE(merge, Merge)

}  // namespace keyline
