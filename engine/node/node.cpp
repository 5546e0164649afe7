// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/node/node.h"

#include <algorithm>

namespace keyline {

namespace {

constexpr std::size_t kLeastBlock = std::size_t{64} << 10;

// Whether an operation makes nothing of nothing: it is asked for the one pixel of a picture that is 0.
bool keeps_zero(const Operation& operation, std::span<const Link> links, std::size_t outputs) {
    constexpr Rect kPixel{0, 0, 1, 1};
    constexpr std::size_t kRoom = 64;  // for whole vectors, and for those that hold the pixel's neighbours
    const std::vector<float> zeros(kRoom, 0.0F);
    std::vector<View> views;
    std::vector<Inputs::Range> slots;
    for (const Link& link : links) {
        slots.push_back({views.size(), link.values.size()});
        views.resize(views.size() + link.values.size(), {zeros.data(), 0, kPixel, kPixel});
    }
    std::vector<float> samples(outputs * kRoom, 0.0F);
    std::vector<MutView> out;
    for (std::size_t i = 0; i < outputs; ++i) out.push_back({samples.data() + i * kRoom, 0, kPixel, kPixel});
    Scratch scratch;
    const std::vector<const Datum*> no_data(links.size(), nullptr);
    operation.compute(Inputs(views, slots, no_data), out, scratch);
    return std::ranges::all_of(out, [](const MutView& v) { return *v.data == 0; });
}

}  // namespace

Rect result_window(const Operation& operation, std::span<const Link> links, std::size_t outputs) {
    Rect window, extent;
    bool has_data = false;
    for (const Link& link : links) {
        has_data = has_data || link.datum.op >= 0;
        if (link.values.empty() && link.datum.op < 0) continue;
        window = unite(window, intersect(grow(link.window, operation.halo()), link.extent));
        extent = unite(extent, link.extent);
    }
    if (!operation.point()) {
        extent = links.front().extent;
        window = intersect(window, extent);
    }
    return has_data || !keeps_zero(operation, links, outputs) ? extent : window;
}

void* Scratch::allocate(std::size_t bytes) {
    bytes = (bytes + kCacheLine - 1) / kCacheLine * kCacheLine;
    while (block_ < blocks_.size() && used_ + bytes > blocks_[block_].size) {
        ++block_;
        used_ = 0;
    }
    if (block_ == blocks_.size()) {
        const std::size_t size = std::max(bytes, kLeastBlock);
        blocks_.push_back({make_aligned<std::byte>(size), size});
    }
    void* p = blocks_[block_].memory.get() + used_;
    used_ += bytes;
    return p;
}

void Scratch::reset() {
    used_ = 0, block_ = 0;
    if (blocks_.size() < 2) return;
    const std::size_t size = bytes();
    blocks_.clear();  // first, so that old and new never stand beside each other
    blocks_.push_back({make_aligned<std::byte>(size), size});
}

std::size_t Scratch::bytes() const {
    std::size_t sum = 0;
    for (const Block& b : blocks_) sum += b.size;
    return sum;
}

Stream Builder::add_source(std::shared_ptr<const Derivation> source) {
    Stream stream;
    stream.data = source->gives();
    stream.file = source->file();
    stream.datum = add(std::move(source), {});
    return stream;
}

}  // namespace keyline
