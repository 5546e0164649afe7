// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/io/oiio/bands.h"

#include "engine/base/error.h"
#include "engine/io/picture_structure.h"
#include "engine/io/system_call.h"

#include <algorithm>
#include <fmt/format.h>
#include <stdexcept>
#include <system_error>

namespace keyline::oiio {

namespace {

// Strips and tiles of a TIFF are compressed one by one; a band of whole ones needs no other.
bool reads_in_any_order(const PictureHeader& header, int band_height) {
    if (header.tile_height > 0) return true;
    return header.format == "tiff" && header.strip_rows > 0 && band_height % header.strip_rows == 0;
}

uint64_t size_of(const std::string& file) {
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(file, error);
    return error ? 0 : size;
}

uint64_t bytes_as_floats(const PictureHeader& header) {
    return uint64_t(header.width) * uint64_t(header.height) * header.channels.size() * sizeof(float);
}

// As far as the structure of a file tells, where it is known.
bool is_cut_off(const std::string& file) {
    std::error_code error;
    return std::filesystem::is_regular_file(file, error) && has_known_structure(file) &&
           !size_of_whole_picture(file);
}

// What the library did with the file, where the helper could not say: it died of it.
[[noreturn]] void fail_with(const std::string& file, const Failure& failure) {
    const std::string& what = failure.error().what;
    const bool named = what.starts_with(file + ": ") || failure.error().kind == ErrorKind::kInternal;
    // A file that is of no format at all has its hint.
    const bool unfinished =
        failure.error().kind == ErrorKind::kInput && failure.error().hint.empty() && is_cut_off(file);
    fail(failure.error().kind, named ? what : fmt::format("{}: damaged: {}", file, what),
         unfinished ? kUnfinishedHint : failure.error().hint,
         unfinished ? Passing::kUnfinished : failure.error().passing);
}

}  // namespace

Pool<Helper>& picture_helpers() {
    static Pool<Helper> pool([] { return std::make_unique<Helper>(kPictureHelper); });
    return pool;
}

PictureHeader open_in(Helper& helper, const PictureRequest& request, uint64_t picture_bytes) {
    HelperRequest task = {};
    task.task = static_cast<uint32_t>(PictureTask::kOpen);
    try {
        return PictureHeader::from(
            helper.run(task, bounds_of(size_of(request.file), picture_bytes), request.bytes()));
    } catch (const Failure& failure) {
        fail_with(request.file, failure);
    } catch (const std::runtime_error& error) {
        fail(ErrorKind::kInput, fmt::format("{}: damaged: {}", request.file, error.what()));
    }
}

BandReader::BandReader(PictureRequest request, PictureHeader header, Sample sample, int band_height)
    : request_(std::move(request)),
      header_(std::move(header)),
      sample_(sample),
      band_height_(band_height),
      row_bytes_(static_cast<std::size_t>(header_.width) * header_.channels.size() * sample_bytes(sample)),
      any_order_(reads_in_any_order(header_, band_height)) {}

BandReader::~BandReader() { let_go(); }

std::shared_ptr<const Band> BandReader::band(int index) {
    const std::lock_guard lock(mutex_);
    if (any_order_) return decode(index);
    if (auto found = kept(index)) return found;
    if (index < next_) let_go();
    if (!helper_) begin();
    for (;;) {
        const int passed = next_;
        auto rows = decode(passed);
        keep(passed, rows);
        if (passed == index) return rows;
    }
}

std::size_t BandReader::kept_bytes() const {
    return any_order_ ? 0 : std::min(kKept, row_bytes_ * static_cast<std::size_t>(header_.height));
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
    helper_.emplace(picture_helpers().take());
    next_ = 0;
    const PictureHeader now = open_in(**helper_, request_, bytes_as_floats(header_));
    if (now.format != header_.format || now.width != header_.width || now.height != header_.height ||
        now.channels.size() != header_.channels.size())
        fail(ErrorKind::kInput, fmt::format("{}: changed while it was read", request_.file), {},
             Passing::kUnfinished);
}

// The helper is for the next picture, without this one.  Some libraries find only now that they wrote where
// they should not have.
void BandReader::close() {
    HelperRequest request = {};
    request.task = static_cast<uint32_t>(PictureTask::kClose);
    (*helper_)->run(request, bounds_of(0, 0), {});
    helper_.reset();
}

void BandReader::let_go() {
    try {
        if (helper_ && (*helper_)->is_running()) close();
    } catch (const Failure&) {  // nothing more is wanted of the picture
    }
    helper_.reset();
}

std::shared_ptr<const Band> BandReader::decode(int index) {
    if (!helper_) begin();
    const int begin = index * band_height_, end = std::min(begin + band_height_, header_.height);
    try {
        auto rows = std::make_shared<const Band>(read_rows(begin, end));
        next_ = index + 1;
        // At its end the helper is free for another picture.
        if (end == header_.height && !any_order_) close();
        return rows;
    } catch (const Failure& failure) {
        helper_.reset();
        fail_with(request_.file, failure);
    }
}

Band BandReader::read_rows(int begin, int end) {
    const std::size_t bytes = row_bytes_ * static_cast<std::size_t>(end - begin);
    const std::span<const std::byte> shared = (*helper_)->shared(bytes);
    HelperRequest request = {};
    request.task = static_cast<uint32_t>(PictureTask::kRead);
    request.first_row = begin;
    request.rows = end - begin;
    HelperBounds bounds = bounds_of(size_of(request_.file), bytes_as_floats(header_));
    bounds.reply_bytes = bytes;
    Band rows = (*helper_)->run(request, bounds, std::as_bytes(std::span(&sample_, 1)));
    if (rows.empty() && shared.size() >= bytes)
        return {shared.begin(), shared.begin() + std::ptrdiff_t(bytes)};
    if (rows.size() != bytes)
        fail(ErrorKind::kInput, fmt::format("{} bytes of samples in place of {}", rows.size(), bytes));
    return rows;
}

}  // namespace keyline::oiio
