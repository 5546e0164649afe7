// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/error.h"
#include "engine/io/exr_file.h"
#include "engine/io/exr_format.h"
#include "engine/io/exr_reader.h"
#include "engine/io/exr_writer.h"
#include "engine/io/image_module.h"
#include "engine/io/image_sink.h"
#include "engine/io/image_source.h"
#include "engine/io/output_file.h"
#include "engine/io/output_format.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace keyline {

namespace {

bool has_exr_content(const std::filesystem::path& file) {
    std::array<std::byte, exr::kMagic.size()> start = {};
    exr::InputFile(file).read_some(0, start);
    return start == exr::kMagic;
}

bool same_channels(std::vector<ChannelInfo> a, std::vector<ChannelInfo> b) {
    std::ranges::sort(a, {}, &ChannelInfo::name);
    std::ranges::sort(b, {}, &ChannelInfo::name);
    return a == b;
}

bool is_finished_exr(const ImageHeader& header, const SinkSpec& spec) {
    const exr::Layout planned = exr::layout_of(spec);
    std::vector<ChannelInfo> channels;
    for (const exr::StoredChannel& channel : planned.channels)
        channels.push_back({channel.name, channel.type});
    return header.display_window == planned.display_window && header.data_window == planned.data_window &&
           header.groups.size() == 1 && same_channels(header.groups[0].channels, channels);
}

// Formats without windows hold the display window, from (0, 0) on; those without names or types choose them.
bool is_finished_other(const ImageHeader& header, const SinkSpec& spec) {
    std::size_t channels = 0;
    for (const ChannelGroup& group : header.groups) channels += group.channels.size();
    return header.display_window.width() == spec.display_window.width() &&
           header.display_window.height() == spec.display_window.height() && channels == spec.channels.size();
}

}  // namespace

std::unique_ptr<ImageSource> open_image(const std::filesystem::path& file, const OpenOptions& options) {
    if (has_exr_content(file)) return exr::open_exr(file, options);
    if (!needs_module(file))
        fail(ErrorKind::kInput,
             fmt::format("{}: not an OpenEXR file, as its name says it is", file.string()));
    return open_with_module(file, options);
}

std::unique_ptr<ImageSink> create_image(const std::filesystem::path& file, const SinkSpec& spec) {
    return !needs_module(file) ? exr::create_exr(file, spec) : create_with_module(file, spec);
}

void check_image(const std::filesystem::path& file, const SinkSpec& spec) {
    if (!needs_module(file))
        exr::layout_of(spec);
    else
        picture_layout(file, spec);
}

SinkShape sink_shape(const std::filesystem::path& file, const SinkSpec& spec) {
    if (needs_module(file)) {
        const Rect& rows = spec.display_window;
        return {std::min(kPictureChunkRows, rows.height()),
                spec.channels.size() * sizeof(float) * static_cast<std::size_t>(rows.width())};
    }
    const exr::Layout layout = exr::layout_of(spec);
    std::size_t pixel = 0;
    for (const exr::StoredChannel& c : layout.channels) pixel += sample_size(c.type);
    return {std::min(exr::rows_at_once(layout), layout.data_window.height()),
            pixel * static_cast<std::size_t>(layout.data_window.width())};
}

bool is_finished(const std::filesystem::path& file, const SinkSpec& spec) {
    try {
        const std::unique_ptr<ImageSource> image = open_image(file);
        return !needs_module(file) ? is_finished_exr(image->header(), spec)
                                   : is_finished_other(image->header(), spec);
    } catch (const Failure& failure) {
        // Not there, or not readable: to be made.  What can't be made is for create_image() to say.
        if (failure.error().kind == ErrorKind::kInput || failure.error().kind == ErrorKind::kGraph)
            return false;
        throw;
    }
}

void remove_leftovers(const std::filesystem::path& file) { remove_unfinished(file); }

}  // namespace keyline
