// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/io/oiio/helper/library.h"
#include "engine/io/oiio/picture_tasks.h"

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>

namespace keyline::oiio {

// What OpenImageIO says about a failure, on one line; "" for none.  Also takes it from OpenImageIO, which
// prints what nobody asked for.
std::string error_of(OIIO::ImageInput& input);
std::string error_of(OIIO::ImageOutput& output);

// Opens a picture of a file with the reader of one format.  Alpha is left as the file has it.
// Throws Failure (kInput).
std::unique_ptr<OIIO::ImageInput> open_input(const std::filesystem::path& file, const std::string& format,
                                             int subimage);

// One picture of a file, open to be read from the top on, or in any order where its format can.
// Everything throws Failure (kInput).
class Decoder {
public:
    explicit Decoder(const PictureRequest& request);

    PictureHeader header() const;
    std::size_t row_bytes(Sample sample) const;
    int height() const { return spec_.height; }

    // Rows from the top, as so many samples one after the other.
    void read_rows(int begin, int end, Sample sample, std::byte* to);

private:
    bool read(int begin, int end, OIIO::TypeDesc type, std::byte* to);

    const std::string file_, format_;
    int subimage_ = 0;
    std::unique_ptr<OIIO::ImageInput> input_;
    OIIO::ImageSpec spec_;
};

}  // namespace keyline::oiio
