// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/io/image_io_formats.h"

#include "engine/error.h"
#include "engine/io/image_io_library.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <fmt/format.h>
#include <map>
#include <set>

namespace keyline::oiio {

namespace {

constexpr Depth k8 = Depth::kUint8, k16 = Depth::kUint16, kF = Depth::kFloat;

// Tried one by one against OpenImageIO 2.4: its writers take whatever they are given, and drop, repeat or
// round without a word what their format lacks (one aborts), so that asking them would not do.
const std::vector<OutputFormat>& output_formats() {
    static const std::vector<OutputFormat> formats = {
        {.name = "bmp", .extensions = {"bmp"}, .depths = {k8}, .channel_sets = {"Y", "RGB", "RGBA"}},
        {.name = "dpx", .extensions = {"dpx"}, .depths = {kF, k16, k8}, .channel_sets = {"Y", "RGB", "RGBA"}},
        {.name = "fits", .extensions = {"fits"}, .depths = {kF, k8}, .channel_sets = {"Y"}},
        {.name = "gif", .extensions = {"gif"}, .depths = {k8}, .channel_sets = {"RGB"}},
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
         .compressions = {"rle"}},
        {.name = "jpeg",
         .extensions = {"jpg", "jpeg", "jpe", "jif", "jfif", "jfi"},
         .depths = {k8},
         .channel_sets = {"Y", "RGB"},
         .compressions = {"jpeg"},
         .has_quality = true},
        {.name = "jpeg2000",
         .extensions = {"jp2", "j2k"},
         .depths = {k16, k8},
         .channel_sets = {"Y", "RGB", "RGBA"},
         .straight_alpha = true},
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
         .has_quality = true},
        {.name = "zfile", .extensions = {"zfile"}, .depths = {kF}, .channel_sets = {"Y"}},
    };
    return formats;
}

struct Magic {
    std::string_view format;
    std::size_t offset;
    std::string_view bytes;
};

using namespace std::string_view_literals;

constexpr std::array kMagics = {
    Magic{"png", 0, "\x89PNG\r\n\x1a\n"sv},
    Magic{"jpeg", 0, "\xff\xd8\xff"sv},
    Magic{"tiff", 0, "II\x2a\0"sv},
    Magic{"tiff", 0, "MM\0\x2a"sv},
    Magic{"tiff", 0, "II\x2b\0"sv},
    Magic{"tiff", 0, "MM\0\x2b"sv},
    Magic{"gif", 0, "GIF8"sv},
    Magic{"dpx", 0, "SDPX"sv},
    Magic{"dpx", 0, "XPDS"sv},
    Magic{"cineon", 0, "\x80\x2a\x5f\xd7"sv},
    Magic{"cineon", 0, "\xd7\x5f\x2a\x80"sv},
    Magic{"sgi", 0, "\x01\xda"sv},
    Magic{"hdr", 0, "#?"sv},
    Magic{"webp", 8, "WEBP"sv},
    Magic{"jpeg2000", 0, "\0\0\0\x0cjP  "sv},
    Magic{"jpeg2000", 0, "\xff\x4f\xff\x51"sv},
    Magic{"heif", 4, "ftyphei"sv},
    Magic{"heif", 4, "ftyphev"sv},
    Magic{"heif", 4, "ftypmif1"sv},
    Magic{"heif", 4, "ftypmsf1"sv},
    Magic{"heif", 4, "ftypavi"sv},
    Magic{"iff", 0, "FOR4"sv},
    Magic{"psd", 0, "8BPS"sv},
    Magic{"dds", 0, "DDS "sv},
    Magic{"fits", 0, "SIMPLE"sv},
    Magic{"softimage", 0, "\x53\x80\xf6\x34"sv},
    Magic{"ico", 0, "\0\0\x01\0"sv},
    Magic{"zfile", 0, "\x2f\x08\x67\xab"sv},
    Magic{"zfile", 0, "\xab\x67\x08\x2f"sv},
    Magic{"dicom", 128, "DICM"sv},
    Magic{"bmp", 0, "BM"sv},
};

