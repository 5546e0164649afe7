// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0

// The graphs that come with Keyline, damaged as text and as bytes, loaded and checked with their plates.

#include "engine/run/render.h"
#include "tests/fuzz/fuzz.h"
#include "tests/io/exr_files.h"

#include <array>
#include <string>
#include <string_view>

namespace keyline {
namespace {

constexpr std::array<std::string_view, 40> kPieces = {
    "{",      "}",    "[",      "]",        ",",   ":",      "\"",     "\\u0000", "//",      "/*",
    "null",   "true", "1e999",  "-1",       "0",   "0.5",    "1e-320", "\"\"",    "[[",      "{}",
    "\x1b[m", "\xC3", "\u202e", "${frame}", "${",  "####",   "%04d",   "../",     "/",       "~",
    ":R",     ":A",   "render", "\"in\"",   "out", "999999", "2e9",    "[0,0,0]", "\"mix\"", "\"#fff\""};

// A number that stands in the text becomes another, a piece comes or goes, a line is doubled.
std::string slipped(std::string text, Random& random) {
    const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % (n + 1)); };
    for (std::size_t n = 1 + below(2); n > 0; --n) {
        const std::size_t at = below(text.size()), line = text.find('\n', at);
        const std::string_view piece = kPieces[random() % kPieces.size()];
        const std::size_t digit = text.find_first_of("0123456789", at);
        switch (random() % 5) {
            case 0: text.insert(at, piece); break;
            case 1: text.erase(at, 1 + below(6)); break;
            case 2:
                if (digit != std::string::npos) text.replace(digit, 1, piece);
                break;
            case 3:
                if (line != std::string::npos) text.insert(line, text.substr(at, line - at));
                break;
            default:
                if (line != std::string::npos) text.erase(at, line - at);
                break;
        }
    }
    return text;
}

Bytes damaged_graph(const Victim& victim, const Victim& other, Random& random) {
    if (random() % 4 == 0) return damaged(victim, other, random);
    const std::string text =
        slipped({reinterpret_cast<const char*>(victim.bytes.data()), victim.bytes.size()}, random);
    const auto* bytes = reinterpret_cast<const std::byte*>(text.data());
    return {bytes, bytes + text.size()};
}

std::vector<Victim> make_victims() {
    std::vector<Victim> victims;
    for (const auto& entry : std::filesystem::directory_iterator(KEYLINE_GRAPHS))
        if (entry.path().extension() == ".json") {
            Victim victim{entry.path().stem(), content(entry.path()), 0, {}};
            victim.header_end = victim.bytes.size();
            victims.push_back(std::move(victim));
        }
    return victims;
}

void check_graph(const std::filesystem::path& file) {
    Diagnostics diagnostics;
    if (const auto graph = Graph::load(file, {}, diagnostics)) {
        const int frame = graph->first_frame_on_disk().value_or(1);
        RenderOptions options;
        options.frames = {frame};
        check(*graph, frame, options, diagnostics);
    }
    if (!diagnostics.ok()) throw Failure(diagnostics.errors().front());
}

bool is_fair(const Error& error) {
    const bool is_one_line = error.text().find('\n') == std::string::npos;
    return is_one_line && (error.kind == ErrorKind::kGraph || error.kind == ErrorKind::kInput);
}

}  // namespace
}  // namespace keyline

int main(int count, char** arguments) {
    const keyline::TemporaryFolder folder;
    std::filesystem::create_symlink(KEYLINE_GRAPHS "/plates", folder / "plates");
    return keyline::run_fuzz({.what = "graphs",
                              .victims = keyline::make_victims(),
                              .folder = folder / ".",
                              .attempt = keyline::check_graph,
                              .is_fair = keyline::is_fair,
                              .extension = "json",
                              .damage = keyline::damaged_graph},
                             count, arguments);
}
