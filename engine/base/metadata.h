// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace KEYLINE_API keyline {

// One attribute of an image's header.  `type` is OpenEXR's own type name ("string", "v2f", "m44f",
// "timecode", …) and says how `value` is read: a v2f is two floats, a box2i four ints, a rational an int and
// an unsigned as two ints.  What OpenEXR does not define stays as its bytes.
struct Attribute {
    using Value = std::variant<std::string, std::vector<std::string>, std::vector<int32_t>,
                               std::vector<float>, std::vector<double>, std::vector<std::byte>>;
    std::string name;
    std::string type;
    Value value;

    friend bool operator==(const Attribute&, const Attribute&) = default;
};

// Whether a name, of an attribute, its type or a channel, is one that a file can hold: of 1 to 255 bytes,
// none of them 0.
bool can_be_stored(std::string_view name);

// An image's attributes in the file's order.  Windows, channels, compression, tiling, line order and the
// names of parts and views are not among them: they describe the storage, not the picture.
// pixelAspectRatio, screenWindowCenter and screenWindowWidth are.
class Metadata {
public:
    const std::vector<Attribute>& attributes() const { return attributes_; }
    const Attribute* find(std::string_view name) const;
    void set(Attribute attribute);  // replaces one of the same name
    void erase(std::string_view name);

    // Erases what no file can hold, and says which names they were: damaged files have attributes without a
    // type, other programs' formats have any text for a name.
    std::vector<std::string> erase_unstorable();

private:
    std::vector<Attribute> attributes_;
};

}  // namespace keyline
