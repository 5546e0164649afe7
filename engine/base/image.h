// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/base/geometry.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace KEYLINE_API keyline {

// One channel of a region, as a node sees it: 32-bit floats, rows `stride` floats apart.  It does not own
// its pixels.  `rect` is what is there to read; `window` is where the image ends (a pixel outside `rect` but
// inside `window` exists; it just was not asked for), for a point operation its data window.
struct View {
    const float* data = nullptr;  // the pixel (rect.x0, rect.y0)
    std::ptrdiff_t stride = 0;
    Rect rect, window;

    const float* at(int x, int y) const { return data + (y - rect.y0) * stride + (x - rect.x0); }
    const float* row(int y) const { return at(rect.x0, y); }
};

// The same to write: `rect` is exactly what is to be computed.
struct MutView {
    float* data = nullptr;
    std::ptrdiff_t stride = 0;
    Rect rect, window;

    float* at(int x, int y) const { return data + (y - rect.y0) * stride + (x - rect.x0); }
    float* row(int y) const { return at(rect.x0, y); }
    operator View() const { return {data, stride, rect, window}; }  // NOLINT(google-explicit-constructor)
};

// How a sample is kept in a file, and by the engine between stages.
enum class SampleType : uint8_t { kHalf, kFloat, kUint };

constexpr std::size_t sample_size(SampleType type) { return type == SampleType::kHalf ? 2 : 4; }
constexpr const char* sample_type_name(SampleType type) {
    return type == SampleType::kHalf ? "half" : type == SampleType::kFloat ? "float" : "uint";
}

// One channel of a region in a file's own sample type, native byte order, rows `stride` bytes apart.
// `data` null: this channel is not wanted.
struct Plane {
    std::byte* data = nullptr;  // the sample (rect.x0, rect.y0)
    std::ptrdiff_t stride = 0;
    SampleType type = SampleType::kHalf;
    Rect rect;

    std::byte* at(int x, int y) const {
        return data + (y - rect.y0) * stride + (x - rect.x0) * static_cast<std::ptrdiff_t>(sample_size(type));
    }
};

}  // namespace keyline
