// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/base/channels.h"
#include "engine/node/node_adaptor.h"
#include "engine/node/pixel_loop.h"
#include "engine/simd/elementary.h"

#include <cmath>
#include <fmt/format.h>

namespace keyline {

namespace {

// Those with a second operand come first.
enum class MathOperation {
    kAdd,
    kSubtract,
    kMultiply,
    kDivide,
    kMin,
    kMax,
    kPower,
    kReciprocal,
    kAbs,
    kNegate,
    kInvert,
    kSqrt,
    kExp,
    kLog,
    kClamp
};

constexpr auto words(MathOperation) {
    using enum MathOperation;
    using W = Word<MathOperation>;
    return std::array{W{"add", kAdd, "in + b"},
                      W{"subtract", kSubtract, "in − b"},
                      W{"multiply", kMultiply, "in × b"},
                      W{"divide", kDivide, "in ÷ b, 0 where b is 0"},
                      W{"min", kMin, "the smaller; NaN is passed over"},
                      W{"max", kMax, "the larger; NaN is passed over"},
                      W{"power", kPower, "in to the power of b; NaN below 0"},
                      W{"reciprocal", kReciprocal, "1 ÷ in, 0 where in is 0"},
                      W{"abs", kAbs, "without its sign"},
                      W{"negate", kNegate, "−in"},
                      W{"invert", kInvert, "1 − in"},
                      W{"sqrt", kSqrt, "the square root; NaN below 0"},
                      W{"exp", kExp, "e to the power of in"},
                      W{"log", kLog, "the natural logarithm; −∞ at 0, NaN below"},
                      W{"clamp", kClamp, "limited to 0 … 1"}};
}

constexpr bool is_binary(MathOperation o) { return o < MathOperation::kReciprocal; }

template <MathOperation kOperation>
float of_two(float a, float b) {
    using enum MathOperation;
    switch (kOperation) {
        case kAdd: return a + b;
        case kSubtract: return a - b;
        case kMultiply: return a * b;
        case kDivide: return b == 0 ? 0 : a / b;
        case kMin: return smaller(a, b);
        case kMax: return larger(a, b);
        default: return static_cast<float>(elementary::pow(double{a}, double{b}));
    }
}

template <MathOperation kOperation>
float of_one(float a) {
    using enum MathOperation;
    switch (kOperation) {
        case kReciprocal: return a == 0 ? 0 : 1 / a;
        case kAbs: return std::fabs(a);
        case kNegate: return -a;
        case kInvert: return 1 - a;
        case kSqrt: return std::sqrt(a);
        case kExp: return static_cast<float>(elementary::exp(double{a}));
        case kLog: return static_cast<float>(elementary::log(double{a}));
        default: return a < 0 ? 0 : a > 1 ? 1 : a;
    }
}

// The loop of one operation on one channel; `b` has no pixels where `value` stands for it.
using Loop = void (*)(const MutView& out, const View& a, const View* b, float value);

template <MathOperation kOperation>
void loop(const MutView& out, const View& a, const View* b, float value) {
    if constexpr (!is_binary(kOperation))
        for_each_pixel(out, of_one<kOperation>, a);
    else if (b)
        for_each_pixel(out, of_two<kOperation>, a, *b);
    else
        for_each_pixel(
            out, [value](float v) { return of_two<kOperation>(v, value); }, a);
}

template <std::size_t... kIndices>
constexpr auto make_loops(std::index_sequence<kIndices...>) {
    return std::array<Loop, sizeof...(kIndices)>{&loop<static_cast<MathOperation>(kIndices)>...};
}
constexpr auto kLoops = make_loops(std::make_index_sequence<words(MathOperation{}).size()>());

class Calculation final : public Operation {
public:
    Calculation(MathOperation o, double value)
        : loop_(kLoops[static_cast<std::size_t>(o)]), value_(static_cast<float>(value)) {}

    void compute(const Inputs& in, Outputs out, Scratch&) const override {
        const std::span<const View> b = in.slot(1);
        loop_(out[0], in.slot(0)[0], b.empty() ? nullptr : b.data(), value_);
    }
    double cost() const override { return 10; }

private:
    Loop loop_;
    float value_;
};

struct Math {
    static constexpr Info info{"math", "Arithmetic on every channel."};

    struct Params : Mixed {
        Input in;
        MathOperation op{};
        std::optional<double> value;
        std::optional<Input> b;

        static constexpr auto fields = declare_mixed(
            input(&Params::in, "in", "The first operand.").leading(),
            field(&Params::op, "op", "What to do.").required(),
            field(&Params::value, "value", "The second operand, a number."),
            input(&Params::b, "b", "The second operand: a single channel, or one for each of in's names."));
    };

    static void check(const Params& p, Check& c) {
        if (!is_binary(p.op) && (p.value || p.b))
            c.error(p.value ? "value" : "b", "this operation has no second operand", "leave it out");
        if (is_binary(p.op) && p.value.has_value() == p.b.has_value())
            c.error("value", p.value ? "'value' and 'b' are both given" : "neither 'value' nor 'b' is given",
                    "give one of them");
    }

    explicit Math(const Params& p) : params(p) {}

    Stream expand(Builder& builder) const {
        const Stream in = builder.input(params.in);
        const Stream b = params.b ? builder.input(*params.b) : Stream{};
        const auto operation = std::make_shared<const Calculation>(params.op, params.value.value_or(0));
        Stream result = in;
        tell_of_ids(builder, in);
        for (StreamChannel& c : result.channels) {
            if (c.exact()) continue;
            std::vector<Link> links{{in, {c.value}}, {b, {}}};
            if (params.b) links[1].values = {operand(builder, b, c.name)};
            result.window = result_window(*operation, links, 1);
            c.value = builder.add(operation, std::move(links), result.window, 1).front();
            c.nature = known_of(c.nature);
        }
        return result;
    }

    const Params params;

private:
    // Sums, factors and limits leave light what it is; a factor may be the A.
    Nature known_of(Nature nature) const {
        using enum MathOperation;
        const bool is_factor = params.op == kMultiply || params.op == kDivide;
        const bool is_line = is_factor || params.op == kAdd || params.op == kSubtract || params.op == kMin ||
                             params.op == kMax || params.op == kClamp;
        if (!is_line) nature.colour_for = Nature::For::kUnknown;
        if (!is_line || is_factor) nature.divided = false;
        return nature;
    }

    static ValueRef operand(Builder& builder, const Stream& b, const std::string& name) {
        if (b.channels.size() == 1) return as_number(builder, b.channels[0], b.window);
        const std::vector<std::string> wanted{name};
        return as_number(builder, b.channels[find_channels(b.names(), wanted).front()], b.window);
    }
};

}  // namespace

KEYLINE_NODE(math, Math)

}  // namespace keyline
