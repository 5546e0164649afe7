// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/io/oiio/picture_tasks.h"
#include "engine/io/pool.h"

#include <cstddef>
#include <deque>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

namespace keyline::oiio {

// Sessions with the helper program for pictures; they idle here between pictures.
Pool<Helper>& picture_helpers();

// The picture of a file, opened in a helper.  Throws Failure (kInput) that names the file.
PictureHeader open_in(Helper& helper, const PictureRequest& request, uint64_t picture_bytes);

// Whole rows of one picture, packed, all channels interleaved, in one sample type.
using Band = std::vector<std::byte>;

// Decodes a picture in bands of rows, in a helper.  Most formats can only be decoded from the top, by one
// thread: a band further down means decoding those above it.  The bands passed on the way are kept, up to a
// limit, for the threads that come for them next; only who comes back for older ones makes the decoder begin
// again.  Reading in any order that is downward in the large therefore decodes each row once.
class BandReader {
public:
    // Kept decoded at most, beyond the bands that are in use; a picture of up to this size is decoded once.
    static constexpr std::size_t kKept = std::size_t{64} << 20;

    // `sample` is the type of the rows.
    BandReader(PictureRequest request, PictureHeader header, Sample sample, int band_height);
    ~BandReader();

    // Safe from any thread.  Throws Failure (kInput) for a damaged file.
    std::shared_ptr<const Band> band(int index);

    int band_height() const { return band_height_; }
    std::size_t band_bytes() const { return row_bytes_ * static_cast<std::size_t>(band_height_); }
    // What is kept at most, bands and not those in use.
    std::size_t kept_bytes() const;

private:
    std::shared_ptr<const Band> kept(int index) const;
    void keep(int index, std::shared_ptr<const Band> band);
    std::shared_ptr<const Band> decode(int index);
    void begin();
    void close();
    void let_go();
    Band read_rows(int begin, int end);

    const PictureRequest request_;
    const PictureHeader header_;
    const Sample sample_;
    const int band_height_;
    const std::size_t row_bytes_;
    const bool any_order_;  // bands can be decoded each on its own

    std::mutex mutex_;                           // guards what follows
    std::optional<Pool<Helper>::Lease> helper_;  // where the picture is open; none: nowhere
    int next_ = 0;                               // the band that the decoder stands before
    std::deque<std::pair<int, std::shared_ptr<const Band>>> kept_;
};

}  // namespace keyline::oiio
