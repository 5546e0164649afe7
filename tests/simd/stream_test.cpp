// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/simd/stream.h"

#include "tests/support/rows.h"
#include "tests/support/targets.h"

namespace keyline {
namespace {

TEST(StreamRow, CopiesFromAndToAnyPlaceOnEveryTarget) {
    test::on_every_target([] {
        for (int n = 0; n <= 100; ++n) {
            const auto row = test::awkward_row(n + 3, static_cast<unsigned>(n));
            const auto from =
                std::span(row).subspan(static_cast<std::size_t>(n % 3), static_cast<std::size_t>(n));
            test::GuardedRow out(n, n % 17);
            simd::stream_row(from.data(), out.data(), n);
            simd::finish_stream();
            test::expect_row(out, from);
        }
    });
}

}  // namespace
}  // namespace keyline
