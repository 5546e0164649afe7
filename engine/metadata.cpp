// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/metadata.h"

#include <algorithm>

namespace keyline {

const Attribute* Metadata::find(std::string_view name) const {
    const auto it = std::ranges::find(attributes_, name, &Attribute::name);
    return it == attributes_.end() ? nullptr : &*it;
}

void Metadata::set(Attribute attribute) {
    const auto it = std::ranges::find(attributes_, attribute.name, &Attribute::name);
    if (it == attributes_.end())
        attributes_.push_back(std::move(attribute));
    else
        *it = std::move(attribute);
}

void Metadata::erase(std::string_view name) {
    std::erase_if(attributes_, [&](const Attribute& a) { return a.name == name; });
}

}  // namespace keyline
