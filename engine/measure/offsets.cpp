// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/measure/offsets.h"

#include <algorithm>
#include <cmath>

namespace keyline {

Offsets offsets_of(const std::vector<double>& offs) {
    if (offs.empty()) return {};
    const auto count = static_cast<double>(offs.size());
    Offsets out;
    std::vector<double> sizes;
    for (const double off : offs) {
        out.bias += off / count;
        out.rms += off * off / count;
        sizes.push_back(std::fabs(off));
    }
    out.rms = std::sqrt(out.rms);
    std::ranges::sort(sizes);
    constexpr double kSigmaOfMedian = 1.4826, kMost = 0.95;
    out.robust = kSigmaOfMedian * sizes[sizes.size() / 2];
    out.most = sizes[static_cast<std::size_t>(kMost * (count - 1))];
    return out;
}

}  // namespace keyline
