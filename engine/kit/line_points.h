// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/kit/gaussian_field.h"
#include "engine/node/node.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

// Points of lines inside surfaces, to a fraction of a pixel: where something changes most, and where it is
// highest or lowest across its way.

namespace KEYLINE_API keyline {

struct LinePoint {
    int x = 0, y = 0;        // its pixel
    float dx = 0, dy = 0;    // from the pixel's centre; at most 0.6 either way
    float tx = 0, ty = 0;    // along the line, of length 1; of an edge with the larger values on the right
    float strength = 0;      // above 0
    uint32_t owner = 0;      // the object that its pixel shows; 0 where it is not known
    float aside = 0;         // from there across, along the axis that it lies on, to where the line runs
    bool by_column = false;  // that axis is the column
};

enum class LineFeature { kEdge, kRidge, kValley };

// At most one a pixel, with at least a strength.  The first input is one channel; or dx, dy and magnitude,
// for edges, of a gradient that was taken elsewhere.  The second, which may be missing, is the ids of
// objects, as find_object_ids() has them; the third, which may be missing too, normals that edges are placed
// by.
class FindLinePoints final : public Operation {
public:
    static constexpr int kOutputs = 8;
    FindLinePoints(LineFeature feature, double sigma, bool integers, double least)
        : feature_(feature), field_(sigma), integers_(integers), least_(least) {}

    Halo halo() const override;
    void compute(const Inputs& in, Outputs out, Scratch& scratch) const override;
    double cost() const override { return 20.0 * field_.reach(); }

private:
    LineFeature feature_;
    GaussianField field_;
    bool integers_;
    double least_;
};

// Those of a block of the outputs, in row-major order.
std::vector<LinePoint> points_in(std::span<const View> outputs, const Rect& block);

}  // namespace keyline
