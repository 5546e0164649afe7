// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/image.h"
#include "engine/base/index.h"
#include "engine/node/node.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

// How objects share blurred pixels.  All sums are of integers: they don't depend on an order, so that a
// mirrored picture has the mirrored shares, bit for bit.

namespace keyline {

// The objects in a pixel with the most of it, the largest share first.
class Shares {
public:
    struct Share {
        uint32_t id = 0, sum = 0;
    };
    static constexpr int kMost = 6;

    void clear() { size_ = 0, whole_ = 0; }
    void add(uint32_t id, uint32_t sum);  // to what an object has already, while there is room
    void finish();                        // after the last: largest first, the larger id of two equal ones
    uint32_t label() const { return shares_[0].id; }
    double share(uint32_t id) const;  // of the whole pixel

private:
    static constexpr int kRoom = 24;
    std::array<Share, kRoom> shares_{};
    int size_ = 0;
    double whole_ = 0;
};

class BlurredShares {
public:
    // `views` are ids and coverage in turn, or one channel of ids.  `weights` fill a square of
    // 2 × reach + 1 pixels.
    BlurredShares(std::span<const View> views, bool integers, std::span<const uint32_t> weights, int reach,
                  Scratch& scratch);

    bool has(int x, int y) const { return rect_.contains(x, y); }

    // The object that has the pixel for itself; kMixed where several share it.
    static constexpr uint64_t kMixed = uint64_t{1} << 32;
    uint64_t sole(int x, int y) const { return sole_[place(x, y)]; }

    // Whether all pixels that are blurred into this one are one object's alone.
    bool is_plain(int x, int y) const { return busy_[place(x, y)] == 0; }

    void get(int x, int y, Shares& out) const;

private:
    std::size_t place(int x, int y) const {
        return index(y - rect_.y0) * index(rect_.width()) + index(x - rect_.x0);
    }
    template <class Take>
    void each_share(int x, int y, const Take& take) const;
    uint64_t find_sole(int x, int y) const;
    void mark_busy(Scratch& scratch);

    std::span<const View> views_;
    bool integers_;
    std::span<const uint32_t> weights_;
    int reach_;
    Rect rect_;
    std::span<uint64_t> sole_;
    std::span<uint8_t> busy_;
};

// A Gaussian's, as integers that sum to about 2^14.
std::vector<uint32_t> blur_weights(double sigma, int reach);

}  // namespace keyline
