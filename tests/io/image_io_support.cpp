// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "image_io_support.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <unistd.h>

namespace keyline::test {

namespace {

float half_as_float(const std::byte* from) {
    std::uint16_t h = 0;
    std::memcpy(&h, from, 2);
    const int exponent = h >> 10U & 31U, mantissa = h & 1023U;
    const double value =
        exponent == 0 ? std::ldexp(mantissa, -24) : std::ldexp(1024 + mantissa, exponent - 25);
    return static_cast<float>((h & 0x8000U) != 0 ? -value : value);
}

std::vector<Plane> planes_over(const Pixels& pixels, const Rect& chunk, const Rect& region,
                               std::vector<std::vector<float>>& storage) {
    std::vector<Plane> planes;
    storage = pixels.channels;
    for (auto& channel : storage) {
        const std::ptrdiff_t stride = pixels.width * std::ptrdiff_t{sizeof(float)};
        planes.push_back({reinterpret_cast<std::byte*>(channel.data()) + (chunk.y0 - region.y0) * stride,
                          stride, SampleType::kFloat, chunk});
    }
    return planes;
}

}  // namespace

float Pixels::at(std::string_view channel, int x, int y) const {
    const auto found = std::ranges::find(names, channel);
    if (found == names.end()) throw std::out_of_range(std::string(channel));
    return channels[static_cast<std::size_t>(found - names.begin())].at(
        static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x));
}

Pixels ramp(int width, int height, const std::vector<std::string>& names) {
    Pixels pixels{width, height, names, {}};
    for (std::size_t c = 0; c < names.size(); ++c) {
        std::vector<float> values;
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                values.push_back((static_cast<float>(x) / static_cast<float>(width) +
                                  2 * static_cast<float>(y) / static_cast<float>(height) +
                                  static_cast<float>(c)) /
                                 static_cast<float>(3 + names.size()));
        pixels.channels.push_back(std::move(values));
    }
    return pixels;
}

SinkSpec spec_for(const Pixels& pixels, Depth depth, const std::string& compression) {
    SinkSpec spec;
    spec.display_window = spec.data_window = {0, 0, pixels.width, pixels.height};
    for (const std::string& name : pixels.names) spec.channels.push_back({name, SampleType::kHalf});
    spec.depth = depth;
    spec.compression = compression;
    return spec;
}

void commit_all(ImageSink& sink, const Pixels& pixels) {
    const Rect region = sink.region();
    const int chunks = (region.height() + sink.chunk_height() - 1) / sink.chunk_height();
    std::vector<EncodedChunk> encoded(static_cast<std::size_t>(chunks));
    for (int i = chunks; i-- > 0;) {
        const int y = region.y0 + i * sink.chunk_height();
        std::vector<std::vector<float>> storage;
        const Rect chunk = intersect(region, {region.x0, y, region.x1, y + sink.chunk_height()});
        const auto planes = planes_over(pixels, chunk, region, storage);
        encoded[static_cast<std::size_t>(i)] = sink.encode(i, planes);
    }
    for (EncodedChunk& chunk : encoded) sink.commit(std::move(chunk));
}

void write(const std::filesystem::path& file, const Pixels& pixels, const SinkSpec& spec) {
    const auto sink = create_image(file, spec);
    commit_all(*sink, pixels);
    sink->finish();
}

Pixels read(const ImageSource& source) {
    const ChannelGroup& group = source.header().groups.at(0);
    Pixels pixels{group.window.width(), group.window.height(), {}, {}};
    const auto area = static_cast<std::size_t>(group.window.area());
    std::vector<Plane> planes;
    std::vector<std::vector<std::byte>> storage;
    for (const ChannelInfo& channel : group.channels) {
        pixels.names.push_back(channel.name);
        const std::size_t size = sample_size(channel.type);
        storage.emplace_back(area * size);
        planes.push_back({storage.back().data(), static_cast<std::ptrdiff_t>(size) * group.window.width(),
                          channel.type, group.window});
    }
    for (int row = 0; row < group.rows(); ++row) source.read_chunk(0, 0, row, planes);
    for (std::size_t c = 0; c < planes.size(); ++c) {
        std::vector<float> values(area);
        for (std::size_t i = 0; i < area; ++i) {
            const std::byte* from = storage[c].data() + i * sample_size(planes[c].type);
            if (planes[c].type == SampleType::kHalf)
                values[i] = half_as_float(from);
            else
                std::memcpy(&values[i], from, sizeof(float));
        }
        pixels.channels.push_back(std::move(values));
    }
    return pixels;
}

Pixels read(const std::filesystem::path& file) { return read(*open_image(file)); }

Folder::Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "keyline_image_io_XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("mkdtemp");
    path_ = name;
}

Folder::~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

std::vector<std::string> Folder::files() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(path_))
        names.push_back(entry.path().filename().string());
    std::ranges::sort(names);
    return names;
}

std::string bytes_of(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

void put_bytes(const std::filesystem::path& file, std::string_view bytes) {
    std::ofstream(file, std::ios::binary) << bytes;
}

}  // namespace keyline::test
