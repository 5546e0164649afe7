// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/node/node.h"

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

// What a link picks of data by a name after a colon, "lines:outline".

namespace KEYLINE_API keyline {

// Of a kind of data; null: it has no parts, or no node gives it.
const DataParts* parts_of_kind(std::string_view kind);

// Which of the parts has the name.
std::optional<std::size_t> find_part(const DataParts& parts, std::string_view name);

// From the whole to one part.  The parts of a kind last as long as the program.
class PickPart final : public Derivation {
public:
    PickPart(std::string kind, const DataParts& parts, std::size_t which)
        : kind_(std::move(kind)), parts_(parts), which_(which) {}

    const char* gives() const override { return kind_.c_str(); }
    std::shared_ptr<const Datum> derive(const Inputs& in) const override;
    std::size_t datum_bytes() const override { return parts_.usual_bytes; }

private:
    const std::string kind_;
    const DataParts& parts_;
    const std::size_t which_;
};

}  // namespace keyline
