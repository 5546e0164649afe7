// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/base/error.h"
#include "engine/io/exr/chunk_table.h"
#include "engine/io/exr/file.h"
#include "engine/io/exr/layout.h"
#include "engine/io/exr/metadata.h"
#include "engine/io/exr/writer.h"
#include "engine/io/image_sink.h"
#include "engine/io/other_formats.h"
#include "engine/io/picture_structure.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace keyline {

namespace {

bool same_channels(std::vector<ChannelInfo> a, std::vector<ChannelInfo> b) {
    std::ranges::sort(a, {}, &ChannelInfo::name);
    std::ranges::sort(b, {}, &ChannelInfo::name);
    return a == b;
}

// Decodes a chunk into nowhere; one that can't be decoded throws Failure (kInput).
void decode(const ImageSource& image, std::size_t index, int column, int row) {
    const ChannelGroup& group = image.header().groups[index];
    const Rect chunk = group.chunk(column, row);
    const auto pixels = static_cast<std::size_t>(chunk.area());
    std::vector<std::byte> samples(pixels * sizeof(float));  // every channel's, one over the other
    std::vector<Plane> planes;
    for (const ChannelInfo& c : group.channels) {
        const auto stride = static_cast<std::ptrdiff_t>(sample_size(c.type)) * chunk.width();
        planes.push_back({samples.data(), stride, c.type, chunk});
    }
    image.read_chunk(index, column, row, planes);
}

void decode_all(const ImageSource& image) {
    for (std::size_t g = 0; g < image.header().groups.size(); ++g)
        for (int row = 0; row < image.header().groups[g].rows(); ++row)
            for (int column = 0; column < image.header().groups[g].columns(); ++column)
                decode(image, g, column, row);
}

bool is_finished_exr(const std::filesystem::path& name, const SinkSpec& spec) {
    const std::unique_ptr<ImageSource> image = open_image(name);
    const ImageHeader& header = image->header();
    const exr::Layout planned = exr::layout_of(spec);
    std::vector<ChannelInfo> channels;
    for (const exr::StoredChannel& channel : planned.channels)
        channels.push_back({channel.name, channel.type});
    if (header.display_window != planned.display_window || header.data_window != planned.data_window ||
        header.groups.size() != 1 || !same_channels(header.groups[0].channels, channels))
        return false;
    const exr::InputFile file(name);
    const exr::ReadContext context(file);
    uint64_t tables = 0;
    auto attributes = exr::read_attributes(file, &tables);
    const std::vector<exr::Part> parts = exr::read_parts(file, context, std::move(attributes));
    if (!exr::has_chunks_in_line(file, context, parts.front(), tables)) return false;
    // What lost its end to a failing disk has zeros there.
    decode(*image, 0, 0, header.groups.front().rows() - 1);
    return true;
}

// Formats without windows hold the display window, from (0, 0) on; those without names or types choose them.
bool is_finished_other(const std::filesystem::path& name, const SinkSpec& spec) {
    PictureSize size;
    if (has_known_structure(name)) {
        const std::optional<PictureSize> whole = size_of_whole_picture(name);
        if (!whole) return false;
        size = *whole;
    } else {
        const std::unique_ptr<ImageSource> image = open_image(name);
        const Rect& window = image->header().display_window;
        size = {static_cast<uint64_t>(window.width()), static_cast<uint64_t>(window.height()), 0};
        for (const ChannelGroup& group : image->header().groups) size.channels += group.channels.size();
        decode_all(*image);
    }
    return size == PictureSize{static_cast<uint64_t>(spec.display_window.width()),
                               static_cast<uint64_t>(spec.display_window.height()), spec.channels.size()};
}

}  // namespace

bool is_finished(const std::filesystem::path& file, const SinkSpec& spec) {
    try {
        return is_other_format(file) ? is_finished_other(file, spec) : is_finished_exr(file, spec);
    } catch (const Failure& failure) {
        // Not there, or not readable: to be made.  What can't be made is for create_image() to say.
        if (failure.error().kind == ErrorKind::kInput || failure.error().kind == ErrorKind::kGraph)
            return false;
        throw;
    }
}

}  // namespace keyline
