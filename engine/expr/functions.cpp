// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/expr/functions.h"

#include "engine/expr/expression.h"
#include "engine/simd/elementary.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <limits>

namespace keyline {

namespace {

using Values = std::span<const double>;

constexpr std::size_t kAny = std::numeric_limits<std::size_t>::max();

struct Function {
    const char* name;
    const char* takes;  // for messages
    std::size_t least, most;
    double (*compute)(Values);
};

// Half away from 0 rounds up, for −0.5 as for 0.5: a value that moves evenly steps evenly.
double round_half_up(Values v) { return std::floor(v[0] + 0.5); }

elementary::SinCos sin_cos(double radians) { return elementary::sin_cos_degrees(radians * (180 / kPi)); }

double mix(double a, double b, double t) { return a + (b - a) * t; }

double smoothstep(Values v) {
    if (v[0] == v[1]) return v[2] < v[0] ? 0 : 1;
    const double t = std::clamp((v[2] - v[0]) / (v[1] - v[0]), 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

// Steele, Lea and Flood's SplitMix64 as a hash: every bit of a number and a seed into a value from −1 to 1.
double random_of(double whole, double seed) {
    constexpr std::uint64_t kGolden = 0x9E3779B97F4A7C15U;
    auto z = static_cast<std::uint64_t>(static_cast<std::int64_t>(whole)) * kGolden +
             static_cast<std::uint64_t>(static_cast<std::int64_t>(seed)) * 0xD1B54A32D192ED03U + kGolden;
    z = (z ^ z >> 30U) * 0xBF58476D1CE4E5B9U;
    z = (z ^ z >> 27U) * 0x94D049BB133111EBU;
    z ^= z >> 31U;
    return static_cast<double>(z >> 11U) * 0x1p-52 - 1;
}

// A value for every whole number, and smoothly from one to the next.
double noise(Values v) {
    constexpr double kFarthest = 0x1p52;
    const double x = std::clamp(v[0], -kFarthest, kFarthest);
    const double seed = v.size() > 1 ? std::clamp(std::floor(v[1]), -kFarthest, kFarthest) : 0;
    const double whole = std::floor(x), t = x - whole;
    return mix(random_of(whole, seed), random_of(whole + 1, seed), t * t * (3 - 2 * t));
}

constexpr std::array kFunctions{
    Function{"min", "values", 1, kAny, [](Values v) { return *std::ranges::min_element(v); }},
    Function{"max", "values", 1, kAny, [](Values v) { return *std::ranges::max_element(v); }},
    Function{"abs", "x", 1, 1, [](Values v) { return std::abs(v[0]); }},
    Function{"floor", "x", 1, 1, [](Values v) { return std::floor(v[0]); }},
    Function{"ceil", "x", 1, 1, [](Values v) { return std::ceil(v[0]); }},
    Function{"round", "x", 1, 1, round_half_up},
    Function{"sqrt", "x", 1, 1, [](Values v) { return std::sqrt(v[0]); }},
    Function{"exp", "x", 1, 1, [](Values v) { return elementary::exp(v[0]); }},
    Function{"log", "x", 1, 1, [](Values v) { return elementary::log(v[0]); }},
    Function{"sin", "an angle in radians", 1, 1, [](Values v) { return sin_cos(v[0]).sin; }},
    Function{"cos", "an angle in radians", 1, 1, [](Values v) { return sin_cos(v[0]).cos; }},
    Function{"clamp", "x, low, high", 3, 3, [](Values v) { return std::max(v[1], std::min(v[0], v[2])); }},
    Function{"mix", "a, b, t", 3, 3, [](Values v) { return mix(v[0], v[1], v[2]); }},
    Function{"step", "edge, x", 2, 2, [](Values v) { return v[1] < v[0] ? 0.0 : 1.0; }},
    Function{"smoothstep", "low, high, x", 3, 3, smoothstep},
    Function{"noise", "x, seed", 1, 2, noise},
    Function{"hold", "a number of frames", 1, 1, nullptr},  // held_frame(), of the frame that the scope knows
};

// As other languages have it.
struct Synonym {
    const char* name;
    const char* hint;
};

constexpr std::array kSynonyms{
    Synonym{"pow", "a power is written x ^ y"},
    Synonym{"mod", "a remainder is written x % y"},
    Synonym{"fmod", "a remainder is written x % y"},
    Synonym{"if", "a choice is written a ? b : c"},
    Synonym{"lerp", "write mix(a, b, t)"},
    Synonym{"ln", "write log(x)"},
    Synonym{"int", "write floor(x) or round(x)"},
    Synonym{"trunc", "write floor(x) or round(x)"},
    Synonym{"random", "write noise(frame, seed)"},
    Synonym{"rand", "write noise(frame, seed)"},
    Synonym{"env", "write ${env:NAME}"},
    Synonym{"getenv", "write ${env:NAME}"},
};

const Function* find(const std::string& name) {
    const auto it = std::ranges::find(kFunctions, name, &Function::name);
    return it == kFunctions.end() ? nullptr : &*it;
}

}  // namespace

std::vector<std::string> function_names() {
    std::vector<std::string> out;
    for (const Function& f : kFunctions) out.emplace_back(f.name);
    return out;
}

void check_function(const std::string& name, std::size_t at) {
    if (find(name)) return;
    const auto synonym = std::ranges::find(kSynonyms, name, &Synonym::name);
    if (synonym != kSynonyms.end())
        throw ExpressionFault(at, "there is no function " + in_quotes(name), synonym->hint);
    const std::vector<std::string> known = function_names();
    std::string hint = did_you_mean(name, known);
    throw ExpressionFault(at, "there is no function " + in_quotes(name),
                          hint.empty() ? "known are " + listed(known) : hint);
}

void check_arguments(const std::string& name, std::size_t count, std::size_t at) {
    const Function& f = *find(name);
    if (count < f.least || count > f.most)
        throw ExpressionFault(at, fmt::format("'{}' takes ({}); it is given {} value{}", name, f.takes, count,
                                              count == 1 ? "" : "s"));
}

double call_function(const std::string& name, std::span<const double> values) {
    return find(name)->compute(values);
}

double power(double x, double y) {
    constexpr double kMostFactors = 1024;
    if (y != std::floor(y) || std::abs(y) > kMostFactors) return elementary::pow(x, y);
    double out = 1;
    for (auto n = static_cast<int>(std::abs(y)); n > 0; n /= 2, x *= x)
        if (n % 2 == 1) out *= x;
    return y < 0 ? 1 / out : out;
}

double modulo(double x, double y) {
    const double rest = std::fmod(x, y);
    return rest != 0 && (rest < 0) != (y < 0) ? rest + y : rest;
}

double held_frame(double frame, double first, double length) { return frame - modulo(frame - first, length); }

}  // namespace keyline
