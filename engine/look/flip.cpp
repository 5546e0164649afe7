// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/look/flip.h"

#include "engine/base/index.h"
#include "engine/simd/elementary.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace keyline {

namespace {

using elementary::pow;
using Plane3 = std::array<std::vector<float>, 3>;
using Vec = std::array<double, 3>;

constexpr double kPi = std::numbers::pi;

// sRGB's primaries to CIE XYZ, and back.
constexpr std::array<Vec, 3> kToXyz{{{10135552.0 / 24577794, 8788810.0 / 24577794, 4435075.0 / 24577794},
                                     {2613072.0 / 12288897, 8788810.0 / 12288897, 887015.0 / 12288897},
                                     {1425312.0 / 73733382, 8788810.0 / 73733382, 70074185.0 / 73733382}}};
constexpr std::array<Vec, 3> kFromXyz{{{3.241003232976, -1.537398969489, -0.498615881996},
                                       {-0.969224252203, 1.875929983695, 0.04155422634},
                                       {0.055639419852, -0.204011206124, 1.057148977188}}};

Vec times(const std::array<Vec, 3>& m, const Vec& v) {
    Vec out{};
    for (std::size_t i = 0; i < 3; ++i) out[i] = m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2];
    return out;
}

const Vec kWhite = times(kToXyz, {1, 1, 1});

// The opponent space that the eye's contrast sensitivity was measured in: lightness, red-green, blue-yellow.
Vec opponent(const Vec& rgb) {
    const Vec xyz = times(kToXyz, rgb);
    const double x = xyz[0] / kWhite[0], y = xyz[1] / kWhite[1], z = xyz[2] / kWhite[2];
    return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

Vec from_opponent(const Vec& v) {
    const double y = (v[0] + 16) / 116, x = y + v[1] / 500, z = y - v[2] / 200;
    return times(kFromXyz, {x * kWhite[0], y * kWhite[1], z * kWhite[2]});
}

// CIE L*a*b*, with the Hunt effect: colours of dark things count less.
Vec perceived(const Vec& rgb) {
    const Vec xyz = times(kToXyz, rgb);
    const auto f = [](double t) {
        constexpr double kDelta = 6.0 / 29;
        return t > kDelta * kDelta * kDelta ? pow(t, 1.0 / 3) : t / (3 * kDelta * kDelta) + 4.0 / 29;
    };
    const double x = f(xyz[0] / kWhite[0]), y = f(xyz[1] / kWhite[1]), z = f(xyz[2] / kWhite[2]);
    const double lightness = 116 * y - 16, hunt = 0.01 * lightness;
    return {lightness, hunt * 500 * (x - y), hunt * 200 * (y - z)};
}

double hyab(const Vec& a, const Vec& b) {
    const double da = a[1] - b[1], db = a[2] - b[2];
    return std::abs(a[0] - b[0]) + std::sqrt(da * da + db * db);
}

// Weights from −radius to radius.
struct Kernel {
    std::vector<double> weights;
    int radius() const { return static_cast<int>(weights.size() / 2); }
    double at(int x) const { return weights[index(x + radius())]; }
};

Kernel kernel_of(int radius, const std::function<double(double)>& f) {
    Kernel out;
    for (int x = -radius; x <= radius; ++x) out.weights.push_back(f(x));
    return out;
}

double sum_of(const Kernel& k) {
    double sum = 0;
    for (const double w : k.weights) sum += w;
    return sum;
}

// What lies beyond the border is what lies at it.
std::vector<float> filtered_rows(const std::vector<float>& in, int width, int height, const Kernel& kernel) {
    std::vector<float> out(in.size());
    const int radius = kernel.radius();
    for (int y = 0; y < height; ++y) {
        const float* row = in.data() + std::ptrdiff_t{y} * width;
        for (int x = 0; x < width; ++x) {
            double sum = 0;
            for (int i = -radius; i <= radius; ++i)
                sum += kernel.at(i) * double{row[std::clamp(x + i, 0, width - 1)]};
            out[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)] =
                static_cast<float>(sum);
        }
    }
    return out;
}

