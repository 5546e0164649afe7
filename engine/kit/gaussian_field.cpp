// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/gaussian_field.h"

#include "engine/base/index.h"
#include "engine/simd/elementary.h"

#include <algorithm>
#include <cmath>

namespace keyline {

// Each is exact for the polynomial of its own order: a slope for ramps, a bend for parabolas.
GaussianField::GaussianField(double sigma) : reach_(static_cast<int>(std::ceil(3 * sigma))) {
    const auto bell = [&](int k) { return sigma > 0 ? elementary::exp(-k * k / (2 * sigma * sigma)) : 1.0; };
    double sum = 0, second = 0, fourth = 0;
    for (int k = -reach_; k <= reach_; ++k) sum += bell(k);
    for (int k = -reach_; k <= reach_; ++k) {
        const double k2 = k * k, share = bell(k) / sum;
        second += k2 * share;
        fourth += k2 * k2 * share;
    }
    for (int k = -reach_; k <= reach_; ++k) {
        const double share = bell(k) / sum;
        kernels_[0].push_back(static_cast<float>(share));
        kernels_[1].push_back(static_cast<float>(k * share / second));
        kernels_[2].push_back(static_cast<float>(2 * (k * k - second) * share / (fourth - second * second)));
    }
}

void GaussianField::fill(const View& in, const Rect& rect, int order_x, int order_y, std::span<float> out,
                         Scratch& scratch) const {
    const std::vector<float>& across = kernels_[index(order_x)];
    const std::vector<float>& down = kernels_[index(order_y)];
    const auto width = index(rect.width());
    const std::span<float> padded = scratch.floats(width + 2 * index(reach_)), row = scratch.floats(width);
    std::ranges::fill(out, 0.0F);
    const auto clamped = [](int v, int low, int high) { return std::clamp(v, low, high - 1); };
    for (int y = rect.y0 - reach_; y < rect.y1 + reach_; ++y) {
        for (std::size_t i = 0; i < padded.size(); ++i) {
            const int x = rect.x0 - reach_ + static_cast<int>(i);
            padded[i] = *in.at(clamped(x, in.rect.x0, in.rect.x1), clamped(y, in.rect.y0, in.rect.y1));
        }
        std::ranges::fill(row, 0.0F);
        for (std::size_t k = 0; k < across.size(); ++k)
            for (std::size_t i = 0; i < width; ++i) row[i] += across[k] * padded[i + k];
        for (int v = std::max(rect.y0, y - reach_); v < std::min(rect.y1, y + reach_ + 1); ++v) {
            const float weight = down[index(y - v + reach_)];
            float* to = &out[index(v - rect.y0) * width];
            for (std::size_t i = 0; i < width; ++i) to[i] += weight * row[i];
        }
    }
}

}  // namespace keyline
