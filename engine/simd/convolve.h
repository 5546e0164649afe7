// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/simd/rows.h"

#include <vector>

// Convolution with a symmetric kernel in x or in y.  At the edge of the data window the weights that fall
// outside are left out and the rest renormalised.

namespace keyline::simd {

// A symmetric kernel of sum 1.
class Taps {
public:
    // `half[d]` is the weight at distance d, in any unit; not empty, half[0] above 0 and none below.
    explicit Taps(const std::vector<double>& half);

    int radius() const { return static_cast<int>(weights_.size()) - 1; }
    const float* weights() const { return weights_.data(); }  // radius() + 1 of them, by distance

    // What the sum is multiplied by where only `margin` pixels exist on the two sides: 1 / (their weights).
    float edge_scale(Margin margin) const;

private:
    std::vector<float> weights_;
    std::vector<double> within_;  // the sum of the weights at distances 0 … d, on one side
};

// With radius ≤ 16
//     out[i] = w[0] in[i] + (w[1] in[i-1] + w[2] in[i-2] + …  +  (w[1] in[i+1] + w[2] in[i+2] + …))
// and beyond that in blocks of 16 distances, each such a bracket and added in turn, so that rounding errors
// grow with radius / 16 and not with the radius.  A pixel outside the data window counts as 0, and then the
// result is multiplied by edge_scale().  The operations are symmetric: a mirrored image gives the mirrored
// result, bit for bit.  `padded` is room for padded_floats(n, taps), used at the edge.
void convolve_row(const float* in, float* out, int n, Margin margin, const Taps& taps, float* padded);

inline std::size_t padded_floats(int n, const Taps& taps) {
    return static_cast<std::size_t>(n + 2 * taps.radius()) + kMostLanes;
}

// The same down the columns: rows[k] is the row k below, for k from −radius to radius; null outside the data
// window.
void convolve_column(const float* const* rows, float* out, int n, const Taps& taps);

}  // namespace keyline::simd
