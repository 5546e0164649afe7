// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/node/node_adaptor.h"
#include "engine/node/pixel_loop.h"

#include <fmt/format.h>

namespace keyline {

namespace {

struct Threshold {
    static constexpr Info info{"threshold", "0 below a value, 1 from it on, with a smooth step between two."};

    struct Params {
        Input in;
        double low = 0;
        std::optional<double> high;

        static constexpr auto fields =
            declare(input(&Params::in, "in", "The image; every channel becomes a matte."),
                    field(&Params::low, "low", "Up to here it is 0.").required(),
                    field(&Params::high, "high", "From here on it is 1; absent: from low on."));
    };

    static constexpr bool makes_mattes = true;

    static void check(const Params& p, Check& c) {
        if (p.high && *p.high < p.low)
            c.error("high", fmt::format("'high' is {}, below 'low', {}", *p.high, p.low),
                    "for a falling step, invert the result with math");
    }

    explicit Threshold(const Params& p) : low(p.low), high(p.high.value_or(p.low)) {}

    // In double: a narrow step multiplies what rounding takes.  NaN is below everything.
    void compute(const View& in, const MutView& out, Scratch&) const {
        const double from = low, to = high;
        if (from == to)
            return for_each_pixel(
                out, [from](float v) { return double{v} >= from ? 1.0F : 0.0F; }, in);
        const auto step = [from, to](float v) {
            const double x = v;
            const double t = x > from ? x < to ? (x - from) / (to - from) : 1.0 : 0.0;
            return static_cast<float>(t * t * (3 - 2 * t));
        };
        for_each_pixel(out, step, in);
    }

    const double low, high;
};

}  // namespace

KEYLINE_NODE(threshold, Threshold)

}  // namespace keyline
