// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/kit/crossings.h"
#include "engine/kit/gaussian_field.h"

#include <span>
#include <vector>

// Where a blurred channel passes a level between the centres of neighbouring pixels.  What reaches the level
// is the object 1 there, the rest is nothing.

namespace KEYLINE_API keyline {

class FindLevels final : public Operation {
public:
    static constexpr int kOutputs = 3;
    FindLevels(double sigma, double level) : field_(sigma), level_(static_cast<float>(level)) {}

    Halo halo() const override { return {field_.reach() + 1, field_.reach() + 1}; }
    void compute(const Inputs& in, Outputs out, Scratch& scratch) const override;
    double cost() const override { return 10.0 * field_.reach(); }

private:
    GaussianField field_;
    float level_;
};

// Those of a block of the outputs, in row-major order.
std::vector<Crossing> levels_in(std::span<const View> outputs, const Rect& block);

}  // namespace keyline
