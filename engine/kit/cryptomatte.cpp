// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/cryptomatte.h"

#include "engine/base/bad_value.h"
#include "engine/base/channels.h"

#include <algorithm>
#include <bit>
#include <fmt/format.h>
#include <map>
#include <set>

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

// Where the channels of one Cryptomatte are in a stream, by their places in it.
using Places = std::map<int, ValueRef>;

// Without the level: "CryptoObject" of CryptoObject01.r.
std::string name_here(const StreamChannel& c) {
    const std::string_view layer = split_channel(c.name).layer;
    const auto level = level_of(layer);
    return std::string(level ? level->name : layer);
}

bool may_be_called(const Cryptomatte& c, std::string_view wanted) {
    return is_called(c.name, wanted) || is_called(c.info->layers, wanted) || is_called(c.info->name, wanted);
}

std::vector<std::string> names_of(const std::vector<Cryptomatte>& all) {
    std::vector<std::string> out;
    for (const Cryptomatte& c : all) out.push_back(c.shown_name());
    return out;
}

void tell_of_levels(Builder& builder, const Stream& stream, const Cryptomatte& matte) {
    std::set<int> levels;
    for (const StreamChannel& c : stream.channels)
        if (c.cryptomatte == matte.info) levels.insert(c.place / 4);
    const auto here = static_cast<int>(levels.size());
    if (here < matte.info->levels)
        builder.warn(
            fmt::format("the input has {} of the {} levels of the Cryptomatte {}: objects that cover "
                        "little of a pixel are missing; connect the whole image",
                        here, matte.info->levels, in_quotes(matte.shown_name())));
}

[[noreturn]] void refuse_none(const Stream& stream) {
    for (const StreamChannel& c : stream.channels)
        if (level_of(split_channel(c.name).layer))
            fail(ErrorKind::kGraph,
                 fmt::format(
                     "the input has no Cryptomatte; the layer {} is none: no metadata tell of it, and it "
                     "is not a level of four channels of 32 bits",
                     in_quotes(split_channel(c.name).layer)),
                 "connect the whole image");
    fail(ErrorKind::kGraph, "the input has no Cryptomatte",
         "it is layers like CryptoObject00 with the channels r g b a: connect the whole image");
}

}  // namespace

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

void add_cryptomatte(Stream& stream, const Cryptomatte& of, const Cryptomatte::Rank& rank, ValueRef nothing) {
    CryptomatteInfo one_level = *of.info;
    one_level.levels = 1;
    const auto shared = std::make_shared<const CryptomatteInfo>(std::move(one_level));
    const std::string level = of.name.empty() ? "" : of.name + "00.";
    const std::array channels{rank.id, rank.coverage, nothing, nothing};
    for (int i = 0; i < 4; ++i)
        stream.set({level + "rgba"[i], channels[index(i)], i % 2 == 0 ? Holds::kId : Holds::kData, false,
                    shared, i});
}

void refuse_half(const Builder& builder, ValueRef id, std::string_view name) {
    if (builder.stored_type(id).value_or(SampleType::kFloat) == SampleType::kHalf)
        fail(ErrorKind::kInput,
             fmt::format("the ids of the Cryptomatte {} are stored as half, which destroys them",
                         in_quotes(name)),
             "write them with 32 bits");
}

std::vector<Cryptomatte> cryptomattes_of(const Stream& stream) {
    std::map<std::pair<std::string, std::shared_ptr<const CryptomatteInfo>>, Places> found;
    for (const StreamChannel& c : stream.channels)
        if (c.cryptomatte) found[{name_here(c), c.cryptomatte}][c.place] = c.value;
    std::vector<Cryptomatte> out;
    for (const auto& [key, places] : found) {
        Cryptomatte matte{key.first, {}, key.second};
        for (const auto& [place, id] : places)
            if (const auto coverage = places.find(place + 1); place % 2 == 0 && coverage != places.end())
                matte.ranks.push_back({id, coverage->second});
        if (!matte.ranks.empty()) out.push_back(std::move(matte));
    }
    return out;
}

Cryptomatte find_cryptomatte(Builder& builder, const Stream& stream, std::string_view layer) {
    std::vector<Cryptomatte> all = cryptomattes_of(stream);
    const std::vector<std::string> names = names_of(all);
    if (names.empty()) refuse_none(stream);
    const bool whole = std::ranges::any_of(all, [&](const Cryptomatte& c) { return c.name == layer; });
    if (!layer.empty())
        std::erase_if(
            all, [&](const Cryptomatte& c) { return whole ? c.name != layer : !may_be_called(c, layer); });
    if (all.size() == 1) {
        for (const Cryptomatte::Rank& rank : all[0].ranks) refuse_half(builder, rank.id, all[0].shown_name());
        tell_of_levels(builder, stream, all[0]);
        return all[0];
    }
    if (layer.empty())
        fail(ErrorKind::kGraph, "the input has several Cryptomattes", "name one: " + listed(names));
    if (all.empty())
        throw BadValue(std::string(layer), fmt::format("there is no Cryptomatte {}", in_quotes(layer)),
                       "there is " + listed(names));
    throw BadValue(std::string(layer), fmt::format("several Cryptomattes are called {}", in_quotes(layer)),
                   "give the whole name: " + listed(names));
}

}  // namespace keyline
