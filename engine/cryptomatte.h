// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/stream.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

// Cryptomatte 1.2: channels that say by rank which objects a pixel shows and how much of it each covers.  An
// object's id is the hash of its name, kept as the bits of a float: only ever compared, never computed with.

namespace keyline {

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
    std::string name;         // "ViewLayer.CryptoObject"; empty for the channels of one level without a layer
    std::vector<Rank> ranks;  // the largest coverage first

    // All channels, id and coverage in turn.
    std::vector<ValueRef> values() const;
};

// What the metadata say of one: what its attributes' names begin with, "cryptomatte/ID/", and its name, which
// the channels begin with.
struct CryptomatteEntry {
    std::string prefix, name;
};
std::vector<CryptomatteEntry> cryptomatte_entries(const Metadata& metadata);

// The Cryptomattes of a stream: layers that differ in their last two digits, 00 01 02 …, with the channels
// r g b a (or R G B A): two ranks of id and coverage.
std::vector<Cryptomatte> cryptomattes_of(const Stream& stream);

// The one called `layer`, by its whole name or the end of it from a dot on; the only one where `layer` is
// empty.  Throws Failure (kGraph) that says which there are.
Cryptomatte find_cryptomatte(const Stream& stream, std::string_view layer);

// Whether a Cryptomatte's name is `wanted`, or ends in it from a dot on.
bool is_called(std::string_view name, std::string_view wanted);

// Names and their ids.
class CryptomatteManifest {
public:
    // From the metadata of the stream, or the file that they name.  `layer` tells which is meant where the
    // channels have lost the name.  Throws Failure (kInput) for one that can't be read.
    static std::optional<CryptomatteManifest> find(const Stream& stream, const Cryptomatte& matte,
                                                   std::string_view layer);

    // From JSON: { "name": "hexadecimal id", … }.  Throws Failure (kInput).
    static CryptomatteManifest parse(std::string_view json);

    // The ids of the names that a pattern matches, in which * stands for any characters.
    std::vector<uint32_t> ids(std::string_view pattern) const;

    std::vector<std::string> names() const;
    std::size_t size() const { return entries_.size(); }

private:
    std::vector<std::pair<std::string, uint32_t>> entries_;  // sorted by name
};

}  // namespace keyline
