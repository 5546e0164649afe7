// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/io/oiio/helper/decoder.h"

#include "engine/base/error.h"
#include "engine/io/oiio/helper/formats.h"
#include "engine/io/oiio/helper/metadata.h"
#include "engine/io/oiio/helper/png.h"
#include "engine/io/output_format.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <fmt/format.h>
#include <fstream>
#include <optional>

namespace keyline::oiio {

namespace {

using OIIO::TypeDesc;

std::string on_one_line(std::string text) {
    std::ranges::replace_if(
        text, [](unsigned char c) { return std::iscntrl(c) != 0; }, ' ');
    while (text.ends_with(' ') || text.ends_with('.')) text.pop_back();
    return text;
}

std::string named_format(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    std::array<std::byte, kFirstBytes> bytes = {};
    in.read(reinterpret_cast<char*>(bytes.data()), bytes.size());
    const auto n = static_cast<std::size_t>(in.gcount());
    if (n == 0) fail(ErrorKind::kInput, fmt::format("{}: the file is empty", file.string()));
    const std::string format = input_format(file, std::span(bytes).first(n));
    if (format.empty())
        fail(ErrorKind::kInput, fmt::format("{}: its content is of no known image format", file.string()),
             "known are " + spaced(input_extensions()));
    return format;
}

std::optional<int> number(const std::string& text) {
    int value = 0;
    const auto parsed = std::from_chars(text.data(), text.data() + text.size(), value);
    if (parsed.ec != std::errc{} || parsed.ptr != text.data() + text.size()) return std::nullopt;
    return value;
}

// By name, else by number.  Throws Failure (kInput) that lists them.
int chosen_subimage(const std::filesystem::path& file, const std::string& format, const std::string& part) {
    if (part.empty()) return 0;
    const auto input = open_input(file, format, 0);
    std::vector<std::string> labels;
    while (input->seek_subimage(static_cast<int>(labels.size()), 0)) {
        const std::string name = input->spec().get_string_attribute("oiio:subimagename");
        if (name == part) return static_cast<int>(labels.size());
        labels.push_back(name.empty() ? std::to_string(labels.size()) : name);
    }
    error_of(*input);
    const auto index = number(part);
    if (index && *index >= 0 && static_cast<std::size_t>(*index) < labels.size()) return *index;
    fail(ErrorKind::kInput, fmt::format("{}: no part {}", file.string(), in_quotes(part)),
         fmt::format("its parts are {}", listed(labels)));
}

// The file's own where Keyline converts it, else float.
Sample sample_of(const OIIO::ImageSpec& spec) {
    if (!spec.channelformats.empty()) return Sample::kFloat;
    switch (spec.format.basetype) {
        case TypeDesc::UINT8: return Sample::kUint8;
        case TypeDesc::UINT16: return Sample::kUint16;
        case TypeDesc::HALF: return Sample::kHalf;
        default: return Sample::kFloat;
    }
}

TypeDesc type_of(Sample sample) {
    switch (sample) {
        case Sample::kUint8: return TypeDesc::UINT8;
        case Sample::kUint16: return TypeDesc::UINT16;
        case Sample::kHalf: return TypeDesc::HALF;
        case Sample::kFloat: break;
    }
    return TypeDesc::FLOAT;
}

// The reader of JPEG 2000 forgets to say so.
bool is_straight(const OIIO::ImageSpec& spec, const std::string& format) {
    return spec.alpha_channel >= 0 && spec.alpha_channel < spec.nchannels && spec.nchannels > 1 &&
           (spec.get_int_attribute("oiio:UnassociatedAlpha") != 0 || format == "jpeg2000");
}

}  // namespace

std::string error_of(OIIO::ImageInput& input) {
    return input.has_error() ? on_one_line(input.geterror()) : "";
}

std::string error_of(OIIO::ImageOutput& output) {
    return output.has_error() ? on_one_line(output.geterror()) : "";
}

std::unique_ptr<OIIO::ImageInput> open_input(const std::filesystem::path& file, const std::string& format,
                                             int subimage) {
    auto input = OIIO::ImageInput::create(format);
    if (!input)
        fail(ErrorKind::kInput, fmt::format("{}: this OpenImageIO can't read {} files: {}", file.string(),
                                            format, on_one_line(OIIO::geterror())));
    input->threads(1);
    // Multiplied by us, in float: OpenImageIO would do it in the file's eight bits.
    OIIO::ImageSpec wish, spec;
    wish.attribute("oiio:UnassociatedAlpha", 1);
    if (!input->open(file.string(), spec, wish) || (subimage > 0 && !input->seek_subimage(subimage, 0))) {
        const std::string why = error_of(*input);
        fail(ErrorKind::kInput, fmt::format("{}: can't be read as {}: {}", file.string(), format,
                                            why.empty() ? "its header is damaged" : why));
    }
    return input;
}

Decoder::Decoder(const PictureRequest& request) : file_(request.file), format_(named_format(file_)) {
    if (format_ == "png") check_png(file_, request.to_be_read ? PngPart::kWhole : PngPart::kHeader);
    subimage_ = chosen_subimage(file_, format_, request.part);
    input_ = open_input(file_, format_, subimage_);
    spec_ = input_->spec();
}

PictureHeader Decoder::header() const {
    PictureHeader h;
    h.format = format_;
    h.x = spec_.x;
    h.y = spec_.y;
    h.width = spec_.width;
    h.height = spec_.height;
    h.full_x = spec_.full_x;
    h.full_y = spec_.full_y;
    h.full_width = spec_.full_width;
    h.full_height = spec_.full_height;
    h.depth = spec_.depth;
    h.tile_height = spec_.tile_width > 0 ? spec_.tile_height : 0;
    h.strip_rows = spec_.get_int_attribute("tiff:RowsPerStrip");
    h.alpha = is_straight(spec_, format_) ? spec_.alpha_channel : -1;
    h.is_deep = spec_.deep;
    h.sample = sample_of(spec_);
    for (int c = 0; c < spec_.nchannels; ++c) {
        h.channels.emplace_back(spec_.channel_name(c));
        h.types.emplace_back(spec_.channelformat(c).c_str());
    }
    h.metadata = metadata_of(spec_);
    return h;
}

std::size_t Decoder::row_bytes(Sample sample) const {
    return static_cast<std::size_t>(spec_.width) * static_cast<std::size_t>(spec_.nchannels) *
           sample_bytes(sample);
}

void Decoder::read_rows(int begin, int end, Sample sample, std::byte* to) {
    const bool done = read(spec_.y + begin, spec_.y + end, type_of(sample), to);
    // Some readers report success, and leave a message and rows of nothing.
    if (const std::string why = error_of(*input_); !done || !why.empty())
        fail(ErrorKind::kInput, fmt::format("{}: damaged between rows {} and {}: {}", file_, begin, end - 1,
                                            why.empty() ? "the file ends too early" : why));
}

bool Decoder::read(int begin, int end, TypeDesc type, std::byte* to) {
    if (spec_.tile_width > 0)
        return input_->read_tiles(subimage_, 0, spec_.x, spec_.x + spec_.width, begin, end, spec_.z,
                                  spec_.z + std::max(1, spec_.depth), 0, spec_.nchannels, type, to);
    return input_->read_scanlines(subimage_, 0, begin, end, spec_.z, 0, spec_.nchannels, type, to);
}

}  // namespace keyline::oiio
