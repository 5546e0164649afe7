// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"

#include <algorithm>
#include <cstdint>
#include <type_traits>

namespace KEYLINE_API keyline {

// Calls take(i) for those of n values, in order, for which holds(value) does.  Made for rows in which few do:
// the others are looked at several at once.
template <class T, class Holds, class Take>
void each_where(const T* values, int n, const Holds& holds, const Take& take) {
    using Mark = std::conditional_t<sizeof(T) == 1, uint8_t, uint32_t>;  // as wide as a value
    constexpr int kAtOnce = 32;
    for (int begin = 0; begin < n; begin += kAtOnce) {
        const int end = std::min(begin + kAtOnce, n);
        Mark any = end - begin < kAtOnce ? 1 : 0;
        if (any == 0)
            for (int i = 0; i < kAtOnce; ++i) any |= static_cast<Mark>(holds(values[begin + i]));
        for (int i = begin; any != 0 && i < end; ++i)
            if (holds(values[i])) take(i);
    }
}

}  // namespace keyline
