// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/look/lettering.h"

#include <array>
#include <cctype>
#include <cstddef>
#include <fmt/format.h>

namespace keyline::cli {

namespace {

// Lines apart by bars, each through points of a grid: a column from 0 to 4, a row from 0 at the top by 6, the
// base line, to 8.
struct Glyph {
    char letter;
    std::string_view lines;
};
// clang-format off
constexpr std::array<Glyph, 42> kGlyphs{{
    {'a', "42 22 13 15 26 45|42 46"},
    {'b', "00 06|03 22 43 45 26 05"},
    {'c', "42 22 03 05 26 46"},
    {'d', "40 46|43 22 03 05 26 45"},
    {'e', "04 44 43 32 12 03 05 16 46"},
    {'f', "40 30 21 26|12 42"},
    {'g', "42 47 38 08|43 22 03 05 26 45"},
    {'h', "00 06|03 22 32 43 46"},
    {'i', "22 26|20 20"},
    {'j', "32 37 28 08|30 30"},
    {'k', "00 06|42 04 46"},
    {'l', "20 25 36"},
    {'m', "06 02|03 12 23 26|23 32 43 46"},
    {'n', "02 06|03 22 32 43 46"},
    {'o', "12 32 43 45 36 16 05 03 12"},
    {'p', "02 08|03 22 43 45 26 05"},
    {'q', "42 48|43 22 03 05 26 45"},
    {'r', "02 06|04 22 42"},
    {'s', "42 12 03 14 34 45 36 06"},
    {'t', "20 25 36 46|02 42"},
    {'u', "02 05 16 26 45|42 46"},
    {'v', "02 26 42"},
    {'w', "02 16 24 36 42"},
    {'x', "02 46|42 06"},
    {'y', "02 26|42 18 08"},
    {'z', "02 42 06 46"},
    {'0', "10 30 41 45 36 16 05 01 10|41 05"},
    {'1', "01 20 26|06 46"},
    {'2', "01 10 30 41 42 06 46"},
    {'3', "00 40 22 33 44 45 36 16 05"},
    {'4', "30 04 44|30 36"},
    {'5', "40 00 02 32 43 45 36 06"},
    {'6', "40 20 02 05 16 36 45 43 33 03"},
    {'7', "00 40 16"},
    {'8', "10 30 41 42 33 13 02 01 10|13 04 05 16 36 45 44 33"},
    {'9', "43 13 02 01 10 30 41 44 26 06"},
    {'-', "04 44"},
    {'_', "07 47"},
    {'/', "40 08"},
    {'.', "26 26"},
    {':', "23 23|26 26"},
    {'#', "11 17|31 37|03 43|05 45"},
}};
// clang-format on

constexpr double kUnit = 1.75;    // pixels from row to row
constexpr double kAdvance = 6.2;  // columns from letter to letter
constexpr int kBaseLine = 6;

std::string_view lines_of(char letter) {
    const auto small = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
    for (const Glyph& g : kGlyphs)
        if (g.letter == small) return g.lines;
    return "";
}

// One line of a letter as a stroke.  A point is a line of no length, which is drawn as a dot.
std::string stroke(std::string_view line, double x, double y) {
    std::string points;
    for (std::size_t i = 0; i + 1 < line.size(); i += 3) {
        const double column = line[i] - '0', row = line[i + 1] - '0';
        const bool ends_a_dot = i > 0 && line.substr(0, 2) == line.substr(3);
        const double nudge = ends_a_dot ? 0.3 : 0;
        points += fmt::format("{}[{:.2f}, {:.2f}]", i == 0 ? "" : ", ", x + (column + nudge) * kUnit,
                              y + (row - kBaseLine) * kUnit);
    }
    return fmt::format("  {{ \"width\": 1.5, \"points\": [{}] }}", points);
}

}  // namespace

Lettering::Lettering(int width, int height) : width_(width), height_(height) {}

void Lettering::add(std::string_view text, double x, double y, double room) {
    const auto most = static_cast<std::size_t>(room / (kAdvance * kUnit));
    for (const char letter : text.substr(0, most)) {
        std::string_view lines = lines_of(letter);
        while (!lines.empty()) {
            const std::size_t bar = lines.find('|');
            lines_ += (lines_.empty() ? "" : ",\n") + stroke(lines.substr(0, bar), x, y);
            lines = bar == std::string_view::npos ? "" : lines.substr(bar + 1);
        }
        x += kAdvance * kUnit;
    }
}

std::string Lettering::text() const {
    return fmt::format(
        "{{ \"strokes\": 1, \"display\": [0, 0, {0}, {1}], \"window\": [0, 0, {0}, {1}],\n"
        "  \"lines\": [\n{2}\n] }}\n",
        width_, height_, lines_);
}

}  // namespace keyline::cli
