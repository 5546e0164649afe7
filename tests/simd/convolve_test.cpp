// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/simd/convolve.h"

#include "tests/support/rows.h"
#include "tests/support/targets.h"

namespace keyline {
namespace {

using simd::Margin;
using simd::Taps;
using test::GuardedRow;

Taps bell(int radius) {
    std::vector<double> half;
    for (int d = 0; d <= radius; ++d) half.push_back(1.0 / (1 + 0.3 * d * d));
    return Taps(half);
}

// The formulas of convolve.h for one pixel; `in` steps from tap to tap by `step`, and `margin` is the pixel's
// own.
float reference(const float* in, std::ptrdiff_t step, Margin margin, const Taps& taps) {
    const float *w = taps.weights(), centre = in[0], scale = taps.edge_scale(margin);
    const auto tap = [&](int k, float missing) {
        return k < -margin.before || k > margin.after ? missing : in[k * step];
    };
    float total = -0.0F, plain = w[0] * centre;
    for (int begin = 1; begin <= taps.radius(); begin += 16) {
        float sum = 0, before = 0, after = 0;
        for (int k = begin; k < begin + 16 && k <= taps.radius(); ++k) {
            const float product = w[k] * ((tap(-k, centre) + tap(k, centre)) - 2 * centre);
            sum = k == begin ? product : sum + product;
            before += w[k] * tap(-k, 0);
            after += w[k] * tap(k, 0);
        }
        total = begin == 1 ? sum : total + sum;
        plain += before + after;
    }
    const float result = centre + scale * total;
    return std::isfinite(result) ? result : test::one_nan(scale * plain);
}

// With no more room for the row's padding than it is said to need.
void convolve_row(const float* in, float* out, int n, Margin margin, const Taps& taps) {
    std::vector<float> workspace(simd::row_workspace(n, taps));
    simd::convolve_row(in, out, n, margin, taps, workspace.data());
}

// Down a column of rows `stride` apart, of which those within the margin exist.
void convolve_column(const float* in, std::ptrdiff_t stride, float* out, int n, Margin margin,
                     const Taps& taps) {
    std::vector<const float*> rows(2 * static_cast<std::size_t>(taps.radius()) + 1);
    const float** const own = rows.data() + taps.radius();
    for (int k = -taps.radius(); k <= taps.radius(); ++k)
        own[k] = k < -margin.before || k > margin.after ? nullptr : in + k * stride;
    simd::convolve_column(own, out, n, margin, taps);
}

std::vector<float> reference_row(const float* in, int n, Margin margin, const Taps& taps) {
    std::vector<float> out;
    for (int i = 0; i < n; ++i)
        out.push_back(reference(in + i, 1, {margin.before + i, margin.after + n - 1 - i}, taps));
    return out;
}

TEST(Taps, AreNormalised) {
    const Taps taps({2, 1});
    ASSERT_EQ(taps.radius(), 1);
    EXPECT_EQ(taps.weights()[0], 0.5F);
    EXPECT_EQ(taps.weights()[1], 0.25F);
    EXPECT_EQ(taps.edge_scale({5, 1}), 1.0F);
    EXPECT_EQ(taps.edge_scale({0, 1}), static_cast<float>(1 / 0.75));
    EXPECT_EQ(taps.edge_scale({0, 0}), 2.0F);
}

TEST(ConvolveRow, IsTheFormulaOnEveryTarget) {
    test::on_every_target([] {
        for (const int radius : {0, 1, 2, 3, 4, 5, 16, 17, 40}) {
            const Taps taps = bell(radius);
            for (int n = 0; n <= 70; ++n) {
                const Margin margin{n % 3 == 0 ? radius + 1 : n % 5, n % 4 == 0 ? radius : n % 7};
                const auto source =
                    test::awkward_row(margin.before + n + margin.after, static_cast<unsigned>(n));
                const float* in = source.data() + margin.before;
                GuardedRow out(n, n % 4);
                convolve_row(in, out.data(), n, margin, taps);
                test::expect_row(out, reference_row(in, n, margin, taps));
            }
        }
    });
}

TEST(ConvolveColumn, IsTheFormulaOnEveryTarget) {
    test::on_every_target([] {
        for (const Margin margin : {Margin{4, 4}, Margin{9, 5}, Margin{0, 4}, Margin{2, 1}, Margin{0, 0}}) {
            const Taps taps = bell(4);
            for (int n = 0; n <= 70; ++n) {
                const int stride = n + 3;
                const int rows = margin.before + 1 + margin.after;
                const auto source = test::awkward_row(stride * rows, static_cast<unsigned>(n));
                const float* in = source.data() + margin.before * stride;
                std::vector<float> expected;
                for (int i = 0; i < n; ++i) expected.push_back(reference(in + i, stride, margin, taps));
                GuardedRow out(n, n % 4);
                convolve_column(in, stride, out.data(), n, margin, taps);
                test::expect_row(out, expected);
            }
        }
    });
}

TEST(ConvolveRow, KeepsAFlatFieldFlatUpToTheEdge) {
    test::on_every_target([] {
        for (const float value : {0.3F, 0.1F, 1e-30F, -7.7F, 1e30F})
            for (const int radius : {1, 3, 6, 20, 100})
                for (const int n : {1, 9, 70, 200}) {
                    const std::vector<float> flat(static_cast<std::size_t>(n), value);
                    std::vector<float> out(flat.size());
                    convolve_row(flat.data(), out.data(), n, {0, 0}, bell(radius));
                    test::expect_same_bits(out, flat);
                    convolve_column(flat.data() + n / 2, 1, out.data(), 1, {n / 2, n - 1 - n / 2},
                                    bell(radius));
                    EXPECT_EQ(out[0], value);
                }
    });
}

TEST(ConvolveRow, AnInfiniteCentreIsNoNan) {
    std::vector<float> row(20, 1.0F), out(20);
    row[10] = test::kInfinity;
    convolve_row(row.data(), out.data(), 20, {0, 0}, bell(4));
    EXPECT_EQ(out[10], test::kInfinity);
    EXPECT_EQ(out[6], test::kInfinity);
    EXPECT_EQ(out[5], 1.0F);
}

TEST(ConvolveRow, TakesABackgroundAtTheTopOfFloat) {
    const std::vector<float> far(20, 3e38F);
    std::vector<float> out(12);
    convolve_row(far.data() + 4, out.data(), 12, {4, 4}, bell(4));
    for (const float value : out) EXPECT_NEAR(value, 3e38F, 1e32F);
}

TEST(ConvolveRow, AMirroredRowGivesTheMirroredResult) {
    const Taps taps = bell(20);
    auto row = test::plain_row(50, 1);
    std::vector<float> out(50), mirrored(50);
    convolve_row(row.data(), out.data(), 50, {0, 0}, taps);
    std::reverse(row.begin(), row.end());
    convolve_row(row.data(), mirrored.data(), 50, {0, 0}, taps);
    std::reverse(mirrored.begin(), mirrored.end());
    test::expect_same_bits(out, mirrored);
}

TEST(ConvolveRow, AWideKernelKeepsItsPrecision) {
    const Taps taps = bell(1250);
    const auto row = test::plain_row(2501, 1);
    double exact = 0, sum = 0;
    for (int k = -1250; k <= 1250; ++k) {
        const double weight = 1.0 / (1 + 0.3 * k * k);
        exact += weight * static_cast<double>(row[static_cast<std::size_t>(1250 + k)]);
        sum += weight;
    }
    float out = 0;
    convolve_row(row.data() + 1250, &out, 1, {1250, 1250}, taps);
    EXPECT_NEAR(out, exact / sum, 1e-6);
}

}  // namespace
}  // namespace keyline
