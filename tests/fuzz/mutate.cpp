// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/mutate.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

namespace keyline {

namespace {

template <class T>
T get(const Bytes& bytes, std::size_t offset) {
    T value{};
    if (offset + sizeof value <= bytes.size()) std::memcpy(&value, bytes.data() + offset, sizeof value);
    return value;
}

template <class T>
void put(Bytes& bytes, std::size_t offset, T value) {
    if (offset + sizeof value <= bytes.size()) std::memcpy(bytes.data() + offset, &value, sizeof value);
}

// The end of one part's attributes, or of the empty name that ends them all.
std::size_t end_of_attributes(const Bytes& bytes, std::size_t at) {
    const auto end_of_text = [&](std::size_t i) {
        return static_cast<std::size_t>(
                   std::find(bytes.begin() + static_cast<std::ptrdiff_t>(i), bytes.end(), std::byte{0}) -
                   bytes.begin()) +
               1;
    };
    while (at < bytes.size() && bytes[at] != std::byte{0}) {
        at = end_of_text(end_of_text(at));
        at += 4 + get<uint32_t>(bytes, at);
    }
    return at + 1;
}

std::size_t below(std::size_t n, Random& random) {
    return n == 0 ? 0 : static_cast<std::size_t>(random() % n);
}

constexpr std::array<int64_t, 18> kExtremes = {0,
                                               1,
                                               -1,
                                               2,
                                               16,
                                               255,
                                               256,
                                               65535,
                                               65536,
                                               1 << 24,
                                               1 << 29,
                                               1 << 30,
                                               0x7FFFFFFF,
                                               -0x80000000LL,
                                               0x7FFFFFFF0LL,
                                               1LL << 40,
                                               -(1LL << 40),
                                               0x7FFFFFFFFFFFFFFFLL};

int64_t extreme(Random& random) {
    const int64_t value = kExtremes[below(kExtremes.size(), random)];
    if (random() % 4 != 0) return value;
    return static_cast<int64_t>(static_cast<uint64_t>(value) + random() % 9 - 4);  // around the largest too
}

uint32_t big_endian(uint32_t v) { return v << 24U | (v & 0xFF00U) << 8U | (v >> 8U & 0xFF00U) | v >> 24U; }

void flip_bits(Bytes& bytes, std::size_t from, std::size_t to, Random& random) {
    for (std::size_t n = 1 + below(8, random); n > 0 && from < to; --n)
        bytes[from + below(to - from, random)] ^= std::byte{1} << (random() % 8);
}

// A part of the file moved to, or doubled at, another place; or of another file.
void splice(Bytes& bytes, const Bytes& from, Random& random) {
    if (from.empty() || bytes.empty()) return;
    const std::size_t begin = below(from.size(), random);
    const std::size_t n = std::min(1 + below(200, random), from.size() - begin);
    const Bytes piece(from.begin() + static_cast<std::ptrdiff_t>(begin),
                      from.begin() + static_cast<std::ptrdiff_t>(begin + n));
    const auto place = bytes.begin() + static_cast<std::ptrdiff_t>(below(bytes.size(), random));
    if (random() % 2 == 0)
        bytes.insert(place, piece.begin(), piece.end());
    else
        std::copy_n(piece.begin(), std::min<std::ptrdiff_t>(std::ssize(piece), bytes.end() - place), place);
}

void edit_offset_table(Bytes& bytes, const Victim& victim, Random& random) {
    if (victim.chunks.empty()) return;
    const auto entry = [&] { return victim.header_end + 8 * below(victim.chunks.size(), random); };
    const std::size_t at = entry();
    switch (random() % 4) {
        case 0: put(bytes, at, extreme(random)); break;
        case 1: put(bytes, at, get<uint64_t>(bytes, entry())); break;
        case 2: put(bytes, at, get<uint64_t>(bytes, at) + random() % 64); break;
        default: put(bytes, at, static_cast<uint64_t>(below(bytes.size(), random))); break;
    }
}

void edit_leader(Bytes& bytes, const Victim& victim, Random& random) {
    if (victim.chunks.empty()) return;
    const std::size_t at = victim.chunks[below(victim.chunks.size(), random)] + 4 * below(6, random);
    const int64_t value = random() % 2 == 0
                              ? extreme(random)
                              : get<int32_t>(bytes, at) + static_cast<int64_t>(random() % 17) - 8;
    put(bytes, at, static_cast<int32_t>(value));
}

void damage(Bytes& bytes, const Victim& victim, const Victim& other, Random& random) {
    const std::size_t header = std::min(victim.header_end, bytes.size());
    switch (random() % 12) {
        case 0: flip_bits(bytes, 0, bytes.size(), random); break;
        case 1: flip_bits(bytes, 0, header, random); break;
        case 2: flip_bits(bytes, header, bytes.size(), random); break;
        case 3: bytes.resize(below(bytes.size(), random)); break;
        case 4: put(bytes, below(header, random), static_cast<int32_t>(extreme(random))); break;
        case 5:
            put(bytes, header + below(bytes.size() - header, random), static_cast<int32_t>(extreme(random)));
            break;
        case 6: edit_offset_table(bytes, victim, random); break;
        case 7: edit_leader(bytes, victim, random); break;
        case 8: splice(bytes, Bytes(bytes), random); break;
        case 9: put(bytes, below(header, random), static_cast<int16_t>(extreme(random))); break;
        case 10: put(bytes, below(header, random), big_endian(static_cast<uint32_t>(extreme(random)))); break;
        default: splice(bytes, other.bytes, random); break;
    }
}

}  // namespace

Victim make_victim(std::string name, Bytes bytes) {
    Victim victim{std::move(name), std::move(bytes), 8, {}};
    const bool multipart = (get<uint32_t>(victim.bytes, 4) & 0x1000U) != 0;
    do victim.header_end = end_of_attributes(victim.bytes, victim.header_end);
    while (multipart && victim.bytes.at(victim.header_end) != std::byte{0});
    if (multipart) ++victim.header_end;
    // The first chunk follows the table.
    for (std::size_t at = victim.header_end; at + 8 <= victim.bytes.size(); at += 8) {
        const auto offset = get<uint64_t>(victim.bytes, at);
        if (!victim.chunks.empty() && at >= victim.chunks.front()) break;
        victim.chunks.push_back(offset);
    }
    return victim;
}

Bytes damaged(const Victim& victim, const Victim& other, Random& random) {
    Bytes bytes = victim.bytes;
    for (std::size_t n = 1 + below(3, random); n > 0; --n) damage(bytes, victim, other, random);
    return bytes;
}

}  // namespace keyline
