// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/cryptomatte.h"
#include "engine/error.h"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>
#include <fstream>
#include <iterator>

namespace keyline {

namespace {

// A flat JSON object of strings; manifests of 100,000 names are usual, so nothing is built but the names.
class ManifestScanner {
public:
    explicit ManifestScanner(std::string_view text) : text_(text) {}

    std::vector<std::pair<std::string, uint32_t>> entries() {
        std::vector<std::pair<std::string, uint32_t>> out;
        expect('{');
        if (!accept('}')) {
            do {
                std::string name = string();
                expect(':');
                const std::string id = string();
                out.emplace_back(std::move(name), number(id));
            } while (accept(','));
            expect('}');
        }
        skip_blanks();
        if (at_ != text_.size()) fault("text after its end");
        return out;
    }

private:
    [[noreturn]] void fault(std::string_view what) const {
        fail(ErrorKind::kInput,
             fmt::format("the Cryptomatte manifest is no JSON object of ids: {} at byte {}", what, at_));
    }

    void skip_blanks() {
        while (at_ < text_.size() && std::string_view(" \t\r\n").find(text_[at_]) != std::string_view::npos)
            ++at_;
    }

    bool accept(char c) {
        skip_blanks();
        if (at_ == text_.size() || text_[at_] != c) return false;
        ++at_;
        return true;
    }

    void expect(char c) {
        if (!accept(c)) fault(fmt::format("'{}' is missing", c));
    }

    char next() {
        if (at_ == text_.size()) fault("it ends early");
        return text_[at_++];
    }

    std::string string() {
        expect('"');
        std::string out;
        for (char c = next(); c != '"'; c = next()) {
            if (c == '\\')
                append_escaped(out);
            else
                out += c;
        }
        return out;
    }

    void append_escaped(std::string& out) {
        static constexpr std::string_view kLetters = "\"\\/bfnrt", kMeanings = "\"\\/\b\f\n\r\t";
        const char c = next();
        if (c == 'u') return append_utf8(out, code_point());
        const std::size_t i = kLetters.find(c);
        if (i == std::string_view::npos) fault("an unknown escape");
        out += kMeanings[i];
    }

    uint32_t code_point() {
        const uint32_t first = four_digits();
        if (first < 0xD800 || first > 0xDBFF) return first;
        if (next() != '\\' || next() != 'u') fault("half a surrogate pair");
        return 0x10000 + ((first - 0xD800) << 10) + ((four_digits() - 0xDC00) & 0x3FF);
    }

    uint32_t four_digits() {
        if (text_.size() - at_ < 4) fault("it ends early");
        at_ += 4;
        return hexadecimal(text_.substr(at_ - 4, 4));
    }

    uint32_t number(const std::string& id) const {
        if (id.empty() || id.size() > 8) fault(fmt::format("{} is no id", in_quotes(id)));
        return hexadecimal(id);
    }

    uint32_t hexadecimal(std::string_view digits) const {
        uint32_t value = 0;
        const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value, 16);
        if (error != std::errc{} || end != digits.data() + digits.size())
            fault(fmt::format("{} is no hexadecimal number", in_quotes(digits)));
        return value;
    }

    static void append_utf8(std::string& out, uint32_t c) {
        const auto tail = [&](int shift) { out += static_cast<char>(0x80 | (c >> shift & 0x3F)); };
        if (c < 0x80) {
            out += static_cast<char>(c);
        } else if (c < 0x800) {
            out += static_cast<char>(0xC0 | c >> 6);
            tail(0);
        } else if (c < 0x10000) {
            out += static_cast<char>(0xE0 | c >> 12);
            tail(6), tail(0);
        } else {
            out += static_cast<char>(0xF0 | c >> 18);
            tail(12), tail(6), tail(0);
        }
    }

    std::string_view text_;
    std::size_t at_ = 0;
};

// Whether `text` is `pattern`, in which * stands for any characters.
bool matches(std::string_view text, std::string_view pattern) {
    std::size_t t = 0, p = 0, star = std::string_view::npos, resume = 0;
    while (t < text.size()) {
        if (p < pattern.size() && pattern[p] == '*') {
            star = p++;
            resume = t;
        } else if (p < pattern.size() && pattern[p] == text[t]) {
            ++p, ++t;
        } else if (star != std::string_view::npos) {
            p = star + 1;
            t = ++resume;
        } else {
            return false;
        }
    }
    return pattern.find_first_not_of('*', p) == std::string_view::npos;
}

std::string string_of(const Metadata& metadata, const std::string& name) {
    const Attribute* a = metadata.find(name);
    const auto* text = a ? std::get_if<std::string>(&a->value) : nullptr;
    return text ? *text : "";
}

// "cryptomatte/ID/" of the Cryptomatte; empty where the metadata do not tell of it.
std::string prefix_of(const Metadata& metadata, const Cryptomatte& matte, std::string_view layer) {
    std::vector<std::string> prefixes;
    for (const Attribute& a : metadata.attributes()) {
        if (!a.name.starts_with("cryptomatte/") || !a.name.ends_with("/name")) continue;
        const std::string name = string_of(metadata, a.name);
        const bool is_it = matte.name.empty() ? layer.empty() || is_called(name, layer)
                                              : is_called(matte.name, name) || is_called(name, matte.name);
        if (is_it) prefixes.push_back(a.name.substr(0, a.name.size() - 4));
    }
    return prefixes.size() == 1 ? prefixes[0] : "";
}

std::string read_text(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    std::string text{std::istreambuf_iterator<char>(in), {}};
    if (!in.is_open() || in.bad())
        fail(ErrorKind::kInput, fmt::format("the Cryptomatte manifest {} can't be read", file.string()),
             "the image's metadata name it; it belongs beside the image");
    return text;
}

}  // namespace

std::optional<CryptomatteManifest> CryptomatteManifest::find(const Stream& stream, const Cryptomatte& matte,
                                                             std::string_view layer) {
    const std::string prefix = prefix_of(*stream.metadata, matte, layer);
    if (prefix.empty()) return {};
    if (const std::string text = string_of(*stream.metadata, prefix + "manifest"); !text.empty())
        return parse(text);
    const std::string file = string_of(*stream.metadata, prefix + "manif_file");
    if (file.empty()) return {};
    return parse(read_text(stream.file.parent_path() / file));
}

CryptomatteManifest CryptomatteManifest::parse(std::string_view json) {
    CryptomatteManifest manifest;
    manifest.entries_ = ManifestScanner(json).entries();
    std::ranges::sort(manifest.entries_);
    return manifest;
}

std::vector<uint32_t> CryptomatteManifest::ids(std::string_view pattern) const {
    std::vector<uint32_t> out;
    if (pattern.find('*') == std::string_view::npos) {
        const auto it = std::ranges::lower_bound(entries_, pattern, {},
                                                 [](const auto& e) { return std::string_view(e.first); });
        if (it != entries_.end() && it->first == pattern) out.push_back(it->second);
        return out;
    }
    for (const auto& [name, id] : entries_)
        if (matches(name, pattern)) out.push_back(id);
    return out;
}

std::vector<std::string> CryptomatteManifest::names() const {
    std::vector<std::string> out;
    for (const auto& [name, id] : entries_) out.push_back(name);
    return out;
}

}  // namespace keyline
