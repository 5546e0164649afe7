// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/io/exr_files.h"

#include "engine/simd/half.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfMultiView.h>
#include <ImfOutputPart.h>
#include <ImfPartType.h>
#include <ImfStandardAttributes.h>
#include <ImfTiledOutputPart.h>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <limits>
#include <stdexcept>

namespace keyline {

namespace {

uint32_t hash(uint32_t a, uint32_t b, uint32_t c) {
    uint32_t h = a * 0x9E3779B1U ^ b * 0x85EBCA77U ^ c * 0xC2B2AE3DU;
    h ^= h >> 15;
    h *= 0x2C1B3C6DU;
    return h ^ h >> 13;
}

float test_value(uint32_t seed, int x, int y) {
    const uint32_t h = hash(seed, static_cast<uint32_t>(x), static_cast<uint32_t>(y));
    if (h % 97 == 0) return std::numeric_limits<float>::infinity();
    if (h % 101 == 0) return std::numeric_limits<float>::quiet_NaN();
    if (h % 103 == 0) return std::ldexp(static_cast<float>(h >> 20), -34);
    const float smooth = std::sin(static_cast<float>(x) * 0.11F) + std::cos(static_cast<float>(y) * 0.07F);
    return (x / 16 + y / 16) % 2 == 0 ? smooth : smooth + static_cast<float>(h >> 8) * 0x1p-22F;
}

Imf::PixelType imf_type(SampleType type) {
    return type == SampleType::kHalf ? Imf::HALF : type == SampleType::kFloat ? Imf::FLOAT : Imf::UINT;
}

SampleType from_imf(Imf::PixelType type) {
    return type == Imf::HALF    ? SampleType::kHalf
           : type == Imf::FLOAT ? SampleType::kFloat
                                : SampleType::kUint;
}

Imf::Compression imf_compression(const std::string& name) {
    static const std::vector<std::string> names = {"none",  "rle", "zips", "zip",  "piz",
                                                   "pxr24", "b44", "b44a", "dwaa", "dwab"};
    return static_cast<Imf::Compression>(std::ranges::find(names, name) - names.begin());
}

Imath::Box2i box(const Rect& r) { return {{r.x0, r.y0}, {r.x1 - 1, r.y1 - 1}}; }
Rect rect(const Imath::Box2i& b) { return {b.min.x, b.min.y, b.max.x + 1, b.max.y + 1}; }

Imf::Header header_of(const TestPart& part) {
    Imf::Header header(box(part.display), box(part.data));
    header.compression() = imf_compression(part.compression);
    header.lineOrder() = part.line_order;
    for (const TestChannel& c : part.channels)
        header.channels().insert(c.name, Imf::Channel(imf_type(c.type), c.x_sampling, c.y_sampling));
    if (!part.name.empty()) header.setName(part.name);
    if (!part.view.empty()) header.setView(part.view);
    if (!part.multi_view.empty()) Imf::addMultiView(header, part.multi_view);
    header.setType(part.storage == TestStorage::kScanline ? Imf::SCANLINEIMAGE : Imf::TILEDIMAGE);
    if (part.storage != TestStorage::kScanline) {
        const auto mode = part.storage == TestStorage::kTiled    ? Imf::ONE_LEVEL
                          : part.storage == TestStorage::kMipmap ? Imf::MIPMAP_LEVELS
                                                                 : Imf::RIPMAP_LEVELS;
        const auto tile = static_cast<unsigned>(part.tile);
        header.setTileDescription(Imf::TileDescription(tile, tile, mode));
    }
    return header;
}

// OpenEXR's C++ library wants the address that (0, 0) would have.
char* origin(Pixels& pixels, int x_sampling = 1, int y_sampling = 1) {
    return reinterpret_cast<char*>(pixels.bytes.data()) -
           pixels.window.y0 / y_sampling * pixels.stride() / x_sampling -
           pixels.window.x0 / x_sampling * static_cast<std::ptrdiff_t>(sample_size(pixels.type));
}

Imf::Slice slice(Pixels& pixels) {
    return {imf_type(pixels.type), origin(pixels), sample_size(pixels.type),
            static_cast<std::size_t>(pixels.stride())};
}

// Every sampled pixel of a channel, tightly.
Pixels subsampled(Pixels full, const TestChannel& channel) {
    Pixels pixels = full;
    const Plane plane = full.plane();
    const std::size_t size = sample_size(channel.type);
    std::size_t n = 0;
    for (int y = full.window.y0; y < full.window.y1; y += channel.y_sampling)
        for (int x = full.window.x0; x < full.window.x1; x += channel.x_sampling, n += size)
            std::memcpy(pixels.bytes.data() + n, plane.at(x, y), size);
    return pixels;
}

void write_levels(Imf::TiledOutputPart& out) {
    for (int ly = 0; ly < out.numYLevels(); ++ly)
        for (int lx = 0; lx < out.numXLevels(); ++lx)
            if (out.isValidLevel(lx, ly))
                out.writeTiles(0, out.numXTiles(lx) - 1, 0, out.numYTiles(ly) - 1, lx, ly);
}

void write_part(Imf::MultiPartOutputFile& file, int index, const TestPart& part) {
    std::vector<Pixels> pixels;
    pixels.reserve(part.channels.size());
    Imf::FrameBuffer buffer;
    for (const TestChannel& c : part.channels) {
        pixels.push_back(subsampled(test_pixels(c, part.data), c));
        Pixels& p = pixels.back();
        buffer.insert(
            c.name,
            Imf::Slice(imf_type(c.type), origin(p, c.x_sampling, c.y_sampling), sample_size(c.type),
                       static_cast<std::size_t>(p.stride() / c.x_sampling), c.x_sampling, c.y_sampling));
    }
    if (part.storage == TestStorage::kScanline) {
        Imf::OutputPart out(file, index);
        out.setFrameBuffer(buffer);
        out.writePixels(part.data.height());
    } else {
        Imf::TiledOutputPart out(file, index);
        out.setFrameBuffer(buffer);
        write_levels(out);
    }
}

}  // namespace

double Pixels::at(int x, int y) const {
    const std::size_t i =
        (static_cast<std::size_t>(y - window.y0) * static_cast<std::size_t>(window.width()) +
         static_cast<std::size_t>(x - window.x0)) *
        sample_size(type);
    if (type == SampleType::kHalf) {
        uint16_t half = 0;
        float value = 0;
        std::memcpy(&half, bytes.data() + i, sizeof half);
        simd::half_to_float(&half, &value, 1);
        return value;
    }
    float value = 0;
    uint32_t number = 0;
    std::memcpy(&value, bytes.data() + i, sizeof value);
    std::memcpy(&number, bytes.data() + i, sizeof number);
    return type == SampleType::kFloat ? static_cast<double>(value) : static_cast<double>(number);
}

Pixels test_pixels(const TestChannel& channel, const Rect& window) {
    Pixels pixels(channel.type, window);
    const Plane plane = pixels.plane();
    const auto seed = static_cast<uint32_t>(std::hash<std::string>{}(channel.name));
    for (int y = window.y0; y < window.y1; ++y)
        for (int x = window.x0; x < window.x1; ++x) {
            const float value = test_value(seed, x, y);
            const uint32_t number =
                hash(seed, static_cast<uint32_t>(x / 5), static_cast<uint32_t>(y / 3)) >> 20;
            uint16_t half = 0;
            simd::float_to_half(&value, &half, 1);
            const void* sample = channel.type == SampleType::kHalf    ? static_cast<const void*>(&half)
                                 : channel.type == SampleType::kFloat ? static_cast<const void*>(&value)
                                                                      : static_cast<const void*>(&number);
            std::memcpy(plane.at(x, y), sample, sample_size(channel.type));
        }
    return pixels;
}

void write_with_openexr(const std::filesystem::path& file, const std::vector<TestPart>& parts) {
    std::vector<Imf::Header> headers;
    for (const TestPart& part : parts) headers.push_back(header_of(part));
    Imf::MultiPartOutputFile out(file.c_str(), headers.data(), static_cast<int>(headers.size()));
    for (std::size_t i = 0; i < parts.size(); ++i) write_part(out, static_cast<int>(i), parts[i]);
}

Image read_with_openexr(const std::filesystem::path& file, int part) {
    Imf::MultiPartInputFile in(file.c_str());
    Imf::InputPart input(in, part);
    const Rect window = rect(input.header().dataWindow());
    Image image;
    Imf::FrameBuffer buffer;
    const Imf::ChannelList& channels = input.header().channels();
    for (auto c = channels.begin(); c != channels.end(); ++c) {
        Pixels& pixels = image.emplace(c.name(), Pixels(from_imf(c.channel().type), window)).first->second;
        buffer.insert(c.name(), slice(pixels));
    }
    input.setFrameBuffer(buffer);
    input.readPixels(window.y0, window.y1 - 1);
    return image;
}

Image read_with_keyline(const std::filesystem::path& file, const OpenOptions& options) {
    const auto source = open_image(file, options);
    Image image;
    for (std::size_t g = 0; g < source->header().groups.size(); ++g) {
        const ChannelGroup& group = source->header().groups[g];
        std::vector<Plane> planes;
        for (const ChannelInfo& c : group.channels)
            planes.push_back(image.emplace(c.name, Pixels(c.type, group.window)).first->second.plane());
        for (int row = 0; row < group.rows(); ++row)
            for (int column = 0; column < group.columns(); ++column)
                source->read_chunk(g, column, row, planes);
    }
    return image;
}

void write_with_keyline(const std::filesystem::path& file, Image image, SinkSpec spec) {
    std::vector<Plane> planes;
    for (auto& [name, pixels] : image) {
        spec.channels.push_back({name, pixels.type});
        planes.push_back(pixels.plane());
    }
    const auto sink = create_image(file, spec);
    const int chunks = (sink->region().height() + sink->chunk_height() - 1) / sink->chunk_height();
    for (int i = 0; i < chunks; ++i) sink->commit(sink->encode(i, planes));
    sink->finish();
}

TemporaryFolder::TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "keyline-test-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

std::vector<std::string> TemporaryFolder::entries() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(path_))
        names.push_back(entry.path().filename().string());
    std::ranges::sort(names);
    return names;
}

}  // namespace keyline
