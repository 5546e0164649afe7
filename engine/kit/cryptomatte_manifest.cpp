// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/base/error.h"
#include "engine/kit/cryptomatte.h"
#include "engine/kit/manifest_text.h"
#include "engine/kit/wildcard.h"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>

namespace keyline {

namespace {

std::optional<uint32_t> parse_id(std::string_view text) {
    uint32_t id = 0;
    const char* end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data(), end, id, 16);
    if (text.empty() || text.size() > 8 || error != std::errc{} || rest != end) return {};
    return id;
}

}  // namespace

bool has_wildcard(std::string_view pattern) {
    for (std::size_t i = 0; i < pattern.size(); ++i)
        if (pattern[i] == '*' && (i == 0 || pattern[i - 1] != '\\')) return true;
    return false;
}

std::string literal_name(std::string_view pattern) {
    std::string out;
    for (std::size_t i = 0; i < pattern.size(); ++i)
        if (!pattern.substr(i).starts_with("\\*")) out += pattern[i];
    return out;
}

std::shared_ptr<const CryptomatteManifest> CryptomatteManifest::find(Context& context,
                                                                     const CryptomatteInfo& info,
                                                                     std::vector<std::string>& faults) {
    const std::optional<std::string> text = manifest_text(info, faults);
    if (!text) return nullptr;
    const Digest key = Digester("manifest").add(*text).digest();
    auto manifest = context.remember<CryptomatteManifest>(key, text->size(), [&] { return parse(*text); });
    if (!manifest->fault().empty()) faults.push_back("the manifest is not whole: " + manifest->fault());
    if (manifest->size() == 0 && !manifest->fault().empty()) return nullptr;
    return manifest;
}

CryptomatteManifest CryptomatteManifest::parse(std::string_view json) {
    ManifestScanner scanner(json);
    CryptomatteManifest manifest;
    while (auto pair = scanner.next()) {
        if (const auto id = parse_id(pair->second))
            manifest.entries_.emplace_back(std::move(pair->first), *id);
        else
            scanner.fault(fmt::format("{} of {} is no id of up to 8 hexadecimal digits",
                                      in_quotes(pair->second), in_quotes(pair->first)));
    }
    std::ranges::sort(manifest.entries_);
    const auto twice =
        std::ranges::adjacent_find(manifest.entries_, {}, [](const auto& e) { return e.first; });
    if (twice != manifest.entries_.end()) scanner.fault(in_quotes(twice->first) + " is named twice");
    manifest.entries_.erase(std::unique(manifest.entries_.begin(), manifest.entries_.end()),
                            manifest.entries_.end());
    manifest.fault_ = scanner.first_fault();
    return manifest;
}

std::vector<uint32_t> CryptomatteManifest::ids(std::string_view pattern) const {
    std::vector<uint32_t> out;
    if (has_wildcard(pattern)) {
        for (const auto& [name, id] : entries_)
            if (matches(name, pattern)) out.push_back(id);
        return out;
    }
    const auto name_of = [](const auto& e) { return std::string_view(e.first); };
    const std::string name = literal_name(pattern);
    const auto first = std::ranges::lower_bound(entries_, std::string_view(name), {}, name_of);
    for (auto it = first; it != entries_.end() && it->first == name; ++it) out.push_back(it->second);
    return out;
}

std::vector<std::string> CryptomatteManifest::names() const {
    std::vector<std::string> out;
    for (const auto& [name, id] : entries_) out.push_back(name);
    return out;
}

}  // namespace keyline
