// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/io/image_io_output.h"

#include "engine/error.h"
#include "engine/io/image_io_bands.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace keyline::oiio {

PictureFile::PictureFile(const std::filesystem::path& file, const std::string& format,
                         const OIIO::ImageSpec& spec)
    : name_(file.string()), format_(format), spec_(spec), output_(OIIO::ImageOutput::create(format)) {
    if (!output_)
        fail(ErrorKind::kOutput, fmt::format("{}: this OpenImageIO can't write {} files", name_, format));
    output_->threads(1);
    if (output_->supports("ioproxy")) {
        file_ = std::make_unique<OutputFile>(file);
        proxy_ = std::make_unique<OutputProxy>(*file_);
        output_->set_ioproxy(proxy_.get());
        require(output_->open(name_, spec_), "starting");
    } else {
        file_ = std::make_unique<OutputFile>(file, OutputFile::Unfinished::kNamed);
        require(output_->open(file_->unfinished_path().string(), spec_), "starting");
    }
}

PictureFile::~PictureFile() {
    if (!output_) return;
    if (format_ == "png") give_png_pixels();
    output_->close();
    error_of(*output_);
}

void PictureFile::write_rows(int begin, int end, const std::byte* rows) {
    const bool done = spec_.tile_width > 0
                          ? output_->write_tiles(0, spec_.width, begin, end, 0, 1, spec_.format, rows)
                          : output_->write_scanlines(begin, end, 0, spec_.format, rows);
    require(done, "writing");
    rows_written_ = end;
}

void PictureFile::finish() {
    const bool done = output_->close();
    require(done, "finishing");
    error_of(*output_);  // the TIFF writer leaves a complaint about its Exif data when all is well
    output_.reset();
    if (!proxy_) check_written();
    file_->publish();
}

// Writers without a proxy find only at the end, and do not tell, that a disk is full.
void PictureFile::check_written() const {
    try {
        const auto input = open_input(file_->unfinished_path(), format_, 0);
        std::vector<std::byte> row(spec_.scanline_bytes());
        const auto reads = [&](int y) { return input->read_scanline(y, 0, spec_.format, row.data()); };
        const bool whole = input->spec().width == spec_.width && input->spec().height == spec_.height &&
                           reads(0) && reads(spec_.height - 1);  // some formats run upwards
        if (error_of(*input).empty() && whole) return;
    } catch (const Failure&) {  // told below, with what it means here
    }
    fail(ErrorKind::kOutput, fmt::format("{}: can't be written: it can't be read back", name_),
         "is the disk full?");
}

// libpng complains to standard error when a file is closed without compressed pixels, even one that is given
// up.  Rows of noise make it write some soon.
void PictureFile::give_png_pixels() {
    std::vector<std::byte> row(spec_.scanline_bytes());
    std::uint32_t noise = 1;
    const int enough = rows_written_ + static_cast<int>((std::size_t{1} << 17) / row.size()) + 1;
    for (int y = rows_written_; y < std::min(enough, spec_.height); ++y) {
        for (std::byte& b : row) b = static_cast<std::byte>((noise = noise * 1664525 + 1013904223) >> 24U);
        if (!output_->write_scanline(y, 0, spec_.format, row.data())) return;
    }
}

void PictureFile::require(bool done, const char* step) {
    if (proxy_) proxy_->rethrow();
    if (done) return;
    const std::string why = error_of(*output_);
    fail(ErrorKind::kOutput,
         fmt::format("{}: can't be written: {} it failed{}", name_, step, why.empty() ? "" : ": " + why));
}

}  // namespace keyline::oiio
