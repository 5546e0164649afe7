// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/digest.h"

#include <cstddef>
#include <span>

namespace keyline {

// The digest of bytes that come piece by piece; how they were cut makes no difference.
class ByteDigester {
public:
    ByteDigester();
    ~ByteDigester();
    ByteDigester(const ByteDigester&) = delete;
    ByteDigester& operator=(const ByteDigester&) = delete;

    ByteDigester& add(std::span<const std::byte> bytes);
    Digest digest() const;

private:
    void* state_;  // of the hash, whose library is known in one file alone
};

}  // namespace keyline
