// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/base/error.h"

#include "engine/base/text.h"

#include <algorithm>
#include <fmt/format.h>
#include <numeric>
#include <tuple>

namespace keyline {

namespace {

constexpr std::size_t kLongestQuote = 60;   // characters
constexpr std::size_t kLeastBeginning = 4;  // characters of a word that another may begin with

// Insertions, deletions, substitutions and swaps of neighbours that make `b` of `a` (optimal string
// alignment), by rows.
std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> before(b.size() + 1), above(b.size() + 1), row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::swap(before, above);
        std::swap(above, row);
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t substitute = above[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
            row[j] = std::min({row[j - 1] + 1, above[j] + 1, substitute});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                row[j] = std::min(row[j], before[j - 2] + 1);
        }
    }
    return row.back();
}

// One line, whatever files and libraries brought into it.
std::string joined(const Error& e, const char* label) {
    std::string out;
    if (!e.place.file.empty()) out += e.place.text() + ": ";
    out += label;
    if (!e.node.empty() && e.node != e.place.file) out += e.node + ": ";
    out += e.what;
    if (!e.hint.empty()) out += "; " + e.hint;
    return escaped(out);
}

// The one candidate that begins with a word; empty where none does, or several.
std::string completed(std::string_view word, const std::vector<std::string>& candidates) {
    const auto begins = [&](const std::string& candidate) { return candidate.starts_with(word); };
    const auto first = std::ranges::find_if(candidates, begins);
    if (first == candidates.end() || std::find_if(first + 1, candidates.end(), begins) != candidates.end())
        return {};
    return *first;
}

}  // namespace

std::string Place::text() const { return line > 0 ? fmt::format("{}:{}:{}", file, line, column) : file; }

std::string Error::text() const {
    return joined(*this, kind == ErrorKind::kInternal ? "error: internal: " : "error: ");
}

std::string Error::warning_text() const {
    std::string out = joined(*this, "warning: ");
    for (const char* word : {"error:", "Error:", "ERROR:"})
        for (auto at = out.find(word); at != std::string::npos; at = out.find(word))
            out.insert(out.begin() + static_cast<std::ptrdiff_t>(at) + 5, ' ');
    return out;
}

void Diagnostics::sort_by_place() {
    const auto key = [](const Error& e) {
        return std::tuple(!e.place.file.empty(), e.place.line, e.place.column);
    };
    std::ranges::stable_sort(errors_, {}, key);
    std::ranges::stable_sort(warnings_, {}, key);
}

void fail(ErrorKind kind, std::string what, std::string hint, Passing passing) {
    throw Failure({kind, {}, {}, std::move(what), std::move(hint), passing});
}

void fail(Code code, ErrorKind kind, std::string what, std::string hint) {
    throw Failure({kind, {}, {}, std::move(what), std::move(hint), Passing::kNever, code});
}

int exit_status(const Error& error) {
    if (error.passing != Passing::kNever) return kTryAgain;
    switch (error.kind) {
        case ErrorKind::kGraph: return 2;
        case ErrorKind::kInput: return 3;
        case ErrorKind::kOutput: return 4;
        default: return 1;
    }
}

const Error& decisive(const std::vector<Error>& errors) {
    const auto of_graph = std::ranges::find(errors, ErrorKind::kGraph, &Error::kind);
    if (of_graph != errors.end()) return *of_graph;
    const auto stays = std::ranges::find(errors, Passing::kNever, &Error::passing);
    return stays != errors.end() ? *stays : errors.front();
}

std::string_view kind_name(ErrorKind kind) {
    switch (kind) {
        case ErrorKind::kGraph: return "graph";
        case ErrorKind::kInput: return "input";
        case ErrorKind::kOutput: return "output";
        case ErrorKind::kFailed: return "failed";
        case ErrorKind::kCancelled: return "cancelled";
        case ErrorKind::kInternal: break;
    }
    return "internal";
}

std::string_view reason_of(const Error& error) {
    switch (error.passing) {
        case Passing::kSpace: return "space";
        case Passing::kQuota: return "quota";
        case Passing::kStale: return "stale";
        case Passing::kDevice: return "device";
        case Passing::kTimeout: return "timeout";
        case Passing::kUnfinished: return "unfinished";
        case Passing::kMemory: return "memory";
        case Passing::kNever: break;
    }
    return kind_name(error.kind);
}

std::string_view code_of(const Error& error) {
    return error.code == Code::kNone ? reason_of(error) : code_name(error.code);
}

std::string in_quotes(std::string_view text) {
    std::string out = "'";
    std::size_t characters = 0;
    while (!text.empty()) {
        if (++characters > kLongestQuote) return out + "…'";
        const std::size_t length = std::max<std::size_t>(1, utf8_length(text));
        out += escaped(text.substr(0, length));
        text.remove_prefix(length);
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
    if (best.empty() && word.size() >= kLeastBeginning) best = completed(word, candidates);
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
