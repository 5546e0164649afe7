// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/params/colour_text.h"

#include "engine/simd/elementary.h"

#include <array>
#include <charconv>

namespace keyline {

namespace {

// The sRGB transfer function's inverse, IEC 61966-2-1.
double srgb_to_linear(int byte) {
    const double s = byte / 255.0;
    return s <= 0.04045 ? s / 12.92 : elementary::pow((s + 0.055) / 1.055, 2.4);
}

}  // namespace

std::optional<Color> colour_of_text(std::string_view text) {
    if (text.size() != 7 || text[0] != '#') return {};
    std::array<int, 3> bytes{};
    for (std::size_t i = 0; i < 3; ++i) {
        const char* begin = text.data() + 1 + 2 * i;
        const auto [end, error] = std::from_chars(begin, begin + 2, bytes[i], 16);
        if (error != std::errc{} || end != begin + 2 || bytes[i] < 0) return {};
    }
    return Color{srgb_to_linear(bytes[0]), srgb_to_linear(bytes[1]), srgb_to_linear(bytes[2])};
}

}  // namespace keyline
