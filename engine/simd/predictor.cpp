// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/simd/predictor.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/simd/predictor.cpp"
#include <algorithm>
#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace keyline::simd::HWY_NAMESPACE {  // NOLINT(modernize-concat-nested-namespaces)

namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET != HWY_SCALAR
// Sums whole blocks of 16 bytes, whatever the target: the sum runs across them one after the other.  Returns
// how many bytes are done.
std::size_t sum_blocks(uint8_t* bytes, std::size_t n) {
    constexpr hn::FixedTag<uint8_t, 16> d;
    const auto bias = hn::Set(d, 128);
    const auto last_everywhere = hn::Set(d, 15);
    auto carry = bias;  // the first byte stands as it is: this takes its bias back
    std::size_t i = 0;
    for (; i + 16 <= n; i += 16) {
        auto sum = hn::Add(hn::LoadU(d, bytes + i), bias);
        sum = hn::Add(sum, hn::ShiftLeftBytes<1>(d, sum));
        sum = hn::Add(sum, hn::ShiftLeftBytes<2>(d, sum));
        sum = hn::Add(sum, hn::ShiftLeftBytes<4>(d, sum));
        sum = hn::Add(sum, hn::ShiftLeftBytes<8>(d, sum));
        const auto total = hn::TableLookupBytes(sum, last_everywhere);
        hn::StoreU(hn::Add(sum, carry), d, bytes + i);
        carry = hn::Add(carry, total);
    }
    return i;
}
#else
std::size_t sum_blocks(uint8_t*, std::size_t) { return 0; }  // bytes one by one, below
#endif

void UndoDifference(uint8_t* bytes, std::size_t n) {
    for (std::size_t i = std::max<std::size_t>(sum_blocks(bytes, n), 1); i < n; ++i)
        bytes[i] = static_cast<uint8_t>(bytes[i - 1] + bytes[i] + 128);
}

}  // namespace keyline::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace keyline::simd {

HWY_EXPORT(UndoDifference);

void undo_difference(std::byte* bytes, std::size_t n) {
    HWY_DYNAMIC_DISPATCH(UndoDifference)(reinterpret_cast<uint8_t*>(bytes), n);
}

// These two the compiler turns into vectors by itself.

void split_and_difference(const std::byte* from, std::byte* to, std::size_t pairs) {
    if (pairs == 0) return;
    const auto* HWY_RESTRICT in = reinterpret_cast<const uint8_t*>(from);
    auto* HWY_RESTRICT even = reinterpret_cast<uint8_t*>(to);
    auto* HWY_RESTRICT odd = even + pairs;
    even[0] = in[0];
    odd[0] = static_cast<uint8_t>(in[1] - in[2 * pairs - 2] + 128);
    for (std::size_t i = 1; i < pairs; ++i) even[i] = static_cast<uint8_t>(in[2 * i] - in[2 * i - 2] + 128);
    for (std::size_t i = 1; i < pairs; ++i)
        odd[i] = static_cast<uint8_t>(in[2 * i + 1] - in[2 * i - 1] + 128);
}

void join_bytes(const std::byte* even, const std::byte* odd, std::byte* to, std::size_t pairs) {
    const std::byte* HWY_RESTRICT a = even;
    const std::byte* HWY_RESTRICT b = odd;
    std::byte* HWY_RESTRICT out = to;
    for (std::size_t i = 0; i < pairs; ++i) {
        out[2 * i] = a[i];
        out[2 * i + 1] = b[i];
    }
}

}  // namespace keyline::simd
#endif  // HWY_ONCE
