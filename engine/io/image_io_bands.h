// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/io/image_io_library.h"

#include <cstddef>
#include <deque>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace keyline::oiio {

// OpenImageIO's own threads off, for the whole process: Keyline's workers are the threads.
void use_no_threads();

// What OpenImageIO says about a failure, on one line; "" for none.  Also takes it from OpenImageIO, which
// prints to standard error what nobody asked for.
std::string error_of(OIIO::ImageInput& input);
std::string error_of(OIIO::ImageOutput& output);

// Opens a picture of a file with the reader of one format.  Alpha is left as the file has it.
// Throws Failure (kInput).
std::unique_ptr<OIIO::ImageInput> open_input(const std::filesystem::path& file, const std::string& format,
                                             int subimage);

// Whole rows of one picture, packed, all channels interleaved, in one sample type.
using Band = std::vector<std::byte>;

// Decodes a picture in bands of rows.  Most formats can only be decoded from the top, by one thread: a band
// further down means decoding those above it.  The bands passed on the way are kept, up to a limit, for the
// threads that come for them next; only who comes back for older ones makes the decoder begin again.  Reading
// in any order that is downward in the large therefore decodes each row once.
class BandReader {
public:
    // Kept decoded at most, beyond the bands that are in use; a picture of up to this size is decoded once.
    static constexpr std::size_t kKept = std::size_t{64} << 20;

    // `sample` is the type of the rows.
    BandReader(std::filesystem::path file, std::string format, int subimage, const OIIO::ImageSpec& spec,
               OIIO::TypeDesc sample, int band_height);
    ~BandReader();

    // Safe from any thread.  Throws Failure (kInput) for a damaged file.
    std::shared_ptr<const Band> band(int index);

    int band_height() const { return band_height_; }
    std::size_t band_bytes() const { return row_bytes_ * static_cast<std::size_t>(band_height_); }

private:
    std::shared_ptr<const Band> kept(int index) const;
    void keep(int index, std::shared_ptr<const Band> band);
    std::shared_ptr<const Band> decode(int index);
    void begin();
    bool read_rows(int begin, int end, std::byte* to);

    const std::filesystem::path file_;
    const std::string format_;
    const int subimage_, band_height_;
    const OIIO::ImageSpec spec_;
    const OIIO::TypeDesc sample_;
    const std::size_t row_bytes_;
    const bool any_order_;  // bands can be decoded each on its own

    std::mutex mutex_;  // guards what follows
    std::unique_ptr<OIIO::ImageInput> input_;
    int next_ = 0;  // the band that the decoder stands before
    std::deque<std::pair<int, std::shared_ptr<const Band>>> kept_;
    bool checked_ = false;
};

}  // namespace keyline::oiio
