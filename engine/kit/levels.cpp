// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/levels.h"

#include "engine/base/index.h"

#include <algorithm>

namespace keyline {

namespace {

// From centre to centre, linearly; 0 where both are on one side.
float between(float p, float q, float level) {
    if ((p >= level) == (q >= level)) return 0;
    const float along = (level - p) / (q - p);
    return along == along ? std::clamp(along, 1e-4F, 1 - 1e-4F) : 0.5F;
}

}  // namespace

void FindLevels::compute(const Inputs& in, Outputs out, Scratch& scratch) const {
    const View& view = in.slot(0)[0];
    const Rect& rect = out[0].rect;
    const Rect with_next = intersect(Rect{rect.x0, rect.y0, rect.x1 + 1, rect.y1 + 1}, view.rect);
    const auto width = index(with_next.width());
    const std::span<float> values = scratch.floats(static_cast<std::size_t>(with_next.area()));
    field_.fill(view, with_next, 0, 0, values, scratch);
    for (int y = rect.y0; y < rect.y1; ++y)
        for (int x = rect.x0; x < rect.x1; ++x) {
            const float* here = &values[index(y - rect.y0) * width + index(x - rect.x0)];
            *out[0].at(x, y) = *here >= level_ ? 1.0F : 0.0F;
            *out[1].at(x, y) = x + 1 < with_next.x1 ? between(*here, here[1], level_) : 0.0F;
            *out[2].at(x, y) = y + 1 < with_next.y1 ? between(*here, here[width], level_) : 0.0F;
        }
}

std::vector<Crossing> levels_in(std::span<const View> outputs, const Rect& block) {
    std::vector<Crossing> out;
    for (int y = block.y0; y < block.y1; ++y)
        for (int x = block.x0; x < block.x1; ++x)
            for (const bool down : {false, true}) {
                const float along = *outputs[down ? 2 : 1].at(x, y);
                if (along == 0) continue;
                const uint32_t here = *outputs[0].at(x, y) > 0 ? 1 : 0;
                out.push_back({x, y, down, along, 0, {{{here, along, 0, 1}, {1 - here, along, 0, 1}}}});
            }
    return out;
}

}  // namespace keyline
