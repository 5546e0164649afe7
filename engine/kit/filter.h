// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/base/geometry.h"
#include "engine/params/param_types.h"

// The filters that an image is resampled with, as functions of the distance in pixels from where it is
// sampled.

namespace KEYLINE_API keyline {

// The pixel edge at `v`, or the outermost that a window may reach: how far out a picture is laid is for the
// parameters to say, and refuse_unreachable() says that it is too far.
int nearest_pixel(double v);

// Throws Failure (kGraph) where a window that was laid out by nearest_pixel() would leave what can be
// counted.
void refuse_unreachable(const Rect& window);

enum class Filter { kNearest, kBox, kTriangle, kCubic, kMitchell, kLanczos };

constexpr auto words(Filter) {
    using W = Word<Filter>;
    return std::array{W{"nearest", Filter::kNearest, "the nearest pixel as it is, also when made smaller"},
                      W{"box", Filter::kBox, "the mean over a pixel"},
                      W{"triangle", Filter::kTriangle, "linear between pixels"},
                      W{"cubic", Filter::kCubic, "Catmull and Rom's cubic; sharp, overshoots a little"},
                      W{"mitchell", Filter::kMitchell, "Mitchell and Netravali's cubic, B = C = 1/3; softer"},
                      W{"lanczos", Filter::kLanczos, "a sinc over three pixels; the sharpest, overshoots"}};
}

// Beyond this distance the weight is 0.
double filter_radius(Filter filter);

// The weight of a pixel whose centre is at `x`; of pixels at both ends of a box the lower one counts.
double filter_weight(Filter filter, double x);

// How many times wider a filter becomes where `pixels` of the input lie under one of the output: those that
// average do not skip any.
double filter_stretch(Filter filter, double pixels);

}  // namespace keyline
