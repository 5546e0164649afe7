// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/image.h"
#include "engine/base/index.h"
#include "engine/node/node.h"

#include <climits>
#include <cstdint>
#include <span>
#include <vector>

// How objects share blurred pixels.  All sums are of integers: they don't depend on an order, so that a
// mirrored picture has the mirrored shares, bit for bit.
//
// Most pixels are one object's alone, far from any other: nothing is computed for them.  The others are
// blurred along rows first and then across them, each as a short list of objects.

namespace keyline {

struct Share {
    uint32_t id = 0;  // 0: nothing
    uint64_t sum = 0;
};

// What objects have of the pixels of a row, a list for each pixel that was given one.
class ShareLists {
public:
    explicit ShareLists(std::size_t pixels) : lists_(pixels) {}

    void clear() { used_ = 0; }
    std::span<const Share> operator[](std::size_t pixel) const {
        return {shares_.data() + lists_[pixel].first, lists_[pixel].count};
    }

    // A list in the making; one at a time.
    class Open {
    public:
        explicit Open(ShareLists& lists) : lists_(lists), place_(lists.room(0)) {}
        void add(uint32_t id, uint64_t sum) {  // to what the object has already
            for (Share* s = place_.end; s-- != place_.begin;)
                if (s->id == id) {
                    s->sum += sum;
                    return;
                }
            if (place_.end == place_.limit)
                place_ = lists_.room(static_cast<std::size_t>(place_.end - place_.begin));
            *place_.end++ = {id, sum};
        }
        uint32_t close(std::size_t pixel);  // whose most of it is; of two equal ones the larger id

    private:
        ShareLists& lists_;
        struct Place {
            Share *begin, *end, *limit;
        } place_;
        friend ShareLists;
    };

private:
    struct List {
        std::size_t first = 0, count = 0;
    };
    Open::Place room(std::size_t taken);  // for more than the shares that an open list has

    std::vector<List> lists_;
    std::vector<Share> shares_;
    std::size_t used_ = 0;  // of them
};

// The pixels of a region before they are blurred.
class SharedPixels {
public:
    // `views` are ids and coverage in turn, or one channel of ids; a pixel is blurred with those within
    // `reach` of it, and where all within `sure` are one object's, nothing can change whose it is.
    SharedPixels(std::span<const View> views, bool integers, int reach, int sure, Scratch& scratch);

    const Rect& rect() const { return rect_; }
    int reach() const { return reach_; }

    // Whether the object has the pixel for itself.
    bool shows(uint32_t id, int x, int y) const {
        return rect_.contains(x, y) && mixed_[place(x, y)] == 0 && sole_[place(x, y)] == id;
    }

    // Rows, from the region's left.  Whose each pixel is; whether objects meet within reach of it in its row,
    // and whether they do so near, in any direction, that its label is not sure.
    const uint32_t* soles(int y) const { return &sole_[place(rect_.x0, y)]; }
    const uint8_t* near_in_row(int y) const { return &near_in_row_[place(rect_.x0, y)]; }
    const uint8_t* near(int y) const { return &near_[place(rect_.x0, y)]; }
    bool is_near_any(int y) const { return row_is_near_[index(y - rect_.y0)] != 0; }
    bool meets_any(int y) const { return row_meets_[index(y - rect_.y0)] != 0; }  // in the row itself
    const uint8_t* mixed(int y) const { return &mixed_[place(rect_.x0, y)]; }

    // take(id, parts) of each object in a pixel, and of nothing: kWhole in all.
    static constexpr uint32_t kWhole = 1U << 16;
    template <class Take>
    void each(int x, int y, const Take& take) const;

private:
    std::size_t place(int x, int y) const {
        return index(y - rect_.y0) * index(rect_.width()) + index(x - rect_.x0);
    }
    uint32_t id_at(const View& view, int x, int y) const;
    void find_soles(int y);
    void find_sole(int x, int y);
    bool mark_meetings(int y, std::span<uint8_t> meets) const;
    void mark_near(Scratch& scratch);

    std::span<const View> views_;
    bool integers_;
    int reach_, sure_;
    Rect rect_;
    std::span<uint32_t> sole_;
    std::span<uint8_t> mixed_, near_in_row_, near_, row_is_near_, row_meets_;
};

// Rows of it, blurred.  They are asked for from top to bottom.
class BlurredRows {
public:
    // `weights` are the blur's, by distance from −reach to reach.
    BlurredRows(const SharedPixels& pixels, std::span<const uint32_t> weights);

    // One row: who has most of each pixel, and how much an object has.
    class Row {
    public:
        explicit Row(std::size_t pixels) : labels_(pixels), blurred_(pixels), lists_(pixels) {}
        std::span<const uint32_t> labels() const { return labels_; }
        double share(std::size_t pixel, uint32_t id) const;  // of the whole pixel

    private:
        friend BlurredRows;
        std::vector<uint32_t> labels_;
        std::vector<uint8_t> blurred_;  // whether it has a list; else it is its label's alone
        ShareLists lists_;
    };
    void fill(int y, Row& row);

private:
    struct Along {
        int y = INT_MIN;
        ShareLists lists;
    };
    // A row that a pixel is blurred across.
    struct Crossed {
        uint64_t weight;
        const uint32_t* soles;
        const uint8_t* near_in_row;
        const ShareLists* lists;
    };
    void find_crossed(int y);
    uint32_t blur_across(std::size_t pixel, ShareLists& to) const;
    const ShareLists& along(int y);
    void blur_along(std::size_t pixel, int y, ShareLists& to) const;

    const SharedPixels& pixels_;
    std::span<const uint32_t> weights_;
    std::vector<uint64_t> whole_;  // by column: what a pixel weighs that is one object's in its row
    std::vector<Along> along_;     // rows blurred along themselves, by y modulo their number
    std::vector<Crossed> crossed_;
    ShareLists mixed_;  // what each has of the mixed pixels of the row that is blurred along itself
};

// A Gaussian's, as integers that sum to about 2^12.
std::vector<uint32_t> blur_weights(double sigma, int reach);

// How far around a pixel all must be one object's so that it has more than half of that pixel and of each
// beside it, whatever is farther away and wherever the picture ends; at most the blur's reach.
int sure_within(std::span<const uint32_t> weights);

}  // namespace keyline
