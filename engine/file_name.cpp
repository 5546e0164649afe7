// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/file_name.h"

#include "engine/error.h"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <fmt/format.h>
#include <set>

namespace keyline {

namespace {

constexpr std::size_t kMostDigits = 20;  // of padding: more is a slip, and no file system takes it far

// "%04d" and "%d" give the number of digits and the length of the token; nothing for anything else.
struct Token {
    std::size_t length, digits;
};

std::optional<Token> parse_percent(std::string_view text) {
    if (text.starts_with("%d")) return Token{2, 0};
    if (!text.starts_with("%0")) return std::nullopt;
    std::size_t digits = 0;
    const auto [stop, error] = std::from_chars(text.data() + 2, text.data() + text.size(), digits);
    const auto length = static_cast<std::size_t>(stop - text.data());
    if (error != std::errc() || digits == 0 || !text.substr(length).starts_with('d')) return std::nullopt;
    return Token{length + 1, digits};
}

// The frames that the digits at the start of `text` can be read as: all of them, or fewer where digits of
// the name itself follow.
std::vector<int> readings(std::string_view text) {
    std::vector<int> out;
    const std::size_t sign = text.starts_with('-') ? 1 : 0;
    for (std::size_t end = sign + 1; end <= text.size(); ++end) {
        int frame = 0;
        const auto [stop, error] = std::from_chars(text.data(), text.data() + end, frame);
        if (stop != text.data() + end) break;
        if (error == std::errc()) out.push_back(frame);
    }
    return out;
}

std::vector<std::string> entries_of(const std::filesystem::path& folder) {
    std::vector<std::string> out;
    std::error_code error;
    const std::filesystem::path listed = folder.empty() ? "." : folder;
    for (std::filesystem::directory_iterator entry(listed, error), end; !error && entry != end;
         entry.increment(error))
        out.push_back(entry->path().filename().string());
    const bool absent = error == std::errc::no_such_file_or_directory || error == std::errc::not_a_directory;
    if (error && !absent)
        fail(ErrorKind::kInput,
             fmt::format("can't list the folder {}: {}", in_quotes(listed.string()), error.message()));
    return out;
}

}  // namespace

FileName::FileName(std::string_view text, std::filesystem::path base) : text_(text), base_(std::move(base)) {
    Parsed parsed = parse(text);
    if (!parsed.fault.empty()) fail(ErrorKind::kGraph, std::move(parsed.fault));
    pieces_ = std::move(parsed.pieces);
}

std::optional<std::string> FileName::fault(std::string_view text) {
    std::string fault = parse(text).fault;
    return fault.empty() ? std::nullopt : std::optional(std::move(fault));
}

bool FileName::has_frame() const { return pieces_.size() > 1; }

std::filesystem::path FileName::at(int frame) const { return base_ / written(pieces_, frame); }

std::vector<int> FileName::frames_on_disk() const {
    if (!has_frame()) return {};
    // The first component that holds the frame is listed; every later one then follows from the frame.
    const std::string& head = pieces_.front().text;
    const std::size_t slash = head.rfind('/');
    const std::size_t start = slash == std::string::npos ? 0 : slash + 1;
    const std::string prefix = head.substr(start);
    std::set<int> out;
    for (const std::string& entry : entries_of(base_ / head.substr(0, start))) {
        if (!entry.starts_with(prefix)) continue;
        for (const int frame : readings(std::string_view(entry).substr(prefix.size()))) {
            const std::string path = written(pieces_, frame).substr(start);
            std::error_code error;
            if (path.substr(0, path.find('/')) == entry && std::filesystem::is_regular_file(at(frame), error))
                out.insert(frame);
        }
    }
    return {out.begin(), out.end()};
}

FileName::Parsed FileName::parse(std::string_view text) {
    const std::string name = in_quotes(text);
    if (text.empty()) return {{}, "a file name is empty"};
    if (text.ends_with('/')) return {{}, fmt::format("{} names a folder, not a file", name)};
    if (text.find('\0') != std::string_view::npos)
        return {{}, fmt::format("the file name {} holds a NUL", name)};
    Parsed out{{{}}, {}};
    while (!text.empty()) {
        const std::size_t plain = std::min(text.find_first_of("#%"), text.size());
        out.pieces.back().text += text.substr(0, plain);
        text.remove_prefix(plain);
        if (text.starts_with("%%")) {
            out.pieces.back().text += '%';
            text.remove_prefix(2);
        } else if (!text.empty()) {
            const std::size_t run = std::min(text.find_first_not_of('#'), text.size());
            const auto token = run > 0 ? Token{run, run} : parse_percent(text);
            if (!token)
                return {
                    {},
                    fmt::format(
                        "a '%' in the file name {} starts neither %d nor %04d; a percent sign is written %%",
                        name)};
            if (token->digits > kMostDigits)
                return {{},
                        fmt::format("the file name {} pads the frame to {} digits; the most is {}", name,
                                    token->digits, kMostDigits)};
            out.pieces.back().digits = token->digits;
            out.pieces.emplace_back();
            text.remove_prefix(token->length);
        }
    }
    return out;
}

std::string FileName::written(const std::vector<Piece>& pieces, int frame) {
    std::string out;
    for (const Piece& piece : pieces) {
        out += piece.text;
        if (!piece.digits) continue;
        const std::string digits = std::to_string(std::abs(static_cast<long long>(frame)));
        if (frame < 0) out += '-';
        out.append(*piece.digits - std::min(*piece.digits, digits.size()), '0');
        out += digits;
    }
    return out;
}

}  // namespace keyline
