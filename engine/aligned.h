// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdlib>
#include <memory>
#include <new>
#include <type_traits>

namespace keyline {

inline constexpr std::size_t kCacheLine = 64;  // and the widest vector

struct FreeMemory {
    void operator()(void* p) const { std::free(p); }
};

// Uninitialised memory for n values, aligned for any vector.
template <class T>
using AlignedArray = std::unique_ptr<T[], FreeMemory>;

template <class T>
AlignedArray<T> make_aligned(std::size_t n) {
    static_assert(std::is_trivially_copyable_v<T>);
    const std::size_t bytes = (n * sizeof(T) + kCacheLine - 1) / kCacheLine * kCacheLine;
    void* p = std::aligned_alloc(kCacheLine, bytes == 0 ? kCacheLine : bytes);
    if (!p) throw std::bad_alloc();
    return AlignedArray<T>(static_cast<T*>(p));
}

}  // namespace keyline
