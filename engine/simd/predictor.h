// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

// What OpenEXR's ZIP, ZIPS and RLE do to bytes before they are packed: those at even places first, those at
// odd places after them (a half's lower and upper bytes part), then each byte as its difference from the one
// before, plus 128.  Sample bytes are even in number.

namespace keyline::simd {

// 2·`pairs` sample bytes at `from` into what is packed, at `to`.
void split_and_difference(const std::byte* from, std::byte* to, std::size_t pairs);

// Undoes the differences, in place, over all `n` bytes of a block.
void undo_difference(std::byte* bytes, std::size_t n);

// Undoes the split for a run of samples: `to` becomes even[0], odd[0], even[1], odd[1], …
void join_bytes(const std::byte* even, const std::byte* odd, std::byte* to, std::size_t pairs);

}  // namespace keyline::simd
