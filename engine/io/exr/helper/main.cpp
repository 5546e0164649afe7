// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0

// See ../helper_tasks.h for what it does.  It opens no file and is given no name.

#include "engine/base/geometry.h"
#include "engine/io/exr/helper_tasks.h"
#include "engine/io/helper/server/server.h"

#include <Iex.h>
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfRgbaFile.h>
#include <algorithm>
#include <cstring>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using keyline::HelperInput;
using keyline::HelperRequest;
using keyline::Rect;
using keyline::exr::HelperTask;

class MemoryInput final : public Imf::IStream {
public:
    explicit MemoryInput(const std::vector<char>& bytes) : IStream("the file"), bytes_(bytes) {}

    bool read(char* to, int n) override {
        const auto count = static_cast<uint64_t>(std::max(n, 0));
        if (position_ + count > bytes_.size()) throw Iex::InputExc("it ends too early");
        std::memcpy(to, bytes_.data() + position_, count);
        position_ += count;
        return position_ < bytes_.size();
    }
    uint64_t tellg() override { return position_; }
    void seekg(uint64_t position) override { position_ = std::min<uint64_t>(position, bytes_.size()); }

private:
    const std::vector<char>& bytes_;
    uint64_t position_ = 0;
};

class MemoryOutput final : public Imf::OStream {
public:
    explicit MemoryOutput(std::vector<char>& bytes) : OStream("the file"), bytes_(bytes) {}

    void write(const char* from, int n) override {
        const auto count = static_cast<uint64_t>(std::max(n, 0));
        bytes_.resize(std::max<uint64_t>(bytes_.size(), position_ + count));
        std::memcpy(bytes_.data() + position_, from, count);
        position_ += count;
    }
    uint64_t tellp() override { return position_; }
    void seekp(uint64_t position) override { position_ = position; }

private:
    std::vector<char>& bytes_;
    uint64_t position_ = 0;
};

struct Channel {
    std::string name;
    Imf::Channel info;
    std::size_t size, before;  // bytes of a sample, and of a pixel's that come before
};

// The channels of a file and where their samples lie: row by row, channel by channel.
struct Samples {
    Rect window;
    std::vector<Channel> channels;
    std::size_t pixel_bytes = 0;

    explicit Samples(const Imf::Header& header) {
        const Imath::Box2i& box = header.dataWindow();
        window = {box.min.x, box.min.y, box.max.x + 1, box.max.y + 1};
        for (auto c = header.channels().begin(); c != header.channels().end(); ++c) {
            const std::size_t size = c.channel().type == Imf::HALF ? 2 : 4;
            channels.push_back({c.name(), c.channel(), size, pixel_bytes});
            pixel_bytes += size;
        }
    }

    std::size_t width() const { return static_cast<std::size_t>(window.width()); }
    std::size_t bytes() const { return static_cast<std::size_t>(window.area()) * pixel_bytes; }

    char* at(char* samples, const Channel& c, int y) const {
        return samples + (static_cast<std::size_t>(y - window.y0) * pixel_bytes + c.before) * width();
    }

    // Sampled pixels lie tightly from each row's beginning on, in the rows that are sampled.
    Imf::FrameBuffer buffer(char* samples) const {
        Imf::FrameBuffer buffer;
        for (const Channel& c : channels) {
            const auto xs = c.info.xSampling, ys = c.info.ySampling;
            const std::size_t row = pixel_bytes * width() * static_cast<std::size_t>(ys);
            // The library wants the address that the pixel (0, 0) would have.
            char* origin = at(samples, c, window.y0) - window.x0 / xs * static_cast<std::ptrdiff_t>(c.size) -
                           window.y0 / ys * static_cast<std::ptrdiff_t>(row);
            buffer.insert(c.name, Imf::Slice(c.info.type, origin, c.size, row, xs, ys));
        }
        return buffer;
    }

    // Repeats each sample over the pixels that it stands for: along its row from the end on, then the row.
    void repeat_subsampled(char* samples) const {
        for (const Channel& c : channels) {
            const auto xs = static_cast<std::size_t>(c.info.xSampling);
            for (int y = window.y0; y < window.y1; ++y) {
                const int sampled = window.y0 + (y - window.y0) / c.info.ySampling * c.info.ySampling;
                char* row = at(samples, c, y);
                if (sampled != y)
                    std::memcpy(row, at(samples, c, sampled), c.size * width());
                else if (xs > 1)
                    for (std::size_t x = width(); x-- > 0;)
                        std::memmove(row + x * c.size, row + x / xs * c.size, c.size);
            }
        }
    }
};

