// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/io/other_formats.h"

#include "engine/base/error.h"
#include "engine/io/image_sink.h"

#include <gmock/gmock.h>

namespace keyline {
namespace {

// This program has no other test that meets a picture: what runs here was started by these.
SinkSpec colour(Depth depth) {
    SinkSpec spec;
    spec.display_window = spec.data_window = {0, 0, 4, 4};
    for (const char* name : {"R", "G", "B"}) spec.channels.push_back({name, SampleType::kFloat});
    spec.depth = depth;
    return spec;
}

TEST(PictureHelper, IsNotStartedToCheckWhatAPictureCanHold) {
    EXPECT_NO_THROW(check_image("a.png", colour(Depth::kUint16)));
    try {
        check_image("a.jpg", colour(Depth::kUint16));
        FAIL() << "accepted";
    } catch (const Failure& failure) {
        EXPECT_THAT(failure.what(), testing::HasSubstr("jpeg has no depth 'uint16'; it has 'uint8'"));
    }
    EXPECT_FALSE(picture_helper_runs());
}

TEST(PictureHelper, IsNotStartedToCheckHowManyPixelsAFormatHolds) {
    const auto fault = [](const char* file, int width, int height) -> std::string {
        SinkSpec spec = colour(Depth::kAuto);
        spec.display_window = spec.data_window = {0, 0, width, height};
        try {
            check_image(file, spec);
            return "";
        } catch (const Failure& failure) {
            return failure.what();
        }
    };
    EXPECT_EQ(fault("a.webp", 16383, 1), "");
    EXPECT_THAT(fault("a.webp", 1, 16384),
                testing::HasSubstr("webp can't hold 1 × 16384 pixels; each way it has 16383 at most"));
    EXPECT_EQ(fault("a.jp2", 32, 32), "");
    EXPECT_THAT(fault("a.jp2", 640, 31),
                testing::HasSubstr("jpeg2000 can't hold 640 × 31 pixels; each way it needs 32"));
    EXPECT_FALSE(picture_helper_runs());
}

TEST(PictureHelper, IsForAllNamesButThoseOfOpenExr) {
    EXPECT_FALSE(is_other_format("a.exr"));
    EXPECT_FALSE(is_other_format("a.EXR"));
    EXPECT_TRUE(is_other_format("a.png"));
    EXPECT_TRUE(is_other_format("exr"));
}

}  // namespace
}  // namespace keyline
