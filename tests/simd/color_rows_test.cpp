// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/simd/color_rows.h"

#include "tests/support/rows.h"
#include "tests/support/targets.h"

namespace keyline {
namespace {

using Row = std::vector<float>;

// Runs kernel(n, out) on every target for many lengths, and compares with reference(i).
template <class Kernel, class Reference>
void expect_formula(const Kernel& kernel, const Reference& reference) {
    test::on_every_target([&] {
        for (int n = 0; n <= 70; ++n) {
            Row expected;
            for (std::size_t i = 0; i < static_cast<std::size_t>(n); ++i)
                expected.push_back(test::one_nan(reference(i)));
            test::GuardedRow out(n, n % 4);
            kernel(n, out.data());
            test::expect_row(out, expected);
        }
    });
}

const Row kA = test::awkward_row(80, 1), kB = test::awkward_row(80, 2), kC = test::awkward_row(80, 3),
          kPlain = test::plain_row(80, 4);

TEST(WeightedRgbRow, IsTheFormulaOnEveryTarget) {
    expect_formula(
        [](int n, float* out) {
            simd::weighted_rgb_row({kA.data() + 1, kB.data() + 2, kPlain.data()}, {0.3F, 0.6F, 0.1F}, n, out);
        },
        [](std::size_t i) { return (kA[i + 1] * 0.3F + kB[i + 2] * 0.6F) + kPlain[i] * 0.1F; });
}

TEST(ClampRow, IsTheFormulaOnEveryTarget) {
    expect_formula([](int n, float* out) { simd::clamp_row(kA.data(), n, out); },
                   [](std::size_t i) { return kA[i] < 0   ? 0.0F
                                              : kA[i] > 1 ? 1.0F
                                                          : kA[i]; });
}

TEST(ScaleRow, IsTheFormulaOnEveryTarget) {
    expect_formula([](int n, float* out) { simd::scale_row(kA.data(), n, 0.7F, out); },
                   [](std::size_t i) { return kA[i] * 0.7F; });
}

TEST(OverRow, IsTheFormulaOnEveryTarget) {
    const auto check = [](const float* alpha, const float* mask, float mix) {
        expect_formula(
            [&](int n, float* out) {
                simd::over_row(kA.data(), {alpha, mask, mix}, kB.data(), n, out);
            },
            [&](std::size_t i) {
                const float k = mask != nullptr ? mask[i] * mix : mix;
                return kA[i] * k + kB[i] * (1 - (alpha != nullptr ? alpha[i] : 1.0F) * k);
            });
    };
    check(kC.data(), kPlain.data(), 0.3F);
    check(kC.data(), nullptr, 1.0F);
    check(nullptr, kPlain.data(), 1.0F);
    check(nullptr, nullptr, 0.25F);
}

TEST(SignedPowerRow, IsAccurate) {
    for (const double exponent : {1 / 2.2, 1 / 2.4, 0.01, 3.0}) {
        Row in;
        for (float v = 1e-30F; v < 1e12F; v *= 1.37F) in.push_back(in.size() % 2 == 0 ? v : -v);
        Row out(in.size());
        simd::signed_power_row(in.data(), static_cast<int>(in.size()), exponent, out.data());
        for (std::size_t i = 0; i < in.size(); ++i) {
            const double expected = std::copysign(std::pow(std::fabs(in[i]), exponent), in[i]);
            EXPECT_NEAR(out[i], expected, std::fabs(expected) * 1e-7 + 1e-45) << in[i];
        }
    }
}

TEST(SignedPowerRow, KeepsZerosInfinitiesAndNan) {
    const Row in = {0.0F, -0.0F, test::kInfinity, -test::kInfinity, test::kNan, 1.0F, -1.0F};
    Row out(in.size());
    simd::signed_power_row(in.data(), static_cast<int>(in.size()), 1 / 2.2, out.data());
    test::expect_same_bits(out, in);

    const float nan = -test::kNan;
    simd::signed_power_row(&nan, 1, 1 / 2.2, out.data());
    test::expect_same_bits({out.data(), 1}, {&test::kNan, 1});
}

TEST(SignedPowerRow, IsTheSameOnEveryTargetAndForEveryLength) {
    Row first;
    test::on_every_target([&] {
        for (int n = 0; n <= 70; ++n) {
            test::GuardedRow out(n, n % 4);
            simd::signed_power_row(kA.data(), n, 1 / 2.2, out.data());
            if (first.size() < static_cast<std::size_t>(n))
                first.assign(out.pixels().begin(), out.pixels().end());
            test::expect_row(out, std::span(first).first(static_cast<std::size_t>(n)));
        }
    });
}

}  // namespace
}  // namespace keyline
