// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/base/channels.h"
#include "engine/base/error.h"
#include "engine/io/image_source.h"
#include "engine/measure/drawn.h"
#include "engine/measure/motion.h"
#include "engine/simd/half.h"

#include <cstring>
#include <fmt/format.h>
#include <optional>

namespace keyline {

namespace {

struct ChannelPlace {
    std::size_t group = 0, channel = 0;
};

std::optional<ChannelPlace> find_channel(const ImageHeader& header, const std::string& layer,
                                         const std::string& base) {
    for (std::size_t g = 0; g < header.groups.size(); ++g)
        for (std::size_t c = 0; c < header.groups[g].channels.size(); ++c) {
            const ChannelName name = split_channel(header.groups[g].channels[c].name);
            if (name.base == base && is_called(name.layer, layer)) return ChannelPlace{g, c};
        }
    return {};
}

// All samples of one channel, row by row over its group's window.
std::vector<float> read_channel(const ImageSource& image, const ChannelPlace& place) {
    const ChannelGroup& group = image.header().groups[place.group];
    const SampleType type = group.channels[place.channel].type;
    const std::size_t row_bytes = sample_size(type) * static_cast<std::size_t>(group.window.width());
    std::vector<std::byte> samples(row_bytes * static_cast<std::size_t>(group.window.height()));
    std::vector<Plane> planes(group.channels.size());
    planes[place.channel] = {samples.data(), static_cast<std::ptrdiff_t>(row_bytes), type, group.window};
    for (int row = 0; row < group.rows(); ++row)
        for (int column = 0; column < group.columns(); ++column)
            image.read_chunk(place.group, column, row, planes);
    std::vector<float> out(static_cast<std::size_t>(group.window.area()));
    if (type == SampleType::kHalf)
        simd::half_to_float(reinterpret_cast<const uint16_t*>(samples.data()), out.data(), out.size());
    else if (type == SampleType::kFloat)
        std::memcpy(out.data(), samples.data(), samples.size());
    else
        simd::uint_to_float(reinterpret_cast<const uint32_t*>(samples.data()), out.data(), out.size());
    return out;
}

}  // namespace

MotionPass read_motion(const std::filesystem::path& file, const std::string& layer) {
    const std::unique_ptr<ImageSource> image = open_image(file);
    const ImageHeader& header = image->header();
    MotionPass out;
    constexpr std::array kChannels{"X", "Y", "Z", "W"};
    for (std::size_t i = 0; i < kChannels.size(); ++i) {
        const std::optional<ChannelPlace> place = find_channel(header, layer, kChannels[i]);
        if (!place)
            fail(ErrorKind::kInput,
                 fmt::format("{}: it has no channel {}.{}", file.string(), layer, kChannels[i]),
                 "name the layer that has the motion of pixels in X Y Z W, as FILE:LAYER");
        out.window = header.groups[place->group].window;
        out.vector[i] = read_channel(*image, *place);
    }
    const std::optional<ChannelPlace> depth = find_channel(header, "Depth", "Z");
    if (depth && header.groups[depth->group].window == out.window) out.depth = read_channel(*image, *depth);
    return out;
}

DrawnLines read_drawn_lines(const std::filesystem::path& file, const std::string& layer) {
    const std::unique_ptr<ImageSource> image = open_image(file);
    const ImageHeader& header = image->header();
    std::optional<ChannelPlace> place = find_channel(header, layer, "A");
    if (!place && header.groups.size() == 1 && header.groups[0].channels.size() == 1) place = ChannelPlace{};
    if (!place)
        fail(ErrorKind::kInput,
             fmt::format("{}: it has no channel A, and not just one channel", file.string()),
             "write what 'draw' gives, or a mask; name a layer as FILE:LAYER");
    return {header.groups[place->group].window, read_channel(*image, *place)};
}

}  // namespace keyline
