// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/error.h"

#include <algorithm>
#include <fmt/format.h>
#include <numeric>

namespace keyline {

namespace {

constexpr std::size_t kLongestQuote = 60;  // characters

// Levenshtein distance, by rows.
std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 0; i < a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i + 1;
        for (std::size_t j = 0; j < b.size(); ++j) {
            const std::size_t substitute = diagonal + (a[i] == b[j] ? 0 : 1);
            diagonal = row[j + 1];
            row[j + 1] = std::min({row[j] + 1, row[j + 1] + 1, substitute});
        }
    }
    return row.back();
}

bool is_continuation(char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; }

void append_escaped(std::string& out, char c) {
    if (c == '\n')
        out += "\\n";
    else if (c == '\t')
        out += "\\t";
    else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
        out += fmt::format("\\x{:02x}", static_cast<unsigned>(static_cast<unsigned char>(c)));
    else
        out += c;
}

}  // namespace

std::string Place::text() const { return line > 0 ? fmt::format("{}:{}:{}", file, line, column) : file; }

std::string Error::text() const {
    std::string out;
    if (!place.file.empty()) out += place.text() + ": ";
    out += kind == ErrorKind::kInternal ? "error: internal: " : "error: ";
    if (!node.empty()) out += node + ": ";
    out += what;
    if (!hint.empty()) out += "; " + hint;
    return out;
}

void fail(ErrorKind kind, std::string what, std::string hint) {
    throw Failure({kind, {}, {}, std::move(what), std::move(hint)});
}

int exit_status(ErrorKind kind) {
    switch (kind) {
        case ErrorKind::kGraph: return 2;
        case ErrorKind::kInput: return 3;
        case ErrorKind::kOutput: return 4;
        default: return 1;
    }
}

std::string in_quotes(std::string_view text) {
    std::string out = "'";
    std::size_t characters = 0;
    for (const char c : text) {
        if (!is_continuation(c) && ++characters > kLongestQuote) return out + "…'";
        append_escaped(out, c);
    }
    return out + "'";
}

std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates) {
    const std::size_t tolerance = std::max<std::size_t>(1, word.size() / 3);
    std::string best;
    std::size_t best_distance = tolerance + 1;
    for (const std::string& candidate : candidates) {
        const std::size_t distance = edit_distance(word, candidate);
        if (distance < best_distance && distance < std::max(word.size(), candidate.size())) {
            best = candidate;
            best_distance = distance;
        }
    }
    return best.empty() ? "" : fmt::format("did you mean {}?", in_quotes(best));
}

std::string listed(const std::vector<std::string>& words) {
    std::string out;
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (i > 0) out += i + 1 == words.size() ? " and " : ", ";
        out += in_quotes(words[i]);
    }
    return out;
}

}  // namespace keyline
