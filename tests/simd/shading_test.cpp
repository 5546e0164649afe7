// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/simd/shading.h"

#include "tests/support/rows.h"
#include "tests/support/targets.h"

#include <array>

// Every instruction set gives the bits that a pixel by itself has on the simplest; that those are right, the
// tests of the nodes say.

namespace keyline {
namespace {

using Row = std::vector<float>;
using Rows = std::array<Row, 5>;

constexpr int kWidth = 45;

const std::array kAwkward{test::awkward_row(80, 1), test::awkward_row(80, 2), test::awkward_row(80, 3),
                          test::awkward_row(80, 4), test::awkward_row(80, 5), test::awkward_row(80, 6),
                          test::awkward_row(80, 7)};

const float* row(std::size_t i, int x) { return kAwkward[i].data() + x; }

struct Vectors {
    std::array<std::array<double, kWidth>, 3> rows{};
    simd::UnitRows unit() { return {rows[0].data(), rows[1].data(), rows[2].data()}; }
};

// Pixels x … x + n of everything that leads to a shaded row, with one far and one near light.
template <class Shade>
Rows shaded(int x, int n, bool premultiplied, const Shade& shade) {
    Vectors normal, toward, eye;
    std::array<std::array<double, kWidth>, 8> of{};
    simd::unit_row({row(0, x), row(1, x), row(2, x)}, n, normal.unit());
    simd::covered_row(row(3, x), normal.unit(), n, of[0].data());
    simd::toward_row({row(4, x), row(5, x), row(6, x)}, {1, -2, 0.5}, n, toward.unit(), of[1].data());
    simd::toward_row({row(4, x), row(5, x), row(6, x)}, {0, 3, 7}, n, eye.unit(), of[2].data());
    simd::reach_row(of[1].data(), row(2, x), row(3, x), n, of[2].data());
    simd::dot_row(normal.unit(), toward.unit(), n, of[3].data());
    simd::dot_row(normal.unit(), {0, 0.6, 0.8}, n, of[4].data());
    simd::dot_row(eye.unit(), toward.unit(), n, of[5].data());
    simd::dot_row(eye.unit(), normal.unit(), n, of[6].data());
    simd::dot_row(eye.unit(), {0, 0.6, 0.8}, n, of[7].data());
    const std::array lights{
        simd::LightRows{of[3].data(), of[2].data(), of[5].data(), {1, 0.5, 0.25}},
        simd::LightRows{of[4].data(), nullptr, of[7].data(), {0.3, 0.2, 0.1}},
    };
    Rows out;
    out.fill(Row(static_cast<std::size_t>(n)));
    shade(simd::SurfaceRows{row(4, x), row(5, x), row(6, x), premultiplied, of[0].data()}, lights,
          of[6].data(), n,
          simd::ShadedRows{out[0].data(), out[1].data(), out[2].data(), out[3].data(), out[4].data()});
    return out;
}

template <class Shade>
void expect_same_everywhere(const Shade& shade) {
    for (const bool premultiplied : {false, true}) {
        Rows expected;
        simd::use_target(simd::targets().back());
        for (int x = 0; x < kWidth; ++x) {
            const Rows one = shaded(x, 1, premultiplied, shade);
            for (std::size_t c = 0; c < one.size(); ++c) expected[c].push_back(one[c][0]);
        }
        test::on_every_target([&] {
            for (int n = 0; n <= kWidth; ++n) {
                const Rows actual = shaded(0, n, premultiplied, shade);
                for (std::size_t c = 0; c < actual.size(); ++c)
                    test::expect_same_bits(actual[c],
                                           std::span(expected[c]).first(static_cast<std::size_t>(n)));
            }
        });
    }
}

using Lights = std::span<const simd::LightRows>;

TEST(CelRow, IsTheSameOnEveryTarget) {
    simd::CelTones tones{false, {0.49, 0.51}, 0.25, 0.5, {0.1, 0.2, 0.3}, 0.9, false, 0, {0, 1}, 0, 0, 0};
    const auto shade = [&](const auto& surface, Lights lights, const double*, int n, const auto& out) {
        simd::cel_row(surface, lights, tones, n, out);
    };
    expect_same_everywhere(shade);
    tones.continuous = true;
    expect_same_everywhere(shade);
    tones.has_highlight = true;
    tones.threshold = 0.6;
    tones.highlight = {0.5, 0.9};
    tones.tint = 0.7;
    tones.gleam = 0.2;
    tones.shine = 0.4;
    expect_same_everywhere(shade);
}

TEST(GoochRow, IsTheSameOnEveryTarget) {
    expect_same_everywhere([](const auto& surface, Lights lights, const double*, int n, const auto& out) {
        simd::gooch_row(surface, lights, {{0, 0, 0.55}, {0.3, 0.3, 0}, 0.25, 0.5}, n, out);
    });
}

TEST(PhongRow, IsTheSameOnEveryTarget) {
    expect_same_everywhere([](const auto& surface, Lights lights, const double* eye, int n, const auto& out) {
        simd::phong_row(surface, lights, eye, {{0.1, 0.1, 0.1}, 0.9, 0.8, 12.5}, n, out);
    });
}

}  // namespace
}  // namespace keyline
