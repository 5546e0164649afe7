// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/kit/line_points.h"
#include "engine/node/node.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

// Where an object is so thin that both of its outlines would run into each other: points along its middle.
//
// Across something thin, along a row or a column, the sum of its coverage is how wide it is there, however
// its edges lie in the pixels, and the mean place of that coverage is its middle.

namespace KEYLINE_API keyline {

// What of a pixel's row or column is one object's, with something else on both sides.
struct ThinPoint {
    // Where a thin part may lie.
    enum class Place : uint8_t { kAmong, kBefore, kBehind, kBetween };

    LinePoint at;  // its strength is how wide it is across, in pixels; the owner it itself
    std::array<uint32_t, 2> beside{};  // who is on both sides: left and right, or above and below
    float near = 0;                    // 1 / depth of what is seen there; 0: far away, or unknown
    Place place = Place::kAmong;       // by the depths here and on both sides
};

// Finds them.  The inputs are those of FindCrossings.
class FindThinParts final : public Operation {
public:
    static constexpr int kOutputs = 10;
    struct Options {
        double widest = 0;      // pixels
        bool integers = false;  // ids are unsigned integers
    };
    explicit FindThinParts(const Options& options) : options_(options) {}

    Halo halo() const override;
    void compute(const Inputs& in, Outputs out, Scratch& scratch) const override;
    double cost() const override { return 20; }

private:
    Options options_;
};

// Those of a block of the outputs, in row-major order.
std::vector<ThinPoint> thin_points_in(std::span<const View> outputs, const Rect& block);

}  // namespace keyline
