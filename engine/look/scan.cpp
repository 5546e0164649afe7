// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/look/scan.h"

#include "engine/simd/half.h"

#include <cstring>

namespace keyline {

namespace {

// Samples of one chunk, a plane a wanted channel.
class ChunkBuffer {
public:
    std::span<const Plane> planes(const ChannelGroup& group, const std::vector<bool>& wanted,
                                  const Rect& rect) {
        planes_.assign(group.channels.size(), {});
        samples_.resize(group.channels.size());
        for (std::size_t c = 0; c < planes_.size(); ++c) {
            const SampleType type = group.channels[c].type;
            planes_[c].type = type;
            if (!wanted[c]) continue;
            samples_[c].resize(static_cast<std::size_t>(rect.area()) * sample_size(type));
            planes_[c] = {samples_[c].data(), static_cast<std::ptrdiff_t>(sample_size(type)) * rect.width(),
                          type, rect};
        }
        return planes_;
    }

private:
    std::vector<std::vector<std::byte>> samples_;
    std::vector<Plane> planes_;
};

template <class T>
std::span<const T> copied(const Plane& plane, int y, std::vector<T>& buffer) {
    buffer.resize(static_cast<std::size_t>(plane.rect.width()));
    std::memcpy(buffer.data(), plane.at(plane.rect.x0, y), buffer.size() * sizeof(T));
    return buffer;
}

template <class T>
void widen(const Plane& plane, int y, std::vector<double>& out) {
    std::vector<T> row;
    copied(plane, y, row);
    out.assign(row.begin(), row.end());
}

void widen_halves(const Plane& plane, int y, std::vector<double>& out) {
    std::vector<uint16_t> row;
    copied(plane, y, row);
    std::vector<float> floats(row.size());
    simd::half_to_float(row.data(), floats.data(), row.size());
    out.assign(floats.begin(), floats.end());
}

}  // namespace

void scan(const ImageSource& source, std::size_t group, const std::vector<bool>& wanted, const Rect& region,
          const std::function<void(const ScannedChunk&)>& visit) {
    const ChannelGroup& g = source.header().groups[group];
    ChunkBuffer buffer;
    for (int row = 0; row < g.rows(); ++row)
        for (int column = 0; column < g.columns(); ++column) {
            const Rect rect = intersect(g.chunk(column, row), region);
            if (rect.empty()) continue;
            const std::span<const Plane> planes = buffer.planes(g, wanted, rect);
            source.read_chunk(group, column, row, planes);
            visit({rect, planes});
        }
}

std::span<const double> row_of(const Plane& plane, int y, std::vector<double>& buffer) {
    switch (plane.type) {
        case SampleType::kHalf: widen_halves(plane, y, buffer); break;
        case SampleType::kFloat: widen<float>(plane, y, buffer); break;
        case SampleType::kUint: widen<uint32_t>(plane, y, buffer); break;
    }
    return buffer;
}

std::span<const uint32_t> bits_of(const Plane& plane, int y, std::vector<uint32_t>& buffer) {
    return copied(plane, y, buffer);
}

}  // namespace keyline
