// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/blurred_shares.h"

#include "engine/simd/elementary.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace keyline {

namespace {

constexpr uint32_t kWhole = 1U << 16;  // a pixel

uint32_t in_parts(float coverage) {
    return coverage > 0 ? static_cast<uint32_t>(std::lround(std::min(coverage, 1.0F) * kWhole)) : 0;
}

}  // namespace

void Shares::add(uint32_t id, uint32_t sum) {
    int i = 0;
    while (i < size_ && shares_[index(i)].id != id) ++i;
    whole_ += sum;
    if (i == kRoom) return;
    if (i == size_) shares_[index(size_++)] = {id, 0};
    shares_[index(i)].sum += sum;
}

void Shares::finish() {
    const auto end = shares_.begin() + size_, most = shares_.begin() + std::min(size_, kMost);
    std::partial_sort(shares_.begin(), most, end, [](const Share& a, const Share& b) {
        return a.sum != b.sum ? a.sum > b.sum : a.id > b.id;
    });
    size_ = std::min(size_, kMost);
}

double Shares::share(uint32_t id) const {
    for (int i = 0; i < size_; ++i)
        if (const Share& s = shares_[index(i)]; s.id == id) return s.sum / whole_;
    return 0;
}

BlurredShares::BlurredShares(std::span<const View> views, bool integers, std::span<const uint32_t> weights,
                             int reach, Scratch& scratch)
    : views_(views), integers_(integers), weights_(weights), reach_(reach), rect_(views[0].rect) {
    sole_ = scratch.take<uint64_t>(static_cast<std::size_t>(rect_.area()));
    busy_ = scratch.take<uint8_t>(static_cast<std::size_t>(rect_.area()));
    for (int y = rect_.y0; y < rect_.y1; ++y)
        for (int x = rect_.x0; x < rect_.x1; ++x) sole_[place(x, y)] = find_sole(x, y);
    mark_busy(scratch);
}

// take(id, parts) of each object in a pixel, and of nothing.
template <class Take>
void BlurredShares::each_share(int x, int y, const Take& take) const {
    const auto id_of = [&](const View& v) {
        const float id = *v.at(x, y);
        return id == 0 && !integers_ ? 0 : std::bit_cast<uint32_t>(id);  // −0 is nothing, but for integers
    };
    if (views_.size() == 1) return take(id_of(views_[0]), kWhole);
    uint32_t left = kWhole;
    for (std::size_t r = 0; r + 1 < views_.size() && left > 0; r += 2) {
        const uint32_t id = id_of(views_[r]), parts = std::min(in_parts(*views_[r + 1].at(x, y)), left);
        if (parts == 0 || id == 0) continue;
        take(id, parts);
        left -= parts;
    }
    if (left > 0) take(0U, left);
}

uint64_t BlurredShares::find_sole(int x, int y) const {
    // Most pixels are of their first object alone.
    if (views_.size() > 1 && *views_[1].at(x, y) >= 1 && *views_[0].at(x, y) != 0)
        return std::bit_cast<uint32_t>(*views_[0].at(x, y));
    uint64_t sole = kMixed;
    each_share(x, y, [&](uint32_t id, uint32_t parts) {
        if (parts == kWhole) sole = id;
    });
    return sole;
}

// A pixel is busy where within the blur's reach there is a mixed one, or one that differs from a neighbour.
void BlurredShares::mark_busy(Scratch& scratch) {
    const auto rows = scratch.take<uint8_t>(busy_.size());
    std::ranges::fill(busy_, uint8_t{0});
    std::ranges::fill(rows, uint8_t{0});
    for (int y = rect_.y0; y < rect_.y1; ++y)
        for (int x = rect_.x0; x < rect_.x1; ++x) {
            const uint64_t here = sole(x, y);
            if (here != kMixed && (x + 1 == rect_.x1 || sole(x + 1, y) == here) &&
                (y + 1 == rect_.y1 || sole(x, y + 1) == here))
                continue;
            const int from = std::max(x - reach_, rect_.x0), to = std::min(x + reach_ + 1, rect_.x1);
            std::fill_n(rows.begin() + static_cast<std::ptrdiff_t>(place(from, y)), to - from, uint8_t{1});
        }
    for (int y = rect_.y0; y < rect_.y1; ++y)
        for (int v = std::max(y - reach_, rect_.y0); v < std::min(y + reach_ + 1, rect_.y1); ++v) {
            const uint8_t* from = &rows[place(rect_.x0, v)];
            uint8_t* to = &busy_[place(rect_.x0, y)];
            for (int i = 0; i < rect_.width(); ++i) to[i] |= from[i];
        }
}

void BlurredShares::get(int x, int y, Shares& out) const {
    out.clear();
    for (int v = std::max(y - reach_, rect_.y0); v < std::min(y + reach_ + 1, rect_.y1); ++v)
        for (int u = std::max(x - reach_, rect_.x0); u < std::min(x + reach_ + 1, rect_.x1); ++u) {
            const auto row = index(v - y + reach_), column = index(u - x + reach_);
            const uint32_t weight = weights_[row * index(2 * reach_ + 1) + column];
            if (const uint64_t one = sole(u, v); one != kMixed)
                out.add(static_cast<uint32_t>(one), weight * kWhole);
            else
                each_share(u, v, [&](uint32_t id, uint32_t parts) { out.add(id, weight * parts); });
        }
    out.finish();
}

std::vector<uint32_t> blur_weights(double sigma, int reach) {
    const auto weight = [&](int x, int y) { return elementary::exp(-(x * x + y * y) / (2 * sigma * sigma)); };
    double sum = 0;
    for (int y = -reach; y <= reach; ++y)
        for (int x = -reach; x <= reach; ++x) sum += weight(x, y);
    std::vector<uint32_t> out;
    for (int y = -reach; y <= reach; ++y)
        for (int x = -reach; x <= reach; ++x)
            out.push_back(static_cast<uint32_t>(std::lround(weight(x, y) / sum * (1 << 14))));
    return out;
}

}  // namespace keyline
