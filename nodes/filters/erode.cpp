// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/brush.h"
#include "engine/node/node_adaptor.h"
#include "engine/simd/extrema.h"

namespace keyline {

namespace {

struct Erode {
    static constexpr Info info{"erode",
                               "The smallest value within a brush around each pixel: makes mattes smaller."};

    struct Params {
        Input in;
        double radius = 1;
        Brush shape = Brush::kDisk;

        static constexpr auto fields =
            declare(input(&Params::in, "in", "The image; each channel by itself."),
                    field(&Params::radius, "radius", "The size of the brush; 0 passes the image on.",
                          px(0, 1000).tested_to(4)),
                    field(&Params::shape, "shape", "The brush."));
    };

    explicit Erode(const Params& p) : widths(half_widths(p.shape, p.radius)) {}

    bool identity() const { return widths.size() == 1; }
    Halo halo() const { return {widths.front(), static_cast<int>(widths.size()) - 1}; }
    double cost() const { return 4.0 * static_cast<double>(widths.size()); }

    void compute(const View& in, const MutView& out, Scratch& scratch) const {
        simd::extremum(in, out, widths, simd::Extremum::kMinimum, scratch);
    }

    const std::vector<int> widths;  // by distance in y
};

}  // namespace

KEYLINE_NODE(erode, Erode)

}  // namespace keyline
