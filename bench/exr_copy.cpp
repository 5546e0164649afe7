// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0

// The least that a compositor on OpenEXR's own C++ library would take:  bench_exr_copy IN.exr LAYER OUT.exr
// THREADS [MORE…]  reads the layer's R G B A and writes them as half, ZIP; of more layers it reads all
// channels. Nothing is computed.

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfThreading.h>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

// Channels of layers, as their types are in the file, and where they are read to.
class Layers {
public:
    Layers(const Imf::Header& header, const std::vector<std::string>& layers, Imf::FrameBuffer& to) {
        const auto window = header.dataWindow();
        const auto width = static_cast<std::size_t>(window.max.x - window.min.x + 1),
                   height = static_cast<std::size_t>(window.max.y - window.min.y + 1);
        for (const std::string& layer : layers) {
            Imf::ChannelList::ConstIterator c, end;
            header.channels().channelsInLayer(layer, c, end);
            if (c == end) throw std::invalid_argument("there is no layer " + layer);
            for (; c != end; ++c) {
                const std::size_t size = c.channel().type == Imf::HALF ? 2 : 4;
                samples_.emplace_back(size * width * height);
                to.insert(c.name(), Imf::Slice::Make(c.channel().type, samples_.back().data(), window, size,
                                                     size * width));
            }
        }
    }

private:
    std::vector<std::vector<char>> samples_;
};

void run(const std::string& from, const std::string& layer, const std::string& to,
         const std::vector<std::string>& more) {
    Imf::InputFile in(from.c_str());
    const auto window = in.header().dataWindow();
    const int width = window.max.x - window.min.x + 1, height = window.max.y - window.min.y + 1;
    const std::size_t samples = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    std::vector<uint16_t> pixels(4 * samples);
    Imf::FrameBuffer input, output;
    Imf::Header header(in.header().displayWindow(), window);
    header.compression() = Imf::ZIP_COMPRESSION;
    std::size_t plane = 0;
    for (const char* channel : {"R", "G", "B", "A"}) {
        char* base = reinterpret_cast<char*>(&pixels[samples * plane++]);
        const auto slice = Imf::Slice::Make(Imf::HALF, base, window, 2, 2 * static_cast<std::size_t>(width));
        input.insert(layer + "." + channel, slice);
        output.insert(channel, slice);
        header.channels().insert(channel, Imf::Channel(Imf::HALF));
    }
    const Layers read_only(in.header(), more, input);
    in.setFrameBuffer(input);
    in.readPixels(window.min.y, window.max.y);
    Imf::OutputFile out(to.c_str(), header);
    out.setFrameBuffer(output);
    out.writePixels(height);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 5) {
        std::cerr << "usage: bench_exr_copy IN.exr LAYER OUT.exr THREADS [MORE_LAYERS...]\n";
        return 2;
    }
    const int threads = std::atoi(argv[4]);
    Imf::setGlobalThreadCount(threads > 1 ? threads : 0);
    try {
        run(argv[1], argv[2], argv[3], {argv + 5, argv + argc});
    } catch (const std::exception& e) {
        std::cerr << "error: " << e.what() << '\n';
        return 1;
    }
    return 0;
}
