// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/run/bands.h"

#include "engine/simd/half.h"
#include "engine/simd/stream.h"

#include <algorithm>
#include <cstring>

namespace keyline {

namespace {

constexpr std::size_t kSlab = 4 * kHugePage;  // at least: a band more than fits, and so these pages are full

}  // namespace

Bands::Bands(const Rect& region, std::vector<SampleType> types, int origin, int height, bool held_at_once)
    : region_(region), types_(std::move(types)), origin_(origin), height_(height) {
    first_ = region_.empty() ? 0 : band_of(region_.y0);
    if (region_.empty()) return;
    bands_.resize(static_cast<std::size_t>(band_of(region_.y1 - 1) + 1 - first_), false);
    // Bands that pass are given back one by one and lie apart; those that are held together share huge pages.
    if (held_at_once) per_slab_ = std::min(bands_.size(), kSlab / band_bytes() + 1);
    slabs_.resize((bands_.size() + per_slab_ - 1) / per_slab_);
}

Bands::Bands(const Rect& region, std::vector<Plane> resident, int origin, int height)
    : Bands(region, std::vector<SampleType>{}, origin, height) {
    resident_ = std::move(resident);
    for (const Plane& plane : resident_) types_.push_back(plane.type);
}

Rect Bands::rect(int band) const {
    const int y = origin_ + band * height_;
    return intersect(region_, {region_.x0, y, region_.x1, y + height_});
}

// Each plane begins on a cache line: two workers that fill neighbouring planes share none.
std::size_t Bands::plane_offset(std::size_t plane) const {
    const auto rows = static_cast<std::size_t>(std::min(height_, region_.height()));
    const std::size_t samples = static_cast<std::size_t>(region_.width()) * rows;
    std::size_t offset = 0;
    for (std::size_t i = 0; i < plane; ++i)
        offset += (samples * sample_size(types_[i]) + kCacheLine - 1) / kCacheLine * kCacheLine;
    return offset;
}

std::byte* Bands::memory(int band) const {
    return slabs_[slot(band) / per_slab_].memory.get() + slot(band) % per_slab_ * band_bytes();
}

void Bands::allocate(int band, bool zero) {
    if (is_resident()) return;
    Slab& slab = slabs_[slot(band) / per_slab_];
    if (!slab.memory && !spare_.empty()) {
        slab.memory = std::move(spare_.back());
        spare_.pop_back();
    } else if (!slab.memory) {
        slab.memory = make_aligned<std::byte>(per_slab_ * band_bytes());
    }
    ++slab.in_use;
    bands_[slot(band)] = true;
    if (zero) std::memset(memory(band), 0, band_bytes());
}

void Bands::release(int band, bool reuse) {
    if (is_resident() || !bands_[slot(band)]) return;
    bands_[slot(band)] = false;
    Slab& slab = slabs_[slot(band) / per_slab_];
    if (--slab.in_use > 0) return;
    // The next band of this store takes it as it is; fresh pages would have to be faulted in and cleared.
    if (reuse) spare_.push_back(std::move(slab.memory));
    slab.memory.reset();
}

Plane Bands::plane(int band, std::size_t plane) const {
    const Rect r = rect(band);
    if (is_resident()) return {resident_[plane].at(r.x0, r.y0), resident_[plane].stride, types_[plane], r};
    const auto stride = static_cast<std::ptrdiff_t>(sample_size(types_[plane])) * r.width();
    return {memory(band) + plane_offset(plane), stride, types_[plane], r};
}

std::optional<MutView> Bands::view(std::size_t plane, const Rect& region, const Rect& window) const {
    if (!is_resident() || types_[plane] != SampleType::kFloat) return {};
    const Plane& p = resident_[plane];
    return MutView{reinterpret_cast<float*>(p.at(region.x0, region.y0)),
                   p.stride / static_cast<std::ptrdiff_t>(sizeof(float)), region, window};
}

void Bands::load(std::size_t plane, const MutView& out) const {
    const auto n = static_cast<std::size_t>(out.rect.width());
    for (int y = out.rect.y0; y < out.rect.y1; ++y) {
        const std::byte* in = this->plane(band_of(y), plane).at(out.rect.x0, y);
        switch (types_[plane]) {
            case SampleType::kHalf:
                simd::half_to_float(reinterpret_cast<const uint16_t*>(in), out.row(y), n);
                break;
            case SampleType::kFloat:
            case SampleType::kUint: std::memcpy(out.row(y), in, n * sizeof(float)); break;
        }
    }
}

// Past the caches: whoever owns the picture looks at it when the frame is done.
void Bands::store_resident(std::size_t plane, const View& in) {
    const Plane& p = resident_[plane];
    for (int y = in.rect.y0; y < in.rect.y1; ++y)
        simd::stream_row(in.row(y), reinterpret_cast<float*>(p.at(in.rect.x0, y)), in.rect.width());
    simd::finish_stream();
}

std::size_t Bands::store(std::size_t plane, const View& in) {
    if (is_resident() && types_[plane] == SampleType::kFloat) {
        store_resident(plane, in);
        return 0;
    }
    const auto n = static_cast<std::size_t>(in.rect.width());
    std::size_t overflowed = 0;
    for (int y = in.rect.y0; y < in.rect.y1; ++y) {
        std::byte* out = this->plane(band_of(y), plane).at(in.rect.x0, y);
        switch (types_[plane]) {
            case SampleType::kHalf:
                overflowed += simd::float_to_half(in.row(y), reinterpret_cast<uint16_t*>(out), n);
                break;
            case SampleType::kFloat:
            case SampleType::kUint: std::memcpy(out, in.row(y), n * sizeof(float)); break;
        }
    }
    return overflowed;
}

// What no node has touched goes from file to file as it is: to make floats of halves
// and halves of them again is two passes for nothing.
void Bands::copy(std::size_t plane, const Bands& from, std::size_t from_plane, const Rect& region) {
    if (types_[plane] != from.types_[from_plane]) return convert(plane, from, from_plane, region);
    const std::size_t bytes = sample_size(types_[plane]) * static_cast<std::size_t>(region.width());
    for (int y = region.y0; y < region.y1; ++y)
        std::memcpy(this->plane(band_of(y), plane).at(region.x0, y),
                    from.plane(from.band_of(y), from_plane).at(region.x0, y), bytes);
}

void Bands::convert(std::size_t plane, const Bands& from, std::size_t from_plane, const Rect& region) {
    std::vector<float> floats(static_cast<std::size_t>(region.width()));
    for (int y = region.y0; y < region.y1; ++y) {
        const MutView row{floats.data(), region.width(), {region.x0, y, region.x1, y + 1}, region};
        from.load(from_plane, row);
        store(plane, row);
    }
}

}  // namespace keyline
