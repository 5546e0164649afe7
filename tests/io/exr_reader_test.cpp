// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/error.h"
#include "tests/io/exr_files.h"

#include <array>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tuple>

namespace keyline {
namespace {

using testing::Combine;
using testing::HasSubstr;
using testing::Values;

std::vector<TestChannel> channels_of(const std::string& types) {
    if (types == "half") return {{"R"}, {"G"}, {"B"}, {"A"}, {"deep.layer.X"}};
    if (types == "float") return {{"R", SampleType::kFloat}, {"Z", SampleType::kFloat}};
    if (types == "uint") return {{"id", SampleType::kUint}, {"n.id", SampleType::kUint}};
    return {{"A"}, {"Z", SampleType::kFloat}, {"id", SampleType::kUint}, {"R"}, {"u", SampleType::kFloat}};
}

constexpr auto kCompressionNames = {"none",  "rle", "zips", "zip",  "piz",
                                    "pxr24", "b44", "b44a", "dwaa", "dwab"};

class EveryKind : public testing::TestWithParam<std::tuple<const char*, const char*, TestStorage>> {};

// The library's own decoding is the reference, for what is lossy as well.
TEST_P(EveryKind, DecodesAsTheLibraryDoes) {
    const TemporaryFolder folder;
    TestPart part;
    part.compression = std::get<0>(GetParam());
    part.channels = channels_of(std::get<1>(GetParam()));
    part.storage = std::get<2>(GetParam());
    part.data = {-13, 7, 180, 300};
    part.display = {0, 0, 200, 310};
    write_with_openexr(folder / "a.exr", {part});
    EXPECT_EQ(read_with_keyline(folder / "a.exr"), read_with_openexr(folder / "a.exr"));
}

std::string kind_name(const testing::TestParamInfo<EveryKind::ParamType>& kind) {
    static constexpr std::array kStorages = {"Scanline", "Tiled", "Mipmap", "Ripmap"};
    return fmt::format("{}_{}_{}", std::get<0>(kind.param), std::get<1>(kind.param),
                       kStorages.at(static_cast<std::size_t>(std::get<2>(kind.param))));
}

INSTANTIATE_TEST_SUITE_P(
    Exr, EveryKind,
    Combine(testing::ValuesIn(kCompressionNames), Values("half", "float", "uint", "mixed"),
            Values(TestStorage::kScanline, TestStorage::kTiled, TestStorage::kMipmap, TestStorage::kRipmap)),
    kind_name);

}  // namespace
}  // namespace keyline
