// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/error.h"
#include "engine/io/oiio/helper/library.h"
#include "engine/io/oiio/helper/proxy.h"
#include "engine/io/oiio/picture_tasks.h"

#include <cstddef>
#include <memory>
#include <string>

namespace keyline::oiio {

// A picture that one of OpenImageIO's writers makes in an open file.  Everything throws Failure (kOutput).
class PictureOutput {
public:
    // The descriptor is its own.
    PictureOutput(const PictureSpec& spec, int descriptor);
    ~PictureOutput();
    PictureOutput(const PictureOutput&) = delete;
    PictureOutput& operator=(const PictureOutput&) = delete;

    std::size_t row_bytes() const { return spec_.scanline_bytes(); }
    int height() const { return spec_.height; }

    // Rows from the top on, in order, in the samples of the spec, interleaved.
    void write_rows(int begin, int end, const std::byte* rows);

    void finish();

private:
    void check_written() const;
    void require(bool done, const char* step);
    [[noreturn]] void fail_with(const std::string& why, std::string hint = {},
                                Passing passing = Passing::kNever) const;

    const std::string name_, format_;
    const OIIO::ImageSpec spec_;
    const int descriptor_;
    std::unique_ptr<OutputProxy> proxy_;         // null for writers that want a path
    std::unique_ptr<OIIO::ImageOutput> output_;  // goes before what it writes to
};

}  // namespace keyline::oiio
