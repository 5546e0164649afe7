// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/geometry.h"
#include "engine/base/image.h"
#include "engine/io/exr/format.h"
#include "engine/io/exr/helper_tasks.h"
#include "engine/io/exr/layout.h"

#include <cstddef>
#include <memory>
#include <openexr.h>
#include <span>
#include <vector>

struct libdeflate_compressor;

namespace keyline::exr {

// A part that is never written: OpenEXRCore's compressors want one.  Packing through it is safe from any
// number of threads.
class PackContext {
public:
    explicit PackContext(const Layout& layout);
    ~PackContext();
    PackContext(const PackContext&) = delete;
    PackContext& operator=(const PackContext&) = delete;

    exr_context_t get() const { return context_; }

private:
    PackContext() = default;

    exr_context_t context_ = nullptr;
};

// Packs chunks for one part, one at a time, in buffers that are kept.
class Packer {
public:
    // `context`: null where uses_core() is false.
    Packer(const Layout& layout, const PackContext* context);
    ~Packer();
    Packer(const Packer&) = delete;
    Packer& operator=(const Packer&) = delete;

    // Appends the chunk of `rect` as the file holds it: its first row, its size, its bytes.  `planes`: one a
    // channel, in the layout's order, covering `rect`.  Throws Failure (kOutput).
    void pack(const Rect& rect, std::span<const Plane> planes, std::vector<std::byte>& out);

    // Bytes that pack() needs for itself and keeps, its helper process included.
    static std::size_t memory(const Layout& layout);

    // Bytes that a packed chunk has at most: what can't be compressed is as large as it was.
    static std::size_t most_packed(const Layout& layout);

    // Whether OpenEXRCore compresses this.
    static bool uses_core(const Layout& layout);

private:
    std::span<const std::byte> compressed(const Rect& rect, std::span<const Plane> planes);
    void gather(const Rect& rect, std::span<const Plane> planes);
    std::span<const std::byte> deflated();
    std::span<const std::byte> packed_in_core(const Rect& rect, std::span<const Plane> planes);
    std::span<const std::byte> packed_in_helper(const Rect& rect);

    struct FreeCompressor {
        void operator()(libdeflate_compressor* compressor) const;
    };

    const Layout& layout_;
    const PackContext* context_;
    BlockLayout block_;
    std::vector<std::byte> samples_, split_, packed_;
    std::unique_ptr<libdeflate_compressor, FreeCompressor> compressor_;
    exr_encode_pipeline_t pipeline_ = {};
    bool has_pipeline_ = false;
    Helper helper_{kHelperProgram};
};

}  // namespace keyline::exr
