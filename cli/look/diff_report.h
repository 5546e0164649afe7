// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/json/json_writer.h"
#include "engine/look/differences.h"

#include <optional>
#include <string>
#include <vector>

namespace keyline::cli {

struct FlipResult {
    double mean = 0;
    float largest = 0;
    int x = 0, y = 0;
};

// Two pictures: what each file shows in one view.
struct DiffReport {
    std::string view;  // empty where the files have none
    Rect display_a, display_b, data_a, data_b;
    PictureDifferences found;
    std::optional<FlipResult> flip;

    // Whether they count as different; attributes do where that is asked for.
    bool differ(bool with_attributes) const;
};

// What two files differ in, for people; "" where there is nothing.
std::string diff_text(const std::string& a, const std::string& b, const DiffReport& report);

// An object.
void write_diff(JsonWriter& json, const DiffReport& report);

}  // namespace keyline::cli
