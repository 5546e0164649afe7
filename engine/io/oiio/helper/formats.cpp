// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/io/oiio/helper/formats.h"

#include "engine/io/oiio/helper/library.h"
#include "engine/io/output_format.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <fmt/format.h>
#include <map>
#include <set>

namespace keyline::oiio {

namespace {

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

std::vector<std::string> input_extensions() {
    std::set<std::string> first = {"exr"};
    for (const auto& [format, extensions] : extensions_read()) first.insert(extensions.front());
    return {first.begin(), first.end()};
}

}  // namespace keyline::oiio
