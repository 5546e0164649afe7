// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/io/output_format.h"

#include "engine/base/bad_value.h"
#include "engine/base/channels.h"
#include "engine/io/other_formats.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <fmt/format.h>

namespace keyline {

namespace {

constexpr Depth k8 = Depth::kUint8, k16 = Depth::kUint16, kF = Depth::kFloat;

// Tried one by one against OpenImageIO 2.4: its writers take whatever they are given, and drop, repeat or
// round without a word what their format lacks (one aborts), so that asking them would not do.
const std::vector<OutputFormat>& output_formats() {
    static const std::vector<OutputFormat> formats = {
        {.name = "bmp",
         .extensions = {"bmp"},
         .depths = {k8},
         .channel_sets = {"Y", "RGB", "RGBA"},
         .frames_held = 0.7},
        {.name = "dpx",
         .extensions = {"dpx"},
         .depths = {kF, k16, k8},
         .channel_sets = {"Y", "RGB", "RGBA"},
         .frames_held = 1},
        {.name = "fits", .extensions = {"fits"}, .depths = {kF, k8}, .channel_sets = {"Y"}},
        {.name = "gif",
         .extensions = {"gif"},
         .depths = {k8},
         .channel_sets = {"RGB"},
         .most_pixels = 65535,
         .frames_held = 7.7},
        {.name = "hdr", .extensions = {"hdr", "rgbe"}, .depths = {kF}, .channel_sets = {"RGB"}},
        {.name = "heif",
         .extensions = {"heic", "heif"},
         .depths = {k8},
         .channel_sets = {"RGB", "RGBA"},
         .straight_alpha = true},
        // Unpacked, or in 16 bits with alpha, it can't be read back.
        {.name = "iff",
         .extensions = {"iff"},
         .depths = {k8},
         .channel_sets = {"RGB", "RGBA"},
         .tiled = true,
         .compressions = {"rle"},
         .least_pixels = 2,
         .most_pixels = 8192,
         .frames_held = 1},
        {.name = "jpeg",
         .extensions = {"jpg", "jpeg", "jpe", "jif", "jfif", "jfi"},
         .depths = {k8},
         .channel_sets = {"Y", "RGB"},
         .compressions = {"jpeg"},
         .has_quality = true,
         .most_pixels = 65500,
         .frames_held = 0.25},
        // Its writer makes six resolutions, each half of the one before.
        {.name = "jpeg2000",
         .extensions = {"jp2", "j2k"},
         .depths = {k16, k8},
         .channel_sets = {"Y", "RGB", "RGBA"},
         .straight_alpha = true,
         .least_pixels = 32,
         .frames_held = 7.2},
        {.name = "png",
         .extensions = {"png"},
         .depths = {k16, k8},
         .channel_sets = {"Y", "YA", "RGB", "RGBA"},
         .straight_alpha = true,
         .compressions = {"zip", "none"}},
        {.name = "pnm", .extensions = {"ppm", "pgm", "pnm"}, .depths = {k8}, .channel_sets = {"Y", "RGB"}},
        // Its run lengths lose samples of integers.
        {.name = "rla", .extensions = {"rla"}, .depths = {kF}, .channel_sets = {"RGB", "RGBA"}},
        {.name = "sgi",
         .extensions = {"sgi", "rgb", "rgba", "bw", "int", "inta"},
         .depths = {k16, k8},
         .channel_sets = {"Y", "RGB", "RGBA"}},
        {.name = "targa",
         .extensions = {"tga", "tpic"},
         .depths = {k8},
         .channel_sets = {"Y", "RGB", "RGBA"},
         .straight_alpha = true,
         .compressions = {"rle", "none"}},
        {.name = "tiff",
         .extensions = {"tif", "tiff", "tx", "env", "sm", "vsm"},
         .depths = {kF, k16, k8},
         .channel_sets = {"Y", "YA", "RGB", "RGBA"},
         .more_channels = true,
         .compressions = {"zip", "lzw", "packbits", "none"}},
        {.name = "webp",
         .extensions = {"webp"},
         .depths = {k8},
         .channel_sets = {"RGB", "RGBA"},
         .straight_alpha = true,
         .compressions = {"webp"},
         .has_quality = true,
         .most_pixels = 16383,
         .frames_held = 3.6},
        {.name = "zfile", .extensions = {"zfile"}, .depths = {kF}, .channel_sets = {"Y"}, .least_pixels = 2},
    };
    return formats;
}

const char* depth_name(Depth depth) {
    switch (depth) {
        case Depth::kAuto: return "auto";
        case Depth::kHalf: return "half";
        case Depth::kFloat: return "float";
        case Depth::kUint8: return "uint8";
        case Depth::kUint16: return "uint16";
    }
    return "";
}

// By the extension, without regard to case.
const OutputFormat& output_format(const std::filesystem::path& file) {
    const std::string extension = extension_of(file);
    std::vector<std::string> known = {"exr"};
    for (const OutputFormat& format : output_formats()) {
        if (std::ranges::find(format.extensions, extension) != format.extensions.end()) return format;
        known.insert(known.end(), format.extensions.begin(), format.extensions.end());
    }
    std::ranges::sort(known);
    const bool is_number = std::ranges::all_of(extension, [](char c) { return c >= '0' && c <= '9'; });
    const std::string what = is_number  // of a frame; an empty one too
                                 ? "the name has no extension to tell the format"
                                 : fmt::format("no format is written as {}", in_quotes("." + extension));
    fail(Code::kFormat, ErrorKind::kGraph, fmt::format("{}: {}", file.string(), what),
         "use one of " + spaced(known));
}

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& what,
                         const std::string& hint) {
    fail(Code::kFormat, ErrorKind::kGraph, fmt::format("{}: {}", file.string(), what), hint);
}

// Where it is not the file's name that is wrong.
[[noreturn]] void refuse_value(const std::string& value, const std::filesystem::path& file,
                               const std::string& what, const std::string& hint) {
    throw BadValue(value, fmt::format("{}: {}", file.string(), what), hint, Code::kFormat);
}

std::optional<std::size_t> index_of(const std::vector<ChannelInfo>& channels, std::string_view name) {
    std::vector<std::string> names;
    for (const ChannelInfo& c : channels) names.push_back(c.name);
    return find_spelled(names, name);
}

// The largest set of the format that the channels hold; "" for none.
std::string_view largest_set(const OutputFormat& format, const std::vector<ChannelInfo>& channels) {
    for (const std::string_view set : {"RGBA", "RGB", "YA", "Y"}) {
        const bool here = std::ranges::all_of(set, [&](const char& letter) {
            return index_of(channels, {&letter, 1}).has_value();
        });
        if (here && format.holds(set)) return set;
    }
    return {};
}

std::vector<std::string> names_beside(std::string_view set, const std::vector<ChannelInfo>& channels) {
    std::vector<std::string> names;
    for (const ChannelInfo& channel : channels)
        if (const auto component = component_of(channel.name);
            component.empty() || set.find(component) == std::string_view::npos)
            names.push_back(channel.name);
    return names;
}

std::vector<std::string> letters(std::string_view set) {
    std::vector<std::string> names;
    for (const char letter : set) names.emplace_back(1, letter);
    return names;
}

[[noreturn]] void refuse_channels(const std::filesystem::path& file, const OutputFormat& format,
                                  std::string_view set, const std::vector<ChannelInfo>& channels) {
    std::vector<std::string> sets;
    for (const std::string_view held : format.channel_sets)
        sets.push_back(held == "Y" ? "one channel of any name" : spaced(letters(held)));
    refuse(file,
           fmt::format("{} can't hold {}; it holds {}", format.name, some_of(names_beside(set, channels)),
                       listed(sets)),
           "leave channels out with 'channels', or take one: NODE:NAME, also in --output NODE:NAME=FILE");
}

ChannelOrder order_of(const std::filesystem::path& file, const OutputFormat& format,
                      const std::vector<ChannelInfo>& channels) {
    if (channels.size() == 1 && format.holds("Y")) return {{0}, std::nullopt};
    const std::string_view set = largest_set(format, channels);
    const bool others = set.size() < channels.size();
    if (set.empty() || (others && !(format.more_channels && set.starts_with("RGB"))))
        refuse_channels(file, format, set, channels);
    ChannelOrder order;
    for (const char& letter : set) order.channels.push_back(*index_of(channels, {&letter, 1}));
    if (set.ends_with('A')) order.alpha = set.size() - 1;
    for (std::size_t c = 0; c < channels.size(); ++c)
        if (std::ranges::find(order.channels, c) == order.channels.end()) order.channels.push_back(c);
    return order;
}

Depth depth_of(const std::filesystem::path& file, const OutputFormat& format, Depth wanted) {
    if (wanted == Depth::kAuto) return format.depths.front();
    if (std::ranges::find(format.depths, wanted) != format.depths.end()) return wanted;
    std::vector<std::string> names;
    for (const Depth depth : format.depths) names.emplace_back(depth_name(depth));
    refuse_value(depth_name(wanted), file,
                 fmt::format("{} has no depth {}; it has {}", format.name, in_quotes(depth_name(wanted)),
                             listed(names)),
                 {});
}

// What its writer spoils or refuses when the first rows come.
void refuse_size(const std::filesystem::path& file, const OutputFormat& format, const Rect& window) {
    const int width = window.width(), height = window.height();
    if (std::min(width, height) < format.least_pixels)
        refuse(file,
               fmt::format("{} can't hold {} × {} pixels; each way it needs {}", format.name, width, height,
                           format.least_pixels),
               "write another format");
    if (std::max(width, height) > format.most_pixels)
        refuse(file,
               fmt::format("{} can't hold {} × {} pixels; each way it has {} at most", format.name, width,
                           height, format.most_pixels),
               "write another format");
}

bool is_quality(std::string_view text) {
    int quality = 0;
    const auto parsed = std::from_chars(text.data(), text.data() + text.size(), quality);
    return parsed.ec == std::errc{} && parsed.ptr == text.data() + text.size() && quality >= 1 &&
           quality <= 100;
}

// "zip" is what `write` says where nothing was asked for; formats without it take their own default then.
std::string compression_of(const std::filesystem::path& file, const OutputFormat& format,
                           const std::string& wanted) {
    const auto& known = format.compressions;
    if (std::ranges::find(known, wanted) != known.end()) return wanted;
    if (wanted == "zip") return known.empty() ? "" : std::string(known.front());
    const std::size_t colon = wanted.find(':');
    if (format.has_quality && wanted.substr(0, colon) == known.front() && colon != std::string::npos &&
        is_quality(std::string_view(wanted).substr(colon + 1)))
        return wanted;
    const std::string what = fmt::format("{} has no compression {}", format.name, in_quotes(wanted));
    if (known.empty()) refuse_value(wanted, file, what + "; there is no choice", "leave 'compression' out");
    refuse_value(
        wanted, file,
        fmt::format(
            "{}; it has {}{}", what, listed({known.begin(), known.end()}),
            format.has_quality ? fmt::format(" ('{}:90' with a quality of 1 to 100)", known.front()) : ""),
        did_you_mean(wanted, {known.begin(), known.end()}));
}

// Ids are bits: no format but OpenEXR has integers of 32, and few have floats.
void refuse_ids(const std::filesystem::path& file, const OutputFormat& format,
                const std::vector<ChannelInfo>& channels, Depth depth) {
    for (const ChannelInfo& c : channels)
        if (c.exact && (depth != Depth::kFloat || c.type == SampleType::kUint))
            refuse(file, fmt::format("{} can't hold the ids in {}", format.name, in_quotes(c.name)),
                   "write them to an OpenEXR file, or leave them out with 'channels'");
}

}  // namespace

