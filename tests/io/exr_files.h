// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/geometry.h"
#include "engine/base/image.h"
#include "engine/io/image_sink.h"
#include "engine/io/image_source.h"

#include <ImfHeader.h>
#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

// Files made and read by OpenEXR's own C++ library, to compare with.

namespace keyline {

// The samples of a channel over a window, row by row.
struct Pixels {
    SampleType type = SampleType::kHalf;
    Rect window;
    std::vector<std::byte> bytes;

    Pixels() = default;
    Pixels(SampleType t, const Rect& w)
        : type(t), window(w), bytes(static_cast<std::size_t>(w.area()) * sample_size(t)) {}

    std::ptrdiff_t stride() const { return static_cast<std::ptrdiff_t>(sample_size(type)) * window.width(); }
    Plane plane() { return {bytes.data(), stride(), type, window}; }
    double at(int x, int y) const;
    friend bool operator==(const Pixels&, const Pixels&) = default;
};

// By full name; for a file of several parts, as Keyline names them.
using Image = std::map<std::string, Pixels>;

struct TestChannel {
    std::string name;
    SampleType type = SampleType::kHalf;
    int x_sampling = 1, y_sampling = 1;
};

enum class TestStorage { kScanline, kTiled, kMipmap, kRipmap };

struct TestPart {
    std::string name, view;
    TestStorage storage = TestStorage::kScanline;
    std::string compression = "zip";
    Imf::LineOrder line_order = Imf::INCREASING_Y;
    Rect data{0, 0, 70, 45}, display{0, 0, 70, 45};
    int tile = 32;
    std::vector<TestChannel> channels = {{"R"}, {"G"}, {"B"}, {"A"}};
    std::vector<std::string> multi_view;
};

// Half smooth, half noise; whole numbers for uint.  Special values (infinities, NaNs, denormals) now and
// then.
Pixels test_pixels(const TestChannel& channel, const Rect& window);

// Writes the test pixels with OpenEXR's C++ library.
void write_with_openexr(const std::filesystem::path& file, const std::vector<TestPart>& parts);

// Channel by channel of one part at full resolution, with OpenEXR's C++ library.
Image read_with_openexr(const std::filesystem::path& file, int part = 0);

// All groups, chunk by chunk.
Image read_with_keyline(const std::filesystem::path& file, const OpenOptions& options = {});

// Writes what `image` holds; the spec's channels are made from it.
void write_with_keyline(const std::filesystem::path& file, Image image, SinkSpec spec);

// An empty folder that is removed with what is in it.
class TemporaryFolder {
public:
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
    const std::filesystem::path& path() const { return path_; }
    std::vector<std::string> entries() const;  // sorted

private:
    std::filesystem::path path_;
};

}  // namespace keyline
