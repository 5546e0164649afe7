// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0

// Pictures of every other format that Keyline writes, damaged and read.

#include "engine/io/image_sink.h"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/read_some.h"
#include "tests/io/exr_files.h"

#include <algorithm>
#include <fmt/format.h>
#include <vector>

namespace keyline {
namespace {

struct Kind {
    std::string extension, channels;
    Depth depth = Depth::kAuto;
    std::string compression = "zip";
};

const std::vector<Kind> kKinds = {{"bmp", "RGB"},
                                  {"bmp", "RGBA"},
                                  {"dpx", "RGB"},
                                  {"dpx", "RGBA", Depth::kUint16},
                                  {"dpx", "Y", Depth::kUint8},
                                  {"fits", "Y"},
                                  {"fits", "Y", Depth::kUint8},
                                  {"gif", "RGB"},
                                  {"hdr", "RGB"},
                                  {"iff", "RGB"},
                                  {"iff", "RGBA"},
                                  {"jp2", "RGB"},
                                  {"jp2", "RGBA", Depth::kUint8},
                                  {"jpg", "RGB"},
                                  {"jpg", "Y"},
                                  {"png", "RGBA"},
                                  {"png", "RGB", Depth::kUint8},
                                  {"ppm", "RGB"},
                                  {"ppm", "Y"},
                                  {"rla", "RGB"},
                                  {"rla", "RGBA"},
                                  {"sgi", "RGB"},
                                  {"sgi", "RGBA", Depth::kUint8},
                                  {"tga", "RGB"},
                                  {"tga", "RGBA", Depth::kAuto, "none"},
                                  {"tif", "RGB"},
                                  {"tif", "RGBA", Depth::kUint16, "lzw"},
                                  {"tif", "RGBAUV", Depth::kUint8, "packbits"},
                                  {"webp", "RGB"},
                                  {"zfile", "Y"}};

constexpr int kWidth = 37, kHeight = 33;  // no less than JPEG 2000 takes

SinkSpec spec_of(const Kind& kind) {
    SinkSpec spec;
    spec.display_window = spec.data_window = {0, 0, kWidth, kHeight};
    for (const char c : kind.channels) spec.channels.push_back({std::string(1, c), SampleType::kFloat});
    spec.depth = kind.depth;
    spec.compression = kind.compression;
    spec.metadata.set({"owner", "string", std::string("Studio")});
    spec.metadata.set({"comments", "string", std::string("shot 12")});
    return spec;
}

void write(const std::filesystem::path& file, const Kind& kind) {
    const SinkSpec spec = spec_of(kind);
    const auto sink = create_image(file, spec);
    std::vector<Pixels> pixels;
    std::vector<Plane> planes;
    for (const ChannelInfo& c : sink->channels())
        planes.push_back(pixels.emplace_back(c.type, sink->region()).plane());
    int n = 0;
    for (const Plane& plane : planes)
        for (int y = 0; y < kHeight; ++y)
            for (int x = 0; x < kWidth; ++x)
                reinterpret_cast<float*>(plane.at(0, y))[x] = static_cast<float>(n++ * 37 % 100) / 100;
    for (int i = 0; i * sink->chunk_height() < kHeight; ++i) sink->commit(sink->encode(i, planes));
    sink->finish();
}

std::vector<Victim> make_victims(const TemporaryFolder& folder) {
    std::vector<Victim> victims;
    for (const Kind& kind : kKinds) {
        const std::filesystem::path file = folder / ("sound." + kind.extension);
        write(file, kind);
        Victim victim{fmt::format("{}-{}", kind.extension, kind.channels), content(file), 0, {}};
        victim.header_end = std::min<std::size_t>(victim.bytes.size(), 512);
        victims.push_back(std::move(victim));
    }
    return victims;
}

}  // namespace
}  // namespace keyline

int main(int count, char** arguments) {
    const keyline::TemporaryFolder folder;
    return keyline::run_fuzz({.what = "pictures",
                              .victims = keyline::make_victims(folder),
                              .folder = folder / ".",
                              .attempt = keyline::read_some,
                              .is_fair = keyline::is_of_input},
                             count, arguments);
}
