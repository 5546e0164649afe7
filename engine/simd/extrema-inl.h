// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0

// Pixels as integers in the order of their values, so that the maximum of any two is one instruction and does
// not depend on their order: NaN, then −∞ … −0, +0 … +∞; or for the minimum NaN, then +∞ … −∞.
//
// Compiled once for each instruction set, so the guard below is Highway's and not an ordinary one.

#if defined(KEYLINE_ENGINE_SIMD_EXTREMA_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef KEYLINE_ENGINE_SIMD_EXTREMA_INL_H_
#undef KEYLINE_ENGINE_SIMD_EXTREMA_INL_H_
#else
#define KEYLINE_ENGINE_SIMD_EXTREMA_INL_H_
#endif

#include "engine/simd/rows-inl.h"

HWY_BEFORE_NAMESPACE();
namespace keyline::simd::HWY_NAMESPACE {

using IntTag = hn::RebindToSigned<FloatTag>;
using Ints = hn::Vec<IntTag>;
constexpr IntTag kInt;

// The key of a NaN, and of a pixel that does not exist.
constexpr int32_t kAbsent = std::numeric_limits<int32_t>::min();

struct Order {
    int32_t flip;  // −1 turns the order of the others round
    HWY_INLINE explicit Order(Extremum which) : flip(which == Extremum::kMaximum ? 0 : -1) {}

    HWY_INLINE Ints key(Floats v) const {
        const auto key = hn::Xor(sign_folded(hn::BitCast(kInt, v)), hn::Set(kInt, flip));
        return hn::IfThenElse(hn::RebindMask(kInt, hn::IsNaN(v)), hn::Set(kInt, kAbsent), key);
    }
    HWY_INLINE Floats value(Ints key) const {
        const auto bits = sign_folded(hn::Xor(key, hn::Set(kInt, flip)));
        return hn::BitCast(kFloat, hn::IfThenZeroElse(hn::Eq(key, hn::Set(kInt, kAbsent)), bits));
    }

private:
    // Of a negative number's bits all but the sign inverted; its own inverse.
    static HWY_INLINE Ints sign_folded(Ints bits) {
        const auto magnitude = hn::Set(kInt, std::numeric_limits<int32_t>::max());
        return hn::Xor(bits, hn::And(hn::BroadcastSignBit(bits), magnitude));
    }
};

// out[i] = max(a[i], b[i]) for whole vectors, up to one more than n holds.
HWY_INLINE void max_row(const int32_t* a, const int32_t* b, int n, int32_t* out) {
    for (int i = 0; i < n; i += kLanes)
        hn::StoreU(hn::Max(hn::LoadU(kInt, a + i), hn::LoadU(kInt, b + i)), kInt, out + i);
}

HWY_INLINE void fill_absent(int32_t* row, int n) {
    for (int i = 0; i < n; i += kLanes) hn::StoreU(hn::Set(kInt, kAbsent), kInt, row + i);
}

// keys[i] = the key of pixel (x + i, y), for 0 ≤ i < n, and up to a vector more that are absent.
HWY_INLINE void load_keys(const View& in, const Order& order, int x, int y, int n, int32_t* keys) {
    const int first = HWY_MAX(x, in.rect.x0), last = HWY_MIN(x + n, in.rect.x1);
    fill_absent(keys, first - x);
    fill_absent(keys + HWY_MAX(last - x, 0), n - (last - x) + 1);
    const float* pixels = in.at(first, y);
    for_each_vector(kFloat, last - first, [&](auto memory, int i) HWY_ATTR {
        memory.store(order.key(memory.load(kFloat, pixels, i)), kInt, keys + (first - x), i);
    });
}

HWY_INLINE void store_values(const int32_t* keys, const Order& order, int n, float* out) {
    for_each_vector(kFloat, n, [&](auto memory, int i) HWY_ATTR {
        memory.store(order.value(memory.load(kInt, keys, i)), kFloat, out, i);
    });
}

// Calls body(d, a, b) for each distance d ≤ reach at which row y has rows of the output, 0 … height − 1,
// above and below it: a and b, or one of them twice.
template <class Body>
HWY_INLINE void for_each_distance(int y, int height, int reach, const Body& body) {
    for (int d = 0; d <= reach; ++d) {
        const bool above = y - d >= 0 && y - d < height, below = y + d >= 0 && y + d < height;
        if (above || below) body(d, above ? y - d : y + d, below ? y + d : y - d);
    }
}

}  // namespace keyline::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // the guard
