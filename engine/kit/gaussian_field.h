// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/base/image.h"
#include "engine/node/node.h"

#include <array>
#include <span>
#include <vector>

// A channel under a Gaussian, and its slopes and bends there, by separable kernels of floats.  Beyond the end
// of the picture its last pixels go on.

namespace KEYLINE_API keyline {

class GaussianField {
public:
    explicit GaussianField(double sigma);

    int reach() const { return reach_; }

    // Of order (x, y): (0, 0) the blurred channel, (1, 0) its slope in x, (1, 1) the mixed second derivative
    // … Fills `out` with the pixels of `rect`, row by row.
    void fill(const View& in, const Rect& rect, int order_x, int order_y, std::span<float> out,
              Scratch& scratch) const;

private:
    int reach_;
    std::array<std::vector<float>, 3> kernels_;  // by order, from −reach to reach
};

}  // namespace keyline
