// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/cryptomatte.h"
#include "engine/error.h"
#include "engine/graph_json.h"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>
#include <fstream>
#include <iterator>

namespace keyline {

namespace {

[[noreturn]] void fault(const Place& place, std::string_view what) {
    fail(ErrorKind::kInput,
         fmt::format("line {}, column {} of the Cryptomatte manifest, a JSON object of ids: {}", place.line,
                     place.column, what));
}

Value parse_manifest(std::string_view json) {
    try {
        return parse_json(json, {});
    } catch (const Failure& f) {
        fault(f.error().place, f.error().what);
    }
}

uint32_t id_of(const Value& v) {
    uint32_t id = 0;
    const char* end = v.text.data() + v.text.size();
    const auto [rest, error] = std::from_chars(v.text.data(), end, id, 16);
    if (!v.is(Value::Kind::kString) || v.text.size() > 8 || error != std::errc{} || rest != end)
        fault(v.place, v.shown() + " is no id of up to 8 hexadecimal digits, in quotes");
    return id;
}

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
    for (const auto& [prefix, name] : cryptomatte_entries(metadata)) {
        const bool is_it = matte.name.empty() ? layer.empty() || is_called(name, layer)
                                              : is_called(matte.name, name) || is_called(name, matte.name);
        if (is_it) prefixes.push_back(prefix);
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
    Value root = parse_manifest(json);
    if (!root.is(Value::Kind::kObject)) fault(root.place, root.shown() + " is no object");
    CryptomatteManifest manifest;
    for (Member& m : root.members) manifest.entries_.emplace_back(std::move(m.key), id_of(m.value));
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
