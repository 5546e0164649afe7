// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/look/heat_map.h"

#include "engine/base/error.h"
#include "engine/io/image_sink.h"
#include "engine/kit/false_color.h"
#include "engine/simd/half.h"

#include <algorithm>
#include <cstring>
#include <fmt/format.h>

namespace keyline {

namespace {

using Row = std::vector<float>;

// One channel of a row of the map.
Row row_of_map(const ErrorMap& map, float most, int y, std::size_t channel) {
    Row out;
    const float* errors = map.errors.data() + std::ptrdiff_t{y - map.window.y0} * map.window.width();
    for (int i = 0; i < map.window.width(); ++i)
        out.push_back(heat(most > 0 ? errors[i] / most : 0)[channel]);
    return out;
}

// One channel of a chunk, in the type that the sink takes.
struct ChunkPlane {
    ChunkPlane(const Rect& rect, SampleType type)
        : samples(static_cast<std::size_t>(rect.area()) * sample_size(type)),
          plane{samples.data(), static_cast<std::ptrdiff_t>(sample_size(type)) * rect.width(), type, rect} {}

    void put(const Row& row, int y) const {
        if (plane.type == SampleType::kFloat) {
            std::memcpy(plane.at(plane.rect.x0, y), row.data(), row.size() * sizeof(float));
            return;
        }
        std::vector<uint16_t> halves(row.size());
        simd::float_to_half(row.data(), halves.data(), row.size());
        std::memcpy(plane.at(plane.rect.x0, y), halves.data(), halves.size() * sizeof(uint16_t));
    }

    std::vector<std::byte> samples;
    Plane plane;
};

}  // namespace

void write_heat_map(const std::filesystem::path& file, const ErrorMap& map, float most) {
    SinkSpec spec;
    spec.display_window = spec.data_window = map.window;
    for (const char* name : {"R", "G", "B"}) spec.channels.push_back({name, SampleType::kHalf});
    const std::unique_ptr<ImageSink> sink = create_image(file, spec);
    const Rect region = sink->region();
    for (int y0 = region.y0, index = 0; y0 < region.y1; y0 += sink->chunk_height(), ++index) {
        const Rect rect{region.x0, y0, region.x1, std::min(region.y1, y0 + sink->chunk_height())};
        std::vector<ChunkPlane> chunk;
        std::vector<Plane> planes;
        for (std::size_t c = 0; c < 3; ++c) {
            chunk.emplace_back(rect, sink->channels()[c].type);
            for (int y = rect.y0; y < rect.y1; ++y) chunk.back().put(row_of_map(map, most, y, c), y);
            planes.push_back(chunk.back().plane);
        }
        sink->commit(sink->encode(index, planes));
    }
    sink->finish();
}

}  // namespace keyline
