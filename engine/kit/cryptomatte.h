// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/node/node.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

// Cryptomatte 1.2: channels that say by rank which objects a pixel shows and how much of it each covers.  An
// object's id is the hash of its name, kept as the bits of a float: only ever compared, never computed with.

namespace KEYLINE_API keyline {

// MurmurHash3, x86 32 bit, with the seed 0.
uint32_t murmur3_32(std::string_view text);

// The bits that stand for a name: its hash, with one bit flipped where they would be 0, denormal, infinite or
// NaN.
uint32_t cryptomatte_id(std::string_view name);

// Where a stream holds one Cryptomatte.
struct Cryptomatte {
    struct Rank {
        ValueRef id, coverage;
    };
    std::string name;         // that its layers have here: "ViewLayer.CryptoObject"; empty without a layer
    std::vector<Rank> ranks;  // the largest coverage first
    std::shared_ptr<const CryptomatteInfo> info;

    // All channels, id and coverage in turn.
    std::vector<ValueRef> values() const;
    // What people call it.
    const std::string& shown_name() const { return name.empty() ? info->layers : name; }
};

// The Cryptomattes of a stream, whatever their layers are called by now (see learn_channels).
std::vector<Cryptomatte> cryptomattes_of(const Stream& stream);

// The one called `layer`, by its whole name or the end of it from a dot on; the only one where `layer` is
// empty.  Warns of levels that were left behind.  Throws Failure: kGraph that says which there are, kInput
// where its ids are stored as half.
Cryptomatte find_cryptomatte(Builder& builder, const Stream& stream, std::string_view layer);

// Adds a Cryptomatte with the names of another and one object a pixel: that rank, and a channel that is 0.
void add_cryptomatte(Stream& stream, const Cryptomatte& of, const Cryptomatte::Rank& rank, ValueRef nothing);

// Throws Failure (kInput) for ids of a Cryptomatte that are stored as half.
void refuse_half(const Builder& builder, ValueRef id, std::string_view name);

// The attributes of the Cryptomattes of an image that is to be written to `file`, under the names that their
// layers have by now.  A manifest that stands in a file elsewhere comes into the image.
std::vector<Attribute> cryptomatte_attributes(Builder& builder, const Stream& stream,
                                              const std::filesystem::path& file);

// Names and their ids.
class CryptomatteManifest {
public:
    // From the attributes of the Cryptomatte, or the file that they name.  Null where there is none, or none
    // that can be read; `faults` says what is wrong with it.  Read once for all nodes and frames.
    static std::shared_ptr<const CryptomatteManifest> find(Context& context, const CryptomatteInfo& info,
                                                           std::vector<std::string>& faults);

    // From JSON: { "name": "hexadecimal id", … }.  Renderers' JSON is not always JSON: what of it can be read
    // is kept, and `fault` says what could not.
    static CryptomatteManifest parse(std::string_view json);

    // The ids of the names that a pattern matches, in which * stands for any characters and \* for itself.
    std::vector<uint32_t> ids(std::string_view pattern) const;

    std::vector<std::string> names() const;
    const std::vector<std::pair<std::string, uint32_t>>& entries() const { return entries_; }  // by name
    std::size_t size() const { return entries_.size(); }
    const std::string& fault() const { return fault_; }  // empty for a manifest that is whole

private:
    std::vector<std::pair<std::string, uint32_t>> entries_;  // sorted by name
    std::string fault_;
};

// Whether * in a pattern stands for any characters, and the name that a pattern without such a one means.
bool has_wildcard(std::string_view pattern);
std::string literal_name(std::string_view pattern);

}  // namespace keyline
