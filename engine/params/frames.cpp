// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/params/frames.h"

#include "engine/base/error.h"

#include <charconv>
#include <cstdint>
#include <cstdlib>
#include <fmt/format.h>
#include <optional>
#include <unordered_set>

namespace keyline {

namespace {

constexpr int64_t kMostFrames = 1'000'000;

// 64 bits, so that neither a range's length nor the step past its end overflows.
struct Range {
    int64_t first, last, step;

    int64_t count() const { return std::abs(last - first) / step + 1; }
    int64_t frame(int64_t i) const { return last < first ? first - i * step : first + i * step; }
};

[[noreturn]] void refuse(std::string_view spec, const std::string& what, std::string hint = {}) {
    fail(ErrorKind::kGraph, fmt::format("frames {}: {}", in_quotes(spec), what), std::move(hint));
}

// Takes an int off the front of `text`; nothing where there is none that fits.
std::optional<int64_t> take_int(std::string_view& text) {
    int number = 0;
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc()) return std::nullopt;
    text.remove_prefix(static_cast<std::size_t>(stop - text.data()));
    return number;
}

bool take(std::string_view& text, char c) {
    if (!text.starts_with(c)) return false;
    text.remove_prefix(1);
    return true;
}

bool is_blank(char c) { return c == ' ' || c == '\t'; }

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
    while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
    return text;
}

std::optional<Range> parse_range(std::string_view text) {
    const auto next_int = [&] { return text = trimmed(text), take_int(text); };
    const auto next = [&](char c) { return text = trimmed(text), take(text, c); };
    const auto first = next_int();
    if (!first) return std::nullopt;
    if (text.empty()) return Range{*first, *first, 1};
    if (!next('-')) return std::nullopt;
    const auto last = next_int();
    if (!last) return std::nullopt;
    if (text.empty()) return Range{*first, *last, 1};
    if (!next('x') && !next(':')) return std::nullopt;
    const auto step = next_int();
    if (!step || !text.empty()) return std::nullopt;
    return Range{*first, *last, *step};
}

Range checked_range(std::string_view part, std::string_view spec) {
    const auto range = parse_range(part);
    if (!range)
        refuse(spec, in_quotes(part) + " is no frame or range", "write A, A-B or A-BxS, joined by commas");
    if (range->step < 1)
        refuse(spec, fmt::format("the step of {} is {}; the least is 1", in_quotes(part), range->step));
    return *range;
}

// How many of `frames` from `start` on are evenly spaced, up or down.
std::size_t run_length(const std::vector<int>& frames, std::size_t start) {
    const auto step = [&frames](std::size_t i) { return int64_t{frames[i + 1]} - frames[i]; };
    std::size_t last = start;
    while (last + 1 < frames.size() && step(last) != 0 && step(last) == step(start)) ++last;
    return last - start + 1;
}

}  // namespace

std::vector<int> parse_frames(std::string_view spec) {
    std::vector<int> out;
    std::unordered_set<int> seen;
    std::string_view rest = spec;
    int64_t count = 0;
    const bool is_one_range = spec.find(',') == std::string_view::npos;
    while (true) {
        const std::size_t comma = rest.find(',');
        const Range range = checked_range(trimmed(rest.substr(0, comma)), spec);
        count += range.count();
        if (count > kMostFrames) refuse(spec, fmt::format("more than {} frames", kMostFrames));
        for (int64_t i = 0; i < range.count(); ++i) {
            const auto frame = static_cast<int>(range.frame(i));
            if (is_one_range || seen.insert(frame).second) out.push_back(frame);
        }
        if (comma == std::string_view::npos) return out;
        rest.remove_prefix(comma + 1);
    }
}

std::string format_frames(const std::vector<int>& frames) {
    std::string out;
    for (std::size_t i = 0; i < frames.size();) {
        // Two frames are shorter as a list.
        const std::size_t run = run_length(frames, i) < 3 ? 1 : run_length(frames, i);
        if (i > 0) out += ", ";
        out += std::to_string(frames[i]);
        if (run > 1) {
            const int64_t step = std::abs(int64_t{frames[i + 1]} - frames[i]);
            out += fmt::format("-{}", frames[i + run - 1]);
            if (step > 1) out += fmt::format("x{}", step);
        }
        i += run;
    }
    return out;
}

}  // namespace keyline
