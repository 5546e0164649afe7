// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/base/metadata.h"

#include <algorithm>

namespace keyline {

bool can_be_stored(std::string_view name) {
    constexpr std::size_t kLongest = 255;
    return !name.empty() && name.size() <= kLongest && name.find('\0') == std::string_view::npos;
}

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

std::vector<std::string> Metadata::erase_unstorable() {
    const auto is_bad = [](const Attribute& a) { return !can_be_stored(a.name) || !can_be_stored(a.type); };
    std::vector<std::string> names;
    for (const Attribute& a : attributes_)
        if (is_bad(a)) names.push_back(a.name);
    std::erase_if(attributes_, is_bad);
    return names;
}

}  // namespace keyline
