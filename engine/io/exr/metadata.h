// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/metadata.h"
#include "engine/io/exr/file.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace keyline::exr {

// The attributes of every part's header, in the file's order, as they stand there.  A stored value and its
// Attribute are the same bytes, whatever the type: what OpenEXR does not define is kept, not understood.
// `end`, where given, becomes the place behind the headers.
// Throws Failure (kInput) for a header that is damaged or larger than any sane one.
std::vector<std::vector<Attribute>> read_attributes(const InputFile& file, uint64_t* end = nullptr);

// Whether an attribute says how a part is stored rather than what it shows.  A preview is counted among them:
// it is a picture of the pixels as they were.
bool describes_storage(std::string_view name);

// The text of a string attribute; nothing where there is none of that name and type.
std::optional<std::string> text_of(std::span<const Attribute> attributes, std::string_view name);

// What is stored between an attribute's size and the next attribute.  Throws Failure (kOutput) for a value
// that its type can't have, which would make the file unreadable.
std::vector<std::byte> stored_value(const Attribute& attribute);

// Appends name, type, size and value.
void append_attribute(std::vector<std::byte>& header, const Attribute& attribute);

}  // namespace keyline::exr
