// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace keyline {

using Bytes = std::vector<std::byte>;
using Random = std::mt19937_64;

// A sound file and where its parts lie, so that damage can be aimed: of an OpenEXR file all is known.
struct Victim {
    std::string name;
    Bytes bytes;
    std::size_t header_end = 0;       // the offset table follows
    std::vector<std::size_t> chunks;  // offsets of the chunks
};

Victim make_victim(std::string name, Bytes bytes);  // of an OpenEXR file

// One to three kinds of damage: flipped bits, fields of the header overwritten with extreme numbers,
// attributes' sizes changed, the offset table or the leaders of chunks edited, bytes cut off, moved, doubled
// or replaced by another file's.
Bytes damaged(const Victim& victim, const Victim& other, Random& random);

}  // namespace keyline
