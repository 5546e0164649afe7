// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/node/parts.h"

#include "engine/node/registry.h"

#include <algorithm>

namespace keyline {

const DataParts* parts_of_kind(std::string_view kind) {
    for (const auto& [name, type] : registry().types())
        if (type.gives == kind && type.parts) return type.parts;
    return nullptr;
}

std::optional<std::size_t> find_part(const DataParts& parts, std::string_view name) {
    const auto it = std::ranges::find(parts.names, name);
    if (it == parts.names.end()) return std::nullopt;
    return static_cast<std::size_t>(it - parts.names.begin());
}

std::shared_ptr<const Datum> PickPart::derive(const Inputs& in) const {
    return parts_.pick(in.any_datum(0), which_);
}

}  // namespace keyline
