// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/simd/rows.h"

#include <vector>

// Convolution with a symmetric kernel in x or in y.  Where the picture ends the weights that fall outside are
// left out and the rest renormalised.

namespace KEYLINE_API keyline {
namespace simd {

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
//     out[i] = in[i] + s (w[1] ((in[i-1] + in[i+1]) − 2 in[i]) + w[2] ((in[i-2] + in[i+2]) − 2 in[i]) + …)
// and beyond that in blocks of 16 distances, each such a sum and added in turn, so that rounding errors grow
// with radius / 16 and not with the radius.  A pixel that does not exist stands for in[i], and s is then
// edge_scale(), else 1.  So every difference in a constant is 0, and it stays that constant to the last bit.
// The operations are symmetric: a mirrored image gives the mirrored result, bit for bit.
//
// Where that is not finite, as where in[i] is infinite, the result is
//     s (w[0] in[i] + ((w[1] in[i-1] + w[2] in[i-2] + …)  +  (w[1] in[i+1] + w[2] in[i+2] + …)))
// in the same blocks, with 0 for a pixel that does not exist.  `workspace` is room for row_workspace(n,
// taps).
void convolve_row(const float* in, float* out, int n, Margin margin, const Taps& taps, float* workspace);

inline std::size_t row_workspace(int n, const Taps& taps) {
    return 2 * (static_cast<std::size_t>(n + taps.radius()) + kMostLanes);
}

// The same down the columns: rows[k] is the row k below, for k from −radius to radius; those outside the
// margin are not looked at.
void convolve_column(const float* const* rows, float* out, int n, Margin margin, const Taps& taps);

// Of a row the pixels left … right − 1 have all others under their taps; what the rest is computed with.
struct RowEnds {
    int left, right;
    const float* scales;  // edge_scale() of each pixel
    float* padded;        // room for the row with zeros around it
};

}  // namespace simd
}  // namespace keyline
