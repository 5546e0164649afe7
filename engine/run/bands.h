// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/aligned.h"
#include "engine/base/image.h"

#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace keyline {

// Planes of samples held by bands of rows, each allocated when its first row comes and released when its last
// reader is done.  Memory of a released band serves the next one.  Where all bands come to be held at once,
// neighbours share a slab of memory.
//
// allocate() and release() are for one thread at a time; a band's samples may be read and written by many, as
// long as they keep to different samples.
class Bands {
public:
    // Band i holds the rows [origin + i·height, origin + (i+1)·height) of `region`.
    Bands(const Rect& region, std::vector<SampleType> types, int origin, int height,
          bool held_at_once = false);

    // The same over memory that someone else holds, whole: a plane a channel.  Nothing is ever allocated.
    Bands(const Rect& region, std::vector<Plane> resident, int origin, int height);

    bool is_resident() const { return !resident_.empty(); }

    const Rect& region() const { return region_; }
    const std::vector<SampleType>& types() const { return types_; }
    int first_band() const { return first_; }
    int end_band() const { return first_ + static_cast<int>(bands_.size()); }
    Rect rect(int band) const;

    bool allocated(int band) const { return is_resident() || bands_[slot(band)]; }
    void allocate(int band, bool zero);
    void release(int band, bool reuse);  // `reuse`: another band will want the memory

    Plane plane(int band, std::size_t plane) const;

    // Samples of one plane where they lie: of resident floats.
    std::optional<MutView> view(std::size_t plane, const Rect& region, const Rect& window) const;

    // Samples of one plane as floats; `region` lies inside the bands' region.
    void load(std::size_t plane, const MutView& out) const;

    // The other way.  Returns how many finite values became infinity because half can't hold them.
    std::size_t store(std::size_t plane, const View& in);

    // Samples of another's plane: as they are where it has the same type, else as floats in between.
    void copy(std::size_t plane, const Bands& from, std::size_t from_plane, const Rect& region);

private:
    void store_resident(std::size_t plane, const View& in);
    void convert(std::size_t plane, const Bands& from, std::size_t from_plane, const Rect& region);

    // Memory of one band or of several neighbours.
    struct Slab {
        AlignedArray<std::byte> memory;
        std::size_t in_use = 0;  // bands
    };
    std::size_t slot(int band) const { return static_cast<std::size_t>(band - first_); }
    int band_of(int y) const { return floor_div(y - origin_, height_); }
    std::size_t plane_offset(std::size_t plane) const;  // bytes into a band
    std::size_t band_bytes() const { return plane_offset(types_.size()); }
    std::byte* memory(int band) const;

    Rect region_;
    std::vector<SampleType> types_;
    int origin_, height_, first_;
    std::size_t per_slab_ = 1;
    std::vector<bool> bands_;  // whether they are allocated
    std::vector<Slab> slabs_;
    std::vector<AlignedArray<std::byte>> spare_;
    std::vector<Plane> resident_;
};

}  // namespace keyline
