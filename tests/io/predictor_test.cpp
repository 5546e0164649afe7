// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/simd/predictor.h"

#include "tests/io/simd_targets.h"

#include <cstdint>
#include <vector>

namespace keyline {
namespace {

std::vector<std::byte> noise(std::size_t n) {
    std::vector<std::byte> bytes(n);
    uint32_t state = 12345;
    for (std::byte& byte : bytes) {
        state = state * 1664525U + 1013904223U;
        byte = static_cast<std::byte>(state >> 24);
    }
    return bytes;
}

// As the OpenEXR file format describes it.
std::vector<std::byte> reference(const std::vector<std::byte>& samples) {
    std::vector<std::byte> split;
    for (std::size_t i = 0; i < samples.size(); i += 2) split.push_back(samples[i]);
    for (std::size_t i = 1; i < samples.size(); i += 2) split.push_back(samples[i]);
    std::vector<std::byte> packed = split;
    for (std::size_t i = 1; i < split.size(); ++i)
        packed[i] = static_cast<std::byte>(static_cast<int>(split[i]) - static_cast<int>(split[i - 1]) + 128);
    return packed;
}

class Predictor : public testing::TestWithParam<std::size_t> {};

TEST_P(Predictor, PacksAsTheFormatSays) {
    const std::vector<std::byte> samples = noise(2 * GetParam());
    std::vector<std::byte> packed(samples.size());
    simd::split_and_difference(samples.data(), packed.data(), GetParam());
    EXPECT_EQ(packed, reference(samples));
}

TEST_P(Predictor, ComesBackTheSameOnEveryTarget) {
    const std::size_t pairs = GetParam();
    const std::vector<std::byte> samples = noise(2 * pairs);
    on_every_target([&] {
        std::vector<std::byte> block = reference(samples);
        simd::undo_difference(block.data(), block.size());
        std::vector<std::byte> joined(samples.size());
        simd::join_bytes(block.data(), block.data() + pairs, joined.data(), pairs);
        EXPECT_EQ(joined, samples);
    });
}

TEST_P(Predictor, JoinsARunFromTheMiddle) {
    const std::size_t pairs = GetParam() + 1;
    const std::vector<std::byte> samples = noise(2 * pairs);
    std::vector<std::byte> block = reference(samples);
    simd::undo_difference(block.data(), block.size());
    std::vector<std::byte> joined(2 * (pairs - 1));
    simd::join_bytes(block.data() + 1, block.data() + pairs + 1, joined.data(), pairs - 1);
    EXPECT_EQ(joined, std::vector<std::byte>(samples.begin() + 2, samples.end()));
}

INSTANTIATE_TEST_SUITE_P(Lengths, Predictor,
                         testing::Values(0, 1, 2, 7, 8, 9, 15, 16, 17, 31, 33, 64, 100, 1000, 4097));

}  // namespace
}  // namespace keyline
