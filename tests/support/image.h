// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/geometry.h"
#include "engine/base/image.h"
#include "engine/base/metadata.h"

#include <initializer_list>
#include <iosfwd>
#include <string>
#include <string_view>
#include <vector>

namespace keyline {

std::ostream& operator<<(std::ostream& out, const Rect& rect);

}  // namespace keyline

namespace keyline::testing {

// A whole image in memory, for tests: what goes into a node and what comes out of it.
struct Image {
    struct Channel {
        std::string name;
        SampleType type = SampleType::kFloat;  // as a file would hold it
        std::vector<float> samples;            // row by row over the data window
    };

    Rect display, window;
    std::vector<Channel> channels;
    Metadata metadata;

    Image() = default;
    // Zeros in the channels given.
    Image(const Rect& window, std::initializer_list<std::string> names);
    Image(const Rect& window, const std::vector<std::string>& names);

    bool has(std::string_view name) const;
    const Channel& channel(std::string_view name) const;  // fails the test where there is none
    Channel& channel(std::string_view name);

    // A sample, 0 outside the data window.
    float at(std::string_view name, int x, int y) const;
    float& at(std::string_view name, int x, int y);

    // Sets every sample of a channel to f(x, y).
    template <class F>
    Image& fill(std::string_view name, F&& f) {
        Channel& c = channel(name);
        std::size_t i = 0;
        for (int y = window.y0; y < window.y1; ++y)
            for (int x = window.x0; x < window.x1; ++x) c.samples[i++] = static_cast<float>(f(x, y));
        return *this;
    }
};

// One channel drawn in characters: '.' is 0, a digit itself, 'x' NaN.  Its corner is the origin.
Image ascii(std::initializer_list<std::string_view> rows, const std::string& channel = "Y");

// Some of an image's channels, in the order given.
Image only(const Image& image, const std::vector<std::string>& names);

// The channels of a layer, by their names in it.
Image layer_of(const Image& image, const std::string& layer);

// Samples above `most` become `most`.
Image limited(Image image, float most);

// What lies inside a window, which becomes both of the image's windows; 0 where the image has nothing.
Image cropped(const Image& image, const Rect& window);

// Moves both windows.
Image moved(Image image, int dx, int dy);

// Repeatable noise in every channel, evenly spread from `low` to `high`.
Image noise(const Rect& window, const std::vector<std::string>& names, unsigned seed, float low = 0,
            float high = 1);

// Reads an EXR file as a node would get it.
Image read_exr(const std::string& file);

// Writes one, each channel in its own type.
void write_exr(const std::string& file, const Image& image);

// A layer of a render of a street, 480 × 270, half float.  Colour ends at 16: fireflies would hide all else.
Image plate(const std::string& layer = "Combined", int frame = 1);

// By pixel: the largest absolute value of all channels within `reach` pixels, NaN passed over.
Image largest_within(const Image& image, int reach);

// The same windows, channels and bits, of NaN too.
bool same(const Image& a, const Image& b);

// For failure messages: the windows, and small channels as numbers.
std::ostream& operator<<(std::ostream& out, const Image& image);

}  // namespace keyline::testing

// The same windows, channels and samples, bit for bit (any NaN equals any other); a difference is told.
#define EXPECT_IMAGE(actual, expected) \
    EXPECT_PRED_FORMAT2(::keyline::testing::compare_images, actual, expected)
// Samples within `tolerance` of each other.
#define EXPECT_IMAGE_NEAR(actual, expected, tolerance) \
    EXPECT_PRED_FORMAT3(::keyline::testing::compare_images_near, actual, expected, tolerance)

// As NODES promises: within 1e-5 of the largest value of the input `in` at most `reach` pixels away.
#define EXPECT_IMAGE_AGREES(actual, expected, in, reach) \
    EXPECT_TRUE(::keyline::testing::agree_within_reach(actual, expected, in, reach))

#include <gtest/gtest.h>

namespace keyline::testing {

::testing::AssertionResult agree_within_reach(const Image& a, const Image& b, const Image& in, int reach);

::testing::AssertionResult compare_images(const char* a_text, const char* b_text, const Image& a,
                                          const Image& b);
::testing::AssertionResult compare_images_near(const char* a_text, const char* b_text,
                                               const char* tolerance_text, const Image& a, const Image& b,
                                               double tolerance);

}  // namespace keyline::testing
