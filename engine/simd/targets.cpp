// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/simd/targets.h"

#include "engine/base/error.h"

#include <hwy/highway.h>

namespace keyline::simd {

namespace {

// Best first, which is Highway's order; the portable body, which always runs, is the last.
std::vector<int64_t> runnable() {
    std::vector<int64_t> found = hwy::SupportedAndGeneratedTargets();
    if (found.empty() || found.back() != HWY_STATIC_TARGET) found.push_back(HWY_STATIC_TARGET);
    return found;
}

}  // namespace

std::vector<std::string> targets() {
    std::vector<std::string> names;
    for (const int64_t target : runnable()) names.emplace_back(hwy::TargetName(target));
    return names;
}

void use_target(const std::string& name) {
    if (name.empty()) return hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    for (const int64_t target : runnable())
        if (hwy::TargetName(target) == name) return hwy::GetChosenTarget().Update(target);
    fail(ErrorKind::kInternal, "no kernels for " + in_quotes(name) + " here; there are " + listed(targets()));
}

}  // namespace keyline::simd
