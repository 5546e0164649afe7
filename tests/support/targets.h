// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/simd/targets.h"

#include <gtest/gtest.h>

namespace keyline::test {

// Calls `check` once for every instruction set that kernels can run on here, and says which when it fails.
template <class Check>
void on_every_target(const Check& check) {
    struct Restore {
        ~Restore() { simd::use_target(""); }
    } restore;
    for (const std::string& target : simd::targets()) {
        SCOPED_TRACE(target);
        simd::use_target(target);
        check();
    }
}

}  // namespace keyline::test