// Formats that no first bytes tell, or whose first bytes are also another's.
constexpr std::array kByExtension = {"ffmpeg"sv, "raw"sv, "rla"sv, "targa"sv};

std::string extension_of(const std::filesystem::path& file) {
    std::string extension = file.extension().string();
    if (!extension.empty()) extension.erase(0, 1);
    std::ranges::transform(extension, extension.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension;
}

// OpenImageIO's own list, "png:png;jpeg:jpg,jpeg", by format.
std::map<std::string, std::vector<std::string>> extensions_read() {
    std::map<std::string, std::vector<std::string>> extensions;
    const auto readable = OIIO::Strutil::splits(OIIO::get_string_attribute("input_format_list"), ",");
    for (const std::string& entry :
         OIIO::Strutil::splits(OIIO::get_string_attribute("extension_list"), ";")) {
        const std::size_t colon = entry.find(':');
        const std::string format = entry.substr(0, colon);
        const bool made_up = format == "null" || format == "openexr" || format == "openvdb";
        if (colon == std::string::npos || made_up || std::ranges::find(readable, format) == readable.end())
            continue;
        extensions[format] = OIIO::Strutil::splits(std::string_view(entry).substr(colon + 1), ",");
    }
    return extensions;
}

bool begins_as(const Magic& magic, std::string_view text) {
    return text.size() >= magic.offset && text.substr(magic.offset).starts_with(magic.bytes);
}

// "P1" to "P6" and a space, or a float map's "PF" and "Pf".
bool is_pnm(std::string_view text) {
    return text.size() >= 3 && text[0] == 'P' && "123456Ff"sv.find(text[1]) != std::string_view::npos &&
           std::isspace(static_cast<unsigned char>(text[2])) != 0;
}

std::string by_content(std::string_view text) {
    for (const Magic& magic : kMagics)
        if (begins_as(magic, text)) return std::string(magic.format);
    return is_pnm(text) ? "pnm" : "";
}

}  // namespace

bool OutputFormat::holds(std::string_view channel_set) const {
    return std::ranges::find(channel_sets, channel_set) != channel_sets.end();
}

const OutputFormat& output_format(const std::filesystem::path& file) {
    const std::string extension = extension_of(file);
    std::vector<std::string> known = {"exr"};
    for (const OutputFormat& format : output_formats()) {
        if (std::ranges::find(format.extensions, extension) != format.extensions.end()) return format;
        known.insert(known.end(), format.extensions.begin(), format.extensions.end());
    }
    std::ranges::sort(known);
    const std::string what = extension.empty()
                                 ? "the name has no extension to tell the format"
                                 : fmt::format("no format is written as {}", in_quotes("." + extension));
    fail(ErrorKind::kGraph, fmt::format("{}: {}", file.string(), what), "use one of " + spaced(known));
}

std::string input_format(const std::filesystem::path& file, std::span<const std::byte> first_bytes) {
    const std::string_view text(reinterpret_cast<const char*>(first_bytes.data()), first_bytes.size());
    const std::string content = by_content(text);
    if (!content.empty() && content != "tiff") return content;
    const auto extensions = extensions_read();
    const std::string extension = extension_of(file);
    for (const std::string_view format : kByExtension) {
        const auto found = extensions.find(std::string(format));
        if (found != extensions.end() && std::ranges::find(found->second, extension) != found->second.end() &&
            (content.empty() || format == "raw"))
            return std::string(format);
    }
    return content;
}

std::string spaced(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
    return text;
}

std::vector<std::string> input_extensions() {
    std::set<std::string> first = {"exr"};
    for (const auto& [format, extensions] : extensions_read()) first.insert(extensions.front());
    return {first.begin(), first.end()};
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

}  // namespace keyline::oiio
