// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/simd/threshold.h"

#include "tests/support/rows.h"
#include "tests/support/targets.h"

namespace keyline {
namespace {

constexpr uint64_t kUntouched = 0x0123456789ABCDEF;

using Bits = std::vector<uint64_t>;

// What threshold_row must leave in `words` words and the one behind them.
template <class Predicate>
Bits expected_bits(const std::vector<float>& row, const Predicate& is_set) {
    Bits bits(static_cast<std::size_t>(simd::words_for(static_cast<int>(row.size()))), 0);
    for (std::size_t i = 0; i < row.size(); ++i)
        if (is_set(row[i])) bits[i / 64] |= uint64_t{1} << (i % 64);
    bits.push_back(kUntouched);
    return bits;
}

TEST(ThresholdRow, IsTheFormulaOnEveryTarget) {
    test::on_every_target([] {
        for (int n = 0; n <= 200; n += n < 70 ? 1 : 13) {
            const auto row = test::awkward_row(n, static_cast<unsigned>(n));
            const auto words = static_cast<std::size_t>(simd::words_for(n));
            Bits weak(words + 1, kUntouched), strong(words + 1, kUntouched);
            simd::threshold_row(row.data(), n, 1.0F, 2.0F, weak.data(), strong.data());
            EXPECT_EQ(weak, expected_bits(row, [](float v) { return v > 1; })) << n;
            EXPECT_EQ(strong, expected_bits(row, [](float v) { return v >= 2; })) << n;
        }
    });
}

TEST(ThresholdRow, AStrongPixelIsAlsoAboveEqualThresholds) {
    const std::vector<float> row = {1.0F, std::nextafter(1.0F, 2.0F), test::kInfinity, test::kNan};
    uint64_t weak, strong;
    simd::threshold_row(row.data(), 4, 1.0F, 1.0F, &weak, &strong);
    EXPECT_EQ(weak, 0b0110U);
    EXPECT_EQ(strong, 0b0110U);
}

TEST(ExpandRow, GivesOneForEachBitOnEveryTarget) {
    test::on_every_target([] {
        const Bits bits = {0xDEADBEEF00C0FFEE, 0x8000000000000001, 0x5555555555555555};
        for (int n = 0; n <= 192; ++n) {
            std::vector<float> expected;
            for (std::size_t i = 0; i < static_cast<std::size_t>(n); ++i)
                expected.push_back((bits[i / 64] >> (i % 64) & 1) != 0 ? 1.0F : 0.0F);
            test::GuardedRow out(n, n % 3);
            simd::expand_row(bits.data(), n, out.data());
            test::expect_row(out, expected);
        }
    });
}

}  // namespace
}  // namespace keyline
