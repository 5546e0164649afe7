// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/node/node.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

// Where borders between objects cross the lines that join the centres of neighbouring pixels.
//
// Coverage is blurred a little, which takes the noise of sampling out of it; a pixel's label is the object
// that has most of it then.  Where the labels of two neighbours differ there is a crossing, at the place
// where both objects have the same share.  Across a straight border blurred coverage runs as the normal
// distribution does, so that place is found between the probits of the shares, to a hundredth of a pixel.

namespace KEYLINE_API keyline {

struct Crossing {
    struct Side {
        uint32_t id = 0;  // 0: nothing
        float along = 0;  // where this object alone has half; may lie a little beyond the centres
        float near = 0;   // 1 / depth at the border, of the surface carried on to it; 0: far away, or unknown
        float facing = 1;  // cosine of the angle at which the surface is seen; 1 where it is unknown
    };
    int x = 0, y = 0;     // of the first pixel
    bool down = false;    // the second lies below it, else to the right
    float along = 0;      // from centre to centre, above 0 and below 1: where both have the same share
    float steepness = 0;  // how much the probit changes from centre to centre
    std::array<Side, 2> sides;
};

// Finds them: each pixel has its crossings with the right and the lower neighbour.  The first input is a
// Cryptomatte's ranks, or one channel of ids; the second, which may be missing, is the depth.
class FindCrossings final : public Operation {
public:
    static constexpr int kOutputs = 19;
    struct Options {
        double sigma = 0.7;      // of the blur, in pixels
        bool integers = false;   // ids are unsigned integers
        double pixel_angle = 0;  // what a pixel covers at depth 1
    };
    explicit FindCrossings(const Options& options);

    Halo halo() const override;
    void compute(const Inputs& in, Outputs out, Scratch& scratch) const override;
    double cost() const override { return 60; }

private:
    Options options_;
    int reach_;
    std::vector<uint32_t> weights_;  // of the blur, along a row or a column
    int sure_;                       // see sure_within()
};

// Those of a block of the outputs.
std::vector<Crossing> crossings_in(std::span<const View> outputs, const Rect& block);

}  // namespace keyline
