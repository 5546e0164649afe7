// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/io/image_io_library.h"
#include "engine/io/output_file.h"

#include <OpenImageIO/filesystem.h>
#include <cstddef>
#include <cstdint>
#include <exception>

namespace keyline::oiio {

// Lets a writer of OpenImageIO write into an OutputFile.
//
// A failure is kept for rethrow(), and success is pretended meanwhile: what libraries do about a full disk is
// to print to standard error (libpng), to end the process (libjpeg) or nothing at all.
class OutputProxy : public OIIO::Filesystem::IOProxy {
public:
    explicit OutputProxy(OutputFile& file) : IOProxy("", Write), file_(file) {}

    const char* proxytype() const override { return "keyline"; }
    std::size_t size() const override { return file_.size(); }
    std::size_t write(const void* bytes, std::size_t n) override;
    std::size_t pwrite(const void* bytes, std::size_t n, std::int64_t offset) override;

    // Throws the first failure of writing, if there was one.
    void rethrow() const;

private:
    OutputFile& file_;
    std::exception_ptr failure_;
};

}  // namespace keyline::oiio
