// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/io/oiio/helper/png.h"

#include "engine/base/error.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <fmt/format.h>
#include <fstream>
#include <libdeflate.h>
#include <string>
#include <string_view>
#include <vector>

namespace keyline::oiio {

namespace {

constexpr std::uint32_t kLongest = 0x7fffffff;
constexpr std::size_t kSignature = 8, kBlock = std::size_t{1} << 16;

// A chunk is its length, four letters, as many bytes, and the checksum of letters and bytes.
class ChunkReader {
public:
    explicit ChunkReader(const std::filesystem::path& file)
        : name_(file.string()), in_(file, std::ios::binary), block_(kBlock) {
        in_.seekg(kSignature);
    }

    // Whether there is another one to check: not after the last, nor where one of the letters `end` begins.
    bool check_chunk(std::string_view end) {
        const std::uint32_t length = number();
        take(4);
        const std::string letters(block_.data(), 4);
        if (length > kLongest)
            fail(ErrorKind::kInput, fmt::format("{}: damaged: a chunk of {} bytes", name_, length));
        if (letters == end) return false;
        std::uint32_t sum = libdeflate_crc32(0, block_.data(), 4);
        for (std::uint64_t left = length; left > 0;) {
            const std::size_t n = std::min<std::uint64_t>(left, block_.size());
            take(n);
            sum = libdeflate_crc32(sum, block_.data(), n);
            left -= n;
        }
        if (number() != sum)
            fail(ErrorKind::kInput, fmt::format("{}: damaged: a checksum before byte {} is wrong", name_,
                                                std::int64_t{in_.tellg()}));
        return letters != "IEND";
    }

private:
    void take(std::size_t n) {
        if (!in_.read(block_.data(), static_cast<std::streamsize>(n)))
            fail(ErrorKind::kInput, fmt::format("{}: damaged: the file ends too early", name_));
    }

    std::uint32_t number() {
        take(4);
        std::uint32_t value = 0;
        for (std::size_t i = 0; i < 4; ++i) value = value << 8U | static_cast<unsigned char>(block_[i]);
        return value;
    }

    std::string name_;
    std::ifstream in_;
    std::vector<char> block_;
};

}  // namespace

void check_png(const std::filesystem::path& file, PngPart part) {
    const std::string_view end = part == PngPart::kHeader ? "IDAT" : "";
    ChunkReader reader(file);
    while (reader.check_chunk(end)) {
    }
}

}  // namespace keyline::oiio
