// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/base/channels.h"
#include "engine/base/index.h"
#include "engine/node/stream.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <optional>

namespace keyline {

namespace {

constexpr std::string_view kPrefix = "cryptomatte/";

bool begins_with_prefix(const Attribute& a) { return a.name.starts_with(kPrefix); }

// The Cryptomattes that the attributes tell of: cryptomatte/ID/name, …/manifest, …
std::vector<CryptomatteInfo> declared_in(const Metadata& metadata, const std::filesystem::path& file) {
    constexpr std::string_view kName = "/name";
    std::vector<CryptomatteInfo> out;
    for (const Attribute& a : metadata.attributes()) {
        const auto* name = std::get_if<std::string>(&a.value);
        if (!name || !begins_with_prefix(a) || !a.name.ends_with(kName)) continue;
        CryptomatteInfo info{*name, {}, a.name.substr(0, a.name.size() - kName.size() + 1), {}, file};
        for (Attribute own : metadata.attributes())
            if (own.name.starts_with(info.prefix)) {
                own.name.erase(0, info.prefix.size());
                info.attributes.push_back(std::move(own));
            }
        out.push_back(std::move(info));
    }
    return out;
}

Metadata without_cryptomattes(Metadata metadata) {
    std::vector<std::string> names;
    for (const Attribute& a : metadata.attributes())
        if (begins_with_prefix(a)) names.push_back(a.name);
    for (const std::string& name : names) metadata.erase(name);
    return metadata;
}

// Layers that differ in their last two digits, and their channels by place; -1 for one that is not there.
using Levels = std::map<int, std::array<int, 4>>;
using LevelsByName = std::map<std::string, Levels, std::less<>>;

LevelsByName levels_of(const Stream& stream) {
    constexpr std::string_view kOrder = "RGBA";
    LevelsByName out;
    for (std::size_t i = 0; i < stream.channels.size(); ++i) {
        const auto [layer, base] = split_channel(stream.channels[i].name);
        const auto level = level_of(layer);
        const std::string_view component = component_of(base);
        const std::size_t place = component.empty() ? std::string_view::npos : kOrder.find(component);
        if (!level || place == std::string_view::npos) continue;
        auto& levels = out[std::string(level->name)];
        levels.try_emplace(level->number, std::array{-1, -1, -1, -1}).first->second[place] =
            static_cast<int>(i);
    }
    return out;
}

// Without a word in the metadata: levels from 0 on, each of four channels of 32 bits.  (A light's layers may
// end in digits too.)
bool looks_like_cryptomatte(const Levels& levels, std::span<const SampleType> types) {
    return levels.contains(0) && std::ranges::all_of(levels, [&](const auto& level) {
               return std::ranges::all_of(
                   level.second, [&](int i) { return i >= 0 && types[index(i)] == SampleType::kFloat; });
           });
}

const CryptomatteInfo* find_declared(const std::vector<CryptomatteInfo>& all, std::string_view layers) {
    for (const CryptomatteInfo& info : all)
        if (info.name == layers) return &info;
    for (const CryptomatteInfo& info : all)
        if (is_called(layers, info.name) || is_called(info.name, layers)) return &info;
    return nullptr;
}

void annotate(Stream& stream, const Levels& levels, CryptomatteInfo info) {
    info.levels = static_cast<int>(levels.size());
    const auto shared = std::make_shared<const CryptomatteInfo>(std::move(info));
    for (const auto& [number, channels] : levels)
        for (int place = 0; place < 4; ++place) {
            const int i = channels[index(place)];
            if (i < 0) continue;
            StreamChannel& c = stream.channels[index(i)];
            c.holds = place % 2 == 0 ? Holds::kId : Holds::kData;
            c.cryptomatte = shared;
            c.place = 4 * number + place;
        }
}

void learn_cryptomattes(Stream& stream, std::span<const SampleType> types,
                        const std::filesystem::path& file) {
    const std::vector<CryptomatteInfo> declared = declared_in(*stream.metadata, file);
    for (const auto& [layers, levels] : levels_of(stream)) {
        if (const CryptomatteInfo* own = find_declared(declared, layers)) {
            CryptomatteInfo info = *own;
            info.layers = layers;
            annotate(stream, levels, std::move(info));
        } else if (declared.empty() && looks_like_cryptomatte(levels, types)) {
            annotate(stream, levels, {layers, layers, {}, {}, file});
        }
    }
    stream.metadata = std::make_shared<Metadata>(without_cryptomattes(*stream.metadata));
}

// Of a name, in lower case and without what only separates words.
std::string letters_of(std::string_view name) {
    std::string out;
    for (const char c : name)
        if (c != '_' && c != '-' && c != ' ')
            out += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return out;
}

bool names_an_id(std::string_view word) {
    static constexpr std::array<std::string_view, 11> kIds{"id",         "ids",        "owner",  "objectid",
                                                           "instanceid", "materialid", "nodeid", "renderid",
                                                           "indexob",    "indexma",    "primid"};
    return std::ranges::find(kIds, word) != kIds.end();
}

// Passes that renderers write in R G B, and that no colour space applies to.
bool names_data(std::string_view word) {
    static constexpr std::array<std::string_view, 9> kExact{"n",  "nn", "p",     "pref",  "uv",
                                                            "st", "z",  "speed", "vector"};
    static constexpr std::array<std::string_view, 8> kEnds{
        "normal", "normals", "position", "positions", "velocity", "motionvector", "motionvectors", "depth"};
    return std::ranges::find(kExact, word) != kExact.end() ||
           std::ranges::any_of(kEnds, [&](std::string_view end) { return word.ends_with(end); });
}

Holds held_by(std::string_view channel, SampleType type) {
    if (type == SampleType::kUint) return Holds::kId;
    const auto [layer, base] = split_channel(channel);
    const std::string word = letters_of(base), of_layer = letters_of(split_channel(layer).base);
    const std::string_view component = component_of(base);
    const bool is_colour =
        !component.empty() && std::string_view("RGBA").find(component) != std::string_view::npos;
    if (type == SampleType::kFloat &&
        (names_an_id(word) || (!component.empty() && !is_colour && names_an_id(of_layer))))
        return Holds::kId;
    if (names_data(is_colour ? of_layer : word) || (!component.empty() && !is_colour && base != "Y"))
        return Holds::kData;
    return Holds::kColour;
}

}  // namespace

void learn_channels(Stream& stream, std::span<const SampleType> types) {
    for (std::size_t i = 0; i < stream.channels.size(); ++i) {
        StreamChannel& c = stream.channels[i];
        c.holds = held_by(c.name, types[i]);
        c.integer = types[i] == SampleType::kUint;
    }
    learn_cryptomattes(stream, types, stream.file);
}

}  // namespace keyline
