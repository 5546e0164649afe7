// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/io/image_io_bands.h"

#include "engine/error.h"
#include "engine/io/image_io_png.h"

#include <algorithm>
#include <cctype>
#include <fmt/format.h>
#include <utility>

namespace keyline::oiio {

namespace {

std::string on_one_line(std::string text) {
    std::ranges::replace_if(
        text, [](unsigned char c) { return std::iscntrl(c) != 0; }, ' ');
    while (text.ends_with(' ') || text.ends_with('.')) text.pop_back();
    return text;
}

// Strips and tiles of a TIFF are compressed one by one; a band of whole ones needs no other.
bool reads_in_any_order(const OIIO::ImageSpec& spec, const std::string& format, int band_height) {
    if (spec.tile_width > 0) return true;
    const int strip = spec.get_int_attribute("tiff:RowsPerStrip");
    return format == "tiff" && strip > 0 && band_height % strip == 0;
}

}  // namespace

void use_no_threads() { OIIO::attribute("threads", 1); }

std::string error_of(OIIO::ImageInput& input) {
    return input.has_error() ? on_one_line(input.geterror()) : "";
}

std::string error_of(OIIO::ImageOutput& output) {
    return output.has_error() ? on_one_line(output.geterror()) : "";
}

std::unique_ptr<OIIO::ImageInput> open_input(const std::filesystem::path& file, const std::string& format,
                                             int subimage) {
    if (format == "png") check_png(file, PngPart::kHeader);
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

BandReader::BandReader(std::filesystem::path file, std::string format, int subimage,
                       const OIIO::ImageSpec& spec, OIIO::TypeDesc sample, int band_height)
    : file_(std::move(file)),
      format_(std::move(format)),
      subimage_(subimage),
      band_height_(band_height),
      spec_(spec),
      sample_(sample),
      row_bytes_(static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.nchannels) *
                 sample.size()),
      any_order_(reads_in_any_order(spec, format_, band_height)) {}

BandReader::~BandReader() {
    if (input_) error_of(*input_);
}

std::shared_ptr<const Band> BandReader::band(int index) {
    const std::lock_guard lock(mutex_);
    if (any_order_) return decode(index);
    if (auto found = kept(index)) return found;
    if (index < next_) input_.reset();
    if (!input_) begin();
    for (;;) {
        const int passed = next_;
        auto rows = decode(passed);
        keep(passed, rows);
        if (passed == index) return rows;
    }
}

std::shared_ptr<const Band> BandReader::kept(int index) const {
    const auto found = std::ranges::find(kept_, index, &std::pair<int, std::shared_ptr<const Band>>::first);
    return found == kept_.end() ? nullptr : found->second;
}

void BandReader::keep(int index, std::shared_ptr<const Band> band) {
    if (kept(index)) return;
    kept_.emplace_back(index, std::move(band));
    if (kept_.size() * band_bytes() > kKept) kept_.pop_front();
}

void BandReader::begin() {
    if (format_ == "png" && !std::exchange(checked_, true)) check_png(file_, PngPart::kWhole);
    input_ = open_input(file_, format_, subimage_);
    next_ = 0;
}

std::shared_ptr<const Band> BandReader::decode(int index) {
    if (!input_) begin();
    const int begin = spec_.y + index * band_height_;
    const int end = std::min(begin + band_height_, spec_.y + spec_.height);
    auto rows = std::make_shared<Band>(row_bytes_ * static_cast<std::size_t>(end - begin));
    const bool done = read_rows(begin, end, rows->data());
    // Some readers report success, and leave a message and rows of nothing.
    if (const std::string why = error_of(*input_); !done || !why.empty()) {
        input_.reset();
        fail(ErrorKind::kInput, fmt::format("{}: damaged between rows {} and {}: {}", file_.string(), begin,
                                            end - 1, why.empty() ? "the file ends too early" : why));
    }
    next_ = index + 1;
    return rows;
}

bool BandReader::read_rows(int begin, int end, std::byte* to) {
    if (spec_.tile_width > 0)
        return input_->read_tiles(subimage_, 0, spec_.x, spec_.x + spec_.width, begin, end, spec_.z,
                                  spec_.z + std::max(1, spec_.depth), 0, spec_.nchannels, sample_, to);
    return input_->read_scanlines(subimage_, 0, begin, end, spec_.z, 0, spec_.nchannels, sample_, to);
}

}  // namespace keyline::oiio
