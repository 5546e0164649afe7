// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/node/node.h"

#include <cstdint>
#include <vector>

// 8-connected components of a bitmap, found block by block and joined across the blocks' borders.  Components
// that hold a seed are kept whole, the others go.  Time is linear in the pixels and the runs, memory two bits
// a pixel and twelve bytes for each run of a component whose fate a block can't tell alone.

namespace KEYLINE_API keyline {

// A bitmap: pixel (x, y) is bit (x − rect.x0) % 64 of word (x − rect.x0) / 64 of its row.  Bits behind a
// row's last pixel are 0.
class BitRows {
public:
    static constexpr const char* kind = "bitmap";

    BitRows() = default;
    explicit BitRows(const Rect& rect);

    const Rect& rect() const { return rect_; }
    int words() const { return words_; }  // of a row
    std::size_t bytes() const { return bits_.size() * sizeof(uint64_t); }
    static std::size_t bytes_for(const Rect& rect);
    friend bool operator==(const BitRows&, const BitRows&) = default;
    uint64_t* row(int y) { return bits_.data() + offset(y); }
    const uint64_t* row(int y) const { return bits_.data() + offset(y); }
    bool test(int x, int y) const {
        const int i = x - rect_.x0;
        return (row(y)[i / 64] >> (i % 64) & 1U) != 0;
    }

    void set(int y, int x0, int x1);  // x0 ≤ x < x1
    bool any(int y, int x0, int x1) const;
    void add(const BitRows& block);  // bits of a bitmap inside this one

    // n pixels of row y from x0 on, from bit 0 of `to` on; words_for(n) words, of which the bits behind the
    // last pixel may be anything.
    void copy_row(int y, int x0, int n, uint64_t* to) const;

private:
    std::size_t offset(int y) const {
        return static_cast<std::size_t>(y - rect_.y0) * static_cast<std::size_t>(words_);
    }

    Rect rect_;
    int words_ = 0;
    std::vector<uint64_t> bits_;
};

struct PixelRun {
    int y = 0, x0 = 0, x1 = 0;  // x0 ≤ x < x1
};

// What one block knows: the pixels that are kept for certain, and the components that touch its border.
struct BlockComponents {
    static constexpr int kNone = -1;

    BitRows kept;
    // Components that touch the border, numbered from 0: whether they hold a seed, and for those that don't,
    // the runs they are made of (of component i: runs[first_run[i]] up to runs[first_run[i + 1]]).
    std::vector<bool> seeded;
    std::vector<std::size_t> first_run;
    std::vector<PixelRun> runs;
    // Their numbers along the border; kNone elsewhere.
    std::vector<int> top, bottom, left, right;
};

// `seeds` is a subset of `pixels`, of the same rectangle.
BlockComponents find_components(const BitRows& pixels, const BitRows& seeds, Scratch& scratch);

// Joins blocks added in row-major order of one grid over the window.
class ComponentMerger {
public:
    explicit ComponentMerger(const Rect& window);

    void add(BlockComponents block);

    // After the last block: the pixels of components that hold a seed.
    BitRows finish();

private:
    int find(int label);
    void join(int a, int b);
    void join_above(const Rect& block, const std::vector<int>& top, int base);
    void join_left(const Rect& block, const std::vector<int>& left, int base);

    BitRows kept_;
    std::vector<int> parent_;
    std::vector<bool> seeded_;
    std::vector<BlockComponents> undecided_;  // blocks with components without a seed at their border
    std::vector<int> undecided_base_;

    int row_y_ = 0;            // of the row of blocks being added
    std::vector<int> above_;   // labels of the pixels over that row, by column of the window
    std::vector<int> bottom_;  // of its own last row of pixels, so far
    std::vector<int> right_;   // of the last column of the block added before
    int right_x_ = 0;
};

}  // namespace keyline
