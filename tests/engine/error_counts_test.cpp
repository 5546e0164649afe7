// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/look/differences.h"

#include <gtest/gtest.h>
#include <limits>

namespace keyline {
namespace {

TEST(ErrorCounts, PercentilesAreWithinAPercentAndNotAbove) {
    ErrorCounts counts;
    for (int i = 1; i <= 1000; ++i) counts.add(i * 0.001);
    for (const double share : {0.01, 0.5, 0.95, 0.99, 1.0}) {
        EXPECT_LE(counts.percentile(share), share + 1e-6);
        EXPECT_GE(counts.percentile(share), 0.99 * share);
    }
}

TEST(ErrorCounts, MostSamplesWithoutAnErrorMakeItNothing) {
    ErrorCounts counts;
    for (int i = 0; i < 99; ++i) counts.add(0);
    counts.add(std::numeric_limits<double>::infinity());
    EXPECT_EQ(counts.percentile(0.99), 0);
    EXPECT_EQ(counts.percentile(1), std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace keyline
