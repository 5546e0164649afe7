// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0

// From 64 pixels to a word of bits and back: pixel i is bit i.
//
// Compiled once for each instruction set, so the guard below is Highway's and not an ordinary one.

#if defined(KEYLINE_ENGINE_SIMD_BITS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef KEYLINE_ENGINE_SIMD_BITS_INL_H_
#undef KEYLINE_ENGINE_SIMD_BITS_INL_H_
#else
#define KEYLINE_ENGINE_SIMD_BITS_INL_H_
#endif

#include "engine/simd/rows-inl.h"

#include <cstring>

HWY_BEFORE_NAMESPACE();
namespace keyline::simd::HWY_NAMESPACE {

constexpr int kWordBits = 64;

// Which of the first `count` ≥ 1 bits of a word exist.
HWY_INLINE uint64_t first_bits(int count) { return ~uint64_t{0} >> (kWordBits - count); }

// Of 64 pixels, those that pass: test(Floats) gives a mask.
template <class Test>
HWY_INLINE uint64_t word_of(const float* pixels, const Test& test) {
    uint64_t word = 0;
    for (int i = 0; i < kWordBits; i += kLanes) {
        uint8_t bytes[8] = {};
        hn::StoreMaskBits(kFloat, test(hn::LoadU(kFloat, pixels + i)), bytes);
        uint64_t bits;
        std::memcpy(&bits, bytes, sizeof bits);
        word |= bits << i;
    }
    return word;
}

// Calls body(pixels, word, exist) for each 64 pixels of a row of n: `pixels` may be read as far as a whole
// word goes, and `exist` has the bits of those that belong to the row.
template <class Body>
HWY_INLINE void for_each_word(const float* in, int n, const Body& body) {
    int i = 0, word = 0;
    for (; i + kWordBits <= n; i += kWordBits) body(in + i, word++, ~uint64_t{0});
    if (i == n) return;
    float rest[kWordBits] = {};
    std::memcpy(rest, in + i, static_cast<size_t>(n - i) * sizeof(float));
    body(rest, word, first_bits(n - i));
}

HWY_INLINE void expand_word(uint64_t word, Floats set, Floats unset, float* out) {
    for (int i = 0; i < kWordBits; i += kLanes) {
        const uint64_t from_i = word >> i;
        uint8_t bytes[8];
        std::memcpy(bytes, &from_i, sizeof bytes);
        hn::StoreU(hn::IfThenElse(hn::LoadMaskBits(kFloat, bytes), set, unset), kFloat, out + i);
    }
}

// out[i] = set or unset, as bit i is.
HWY_INLINE void expand_bits(const uint64_t* bits, int n, Floats set, Floats unset, float* out) {
    int i = 0;
    for (; i + kWordBits <= n; i += kWordBits) expand_word(*bits++, set, unset, out + i);
    if (i == n) return;
    float rest[kWordBits];
    expand_word(*bits, set, unset, rest);
    std::memcpy(out + i, rest, static_cast<size_t>(n - i) * sizeof(float));
}

}  // namespace keyline::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // the guard
