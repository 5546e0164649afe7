// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/io/image_source.h"

#include <memory>

namespace KEYLINE_API keyline {

enum class NanPolicy { kMend, kKeep, kError };

// The image with NaN as 0 and ±infinity as the largest value of its kind (±65504 in half, ±1e10 in float), or
// with an error for the first one met.  What was mended is remembered, each sample once however often its
// chunk is read, and so are uint samples that a float can't hold; a bit a sample of the chunks that have
// some.
std::shared_ptr<const ImageSource> mended(std::shared_ptr<const ImageSource> source, NanPolicy policy);

// An image of zeros with the windows and channels of another.
std::shared_ptr<const ImageSource> black_like(const ImageSource& like);

}  // namespace keyline
