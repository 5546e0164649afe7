// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/geometry.h"
#include "engine/base/image.h"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <vector>

// What the OpenEXR file format fixes, shared by reader, writer and helper process.

namespace keyline::exr {

static_assert(std::endian::native == std::endian::little, "OpenEXR files are little-endian");

inline constexpr std::array<std::byte, 4> kMagic = {std::byte{0x76}, std::byte{0x2f}, std::byte{0x31},
                                                    std::byte{0x01}};

// Bits of the version field, above the version number.
inline constexpr uint32_t kVersion = 2, kTiledFlag = 0x200, kLongNamesFlag = 0x400, kDeepFlag = 0x800,
                          kMultipartFlag = 0x1000;
inline constexpr std::size_t kLongestShortName = 31, kLongestName = 255;

enum class Compression : uint8_t { kNone, kRle, kZips, kZip, kPiz, kPxr24, kB44, kB44a, kDwaa, kDwab };

struct CompressionInfo {
    const char* name;
    int rows;      // in a chunk of a scanline part
    double ratio;  // no chunk of at least a few hundred bytes unpacks to more than this many times its size
};

// The ratios: a run of 128 bytes takes RLE 2; deflate reaches 1032 (258 bytes in 2 bits); PXR24 drops a byte
// of four first; PIZ's Huffman code takes 10 bits for 256 samples; B44A takes 3 bytes for 16 samples, and B44
// leaves what is not half as it is; DWA codes a block of 64 floats as one half, which it deflates.
inline constexpr std::array<CompressionInfo, 10> kCompressions = {{{"none", 1, 1},
                                                                   {"rle", 1, 64},
                                                                   {"zips", 1, 1032},
                                                                   {"zip", 16, 1032},
                                                                   {"piz", 32, 512},
                                                                   {"pxr24", 16, 1376},
                                                                   {"b44", 32, 11},
                                                                   {"b44a", 32, 11},
                                                                   {"dwaa", 32, 132096},
                                                                   {"dwab", 256, 132096}}};

constexpr const CompressionInfo& info(Compression c) { return kCompressions[static_cast<std::size_t>(c)]; }

// How the samples of a chunk lie once it is unpacked: row by row, in a row channel by channel.
class BlockLayout {
public:
    // `types`: of the channels, in the file's order.
    explicit BlockLayout(std::span<const SampleType> types) {
        for (const SampleType type : types) {
            before_.push_back(pixel_bytes_);
            pixel_bytes_ += sample_size(type);
        }
    }

    std::size_t pixel_bytes() const { return pixel_bytes_; }
    std::size_t bytes(const Rect& block) const {
        return static_cast<std::size_t>(block.area()) * pixel_bytes_;
    }

    // Where the samples of `channel` in row `y` of a block begin.
    std::size_t offset(const Rect& block, std::size_t channel, int y) const {
        const auto width = static_cast<std::size_t>(block.width());
        return (static_cast<std::size_t>(y - block.y0) * pixel_bytes_ + before_[channel]) * width;
    }

private:
    std::vector<std::size_t> before_;  // bytes of a pixel that come before a channel's
    std::size_t pixel_bytes_ = 0;
};

// Plain values as the file holds them.
template <class T>
T get(std::span<const std::byte> bytes, std::size_t offset = 0) {
    T value;
    std::memcpy(&value, bytes.subspan(offset).first(sizeof value).data(), sizeof value);
    return value;
}

template <class T>
void append(std::vector<std::byte>& out, T value) {
    const std::size_t at = out.size();
    out.resize(at + sizeof value);
    std::memcpy(out.data() + at, &value, sizeof value);
}

inline void append(std::vector<std::byte>& out, const std::string& text) {
    const auto* bytes = reinterpret_cast<const std::byte*>(text.data());
    out.insert(out.end(), bytes, bytes + text.size());
}

}  // namespace keyline::exr
