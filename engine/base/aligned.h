// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <memory>
#include <new>
#include <sys/mman.h>
#include <type_traits>

namespace KEYLINE_API keyline {

inline constexpr std::size_t kCacheLine = 64;  // and the widest vector
inline constexpr std::size_t kHugePage = std::size_t{2} << 20;

struct FreeMemory {
    void operator()(void* p) const { std::free(p); }
};

// Uninitialised memory for n values, aligned for any vector.  What is as large as a huge page lies on huge
// pages, where the system has them: it is then cleared in a few steps and not in thousands.
template <class T>
using AlignedArray = std::unique_ptr<T[], FreeMemory>;

template <class T>
AlignedArray<T> make_aligned(std::size_t n) {
    static_assert(std::is_trivially_copyable_v<T>);
    const std::size_t bytes = n * sizeof(T);
    const std::size_t alignment = bytes >= kHugePage ? kHugePage : kCacheLine;
    void* p = std::aligned_alloc(alignment,
                                 std::max<std::size_t>(1, (bytes + alignment - 1) / alignment) * alignment);
    if (!p) throw std::bad_alloc();
    // A hint, which may fail.  The end lies on small pages, as many as are touched.
    if (bytes >= kHugePage) madvise(p, bytes / kHugePage * kHugePage, MADV_HUGEPAGE);
    return AlignedArray<T>(static_cast<T*>(p));
}

}  // namespace keyline
