// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/cryptomatte.h"

#include "engine/channels.h"
#include "engine/error.h"

#include <algorithm>
#include <bit>
#include <cctype>
#include <fmt/format.h>
#include <map>

namespace keyline {

namespace {

uint32_t scrambled(uint32_t block) { return std::rotl(block * 0xcc9e2d51U, 15) * 0x1b873593U; }

// The bytes of a block, the first the lowest.
uint32_t block_of(std::string_view bytes) {
    uint32_t block = 0;
    for (std::size_t i = bytes.size(); i-- > 0;)
        block = block << 8 | static_cast<uint32_t>(static_cast<unsigned char>(bytes[i]));
    return block;
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

// "CryptoObject" of the level "CryptoObject01"; a layer that is no level has none.
std::optional<std::string> name_of_level(std::string_view layer) {
    const std::size_t n = layer.size();
    if (layer.empty()) return "";
    if (n < 3 || !is_digit(layer[n - 1]) || !is_digit(layer[n - 2])) return {};
    return std::string(layer.substr(0, n - 2));
}

// The channel of a level, in lower or upper case; R G B A without a layer are colour.
const StreamChannel* component(const Stream& stream, const std::string& layer, char c) {
    const std::string lower(1, c), upper(1, static_cast<char>(std::toupper(c)));
    const StreamChannel* found = stream.find(join_channel(layer, lower));
    if (found) return found;
    return layer.empty() ? nullptr : stream.find(join_channel(layer, upper));
}

// Whether channels that have lost their layer may be those of a Cryptomatte called `layer`.
bool may_be_called(const Metadata& metadata, std::string_view layer) {
    const std::vector<CryptomatteEntry> entries = cryptomatte_entries(metadata);
    return entries.empty() || layer.empty() ||
           std::ranges::any_of(entries, [&](const CryptomatteEntry& e) { return is_called(e.name, layer); });
}

void add_ranks(const Stream& stream, const std::string& layer, std::vector<Cryptomatte::Rank>& ranks) {
    for (const auto& [id, coverage] : {std::pair('r', 'g'), std::pair('b', 'a')}) {
        const StreamChannel *i = component(stream, layer, id), *c = component(stream, layer, coverage);
        if (i && c) ranks.push_back({i->value, c->value});
    }
}

}  // namespace

bool is_called(std::string_view name, std::string_view wanted) {
    return name == wanted || (name.size() > wanted.size() && name.ends_with(wanted) &&
                              name[name.size() - wanted.size() - 1] == '.');
}

uint32_t murmur3_32(std::string_view text) {
    uint32_t hash = 0;
    const std::size_t whole = text.size() / 4 * 4;
    for (std::size_t i = 0; i < whole; i += 4)
        hash = std::rotl(hash ^ scrambled(block_of(text.substr(i, 4))), 13) * 5 + 0xe6546b64U;
    hash ^= scrambled(block_of(text.substr(whole)));
    hash ^= static_cast<uint32_t>(text.size());
    hash = (hash ^ hash >> 16) * 0x85ebca6bU;
    hash = (hash ^ hash >> 13) * 0xc2b2ae35U;
    return hash ^ hash >> 16;
}

uint32_t cryptomatte_id(std::string_view name) {
    const uint32_t hash = murmur3_32(name), exponent = hash >> 23 & 0xff;
    return exponent == 0 || exponent == 0xff ? hash ^ 1U << 23 : hash;
}

std::vector<ValueRef> Cryptomatte::values() const {
    std::vector<ValueRef> out;
    for (const Rank& r : ranks) out.insert(out.end(), {r.id, r.coverage});
    return out;
}

std::vector<CryptomatteEntry> cryptomatte_entries(const Metadata& metadata) {
    constexpr std::string_view kName = "/name";
    std::vector<CryptomatteEntry> out;
    for (const Attribute& a : metadata.attributes()) {
        const auto* name = std::get_if<std::string>(&a.value);
        if (name && a.name.starts_with("cryptomatte/") && a.name.ends_with(kName))
            out.push_back({a.name.substr(0, a.name.size() - kName.size() + 1), *name});
    }
    return out;
}

std::vector<Cryptomatte> cryptomattes_of(const Stream& stream) {
    std::map<std::string, std::vector<std::string>> levels;  // by name
    std::vector<std::string> layers = layers_of(stream.names());
    layers.emplace_back();
    std::ranges::sort(layers);
    for (const std::string& layer : layers)
        if (const auto name = name_of_level(layer)) levels[*name].push_back(layer);
    std::vector<Cryptomatte> out;
    for (const auto& [name, of_name] : levels) {
        Cryptomatte matte{name, {}};
        for (const std::string& layer : of_name) add_ranks(stream, layer, matte.ranks);
        if (!matte.ranks.empty()) out.push_back(std::move(matte));
    }
    return out;
}

Cryptomatte find_cryptomatte(const Stream& stream, std::string_view layer) {
    std::vector<Cryptomatte> all = cryptomattes_of(stream);
    // A level selected from a layer is all there is.
    if (all.size() == 1 && all[0].name.empty() && may_be_called(*stream.metadata, layer)) return all[0];
    std::erase_if(all, [](const Cryptomatte& c) { return c.name.empty(); });
    std::vector<std::string> names;
    for (const Cryptomatte& c : all) names.push_back(c.name);
    if (names.empty())
        fail(ErrorKind::kGraph, "the input has no Cryptomatte",
             "it is layers like CryptoObject00 with the channels r g b a: connect the whole image");
    std::erase_if(all, [&](const Cryptomatte& c) { return !layer.empty() && !is_called(c.name, layer); });
    if (all.size() == 1) return all[0];
    if (layer.empty())
        fail(ErrorKind::kGraph, "the input has several Cryptomattes", "name one: " + listed(names));
    if (all.empty())
        fail(ErrorKind::kGraph, fmt::format("there is no Cryptomatte {}", in_quotes(layer)),
             "there is " + listed(names));
    fail(ErrorKind::kGraph, fmt::format("several Cryptomattes are called {}", in_quotes(layer)),
         "give the whole name: " + listed(names));
}

}  // namespace keyline