std::vector<float> filtered_columns(const std::vector<float>& in, int width, int height,
                                    const Kernel& kernel) {
    std::vector<float> out(in.size());
    const int radius = kernel.radius();
    std::vector<double> sums(static_cast<std::size_t>(width));
    for (int y = 0; y < height; ++y) {
        std::ranges::fill(sums, 0);
        for (int i = -radius; i <= radius; ++i) {
            const float* row = in.data() + std::ptrdiff_t{std::clamp(y + i, 0, height - 1)} * width;
            const double weight = kernel.at(i);
            for (std::size_t x = 0; x < sums.size(); ++x) sums[x] += weight * double{row[x]};
        }
        std::ranges::transform(sums, out.begin() + std::ptrdiff_t{y} * width,
                               [](double v) { return static_cast<float>(v); });
    }
    return out;
}

std::vector<float> filtered(const std::vector<float>& in, int width, int height, const Kernel& across,
                            const Kernel& down) {
    return filtered_columns(filtered_rows(in, width, height, across), width, height, down);
}

// What the eye resolves of a channel: one Gaussian or a sum of two, as a function of degrees.
struct Sensitivity {
    double a1, b1, a2, b2;
};
constexpr std::array<Sensitivity, 3> kSensitivities{
    {{1, 0.0047, 0, 1e-5}, {1, 0.0053, 0, 1e-5}, {34.1, 0.04, 13.5, 0.025}}};
constexpr double kWidest = 0.04;  // of the b above: all kernels have its radius

std::vector<float> as_resolved(const std::vector<float>& in, int width, int height, const Sensitivity& s,
                               double pixels_per_degree) {
    const int radius =
        static_cast<int>(std::ceil(3 * std::sqrt(kWidest / (2 * kPi * kPi)) * pixels_per_degree));
    const auto gaussian = [&](double b) {
        return kernel_of(radius, [&](double x) {
            const double degrees = x / pixels_per_degree;
            return elementary::exp(-kPi * kPi * degrees * degrees / b);
        });
    };
    const Kernel one = gaussian(s.b1), two = gaussian(s.b2);
    // Each is the product of its rows' and its columns'.
    const double scale_one = s.a1 * std::sqrt(kPi / s.b1), scale_two = s.a2 * std::sqrt(kPi / s.b2);
    const double all = scale_one * sum_of(one) * sum_of(one) + scale_two * sum_of(two) * sum_of(two);
    std::vector<float> out = filtered(in, width, height, one, one);
    for (float& v : out) v = static_cast<float>(double{v} * scale_one / all);
    if (s.a2 == 0) return out;
    const std::vector<float> more = filtered(in, width, height, two, two);
    for (std::size_t i = 0; i < out.size(); ++i)
        out[i] = static_cast<float>(double{out[i]} + double{more[i]} * scale_two / all);
    return out;
}

Plane3 opponents_of(const LinearPicture& picture) {
    Plane3 out;
    for (auto& plane : out) plane.resize(picture.rgb[0].size());
    for (std::size_t i = 0; i < out[0].size(); ++i) {
        Vec rgb;
        for (std::size_t c = 0; c < 3; ++c) rgb[c] = std::clamp(double{picture.rgb[c][i]}, 0.0, 1.0);
        const Vec v = opponent(rgb);
        for (std::size_t c = 0; c < 3; ++c) out[c][i] = static_cast<float>(v[c]);
    }
    return out;
}

// The colours that are perceived at the distance.
Plane3 perceived_colours(const Plane3& opponents, int width, int height, double pixels_per_degree) {
    Plane3 out;
    for (std::size_t c = 0; c < 3; ++c)
        out[c] = as_resolved(opponents[c], width, height, kSensitivities[c], pixels_per_degree);
    for (std::size_t i = 0; i < out[0].size(); ++i) {
        Vec rgb = from_opponent({double{out[0][i]}, double{out[1][i]}, double{out[2][i]}});
        for (double& v : rgb) v = std::clamp(v, 0.0, 1.0);
        const Vec v = perceived(rgb);
        for (std::size_t c = 0; c < 3; ++c) out[c][i] = static_cast<float>(v[c]);
    }
    return out;
}

