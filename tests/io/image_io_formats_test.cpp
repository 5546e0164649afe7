// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/base/error.h"
#include "image_io_support.h"

#include <cmath>
#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace keyline::test {
namespace {

// Every format that is written, with each of its depths and channel sets.
struct Case {
    std::string extension;
    Depth depth;
    std::vector<std::string> channels;
    double step;  // half of it may be lost
    std::string compression = "zip";
};

std::vector<std::string> letters(const std::string& word) {
    std::vector<std::string> out;
    for (const char c : word) out.emplace_back(1, c);
    return out;
}

std::vector<Case> cases() {
    std::vector<Case> all;
    const auto add = [&](const std::string& extension, Depth depth, const std::vector<std::string>& sets,
                         double step, const std::string& compression = "zip") {
        for (const std::string& set : sets)
            all.push_back({extension, depth, letters(set), step, compression});
    };
    constexpr double k8 = 1.0 / 255, k16 = 1.0 / 65535, kLossy = 0.06;
    add("png", Depth::kUint8, {"Y", "YA", "RGB", "RGBA"}, k8);
    add("png", Depth::kUint16, {"Y", "YA", "RGB", "RGBA"}, k16);
    for (const char* compression : {"zip", "lzw", "packbits", "none"}) {
        add("tif", Depth::kUint8, {"Y", "YA", "RGB", "RGBA", "RGBAUV"}, k8, compression);
        add("tif", Depth::kUint16, {"Y", "RGB", "RGBA"}, k16, compression);
        add("tif", Depth::kFloat, {"Y", "YA", "RGB", "RGBA", "RGBZ"}, 0, compression);
    }
    add("jpg", Depth::kUint8, {"Y", "RGB"}, kLossy);
    add("jpg", Depth::kUint8, {"Y", "RGB"}, kLossy, "jpeg:90");
    add("bmp", Depth::kUint8, {"Y", "RGB", "RGBA"}, k8);
    add("dpx", Depth::kUint8, {"Y", "RGB", "RGBA"}, k8);
    add("dpx", Depth::kUint16, {"Y", "RGB", "RGBA"}, k16);
    add("dpx", Depth::kFloat, {"Y", "RGB", "RGBA"}, 0);
    add("fits", Depth::kUint8, {"Y"}, k8);
    add("fits", Depth::kFloat, {"Y"}, 0);
    add("hdr", Depth::kFloat, {"RGB"}, 1.0 / 128);
    add("iff", Depth::kUint8, {"RGB", "RGBA"}, k8);
    add("iff", Depth::kUint8, {"RGB", "RGBA"}, k8, "rle");
    add("jp2", Depth::kUint8, {"Y", "RGB", "RGBA"}, kLossy);
    add("jp2", Depth::kUint16, {"Y", "RGB", "RGBA"}, kLossy);
    add("ppm", Depth::kUint8, {"Y", "RGB"}, k8);
    add("rla", Depth::kFloat, {"RGB", "RGBA"}, 0);
    add("sgi", Depth::kUint8, {"Y", "RGB", "RGBA"}, k8);
    add("sgi", Depth::kUint16, {"Y", "RGB", "RGBA"}, k16);
    add("tga", Depth::kUint8, {"Y", "RGB", "RGBA"}, k8);
    add("tga", Depth::kUint8, {"Y", "RGB", "RGBA"}, k8, "none");
    add("webp", Depth::kUint8, {"RGB"}, kLossy);
    add("webp", Depth::kUint8, {"RGB"}, kLossy, "webp:95");
    add("zfile", Depth::kFloat, {"Y"}, 0);
    return all;
}

class ImageIoFormat : public ::testing::TestWithParam<Case> {};

// Premultiplied colour whose alpha is nowhere 0 and nowhere below the colour.
Pixels colour(const std::vector<std::string>& names) {
    Pixels pixels = ramp(97, 71, names);
    for (std::size_t c = 0; c < names.size(); ++c)
        if (names[c] == "A")
            for (float& a : pixels.channels[c]) a = 1 - a / 8;
    return pixels;
}

TEST_P(ImageIoFormat, ReadsBackWhatItWrote) {
    const Case& c = GetParam();
    const Folder folder;
    const auto file = folder / ("a." + c.extension);
    const Pixels in = colour(c.channels);
    write(file, in, spec_for(in, c.depth, c.compression));
    const Pixels out = read(file);
    ASSERT_EQ(out.width, in.width);
    ASSERT_EQ(out.height, in.height);
    ASSERT_EQ(out.channels.size(), in.channels.size());
    // Half a step, and once more where colour and alpha were both rounded.
    const double loss = c.channels.back() == "A" ? 1.001 : 0.501;
    for (std::size_t k = 0; k < in.channels.size(); ++k)
        for (std::size_t i = 0; i < in.channels[k].size(); ++i)
            ASSERT_NEAR(out.channels[k][i], in.channels[k][i], c.step * loss) << c.channels[k] << ' ' << i;
}

// A writer may spoil what is too small for it without a word.
TEST_P(ImageIoFormat, ReadsBackTheSmallestPictureThatItTakes) {
    const Case& c = GetParam();
    const Folder folder;
    const auto file = folder / ("a." + c.extension);
    const auto takes = [&](int side) {
        try {
            check_image(file, spec_for(ramp(side, side, c.channels), c.depth, c.compression));
            return true;
        } catch (const Failure&) {
            return false;
        }
    };
    int side = 1;
    while (side < 64 && !takes(side)) ++side;
    const Pixels in = ramp(side, side, c.channels);
    write(file, in, spec_for(in, c.depth, c.compression));
    EXPECT_EQ(read(file).width, side);
    EXPECT_EQ(read(file).height, side);
}

std::string case_name(const ::testing::TestParamInfo<Case>& info) {
    std::string name = info.param.extension + "_" + std::to_string(static_cast<int>(info.param.depth)) + "_";
    for (const std::string& channel : info.param.channels) name += channel;
    for (const char letter : info.param.compression) name += std::isalnum(letter) != 0 ? letter : '_';
    return name;
}

INSTANTIATE_TEST_SUITE_P(All, ImageIoFormat, ::testing::ValuesIn(cases()), case_name);

}  // namespace
}  // namespace keyline::test
