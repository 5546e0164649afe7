// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/io/image_io_library.h"
#include "engine/io/image_io_proxy.h"
#include "engine/io/output_file.h"

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>

namespace keyline::oiio {

// A picture that one of OpenImageIO's writers makes, under its name when it is whole.
// Everything throws Failure (kOutput).
class PictureFile {
public:
    PictureFile(const std::filesystem::path& file, const std::string& format, const OIIO::ImageSpec& spec);
    ~PictureFile();

    // Rows from the top on, in order, in the samples of the spec, interleaved.
    void write_rows(int begin, int end, const std::byte* rows);

    void finish();

private:
    void give_png_pixels();
    void check_written() const;
    void require(bool done, const char* step);

    const std::string name_, format_;
    const OIIO::ImageSpec spec_;
    // Either given to the writer through the proxy, or, for writers that want a path, by name.
    std::unique_ptr<OutputFile> file_;
    std::unique_ptr<OutputProxy> proxy_;
    std::unique_ptr<OIIO::ImageOutput> output_;  // goes before what it writes to
    int rows_written_ = 0;
};

}  // namespace keyline::oiio
