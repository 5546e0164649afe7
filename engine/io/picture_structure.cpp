// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/io/picture_structure.h"

#include "engine/base/error.h"
#include "engine/io/exr/file.h"
#include "engine/io/output_format.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <span>
#include <string_view>
#include <vector>

namespace keyline {

namespace {

using exr::InputFile;

constexpr std::array<unsigned char, 8> kPng = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};

// Numbers of a file, in its order of bytes; what lies behind its end throws Failure (kInput).
class Bytes {
public:
    Bytes(const InputFile& file, bool big_endian) : file_(file), big_endian_(big_endian) {}

    uint64_t number(uint64_t at, std::size_t n) const {
        std::array<std::byte, 8> bytes = {};
        file_.read(at, std::span(bytes).first(n));
        uint64_t out = 0;
        for (std::size_t i = 0; i < n; ++i)
            out = out << 8U | std::to_integer<uint64_t>(bytes[big_endian_ ? i : n - 1 - i]);
        return out;
    }
    uint64_t size() const { return file_.size(); }

private:
    const InputFile& file_;
    const bool big_endian_;
};

constexpr uint64_t tag(std::string_view four) {
    uint64_t out = 0;
    for (const char c : four) out = out << 8U | static_cast<unsigned char>(c);
    return out;
}

// A chain of chunks from IHDR to IEND, which is the file's end; pixels in between.
std::optional<PictureSize> whole_png(const InputFile& file) {
    const Bytes bytes(file, true);
    PictureSize size;
    bool has_pixels = false;
    for (std::size_t i = 0; i < kPng.size(); ++i)
        if (bytes.number(i, 1) != kPng[i]) return std::nullopt;
    for (uint64_t at = kPng.size();;) {
        const uint64_t length = bytes.number(at, 4), type = bytes.number(at + 4, 4);
        if (type == tag("IHDR")) {
            constexpr std::array<uint64_t, 7> kChannels = {1, 0, 3, 1, 2, 0, 4};  // by colour type
            const uint64_t color = bytes.number(at + 17, 1);
            size = {bytes.number(at + 8, 4), bytes.number(at + 12, 4),
                    color < kChannels.size() ? kChannels[color] : 0};
        }
        has_pixels = has_pixels || type == tag("IDAT");
        at += length + 12;
        if (at > bytes.size() || length > bytes.size()) return std::nullopt;
        if (type == tag("IEND")) {
            constexpr uint64_t kSum = 0xAE426082;
            const bool whole = has_pixels && at == bytes.size() && bytes.number(at - 4, 4) == kSum;
            return whole ? std::optional(size) : std::nullopt;
        }
        if (type == 0) return std::nullopt;
    }
}

// Segments up to the first scan, and the mark of the end as the file's last bytes.
std::optional<PictureSize> whole_jpeg(const InputFile& file) {
    const Bytes bytes(file, true);
    if (bytes.number(0, 2) != 0xFFD8 || bytes.number(bytes.size() - 2, 2) != 0xFFD9) return std::nullopt;
    std::optional<PictureSize> size;
    for (uint64_t at = 2;;) {
        const uint64_t marker = bytes.number(at, 2);
        if (marker < 0xFFC0) return std::nullopt;
        if (marker == 0xFFDA) return size;
        const bool is_frame = marker <= 0xFFCF && marker != 0xFFC4 && marker != 0xFFC8 && marker != 0xFFCC;
        if (is_frame) size = {bytes.number(at + 7, 2), bytes.number(at + 5, 2), bytes.number(at + 9, 1)};
        at += 2 + bytes.number(at + 2, 2);
    }
}

// The first directory of a TIFF file: values by tag.
class TiffDirectory {
public:
    static constexpr uint64_t kWidth = 256, kHeight = 257, kStrips = 273, kChannels = 277, kStripBytes = 279,
                              kTiles = 324, kTileBytes = 325;

    TiffDirectory(const Bytes& bytes, bool is_big) : bytes_(bytes), is_big_(is_big) {
        const uint64_t start = bytes.number(is_big ? 8 : 4, is_big ? 8 : 4), count_size = is_big ? 8 : 2;
        const uint64_t count = std::min<uint64_t>(bytes.number(start, count_size), kMostEntries);
        for (uint64_t i = 0; i < count; ++i) {
            const uint64_t entry = start + count_size + i * (is_big ? 20 : 12);
            entries_[bytes.number(entry, 2)] = entry;
        }
    }

