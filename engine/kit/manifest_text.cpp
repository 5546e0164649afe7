// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/manifest_text.h"

#include "engine/base/error.h"
#include "engine/base/text.h"

#include <charconv>
#include <fmt/format.h>
#include <fstream>
#include <iterator>
#include <system_error>

namespace keyline {

namespace {

// As much as a header may hold.
constexpr std::uintmax_t kMostBytes = std::uintmax_t{64} << 20;

std::string text_of(const CryptomatteInfo& info, std::string_view name) {
    for (const Attribute& a : info.attributes)
        if (const auto* text = std::get_if<std::string>(&a.value); text && a.name == name) return *text;
    return {};
}

// A name of a file in the image's own folder, and nothing that leads out of it.
bool is_plain_name(const std::string& name) {
    return name != "." && name != ".." &&
           name.find_first_of(std::string_view("/\\\0", 3)) == std::string::npos;
}

std::optional<std::string> read_beside(const CryptomatteInfo& info, const std::string& name,
                                       std::vector<std::string>& faults) {
    const auto refuse = [&](std::string_view why) {
        faults.push_back(fmt::format("its manifest {} {}", in_quotes(name), why));
        return std::nullopt;
    };
    if (!is_plain_name(name)) return refuse("is no file beside the image, and is not read");
    const std::filesystem::path file = info.file.parent_path() / name;
    std::error_code error;
    if (!std::filesystem::exists(file, error)) return refuse("is not there; it belongs beside the image");
    if (!std::filesystem::is_regular_file(file, error)) return refuse("is no regular file, and is not read");
    if (std::filesystem::file_size(file, error) > kMostBytes || error)
        return refuse("is larger than 64 MiB, and is not read");
    std::ifstream in(file, std::ios::binary);
    std::string text{std::istreambuf_iterator<char>(in), {}};
    if (!in.is_open() || in.bad()) return refuse("can't be read");
    return text;
}

bool is_utf8(std::string_view text) {
    while (!text.empty()) {
        const std::size_t length = utf8_length(text);
        if (length == 0) return false;
        text.remove_prefix(length);
    }
    return true;
}

void append_code_point(std::string& out, uint32_t c) {
    const auto add = [&](uint32_t byte) { out += static_cast<char>(byte); };
    if (c < 0x80) return add(c);
    if (c < 0x800) {
        add(0xC0 | c >> 6);
    } else if (c < 0x10000) {
        add(0xE0 | c >> 12);
        add(0x80 | (c >> 6 & 0x3F));
    } else {
        add(0xF0 | c >> 18);
        add(0x80 | (c >> 12 & 0x3F));
        add(0x80 | (c >> 6 & 0x3F));
    }
    add(0x80 | (c & 0x3F));
}

}  // namespace

std::optional<std::string> manifest_text(const CryptomatteInfo& info, std::vector<std::string>& faults) {
    if (std::string text = text_of(info, "manifest"); !text.empty()) return text;
    const std::string name = text_of(info, "manif_file");
    return name.empty() ? std::nullopt : read_beside(info, name, faults);
}

ManifestScanner::ManifestScanner(std::string_view text) : text_(text) {
    if (text_.starts_with("\xEF\xBB\xBF")) at_ = 3;
    skip_blanks();
    if (!take('{')) stop("it is no JSON object");
}

std::optional<std::pair<std::string, std::string>> ManifestScanner::next() {
    skip_blanks();
    while (take(',')) skip_blanks();
    if (take('}')) {
        skip_blanks();
        if (at_ < text_.size()) stop("something follows its end");
        return {};
    }
    auto name = take_string();
    skip_blanks();
    if (!name || !take(':')) {
        stop(fmt::format("it breaks off or is no JSON after {} names", pairs_));
        return {};
    }
    skip_blanks();
    auto value = take_string();
    if (!value) {
        stop(fmt::format("it breaks off or is no JSON after {} names", pairs_));
        return {};
    }
    ++pairs_;
    if (!is_utf8(*name)) fault(in_quotes(*name) + " is no UTF-8");
    return std::pair(std::move(*name), std::move(*value));
}

void ManifestScanner::fault(std::string what) {
    if (fault_.empty()) fault_ = std::move(what);
}

void ManifestScanner::stop(std::string what) {
    fault(std::move(what));
    at_ = text_.size();
}

void ManifestScanner::skip_blanks() {
    while (at_ < text_.size() && std::string_view(" \t\r\n").find(text_[at_]) != std::string_view::npos)
        ++at_;
}

bool ManifestScanner::take(char c) {
    if (at_ == text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
}

// Nothing where there is none, or it does not end.
std::optional<std::string> ManifestScanner::take_string() {
    if (!take('"')) return {};
    std::string out;
    while (at_ < text_.size()) {
        const char c = text_[at_++];
        if (c == '"') return out;
        if (c == '\\')
            take_escape(out);
        else
            out += c;
    }
    return {};
}

void ManifestScanner::take_escape(std::string& out) {
    if (at_ == text_.size()) return;
    constexpr std::string_view kLetters = "\"\\/bfnrt", kMeant = "\"\\/\b\f\n\r\t";
    const char c = text_[at_++];
    if (const auto i = kLetters.find(c); i != std::string_view::npos) {
        out += kMeant[i];
        return;
    }
    const auto unit = c == 'u' ? take_code_unit() : std::nullopt;
    if (!unit) {
        fault(fmt::format("a backslash before {}", in_quotes(std::string(1, c))));
        out += c;
        return;
    }
    uint32_t point = *unit;
    if (point >= 0xD800 && point < 0xDC00 && text_.substr(at_).starts_with("\\u")) {
        at_ += 2;
        const auto low = take_code_unit();
        if (low && *low >= 0xDC00 && *low < 0xE000)
            point = 0x10000 + ((point - 0xD800) << 10) + (*low - 0xDC00);
    }
    if (point >= 0xD800 && point < 0xE000) fault("half of a surrogate pair");
    append_code_point(out, point);
}

// Four hexadecimal digits.
std::optional<uint32_t> ManifestScanner::take_code_unit() {
    uint32_t unit = 0;
    const std::string_view digits = text_.substr(at_, 4);
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), unit, 16);
    if (error != std::errc{} || end != digits.data() + 4) return {};
    at_ += 4;
    return unit;
}

}  // namespace keyline
