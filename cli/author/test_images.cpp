// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/author/test_images.h"

#include "engine/io/image_sink.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <fmt/format.h>
#include <limits>
#include <optional>
#include <string_view>

namespace keyline::cli {

namespace {

using Kind = Value::Kind;

constexpr int kMostSide = 4096;

[[noreturn]] void refuse(const Value& value, std::string what, std::string hint = {}) {
    throw Failure({ErrorKind::kGraph, value.place, {}, std::move(what), std::move(hint)});
}

struct Grid {
    int width = 0, height = 0;
    std::vector<float> samples;
};

float sample_of(const Value& row, char c) {
    if (c == '.') return 0;
    if (c >= '0' && c <= '9') return static_cast<float>(c - '0');
    if (c == 'x') return std::numeric_limits<float>::quiet_NaN();
    refuse(row, fmt::format("a grid has no {}", in_quotes(std::string(1, c))),
           "it has . for 0, digits, and x for NaN");
}

void add_row(Grid& grid, const Value& row) {
    const std::size_t before = grid.samples.size();
    if (row.is(Kind::kString)) {
        for (const char c : row.text) grid.samples.push_back(sample_of(row, c));
    } else if (row.is(Kind::kArray)) {
        for (const Value& v : row.items) {
            if (!v.is(Kind::kNumber)) refuse(v, "a row of a grid is characters, or a list of numbers");
            grid.samples.push_back(static_cast<float>(v.number));
        }
    } else {
        refuse(row, "a row of a grid is characters, or a list of numbers");
    }
    const auto width = static_cast<int>(grid.samples.size() - before);
    if (width == 0) refuse(row, "the row is empty");
    if (grid.height > 0 && width != grid.width)
        refuse(row, fmt::format("the row is {} wide, the one before {}", width, grid.width));
    grid.width = width;
    ++grid.height;
}

Grid read_grid(const Value& value) {
    if (value.items.empty()) refuse(value, "the grid is empty");
    Grid out;
    for (const Value& row : value.items) add_row(out, row);
    return out;
}

void fit(TestImage& image, const Value& value, const Grid& grid) {
    if (image.width == 0) image.width = grid.width, image.height = grid.height;
    if (image.width != grid.width || image.height != grid.height)
        refuse(value, fmt::format("the channel is {} × {}, others are {} × {}", grid.width, grid.height,
                                  image.width, image.height));
}

TestImage read_channels(const Value& value) {
    TestImage out;
    for (const Member& m : value.members)
        if (m.value.is(Kind::kArray)) fit(out, m.value, read_grid(m.value));
    if (out.width == 0) refuse(value, "no channel has a grid, which would say how large the image is");
    for (const Member& m : value.members) {
        if (m.value.is(Kind::kArray))
            out.channels.push_back({m.key, read_grid(m.value).samples});
        else if (m.value.is(Kind::kNumber))
            out.channels.push_back({m.key, std::vector<float>(static_cast<std::size_t>(out.width) *
                                                                  static_cast<std::size_t>(out.height),
                                                              static_cast<float>(m.value.number))});
        else
            refuse(m.value, "a channel is a grid or a number");
    }
    return out;
}

// What is at a pixel, each from 0 to 1.
struct Pattern {
    std::string_view name;
    float (*at)(int x, int y, int width, int height, uint32_t channel);
};

// A bit of everything of a number; the same on every machine.
uint32_t scattered(uint32_t v) {
    v = (v ^ (v >> 16U)) * 0x7feb352dU;
    v = (v ^ (v >> 15U)) * 0x846ca68bU;
    return v ^ (v >> 16U);
}

float share(int i, int n) { return n > 1 ? static_cast<float>(i) / static_cast<float>(n - 1) : 0; }

constexpr std::array kPatterns{
    Pattern{"ramp", [](int x, int, int width, int, uint32_t) { return share(x, width); }},
    Pattern{"fall", [](int, int y, int, int height, uint32_t) { return share(y, height); }},
    Pattern{"checker", [](int x, int y, int, int, uint32_t) { return static_cast<float>((x + y) % 2); }},
    Pattern{"step", [](int x, int, int width, int, uint32_t) { return 2 * x >= width ? 1.0F : 0.0F; }},
    Pattern{"disc",
            [](int x, int y, int width, int height, uint32_t) {
                const int dx = 2 * x + 1 - width, dy = 2 * y + 1 - height, r = std::min(width, height) / 2;
                return dx * dx + dy * dy <= r * r ? 1.0F : 0.0F;
            }},
    Pattern{"noise", [](int x, int y, int width, int, uint32_t channel) {
                const auto i = static_cast<uint32_t>(y * width + x);
                return static_cast<float>(scattered(scattered(i) + channel) >> 8U) /
                       static_cast<float>(1U << 24U);
            }}};

std::vector<std::string> pattern_names() {
    std::vector<std::string> out;
    for (const Pattern& p : kPatterns) out.emplace_back(p.name);
    return out;
}

int side_of(const Value& value) {
    if (!value.is(Kind::kNumber) || value.number != std::floor(value.number) || value.number < 1 ||
        value.number > kMostSide)
        refuse(value, fmt::format("it must be a whole number from 1 to {}", kMostSide));
    return static_cast<int>(value.number);
}

TestImage read_pattern(const Value& value) {
    const Value &name = *value.find("pattern"), *size = value.find("size"),
                *channels = value.find("channels");
    const auto* pattern = std::ranges::find(kPatterns, std::string_view(name.text), &Pattern::name);
    if (!name.is(Kind::kString) || pattern == kPatterns.end())
        refuse(name, "there is no pattern " + name.shown(), "there are " + listed(pattern_names()));
    if (!size || size->items.size() != 2) refuse(value, "'size' is missing: [width, height]");
    TestImage out{side_of(size->items[0]), side_of(size->items[1]), {}, channels == nullptr};
    std::vector<std::string> names{"Y"};
    if (channels) {
        names.clear();
        for (const Value& c : channels->items) names.push_back(c.text);
    }
    for (uint32_t c = 0; c < names.size(); ++c) {
        std::vector<float> samples;
        for (int y = 0; y < out.height; ++y)
            for (int x = 0; x < out.width; ++x)
                samples.push_back(pattern->at(x, y, out.width, out.height, c));
        out.channels.push_back({names[c], std::move(samples)});
    }
    return out;
}

}  // namespace

TestImage read_test_image(const Value& value) {
    if (value.is(Kind::kArray)) {
        Grid grid = read_grid(value);
        return {grid.width, grid.height, {{"Y", std::move(grid.samples)}}, true};
    }
    if (!value.is(Kind::kObject))
        refuse(value, "an image is a grid, or an object of channels, a file or a pattern");
    return value.find("pattern") ? read_pattern(value) : read_channels(value);
}

void write_test_image(const TestImage& image, const std::string& file) {
    SinkSpec spec;
    spec.display_window = spec.data_window = {0, 0, image.width, image.height};
    for (const TestImage::Channel& c : image.channels) spec.channels.push_back({c.name, SampleType::kFloat});
    const auto sink = create_image(file, spec);
    const Rect region = sink->region();
    const auto row_bytes = static_cast<std::ptrdiff_t>(sizeof(float)) * image.width;
    for (int i = 0, y = region.y0; y < region.y1; ++i, y += sink->chunk_height()) {
        const Rect rows = intersect(region, {region.x0, y, region.x1, y + sink->chunk_height()});
        std::vector<std::vector<std::byte>> bytes;
        std::vector<Plane> planes;
        for (const ChannelInfo& channel : sink->channels()) {
            const auto from = std::ranges::find(image.channels, channel.name, &TestImage::Channel::name);
            auto& copy = bytes.emplace_back(static_cast<std::size_t>(row_bytes * rows.height()));
            std::memcpy(copy.data(), from->samples.data() + static_cast<std::ptrdiff_t>(y) * image.width,
                        copy.size());
            planes.push_back({copy.data(), row_bytes, SampleType::kFloat, rows});
        }
        sink->commit(sink->encode(i, planes));
    }
    sink->finish();
}

}  // namespace keyline::cli
