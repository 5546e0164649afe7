// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/io/image_module.h"

#include "engine/error.h"

#include <gmock/gmock.h>

namespace keyline {
namespace {

// This program has no other test that meets a picture: what is loaded here was loaded by these.
SinkSpec colour(Depth depth) {
    SinkSpec spec;
    spec.display_window = spec.data_window = {0, 0, 4, 4};
    for (const char* name : {"R", "G", "B"}) spec.channels.push_back({name, SampleType::kFloat});
    spec.depth = depth;
    return spec;
}

TEST(ImageModule, IsNotLoadedToCheckWhatAPictureCanHold) {
    EXPECT_NO_THROW(check_image("a.png", colour(Depth::kUint16)));
    try {
        check_image("a.jpg", colour(Depth::kUint16));
        FAIL() << "accepted";
    } catch (const Failure& failure) {
        EXPECT_THAT(failure.what(), testing::HasSubstr("jpeg has no depth 'uint16'; it has 'uint8'"));
    }
    EXPECT_FALSE(module_is_loaded());
}

TEST(ImageModule, IsForAllNamesButThoseOfOpenExr) {
    EXPECT_FALSE(needs_module("a.exr"));
    EXPECT_FALSE(needs_module("a.EXR"));
    EXPECT_TRUE(needs_module("a.png"));
    EXPECT_TRUE(needs_module("exr"));
}

}  // namespace
}  // namespace keyline
