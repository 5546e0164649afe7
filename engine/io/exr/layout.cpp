// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/io/exr/layout.h"

#include "engine/base/error.h"
#include "engine/io/exr/metadata.h"

#include <algorithm>
#include <fmt/format.h>
#include <string_view>

namespace keyline::exr {

namespace {

void check_name(std::string_view what, std::string_view name) {
    if (!can_be_stored(name))
        fail(ErrorKind::kOutput,
             fmt::format("{} {} can't be a name in an OpenEXR file; 1 to {} bytes can, none of them 0", what,
                         in_quotes(name), kLongestName));
}

Attribute box(const char* name, const Rect& r) {
    return {name, "box2i", std::vector<int32_t>{r.x0, r.y0, r.x1 - 1, r.y1 - 1}};
}

Attribute byte(const char* name, const char* type, uint8_t value) {
    return {name, type, std::vector<std::byte>{std::byte{value}}};
}

int32_t stored_type(SampleType type) {
    return type == SampleType::kUint ? 0 : type == SampleType::kHalf ? 1 : 2;
}

Attribute channel_list(const std::vector<StoredChannel>& channels) {
    std::vector<std::byte> list;
    for (const StoredChannel& channel : channels) {
        check_name("channel", channel.name);
        append(list, channel.name);
        append(list, '\0');
        append(list, stored_type(channel.type));
        append(list, int32_t{channel.is_linear});  // and three bytes reserved
        append(list, int32_t{channel.x_sampling});
        append(list, int32_t{channel.y_sampling});
    }
    append(list, '\0');
    return {"channels", "chlist", list};
}

Attribute tile_description(const Rect& window) {
    std::vector<std::byte> description;
    append(description, static_cast<uint32_t>(window.width()));
    append(description, static_cast<uint32_t>(window.height()));
    append(description, uint8_t{0});  // one level
    return {"tiles", "tiledesc", description};
}

// Those that OpenEXR requires, whatever the metadata says of them.
std::vector<Attribute> required(const Layout& layout) {
    std::vector<Attribute> attributes = {
        channel_list(layout.channels),
        byte("compression", "compression", static_cast<uint8_t>(layout.compression)),
        box("dataWindow", layout.data_window),
        box("displayWindow", layout.display_window),
        byte("lineOrder", "lineOrder", 0),  // increasing y
    };
    if (layout.one_tile) attributes.push_back(tile_description(layout.data_window));
    const std::vector<Attribute> defaults = {
        {"pixelAspectRatio", "float", std::vector<float>{1}},
        {"screenWindowCenter", "v2f", std::vector<float>{0, 0}},
        {"screenWindowWidth", "float", std::vector<float>{1}},
    };
    for (const Attribute& attribute : defaults) {
        const Attribute* own = layout.metadata.find(attribute.name);
        if (own == nullptr || own->type != attribute.type) attributes.push_back(attribute);
    }
    return attributes;
}

bool has_long_name(const std::vector<Attribute>& attributes, const std::vector<StoredChannel>& channels) {
    const auto is_long = [](const std::string& name) { return name.size() > kLongestShortName; };
    return std::ranges::any_of(attributes,
                               [&](const Attribute& a) { return is_long(a.name) || is_long(a.type); }) ||
           std::ranges::any_of(channels, [&](const StoredChannel& c) { return is_long(c.name); });
}

}  // namespace

std::vector<std::byte> Layout::header() const {
    std::vector<Attribute> attributes = required(*this);
    const std::size_t own = attributes.size();
    for (const Attribute& attribute : metadata.attributes()) {
        const auto same = std::ranges::find(attributes, attribute.name, &Attribute::name);
        if (!describes_storage(attribute.name) && same == attributes.end()) attributes.push_back(attribute);
    }
    for (std::size_t i = own; i < attributes.size(); ++i) {
        check_name("attribute", attributes[i].name);
        check_name("attribute type", attributes[i].type);
    }

    std::vector<std::byte> bytes(kMagic.begin(), kMagic.end());
    const uint32_t tiled = one_tile ? kTiledFlag : 0;
    const uint32_t long_names = has_long_name(attributes, channels) ? kLongNamesFlag : 0;
    append(bytes, kVersion | tiled | long_names);
    for (const Attribute& attribute : attributes) append_attribute(bytes, attribute);
    append(bytes, '\0');
    return bytes;
}

}  // namespace keyline::exr
