// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/io/oiio/helper/output.h"

#include "engine/base/error.h"
#include "engine/io/oiio/helper/decoder.h"
#include "engine/io/oiio/helper/metadata.h"
#include "engine/io/system_call.h"

#include <algorithm>
#include <fcntl.h>
#include <system_error>
#include <unistd.h>
#include <vector>

namespace keyline::oiio {

namespace {

using OIIO::ImageSpec;
using OIIO::TypeDesc;

// One writer puts the path that it is given into the file: it must be the same in every process.
constexpr int kDescriptor = 100;

int at_its_place(int descriptor) {
    const int moved = fcntl(descriptor, F_DUPFD_CLOEXEC, kDescriptor);
    close(descriptor);
    return moved;
}

std::string path_of(int descriptor) { return "/proc/self/fd/" + std::to_string(descriptor); }

// PNG keeps text under names of 1 to 79 printable characters.
void drop_names_png_refuses(Metadata& metadata) {
    std::vector<std::string> refused;
    for (const Attribute& a : metadata.attributes()) {
        const bool printable = std::ranges::all_of(a.name, [](char c) { return c > ' ' && c < '\x7f'; });
        if (a.name.empty() || a.name.size() > 79 || !printable) refused.push_back(a.name);
    }
    for (const std::string& name : refused) metadata.erase(name);
}

TypeDesc type_of(Sample sample) {
    return sample == Sample::kUint8    ? TypeDesc::UINT8
           : sample == Sample::kUint16 ? TypeDesc::UINT16
                                       : TypeDesc::FLOAT;
}

ImageSpec spec_of(const PictureSpec& wanted) {
    ImageSpec spec(wanted.width, wanted.height, static_cast<int>(wanted.channels.size()),
                   type_of(wanted.sample));
    Metadata metadata = wanted.metadata;
    if (wanted.format == "png") drop_names_png_refuses(metadata);
    set_metadata(spec, metadata);
    spec.channelnames = wanted.channels;
    spec.alpha_channel = wanted.alpha;
    spec.z_channel = -1;
    spec.tile_width = spec.tile_height = wanted.tile_size;
    // What is divided by alpha must not be divided again, in integers.
    if (wanted.is_straight) spec.attribute("oiio:UnassociatedAlpha", 1);
    if (!wanted.compression.empty()) spec.attribute("compression", wanted.compression);
    // Else the writer would put in a date that it does not know.
    if (wanted.format == "tiff" && spec.find_attribute("DateTime") == nullptr) spec.attribute("DateTime", "");
    // Else the writer leaves in the name what lay in memory: other bytes in each run.
    if (wanted.format == "sgi" && spec.find_attribute("ImageDescription") == nullptr)
        spec.attribute("ImageDescription", " ");
    // A render waits for this one thread.  Against zlib's 6, 16-bit frames with grain take 60 to 75 % of the
    // time and 1 % more room.
    spec.attribute("png:compressionLevel", 3);
    spec.attribute("tiff:zipquality", 3);
    return spec;
}

}  // namespace

PictureOutput::PictureOutput(const PictureSpec& spec, int descriptor)
    : name_(spec.file),
      format_(spec.format),
      spec_(spec_of(spec)),
      descriptor_(at_its_place(descriptor)),
      output_(OIIO::ImageOutput::create(spec.format)) {
    if (!output_)
        fail(ErrorKind::kOutput, fmt::format("{}: this OpenImageIO can't write {} files", name_, format_));
    output_->threads(1);
    if (output_->supports("ioproxy")) {
        proxy_ = std::make_unique<OutputProxy>(descriptor_);
        output_->set_ioproxy(proxy_.get());
    }
    // One writer takes the kind of file from the name's extension.
    const std::string name = "picture" + std::filesystem::path(name_).extension().string();
    require(output_->open(proxy_ ? name : path_of(descriptor_), spec_), "starting");
}

PictureOutput::~PictureOutput() {
    output_.reset();
    close(descriptor_);
}

void PictureOutput::write_rows(int begin, int end, const std::byte* rows) {
    const bool done = spec_.tile_width > 0
                          ? output_->write_tiles(0, spec_.width, begin, end, 0, 1, spec_.format, rows)
                          : output_->write_scanlines(begin, end, 0, spec_.format, rows);
    require(done, "writing");
}

void PictureOutput::finish() {
    const bool done = output_->close();
    require(done, "finishing");
    error_of(*output_);  // the TIFF writer leaves a complaint about its Exif data when all is well
    output_.reset();
    if (proxy_ && proxy_->size() == 0) fail_with("its writer wrote nothing");
    if (!proxy_) check_written();
}

// Writers without a proxy find only at the end, and do not tell, that a disk is full.
void PictureOutput::check_written() const {
    try {
        const auto input = open_input(path_of(descriptor_), format_, 0);
        std::vector<std::byte> row(spec_.scanline_bytes());
        const auto reads = [&](int y) { return input->read_scanline(y, 0, spec_.format, row.data()); };
        const bool whole = input->spec().width == spec_.width && input->spec().height == spec_.height &&
                           reads(0) && reads(spec_.height - 1);  // some formats run upwards
        if (error_of(*input).empty() && whole) return;
    } catch (const Failure&) {  // told below, with what it means here
    }
    fail_with("it can't be read back", "is the disk full?");
}

void PictureOutput::require(bool done, const char* step) {
    if (proxy_ && proxy_->error() != 0)
        fail_with(system_text(proxy_->error()), system_hint(proxy_->error()),
                  system_passing(proxy_->error()));
    if (done) return;
    const std::string why = error_of(*output_);
    fail_with(fmt::format("{} it failed{}", step, why.empty() ? "" : ": " + why));
}

void PictureOutput::fail_with(const std::string& why, std::string hint, Passing passing) const {
    fail(ErrorKind::kOutput, fmt::format("{}: can't be written: {}", name_, why), std::move(hint), passing);
}

}  // namespace keyline::oiio
