// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/json/value.h"

#include <string>
#include <vector>

namespace keyline::cli {

// A small picture that stands in a test: drawn in characters or numbers, or a pattern.
struct TestImage {
    struct Channel {
        std::string name;
        std::vector<float> samples;  // row by row
    };
    int width = 0, height = 0;
    std::vector<Channel> channels;
    bool is_unnamed = false;  // one grid without a channel's name
};

// Of
//   ["..1", ".1."]                 one channel: . is 0, a digit itself, x NaN
//   [[0, 0.5], [1, 0]]             one in numbers
//   { "R": …, "G": …, "A": 1 }     several; a number is one value all over
//   { "pattern": "ramp", "size": [16, 8], "channels": ["R", "G", "B"] }
// Throws Failure (kGraph) with the place of what is wrong.
TestImage read_test_image(const Value& value);

// As an OpenEXR file of 32-bit floats.
void write_test_image(const TestImage& image, const std::string& file);

}  // namespace keyline::cli
