// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/support/targets.h"

#include "engine/base/error.h"

#include <gmock/gmock.h>

namespace keyline {
namespace {

TEST(Targets, ThePortableBodyIsAmongThem) { EXPECT_FALSE(simd::targets().empty()); }

TEST(Targets, AnUnknownOneIsRefusedWithTheKnown) {
    try {
        simd::use_target("MMX");
        FAIL() << "accepted";
    } catch (const Failure& failure) {
        EXPECT_THAT(failure.what(), testing::HasSubstr("'MMX'"));
        EXPECT_THAT(failure.what(), testing::HasSubstr(simd::targets().front()));
    }
}

}  // namespace
}  // namespace keyline
