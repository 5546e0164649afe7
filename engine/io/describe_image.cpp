// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/io/describe_image.h"

#include "engine/io/exr/chunk_table.h"
#include "engine/io/exr/file.h"
#include "engine/io/exr/header.h"
#include "engine/io/exr/metadata.h"
#include "engine/io/oiio/reader.h"

namespace keyline {

namespace {

const char* storage_name(exr::Storage storage) {
    switch (storage) {
        case exr::Storage::kScanline: return "scanline";
        case exr::Storage::kTiled: return "tiled";
        case exr::Storage::kDeep: break;
    }
    return "deep";
}

ImagePart describe_part(const exr::Part& part) {
    ImagePart out;
    out.name = part.name;
    out.view = part.view;
    out.views = part.views;
    out.storage = storage_name(part.storage);
    out.compression = exr::info(part.compression).name;
    out.display_window = part.display_window;
    out.data_window = part.data_window;
    if (part.storage == exr::Storage::kTiled) {
        out.tile_width = part.chunk_width;
        out.tile_height = part.chunk_height;
    }
    for (const exr::StoredChannel& c : part.channels)
        out.channels.push_back({c.name, sample_type_name(c.type)});
    out.metadata = part.metadata;
    return out;
}

// Integers are handed on as floats; here they are what they are in the file.
std::vector<FileChannel> channels_of(const ImageSource& source, const ChannelGroup& group) {
    const auto* const picture = dynamic_cast<const oiio::PictureSource*>(&source);
    std::vector<FileChannel> out;
    for (std::size_t i = 0; i < group.channels.size(); ++i) {
        const ChannelInfo& c = group.channels[i];
        out.push_back({c.name, picture ? picture->stored_types()[i] : sample_type_name(c.type)});
    }
    return out;
}

// An image that the engine opened; its groups are all there is to know of its storage.
ImageDescription describe_source(const ImageSource& source) {
    const ImageHeader& header = source.header();
    ImageDescription out{header.format, {}, {}};
    for (const ChannelGroup& group : header.groups) {
        ImagePart part;
        part.display_window = header.display_window;
        part.data_window = group.window;
        part.channels = channels_of(source, group);
        part.metadata = header.metadata;
        out.parts.push_back(std::move(part));
    }
    return out;
}

}  // namespace

ImageDescription describe_image(const std::filesystem::path& file) {
    const exr::InputFile input(file);
    std::array<std::byte, exr::kMagic.size()> start = {};
    input.read_some(0, start);
    if (start != exr::kMagic) return describe_source(*open_image(file));
    const exr::ReadContext context(input);
    ImageDescription out{"openexr", {}, {}};
    uint64_t tables = 0;
    auto attributes = exr::read_attributes(input, &tables);
    const std::vector<exr::Part> parts = exr::read_parts(input, context, std::move(attributes));
    for (const exr::Part& part : parts) out.parts.push_back(describe_part(part));
    try {
        exr::check_chunk_tables(input, context, parts, tables);
    } catch (const Failure& f) {
        out.fault = f.error();
    }
    return out;
}

}  // namespace keyline
