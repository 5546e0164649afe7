// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/look/terminal_picture.h"

#include "cli/common/base64.h"
#include "engine/base/error.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

namespace keyline::cli {

namespace {

std::string variable(const char* name) {
    const char* value = std::getenv(name);
    return value ? value : "";
}

constexpr int kSteps = 6;  // of each channel, in sixels

int step_of(uint8_t sample) { return (sample * (kSteps - 1) + 127) / 255; }

int colour_of(const Bitmap& bitmap, int x, int y) {
    const uint8_t* p = bitmap.rgb.data() + 3 * (std::ptrdiff_t{y} * bitmap.width + x);
    return (step_of(p[0]) * kSteps + step_of(p[1])) * kSteps + step_of(p[2]);
}

// Runs of four or more are counted.
void append_run(std::string& out, char sixel, int length) {
    if (length > 3)
        out += fmt::format("!{}{}", length, sixel);
    else
        out.append(static_cast<std::size_t>(length), sixel);
}

// What of six rows has one colour.
std::string sixel_row(const Bitmap& bitmap, int y0, int colour) {
    std::string out;
    char before = 0;
    int length = 0;
    for (int x = 0; x < bitmap.width; ++x) {
        int bits = 0;
        for (int i = 0; i < 6 && y0 + i < bitmap.height; ++i)
            bits |= colour_of(bitmap, x, y0 + i) == colour ? 1 << i : 0;
        const auto sixel = static_cast<char>('?' + bits);
        if (sixel != before) append_run(out, before, length), length = 0;
        before = sixel;
        ++length;
    }
    if (before != '?') append_run(out, before, length);
    return out;
}

}  // namespace

TerminalKind terminal_kind(const std::string& word) {
    static const std::array<std::pair<const char*, TerminalKind>, 4> kKinds{
        {{"kitty", TerminalKind::kKitty},
         {"iterm", TerminalKind::kIterm},
         {"sixel", TerminalKind::kSixel},
         {"blocks", TerminalKind::kBlocks}}};
    for (const auto& [name, kind] : kKinds)
        if (word == name) return kind;
    if (!word.empty())
        throw Failure(
            {ErrorKind::kGraph, {"--as " + word, 0, 0}, {}, "it must be kitty, iterm, sixel or blocks", {}});
    const std::string term = variable("TERM"), program = variable("TERM_PROGRAM");
    if (!variable("KITTY_WINDOW_ID").empty() || term == "xterm-kitty" || term == "xterm-ghostty")
        return TerminalKind::kKitty;
    if (program == "iTerm.app" || program == "WezTerm") return TerminalKind::kIterm;
    if (term.starts_with("foot") || term.starts_with("mlterm") || term.find("sixel") != std::string::npos)
        return TerminalKind::kSixel;
    return TerminalKind::kBlocks;
}

TerminalSize terminal_size() {
    winsize size{};
    if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0 || size.ws_row == 0) return {};
    return {size.ws_col, size.ws_row};
}

std::string kitty_text(std::string_view png) {
    constexpr std::size_t kPiece = 4096;
    const std::string all = base64(png);
    std::string out;
    for (std::size_t at = 0; at < all.size(); at += kPiece)
        out += fmt::format("\x1b_G{}m={};{}\x1b\\", at == 0 ? "a=T,f=100," : "",
                           at + kPiece < all.size() ? 1 : 0, all.substr(at, kPiece));
    return out + "\n";
}

std::string iterm_text(std::string_view png) {
    return fmt::format("\x1b]1337;File=inline=1;size={}:{}\a\n", png.size(), base64(png));
}

std::string sixel_text(const Bitmap& bitmap) {
    std::string out = fmt::format("\x1bPq\"1;1;{};{}", bitmap.width, bitmap.height);
    constexpr int kColours = kSteps * kSteps * kSteps, kPercent = 100 / (kSteps - 1);
    for (int c = 0; c < kColours; ++c)
        out += fmt::format("#{};2;{};{};{}", c, c / (kSteps * kSteps) * kPercent,
                           c / kSteps % kSteps * kPercent, c % kSteps * kPercent);
    for (int y = 0; y < bitmap.height; y += 6) {
        std::array<bool, kColours> used{};
        for (int i = y; i < std::min(y + 6, bitmap.height); ++i)
            for (int x = 0; x < bitmap.width; ++x)
                used[static_cast<std::size_t>(colour_of(bitmap, x, i))] = true;
        for (int c = 0; c < kColours; ++c)
            if (used[static_cast<std::size_t>(c)]) out += fmt::format("#{}{}$", c, sixel_row(bitmap, y, c));
        out += "-";
    }
    return out + "\x1b\\\n";
}

std::string blocks_text(const Bitmap& bitmap) {
    const auto at = [&](int x, int y) {
        const uint8_t* p =
            bitmap.rgb.data() + 3 * (std::ptrdiff_t{std::min(y, bitmap.height - 1)} * bitmap.width + x);
        return fmt::format("{};{};{}", p[0], p[1], p[2]);
    };
    std::string out;
    for (int y = 0; y < bitmap.height; y += 2) {
        for (int x = 0; x < bitmap.width; ++x)
            out += fmt::format("\x1b[38;2;{}m\x1b[48;2;{}m\u2580", at(x, y), at(x, y + 1));
        out += "\x1b[0m\n";
    }
    return out;
}

}  // namespace keyline::cli
