// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/base/geometry.h"
#include "engine/io/image_source.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace KEYLINE_API keyline {

// An object of a Cryptomatte, as a picture shows it.
struct SeenObject {
    std::string name;  // its id in hexadecimal where the manifest has no name for it
    uint32_t id = 0;
    int64_t pixels = 0;  // that it covers at all
    double area = 0;     // in pixels: the sum of its coverage
    Rect window;         // the smallest that holds them
};

struct SeenCryptomatte {
    std::string name;                 // of its layers
    std::vector<SeenObject> objects;  // the one with the most pixels first
    std::size_t unseen = 0;           // names of the manifest that cover nothing
    std::vector<std::string> faults;  // of the manifest
};

// Throws Failure (kInput) for what is damaged, and for ids that are stored as half.
std::vector<SeenCryptomatte> objects_of(const ImageSource& source);

// How much of a pixel an object covers.
struct Share {
    std::string cryptomatte, object;
    double coverage = 0;
};

struct PixelSample {
    std::string channel;
    SampleType type = SampleType::kHalf;
    double value = 0;
    bool inside = true;  // the channel's data window
};

struct Pixel {
    std::vector<PixelSample> samples;  // in the file's order
    std::vector<Share> objects;        // the ranks in turn
};

// Every channel of one pixel, and what it shows.  Outside of data windows a channel is 0.
Pixel pixel_of(const ImageSource& source, int x, int y);

}  // namespace keyline