bool OutputFormat::holds(std::string_view channel_set) const {
    return std::ranges::find(channel_sets, channel_set) != channel_sets.end();
}

bool holds_whole_numbers(const std::filesystem::path& file) {
    const std::string extension = extension_of(file);
    return std::ranges::any_of(output_formats(), [&](const OutputFormat& format) {
        return std::ranges::find(format.extensions, extension) != format.extensions.end() &&
               std::ranges::find(format.depths, kF) == format.depths.end();
    });
}

InOtherFormat in_other_format(const std::filesystem::path& file, const SinkSpec& spec) {
    if (!is_other_format(file)) return {};
    try {
        const PictureLayout layout = picture_layout(file, spec);
        return {layout.depth != Depth::kFloat, layout.order.alpha && layout.format.straight_alpha};
    } catch (const Failure&) {
        return {};
    }
}

PictureLayout picture_layout(const std::filesystem::path& file, const SinkSpec& spec) {
    const OutputFormat& format = output_format(file);
    PictureLayout layout{format, order_of(file, format, spec.channels), depth_of(file, format, spec.depth),
                         compression_of(file, format, spec.compression)};
    refuse_ids(file, format, spec.channels, layout.depth);
    refuse_size(file, format, spec.display_window);
    return layout;
}

SinkMemory picture_memory(const std::filesystem::path& file, const SinkSpec& spec) {
    const PictureLayout layout = picture_layout(file, spec);
    const Rect& window = spec.display_window;
    const std::size_t depth = layout.depth == Depth::kUint8 ? 1 : layout.depth == Depth::kUint16 ? 2 : 4;
    const std::size_t row = layout.order.channels.size() * static_cast<std::size_t>(window.width()) * depth;
    const double frame = static_cast<double>(row) * window.height();
    return {row * static_cast<std::size_t>(std::min(kPictureChunkRows, window.height())),
            static_cast<std::size_t>(layout.format.frames_held * frame)};
}

std::string extension_of(const std::filesystem::path& file) {
    std::string extension = file.extension().string();
    if (!extension.empty()) extension.erase(0, 1);
    std::ranges::transform(extension, extension.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension;
}

std::string spaced(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
    return text;
}

}  // namespace keyline
