// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/base/digest.h"

#include <bit>
#include <fmt/format.h>
#include <xxhash.h>

namespace keyline {

std::string to_string(const Digest& digest) {
    return digest.known() ? fmt::format("{:016x}{:016x}", digest.high, digest.low) : "unknown";
}

// The lowest byte first on every machine.
Digester& Digester::add_number(uint64_t number) {
    for (unsigned i = 0; i < 8; ++i) bytes_.push_back(static_cast<char>(number >> (8 * i) & 0xFF));
    return *this;
}

Digester& Digester::add(std::string_view text) {
    add_number(text.size());
    bytes_.append(text);
    return *this;
}

Digester& Digester::add(double number) { return add_number(std::bit_cast<uint64_t>(number)); }

Digester& Digester::add(const Digest& digest) {
    known_ = known_ && digest.known();
    return add_number(digest.high).add_number(digest.low);
}

Digest Digester::digest() const {
    if (!known_) return {};
    const XXH128_hash_t hash = XXH3_128bits(bytes_.data(), bytes_.size());
    return {hash.high64, hash.low64};
}

}  // namespace keyline
