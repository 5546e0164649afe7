// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/io/exr/helper_tasks.h"
#include "engine/io/exr/layout.h"
#include "engine/io/exr/unpack.h"

#include <cstddef>
#include <span>
#include <vector>

namespace keyline::exr {

// What a helper process that unpacks takes beside what a chunk needs: its share of the library's pages.
inline constexpr std::size_t kHelperProcess = std::size_t{4} << 20;

// Whether OpenEXRCore (3.1.5) can't do it and a helper process must: DWA, B44 with float channels.
bool needs_helper(Compression compression, std::span<const StoredChannel> channels);

// Unpacks in a helper process: what needs_helper(), luminance/chroma images and subsampled channels.  A few
// chunks at a time are made into a small file of their own, which the helper is sent.
class ContainedUnpacker final : public Unpacker {
public:
    ContainedUnpacker(const InputFile& file, const ReadContext& context, const Part& part, int part_index);

    static bool is_for(const Part& part);
    static int block_rows(const Part& part);
    static std::size_t memory(const Part& part);

    Block unpack(const Rect& rect) override;

private:
    std::vector<std::byte> small_file(const Rect& rect) const;
    void append_chunk(const Rect& rect, std::vector<std::byte>& chunks) const;

    const InputFile& file_;
    const ReadContext& context_;
    const Part& part_;
    int part_index_;
    bool as_rgba_;
    BlockLayout stored_;  // were nothing subsampled
    Helper helper_{kHelperProgram};
    std::vector<std::byte> samples_;
};

// An OpenEXR file in memory: `chunks` are its chunks one after the other, each with its leader.
std::vector<std::byte> file_of(const Layout& layout, std::span<const std::byte> chunks);

}  // namespace keyline::exr