// The rows that are wanted of samples that lie row by row.
std::vector<char> wanted_rows(std::vector<char> samples, const Rect& window, const HelperRequest& request) {
    if (window.empty() || request.first_row < window.y0 || request.rows < 0 ||
        request.rows > window.y1 - request.first_row)
        throw std::runtime_error("it has other rows than it should");
    const std::size_t row = samples.size() / static_cast<std::size_t>(window.height());
    const auto begin = samples.begin() + static_cast<std::ptrdiff_t>(
                                             static_cast<std::size_t>(request.first_row - window.y0) * row);
    return {begin, begin + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(request.rows) * row)};
}

std::vector<char> unpack(Imf::InputFile& file, const Samples& layout) {
    std::vector<char> samples(layout.bytes());
    file.setFrameBuffer(layout.buffer(samples.data()));
    file.readPixels(layout.window.y0, layout.window.y1 - 1);
    layout.repeat_subsampled(samples.data());
    return samples;
}

std::vector<char> unpack(const std::vector<char>& bytes, const HelperRequest& request) {
    MemoryInput stream(bytes);
    Imf::InputFile file(stream, 0);
    const Samples layout(file.header());
    return wanted_rows(unpack(file, layout), layout.window, request);
}

std::vector<char> unpack_as_rgba(const std::vector<char>& bytes, const HelperRequest& request) {
    MemoryInput stream(bytes);
    Imf::RgbaInputFile file(stream, 0);
    const Imath::Box2i box = file.dataWindow();
    const Rect window{box.min.x, box.min.y, box.max.x + 1, box.max.y + 1};
    const auto width = static_cast<std::size_t>(window.width());
    std::vector<Imf::Rgba> row(width);
    const bool has_alpha = (file.channels() & Imf::WRITE_A) != 0;
    std::vector<char> samples;
    const auto add = [&](half Imf::Rgba::*channel) {
        for (const Imf::Rgba& pixel : row) {
            const uint16_t bits = (pixel.*channel).bits();
            samples.push_back(static_cast<char>(bits & 0xFF));
            samples.push_back(static_cast<char>(bits >> 8));
        }
    };
    file.setFrameBuffer(row.data() - window.x0, 1, 0);
    for (int y = window.y0; y < window.y1; ++y) {
        file.readPixels(y);
        if (has_alpha) add(&Imf::Rgba::a);
        add(&Imf::Rgba::b);
        add(&Imf::Rgba::g);
        add(&Imf::Rgba::r);
    }
    return wanted_rows(std::move(samples), window, request);
}

std::vector<char> pack(const std::vector<char>& bytes, Imf::Compression compression) {
    MemoryInput stream(bytes);
    Imf::InputFile file(stream, 0);
    const Samples layout(file.header());
    std::vector<char> samples = unpack(file, layout);
    std::vector<char> packed;
    MemoryOutput output(packed);
    {
        Imf::Header header = file.header();
        header.compression() = compression;
        Imf::OutputFile out(output, header, 0);
        out.setFrameBuffer(layout.buffer(samples.data()));
        out.writePixels(layout.window.height());
    }
    MemoryInput again(packed);
    Imf::InputFile whole(again, 0);
    const char* chunk = nullptr;
    int size = 0;
    whole.rawPixelData(layout.window.y0, chunk, size);
    return {chunk, chunk + size};
}

std::vector<char> perform_task(const HelperRequest& request, const std::vector<char>& file) {
    const auto task = static_cast<HelperTask>(request.task);
    if (task == HelperTask::kUnpack) return unpack(file, request);
    if (task == HelperTask::kUnpackAsRgba) return unpack_as_rgba(file, request);
    return pack(file,
                static_cast<Imf::Compression>(request.task - static_cast<uint32_t>(HelperTask::kPackFirst)));
}

std::vector<std::byte> perform(const HelperInput& input) {
    const auto* file = reinterpret_cast<const char*>(input.bytes.data());
    const std::vector<char> out = perform_task(input.request, {file, file + input.bytes.size()});
    const auto bytes = std::as_bytes(std::span(out));
    return {bytes.begin(), bytes.end()};
}

}  // namespace

int main() {
    return keyline::serve([] { return perform; });
}
