// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/io/oiio/helper/library.h"

#include <OpenImageIO/filesystem.h>
#include <cstddef>
#include <cstdint>

namespace keyline::oiio {

// Lets a writer of OpenImageIO write into an open file.
//
// A failure is kept, and success is pretended meanwhile: what libraries do about a full disk is to end the
// process (libjpeg) or nothing at all.
class OutputProxy : public OIIO::Filesystem::IOProxy {
public:
    explicit OutputProxy(int descriptor) : IOProxy("", Write), descriptor_(descriptor) {}

    const char* proxytype() const override { return "keyline"; }
    std::size_t size() const override { return static_cast<std::size_t>(size_); }
    std::size_t write(const void* bytes, std::size_t n) override;
    std::size_t pwrite(const void* bytes, std::size_t n, std::int64_t offset) override;

    // The first error of the system; 0 for none.
    int error() const { return error_; }

private:
    int descriptor_;
    std::int64_t size_ = 0, being_synced_ = 0;
    int error_ = 0;
};

}  // namespace keyline::oiio
