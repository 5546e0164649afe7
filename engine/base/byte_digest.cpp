// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/base/byte_digest.h"

#include <new>
#include <xxhash.h>

namespace keyline {

namespace {

XXH3_state_t* hash_of(void* state) { return static_cast<XXH3_state_t*>(state); }

}  // namespace

ByteDigester::ByteDigester() : state_(XXH3_createState()) {
    if (!state_) throw std::bad_alloc();
    XXH3_128bits_reset(hash_of(state_));
}

ByteDigester::~ByteDigester() { XXH3_freeState(hash_of(state_)); }

ByteDigester& ByteDigester::add(std::span<const std::byte> bytes) {
    XXH3_128bits_update(hash_of(state_), bytes.data(), bytes.size());
    return *this;
}

Digest ByteDigester::digest() const {
    const XXH128_hash_t hash = XXH3_128bits_digest(hash_of(state_));
    return {hash.high64, hash.low64};
}

}  // namespace keyline
