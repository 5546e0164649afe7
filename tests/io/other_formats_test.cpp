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

TEST(PictureHelper, IsForAllNamesButThoseOfOpenExr) {
    EXPECT_FALSE(is_other_format("a.exr"));
    EXPECT_FALSE(is_other_format("a.EXR"));
    EXPECT_TRUE(is_other_format("a.png"));
    EXPECT_TRUE(is_other_format("exr"));
}

}  // namespace
}  // namespace keyline
