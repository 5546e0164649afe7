// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/simd/gradient.h"

#include "tests/support/rows.h"
#include "tests/support/targets.h"

#include <array>

namespace keyline {
namespace {

using simd::GradientOperator;
using simd::Margin;
using simd::Rows3;
using test::GuardedRow;

struct Sample {
    double dx, dy, magnitude;
};

// Three rows of awkward or plain pixels, with room for any margin of 1 or more.
struct Channel {
    Channel(int n, unsigned seed, std::vector<float> (*make)(int, unsigned))
        : pixels(make(3 * (n + 2), seed)), stride(n + 2) {}
    Rows3 rows() const {
        const float* at = pixels.data() + stride + 1;
        return {at - stride, at, at + stride};
    }
    std::vector<float> pixels;
    std::ptrdiff_t stride;
};

// The derivatives at pixel i as gradient.h gives them, in T.
template <class T>
std::pair<T, T> derivatives(GradientOperator op, const Rows3& rows, int i, int n, Margin margin) {
    const int left = i == 0 && margin.before == 0 ? i : i - 1,
              right = i == n - 1 && margin.after == 0 ? i : i + 1;
    const auto d = [](float to, float from) { return static_cast<T>(to) - static_cast<T>(from); };
    const T dx = d(rows.at[right], rows.at[left]), dy = d(rows.below[i], rows.above[i]);
    if (op == GradientOperator::kCentral) return {dx, dy};
    const bool sobel = op == GradientOperator::kSobel, prewitt = op == GradientOperator::kPrewitt;
    const T corner = static_cast<T>(sobel ? 1.0 / 8 : prewitt ? 1.0 / 6 : 3.0 / 32);
    const T side = static_cast<T>(sobel ? 2.0 / 8 : prewitt ? 1.0 / 6 : 10.0 / 32);
    return {
        (corner * d(rows.above[right], rows.above[left]) + corner * d(rows.below[right], rows.below[left])) +
            side * dx,
        (corner * d(rows.below[left], rows.above[left]) + corner * d(rows.below[right], rows.above[right])) +
            side * dy};
}

float reference_length(float dx, float dy) {
    const float squares = dx * dx + dy * dy;
    if ((squares >= 0x1p-80F && squares <= 0x1p120F) || (dx == 0 && dy == 0)) return std::sqrt(squares);
    const float scale = std::fabs(dx) > 1 || std::fabs(dy) > 1 ? 0x1p-100F : 0x1p100F;
    const float x = dx * scale, y = dy * scale;
    return std::sqrt(x * x + y * y) * (1 / scale);
}

constexpr std::array kOperators = {GradientOperator::kCentral, GradientOperator::kSobel,
                                   GradientOperator::kPrewitt, GradientOperator::kScharr};

void check_one_channel(GradientOperator op, int n, Margin margin) {
    const Channel channel(n, static_cast<unsigned>(n), test::awkward_row);
    const Rows3 rows = channel.rows();
    std::vector<float> dx, dy, magnitude;
    for (int i = 0; i < n; ++i) {
        const auto [x, y] = derivatives<float>(op, rows, i, n, margin);
        dx.push_back(test::one_nan(x));
        dy.push_back(test::one_nan(y));
        magnitude.push_back(test::one_nan(reference_length(x, y)));
    }
    GuardedRow out_dx(n), out_dy(n, 1), out_magnitude(n, 2);
    simd::gradient_row(op, {&rows, 1}, n, margin, {out_dx.data(), out_dy.data(), out_magnitude.data()});
    test::expect_row(out_dx, dx);
    test::expect_row(out_dy, dy);
    test::expect_row(out_magnitude, magnitude);
}

TEST(GradientRow, IsTheFormulaOnEveryTarget) {
    test::on_every_target([] {
        for (const GradientOperator op : kOperators)
            for (int n = 0; n <= 70; ++n) check_one_channel(op, n, {n % 2, n / 2 % 2});
    });
}

TEST(GradientRow, TheLengthNeitherOverflowsNorUnderflows) {
    for (const float unit : {1e30F, 1e-30F, 1e-42F, 3e37F, 1e-15F, 1.0F}) {
        const std::array<float, 3> above{0, 0, 0}, at{0, 0, 3 * unit}, below{0, 4 * unit, 0};
        const Rows3 rows{above.data() + 1, at.data() + 1, below.data() + 1};
        float dx, dy, magnitude;
        simd::gradient_row(GradientOperator::kCentral, {&rows, 1}, 1, {1, 1}, {&dx, &dy, &magnitude});
        EXPECT_NEAR(magnitude / unit, 5, unit < 1e-40F ? 0.01 : 1e-5) << unit;
    }
}

TEST(GradientRow, HasOneSidedDifferencesAtTheEnds) {
    const std::array<float, 3> row{1, 4, 9};
    const Rows3 rows{row.data(), row.data(), row.data()};
    std::array<float, 3> dx, dy, magnitude;
    simd::gradient_row(GradientOperator::kCentral, {&rows, 1}, 3, {0, 0},
                       {dx.data(), dy.data(), magnitude.data()});
    test::expect_same_bits(dx, std::array<float, 3>{3, 8, 5});
    test::expect_same_bits(dy, std::array<float, 3>{0, 0, 0});
    simd::gradient_row(GradientOperator::kSobel, {&rows, 1}, 1, {0, 0},
                       {dx.data(), dy.data(), magnitude.data()});
    EXPECT_EQ(dx[0], 0.0F);
}

// Di Zenzo's gradient in long double, by the eigenvalue's definition.
Sample di_zenzo(GradientOperator op, const std::vector<Rows3>& channels, int i, int n, Margin margin) {
    long double xx = 0, xy = 0, yy = 0;
    for (const Rows3& rows : channels) {
        const auto [dx, dy] = derivatives<long double>(op, rows, i, n, margin);
        xx += dx * dx;
        xy += dx * dy;
        yy += dy * dy;
    }
    const long double angle = std::atan2(2 * xy, xx - yy) / 2;
    const long double root = std::sqrt((xx + yy + std::hypot(xx - yy, 2 * xy)) / 2);
    const long double c = std::cos(angle), s = std::sin(angle);
    const bool right_way = c > 1e-12L || (std::fabs(c) <= 1e-12L && s >= 0);
    const long double sign = right_way ? 1 : -1;
    return {static_cast<double>(sign * root * c), static_cast<double>(sign * root * s),
            static_cast<double>(root)};
}

TEST(GradientRow, OfSeveralChannelsIsDiZenzos) {
    for (const GradientOperator op : kOperators) {
        constexpr int n = 500;
        const Channel r(n, 1, test::plain_row), g(n, 2, test::plain_row), b(n, 3, test::plain_row);
        const std::vector<Rows3> channels{r.rows(), g.rows(), b.rows()};
        std::vector<float> dx(n), dy(n), magnitude(n);
        simd::gradient_row(op, channels, n, {0, 1}, {dx.data(), dy.data(), magnitude.data()});
        for (int i = 0; i < n; ++i) {
            const auto k = static_cast<std::size_t>(i);
            const Sample expected = di_zenzo(op, channels, i, n, {0, 1});
            EXPECT_NEAR(dx[k], expected.dx, 2e-6) << i;
            EXPECT_NEAR(dy[k], expected.dy, 2e-6) << i;
            EXPECT_NEAR(magnitude[k], expected.magnitude, 2e-6) << i;
        }
    }
}

TEST(GradientRow, OfSeveralChannelsIsTheSameOnEveryTargetAndForEveryLength) {
    constexpr int n = 70;
    const Channel a(n, 1, test::awkward_row), b(n, 2, test::plain_row);
    const std::vector<Rows3> channels{a.rows(), b.rows()};
    std::vector<float> first[3];
    test::on_every_target([&] {
        for (int length = 0; length <= n; ++length) {
            GuardedRow dx(length), dy(length, 1), magnitude(length, 2);
            simd::gradient_row(GradientOperator::kSobel, channels, length, {1, 1},
                               {dx.data(), dy.data(), magnitude.data()});
            GuardedRow* rows[3] = {&dx, &dy, &magnitude};
            for (int k = 0; k < 3; ++k) {
                std::vector<float> pixels(rows[k]->pixels().begin(), rows[k]->pixels().end());
                if (first[k].size() < pixels.size()) first[k] = pixels;
                test::expect_row(*rows[k], std::span(first[k]).first(pixels.size()));
            }
        }
    });
}

// One pixel with the given derivatives in two channels.
Sample two_channels(float dx0, float dy0, float dx1, float dy1) {
    const float zeros[3] = {0, 0, 0};
    const float at0[3] = {0, 0, dx0}, below0[3] = {0, dy0, 0}, at1[3] = {0, 0, dx1}, below1[3] = {0, dy1, 0};
    const Rows3 channels[2] = {{zeros + 1, at0 + 1, below0 + 1}, {zeros + 1, at1 + 1, below1 + 1}};
    float dx, dy, magnitude;
    simd::gradient_row(GradientOperator::kCentral, channels, 1, {1, 1}, {&dx, &dy, &magnitude});
    return {dx, dy, magnitude};
}

TEST(GradientRow, TheEigenvectorPointsRightOrDown) {
    const auto expect = [](Sample actual, double dx, double dy, double magnitude) {
        EXPECT_NEAR(actual.dx, dx, 1e-6 * magnitude);
        EXPECT_NEAR(actual.dy, dy, 1e-6 * magnitude);
        EXPECT_NEAR(actual.magnitude, magnitude, 1e-6 * magnitude);
    };
    expect(two_channels(-3, 0, -4, 0), 5, 0, 5);
    expect(two_channels(0, -3, 0, -4), 0, 5, 5);
    expect(two_channels(-3, 4, 3, -4), std::sqrt(18), -std::sqrt(32), std::sqrt(50));
    expect(two_channels(1, 0, 0, 1), 1, 0, 1);
    expect(two_channels(1e30F, -1e30F, 1e30F, -1e30F), std::sqrt(2.0) * 1e30, -std::sqrt(2.0) * 1e30, 2e30);
    expect(two_channels(1e-30F, 0, 1e-36F, 1e-36F), 1e-30, 0, 1e-30);
    const Sample flat = two_channels(0, 0, 0, 0);
    EXPECT_EQ(flat.dx, 0.0);
    EXPECT_EQ(flat.dy, 0.0);
    EXPECT_EQ(flat.magnitude, 0.0);
}

}  // namespace
}  // namespace keyline
