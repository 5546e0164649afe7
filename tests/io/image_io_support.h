// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/error.h"
#include "engine/io/image_sink.h"
#include "engine/io/image_source.h"
#include "tests/support/failure.h"

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace keyline::test {

// A picture in memory: channels of width × height floats over the display window.
struct Pixels {
    int width = 0, height = 0;
    std::vector<std::string> names;
    std::vector<std::vector<float>> channels;

    float at(std::string_view channel, int x, int y) const;
};

// A slow ramp with a different value in every channel and pixel, between 0 and 1.
Pixels ramp(int width, int height, const std::vector<std::string>& names);

SinkSpec spec_for(const Pixels& pixels, Depth depth = Depth::kAuto, const std::string& compression = "zip");

// Chunk by chunk as the engine does, encoded out of order, committed in order.
void commit_all(ImageSink& sink, const Pixels& pixels);
void write(const std::filesystem::path& file, const Pixels& pixels, const SinkSpec& spec);

// All channels of the first group, half converted to float.
Pixels read(const ImageSource& source);
Pixels read(const std::filesystem::path& file);

// A folder that goes with its contents.
class Folder {
public:
    Folder();
    ~Folder();
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;

    std::filesystem::path operator/(std::string_view name) const { return path_ / name; }
    std::vector<std::string> files() const;

private:
    std::filesystem::path path_;
};

std::string bytes_of(const std::filesystem::path& file);
void put_bytes(const std::filesystem::path& file, std::string_view bytes);

}  // namespace keyline::test