// A distance of colours, from 0 to 1.  Small ones, which are seen well, take most of the range.
double colour_error(double distance) {
    constexpr double kPower = 0.7, kKnee = 0.4, kAtKnee = 0.95;
    static const double most = pow(hyab(perceived({0, 1, 0}), perceived({0, 0, 1})), kPower);
    const double error = pow(distance, kPower), knee = kKnee * most;
    return error < knee ? kAtKnee / knee * error : kAtKnee + (error - knee) / (most - knee) * (1 - kAtKnee);
}

// The positive weights sum to 1, the negative ones to −1.
Kernel balanced(Kernel kernel) {
    double positive = 0, negative = 0;
    for (const double w : kernel.weights) (w > 0 ? positive : negative) += w;
    for (double& w : kernel.weights) w /= w > 0 ? positive : -negative;
    return kernel;
}

struct Features {
    std::vector<float> edges, points;
};

// How much of an edge, and of a point, there is in the lightness.
Features features_of(const std::vector<float>& lightness, int width, int height, double pixels_per_degree) {
    constexpr double kWidth = 0.082;  // of a feature, in degrees
    const double deviation = 0.5 * kWidth * pixels_per_degree;
    const int radius = static_cast<int>(std::ceil(3 * deviation));
    const auto gauss = [&](double x) { return elementary::exp(-x * x / (2 * deviation * deviation)); };
    Kernel smooth = kernel_of(radius, gauss);
    const double sum = sum_of(smooth);
    for (double& w : smooth.weights) w /= sum;
    const Kernel slope = balanced(kernel_of(radius, [&](double x) { return -x * gauss(x); }));
    const Kernel bend = balanced(
        kernel_of(radius, [&](double x) { return (x * x / (deviation * deviation) - 1) * gauss(x); }));
    std::vector<float> scaled(lightness.size());
    std::ranges::transform(lightness, scaled.begin(), [](float v) { return (v + 16) / 116; });
    const auto strength = [&](const Kernel& kernel) {
        std::vector<float> across = filtered(scaled, width, height, kernel, smooth);
        const std::vector<float> down = filtered(scaled, width, height, smooth, kernel);
        for (std::size_t i = 0; i < across.size(); ++i)
            across[i] = std::sqrt(across[i] * across[i] + down[i] * down[i]);
        return across;
    };
    return {strength(slope), strength(bend)};
}

double feature_error(const Features& a, const Features& b, std::size_t i) {
    const double edge = std::abs(double{a.edges[i]} - double{b.edges[i]});
    const double point = std::abs(double{a.points[i]} - double{b.points[i]});
    return std::sqrt(std::max(edge, point) / std::numbers::sqrt2);
}

}  // namespace

std::vector<float> flip(const LinearPicture& reference, const LinearPicture& test, double pixels_per_degree) {
    const int width = reference.width, height = reference.height;
    const Plane3 opponents_a = opponents_of(reference), opponents_b = opponents_of(test);
    const Features features_a = features_of(opponents_a[0], width, height, pixels_per_degree);
    const Features features_b = features_of(opponents_b[0], width, height, pixels_per_degree);
    const Plane3 a = perceived_colours(opponents_a, width, height, pixels_per_degree);
    const Plane3 b = perceived_colours(opponents_b, width, height, pixels_per_degree);
    std::vector<float> out(a[0].size());
    for (std::size_t i = 0; i < out.size(); ++i) {
        const Vec of_a{double{a[0][i]}, double{a[1][i]}, double{a[2][i]}};
        const Vec of_b{double{b[0][i]}, double{b[1][i]}, double{b[2][i]}};
        // Where features differ too, a difference of colour counts more.
        out[i] = static_cast<float>(
            pow(colour_error(hyab(of_a, of_b)), std::max(0.0, 1 - feature_error(features_a, features_b, i))));
    }
    return out;
}

}  // namespace keyline
