// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/digest.h"
#include "engine/node/stream.h"

#include <vector>

namespace keyline {

Digest digest_of(const Metadata& metadata);

// Of what is known of a stream without its pixels, of its metadata's digest, and of `values`: what its
// channels are made of, where that is to count.  Its file is not in it: who reads another file beside it says
// so.
Digest digest_of(const Stream& stream, const Digest& metadata, const std::vector<Digest>& values);

}  // namespace keyline
