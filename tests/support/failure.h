// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/error.h"

#include <gtest/gtest.h>

namespace keyline {

// The Failure that is expected of f.
template <class F>
Error error_of(F&& f) {
    try {
        f();
    } catch (const Failure& failure) {
        return failure.error();
    }
    ADD_FAILURE() << "nothing was thrown";
    return {};
}

}  // namespace keyline
