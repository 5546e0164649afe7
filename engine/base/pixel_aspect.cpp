// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/base/pixel_aspect.h"

namespace keyline {

namespace {

constexpr const char* kAspect = "pixelAspectRatio";

}  // namespace

float pixel_aspect(const Metadata& metadata) {
    const Attribute* a = metadata.find(kAspect);
    const auto* value = a ? std::get_if<std::vector<float>>(&a->value) : nullptr;
    return value && value->size() == 1 ? value->front() : 1.0F;
}

void set_pixel_aspect(Metadata& metadata, double aspect) {
    metadata.set({kAspect, "float", std::vector<float>{static_cast<float>(aspect)}});
}

}  // namespace keyline
