// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/simd/extrema_layout.h"
#include "engine/simd/rows.h"

// What follows foreach_target.h is compiled once for each target.
// clang-format off
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/simd/extrema_mask.cpp"
#include <hwy/foreach_target.h>
#include "engine/simd/bits-inl.h"
#include "engine/simd/extrema-inl.h"
// clang-format on

// As extrema_shape.cpp, with a bit for each pixel: set where it has the greater of the two values.

HWY_BEFORE_NAMESPACE();
namespace keyline::simd::HWY_NAMESPACE {

using WordTag = hn::ScalableTag<uint64_t>;
constexpr WordTag kWords;
constexpr int kWordLanes = static_cast<int>(hn::MaxLanes(kWords));

// The values that occur, by their bits.
struct TwoValues {
    int32_t first, second;
    bool found_second = false;
};

HWY_INLINE uint64_t pixels_equal(const float* pixels, int32_t value) {
    return word_of(pixels, [&](Floats v) HWY_ATTR {
        return hn::RebindMask(kFloat, hn::Eq(hn::BitCast(kInt, v), hn::Set(kInt, value)));
    });
}

// Sets a bit where the pixel has the first value; false where there is a third.
HWY_INLINE bool find_values(const float* in, int n, TwoValues& values, uint64_t* bits) {
    bool two = true;
    for_each_word(in, n, [&](const float* pixels, int word, uint64_t exist) HWY_ATTR {
        const uint64_t first = pixels_equal(pixels, values.first) & exist, others = exist & ~first;
        bits[word] = first;
        if (others == 0 || !two) return;
        if (!values.found_second) {
            values.second = std::bit_cast<int32_t>(pixels[hwy::Num0BitsBelowLS1Bit_Nonzero64(others)]);
            values.found_second = true;
        }
        two = (others & ~pixels_equal(pixels, values.second)) == 0;
    });
    return two;
}

// A line of bits read from some bit on.
class BitReader {
public:
    HWY_INLINE BitReader(const uint64_t* line, int offset)
        : words_(line + offset / kWordBits), shift_(offset % kWordBits) {}

    // The words from word i on.
    HWY_INLINE hn::Vec<WordTag> load(int i) const {
        const auto low = hn::ShiftRightSame(hn::LoadU(kWords, words_ + i), shift_);
        const auto next = hn::ShiftLeft<1>(hn::LoadU(kWords, words_ + i + 1));
        return hn::Or(low, hn::ShiftLeftSame(next, kWordBits - 1 - shift_));
    }

private:
    const uint64_t* words_;
    int shift_;
};

// Line k of `lines`: where one of the 2^k bits from there on is set in line 0.
HWY_INLINE void build_levels(uint64_t* lines, const MaskLayout& layout) {
    for (int k = 1; k < layout.levels; ++k, lines += layout.line) {
        const BitReader ahead(lines, 1 << (k - 1));
        for (int i = 0; i < layout.used; i += kWordLanes)
            hn::StoreU(hn::Or(hn::LoadU(kWords, lines + i), ahead.load(i)), kWords, lines + layout.line + i);
    }
}

// Sets in the rows a and b, which may be the same, the bits set in either of two windows.
HWY_INLINE void raise_rows(const BitReader& left, const BitReader& right, int words, uint64_t* a,
                           uint64_t* b) {
    for (int i = 0; i < words; i += kWordLanes) {
        const auto window = hn::Or(left.load(i), right.load(i));
        const auto raised_a = hn::Or(hn::LoadU(kWords, a + i), window);
        const auto raised_b = hn::Or(hn::LoadU(kWords, b + i), window);
        hn::StoreU(raised_a, kWords, a + i);
        hn::StoreU(raised_b, kWords, b + i);
    }
}

// The part of row y of the input, counted from the output's first, in all rows of the output that see it.
HWY_INLINE void spread_row(const uint64_t* lines, const MaskLayout& layout, int y, const Rect& out,
                           uint64_t* sums) {
    const auto row = [&](int at) { return sums + static_cast<std::ptrdiff_t>(at) * layout.pitch; };
    const int column =
        layout.lead * kWordBits + out.x0 - layout.looked_at.x0;  // the output's first, in a line
    const int words = (out.width() + kWordBits - 1) / kWordBits;
    for_each_distance(y, layout.height, layout.reach_y, [&](int d, int a, int b) HWY_ATTR {
        const int w = layout.shape[static_cast<std::size_t>(d)], length = 2 * w + 1;
        const int level = window_levels(length) - 1, left = column - w;
        const uint64_t* line = lines + static_cast<std::ptrdiff_t>(level) * layout.line;
        const BitReader from_left(line, left), from_right(line, left + length - (1 << level));
        raise_rows(from_left, from_right, words, row(a), row(b));
    });
}

// One row of the input as line 0: bits as they are, or the others of those that exist.  False where none is
// set.
HWY_INLINE bool place_row(const uint64_t* bits, const MaskLayout& layout, bool invert, uint64_t* line) {
    uint64_t any = 0;
    for (int word = 0; word < layout.segment; ++word) {
        const int count = HWY_MIN(kWordBits, layout.looked_at.width() - word * kWordBits);
        line[layout.lead + word] = invert ? ~bits[word] & first_bits(count) : bits[word];
        any |= line[layout.lead + word];
    }
    return any != 0;
}

bool mask(const View& in, const MutView& out, const MaskLayout& layout, Extremum which, uint64_t* workspace) {
    const Rect& area = layout.looked_at;
    uint64_t* bits = workspace;
    TwoValues values{std::bit_cast<int32_t>(*in.at(area.x0, area.y0)), 0};
    for (int y = area.y0; y < area.y1; ++y, bits += layout.segment)
        if (!find_values(in.at(area.x0, y), area.width(), values, bits)) return false;
    if (!values.found_second) values.second = values.first;

    const Order order(which);
    const auto key = [&](int32_t value)
                         HWY_ATTR { return order.key(hn::BitCast(kFloat, hn::Set(kInt, value))); };
    const auto first = key(values.first), second = key(values.second);
    const bool invert = hn::GetLane(second) > hn::GetLane(first);

    uint64_t* lines = bits;
    uint64_t* sums = lines + layout.line_words();
    std::fill_n(lines, layout.line_words() + layout.output_words(), 0);
    bits = workspace;
    for (int y = area.y0; y < area.y1; ++y, bits += layout.segment) {
        if (!place_row(bits, layout, invert, lines)) continue;
        build_levels(lines, layout);
        spread_row(lines, layout, y - out.rect.y0, out.rect, sums);
    }
    const auto greater = order.value(hn::Max(first, second)), less = order.value(hn::Min(first, second));
    for (int y = out.rect.y0; y < out.rect.y1; ++y, sums += layout.pitch)
        expand_bits(sums, out.rect.width(), greater, less, out.row(y));
    return true;
}

}  // namespace keyline::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace keyline::simd {

HWY_EXPORT(mask);

std::size_t mask_workspace(const View& in, const Rect& out, HalfWidths shape) {
    return MaskLayout(in, out, shape).size();
}

bool mask_extremum(const View& in, const MutView& out, HalfWidths shape, Extremum which,
                   std::span<uint64_t> workspace) {
    return HWY_DYNAMIC_DISPATCH(mask)(in, out, MaskLayout(in, out.rect, shape), which, workspace.data());
}

}  // namespace keyline::simd
#endif  // HWY_ONCE