    // Whether all that the entries refer to lies in the file.
    bool is_whole() const {
        for (const auto& [name, entry] : entries_) {
            const uint64_t count = bytes_.number(entry + 4, is_big_ ? 8 : 4);
            if (count > bytes_.size()) return false;
            const uint64_t length = count * size_of_type(bytes_.number(entry + 2, 2));
            const uint64_t field = is_big_ ? 8 : 4;
            if (length > field && bytes_.number(entry + 4 + field, field) + length > bytes_.size())
                return false;
        }
        return true;
    }

    bool has(uint64_t name) const { return entries_.contains(name); }

    // None where the entry is not there, or lies outside the file.
    std::vector<uint64_t> values(uint64_t name) const {
        const auto found = entries_.find(name);
        if (found == entries_.end()) return {};
        const std::size_t size = size_of_type(bytes_.number(found->second + 2, 2)), field = is_big_ ? 8 : 4;
        const uint64_t count = bytes_.number(found->second + 4, field);
        if (size == 0 || count > bytes_.size() / size) return {};
        uint64_t at = found->second + 4 + field;
        if (count * size > field) at = bytes_.number(at, field);
        std::vector<uint64_t> out;
        for (uint64_t i = 0; i < count; ++i) out.push_back(bytes_.number(at + i * size, size));
        return out;
    }

    uint64_t value(uint64_t name, uint64_t otherwise) const {
        const std::vector<uint64_t> all = values(name);
        return all.empty() ? otherwise : all.front();
    }

private:
    static constexpr uint64_t kMostEntries = 4096;

    static std::size_t size_of_type(uint64_t type) {
        constexpr std::array<std::size_t, 17> kSizes = {0, 1, 1, 2, 4, 8, 1, 1, 2, 4, 8, 4, 8, 0, 0, 0, 8};
        return type < kSizes.size() ? kSizes[type] : 0;
    }

    const Bytes& bytes_;
    bool is_big_;
    std::map<uint64_t, uint64_t> entries_;  // tag → where it stands
};

// Every strip or tile lies inside the file.
std::optional<PictureSize> whole_tiff(const InputFile& file) {
    const uint64_t order = Bytes(file, true).number(0, 2);
    const Bytes bytes(file, order == 0x4D4D);
    const uint64_t version = bytes.number(2, 2);
    if ((order != 0x4D4D && order != 0x4949) || (version != 42 && version != 43)) return std::nullopt;
    const TiffDirectory directory(bytes, version == 43);
    if (!directory.is_whole()) return std::nullopt;
    const bool tiled = directory.has(TiffDirectory::kTiles);
    const auto offsets = directory.values(tiled ? TiffDirectory::kTiles : TiffDirectory::kStrips);
    const auto sizes = directory.values(tiled ? TiffDirectory::kTileBytes : TiffDirectory::kStripBytes);
    if (offsets.empty() || offsets.size() != sizes.size()) return std::nullopt;
    for (std::size_t i = 0; i < offsets.size(); ++i)
        if (offsets[i] == 0 || sizes[i] == 0 || sizes[i] > bytes.size() ||
            offsets[i] > bytes.size() - sizes[i])
            return std::nullopt;
    return PictureSize{directory.value(TiffDirectory::kWidth, 0), directory.value(TiffDirectory::kHeight, 0),
                       directory.value(TiffDirectory::kChannels, 1)};
}

using Structure = std::optional<PictureSize> (*)(const InputFile&);

Structure structure_of(const std::filesystem::path& file) {
    const std::string extension = extension_of(file);
    if (extension == "png") return whole_png;
    if (extension == "jpg" || extension == "jpeg") return whole_jpeg;
    if (extension == "tif" || extension == "tiff") return whole_tiff;
    return nullptr;
}

}  // namespace

bool has_known_structure(const std::filesystem::path& file) { return structure_of(file) != nullptr; }

std::optional<PictureSize> size_of_whole_picture(const std::filesystem::path& file) {
    try {
        return structure_of(file)(InputFile(file));
    } catch (const Failure&) {  // not there, or it ends before its structure does
        return std::nullopt;
    }
}

}  // namespace keyline
