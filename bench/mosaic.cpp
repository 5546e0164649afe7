// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0

// Makes a large plate of a small one:  bench_mosaic IN.exr N OUT.exr  lays N × N copies side by side, every
// other one mirrored, so that there are no seams and deflate finds no repeats.  Channels keep their types,
// Cryptomattes the names of their objects.

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfThreading.h>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <map>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

namespace {

struct Plane {
    Imf::PixelType type;
    std::size_t size;  // of a sample
    std::vector<char> samples;
};

std::map<std::string, Plane> read_planes(Imf::InputFile& in, int width, int height) {
    std::map<std::string, Plane> planes;
    Imf::FrameBuffer buffer;
    const auto& channels = in.header().channels();
    for (auto c = channels.begin(); c != channels.end(); ++c) {
        const std::size_t size = c.channel().type == Imf::HALF ? 2 : 4;
        Plane& p = planes[c.name()];
        p = {c.channel().type, size,
             std::vector<char>(size * static_cast<std::size_t>(width) * static_cast<std::size_t>(height))};
        buffer.insert(c.name(),
                      Imf::Slice(p.type, p.samples.data(), size, size * static_cast<std::size_t>(width)));
    }
    in.setFrameBuffer(buffer);
    in.readPixels(0, height - 1);
    return planes;
}

std::vector<char> tile(const Plane& p, int width, int height, int n) {
    std::vector<char> out(p.samples.size() * static_cast<std::size_t>(n) * static_cast<std::size_t>(n));
    const auto w = static_cast<std::size_t>(width), h = static_cast<std::size_t>(height),
               copies = static_cast<std::size_t>(n);
    for (std::size_t y = 0; y < h * copies; ++y)
        for (std::size_t x = 0; x < w * copies; ++x) {
            const std::size_t sx = (x / w) % 2 == 0 ? x % w : w - 1 - x % w,
                              sy = (y / h) % 2 == 0 ? y % h : h - 1 - y % h;
            std::memcpy(&out[(y * w * copies + x) * p.size], &p.samples[(sy * w + sx) * p.size], p.size);
        }
    return out;
}

void run(const std::string& from, int n, const std::string& to) {
    Imf::InputFile in(from.c_str());
    const auto window = in.header().dataWindow();
    const int width = window.max.x + 1, height = window.max.y + 1;
    std::map<std::string, Plane> planes = read_planes(in, width, height);
    Imf::Header header(width * n, height * n);
    header.compression() = in.header().compression();
    for (auto a = in.header().begin(); a != in.header().end(); ++a)
        if (std::string_view(a.name()).starts_with("cryptomatte/")) header.insert(a.name(), a.attribute());
    Imf::FrameBuffer buffer;
    for (auto& [name, plane] : planes) {
        plane.samples = tile(plane, width, height, n);
        header.channels().insert(name, Imf::Channel(plane.type));
        buffer.insert(name, Imf::Slice(plane.type, plane.samples.data(), plane.size,
                                       plane.size * static_cast<std::size_t>(width * n)));
    }
    Imf::OutputFile out(to.c_str(), header);
    out.setFrameBuffer(buffer);
    out.writePixels(height * n);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 4) {
        std::cerr << "usage: bench_mosaic IN.exr N OUT.exr\n";
        return 2;
    }
    Imf::setGlobalThreadCount(static_cast<int>(std::thread::hardware_concurrency()));
    try {
        run(argv[1], std::atoi(argv[2]), argv[3]);
    } catch (const std::exception& e) {
        std::cerr << "error: " << e.what() << '\n';
        return 1;
    }
    return 0;
}
