// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/support/image.h"

#include "engine/base/channels.h"
#include "engine/io/image_sink.h"
#include "engine/io/image_source.h"
#include "engine/run/bands.h"
#include "engine/simd/half.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <fmt/format.h>
#include <limits>
#include <ostream>
#include <random>
#include <stdexcept>

namespace keyline {

std::ostream& operator<<(std::ostream& out, const Rect& r) {
    return out << '[' << r.x0 << ',' << r.y0 << " to " << r.x1 << ',' << r.y1 << ')';
}

}  // namespace keyline

namespace keyline::testing {

namespace {

std::size_t offset(const Image& image, int x, int y) {
    return static_cast<std::size_t>(y - image.window.y0) * static_cast<std::size_t>(image.window.width()) +
           static_cast<std::size_t>(x - image.window.x0);
}

bool same_sample(float a, float b) {
    return (std::isnan(a) && std::isnan(b)) || std::bit_cast<uint32_t>(a) == std::bit_cast<uint32_t>(b);
}

bool near(float a, float b, double tolerance) {
    return a == b || std::abs(static_cast<double>(a) - static_cast<double>(b)) <= tolerance;
}

// equal(a, b, x, y) decides on two samples.
template <class Equal>
::testing::AssertionResult compare(const Image& a, const Image& b, Equal equal) {
    if (!(a.display == b.display) || !(a.window == b.window))
        return ::testing::AssertionFailure() << "windows differ: display " << a.display << " and "
                                             << b.display << ", data " << a.window << " and " << b.window;
    if (a.channels.size() != b.channels.size())
        return ::testing::AssertionFailure() << "channels differ:\n" << a << b;
    for (std::size_t c = 0; c < a.channels.size(); ++c) {
        if (a.channels[c].name != b.channels[c].name)
            return ::testing::AssertionFailure() << "channels differ:\n" << a << b;
        for (int y = a.window.y0; y < a.window.y1; ++y)
            for (int x = a.window.x0; x < a.window.x1; ++x) {
                const float va = a.channels[c].samples[offset(a, x, y)],
                            vb = b.channels[c].samples[offset(b, x, y)];
                if (same_sample(va, vb) || equal(va, vb, x, y)) continue;
                return ::testing::AssertionFailure() << "channel '" << a.channels[c].name << "' differs at "
                                                     << x << ',' << y << ": " << va << " and " << vb << '\n'
                                                     << a << b;
            }
    }
    return ::testing::AssertionSuccess();
}

}  // namespace

Image::Image(const Rect& w, std::initializer_list<std::string> names)
    : Image(w, std::vector<std::string>(names)) {}

Image::Image(const Rect& w, const std::vector<std::string>& names) : display(w), window(w) {
    for (const std::string& name : names)
        channels.push_back(
            {name, SampleType::kFloat, std::vector<float>(static_cast<std::size_t>(w.area()))});
}

bool Image::has(std::string_view name) const {
    return std::ranges::find(channels, name, &Channel::name) != channels.end();
}

const Image::Channel& Image::channel(std::string_view name) const {
    const auto it = std::ranges::find(channels, name, &Channel::name);
    if (it == channels.end()) throw std::out_of_range("the image has no channel " + std::string(name));
    return *it;
}

Image::Channel& Image::channel(std::string_view name) {
    return const_cast<Channel&>(std::as_const(*this).channel(name));
}

float Image::at(std::string_view name, int x, int y) const {
    return window.contains(x, y) ? channel(name).samples[offset(*this, x, y)] : 0.0F;
}

float& Image::at(std::string_view name, int x, int y) {
    return channel(name).samples.at(offset(*this, x, y));
}

Image ascii(std::initializer_list<std::string_view> rows, const std::string& channel) {
    const int width = rows.size() == 0 ? 0 : static_cast<int>(rows.begin()->size());
    Image image({0, 0, width, static_cast<int>(rows.size())}, {channel});
    return image.fill(channel, [&](int x, int y) {
        const char c = rows.begin()[y][static_cast<std::size_t>(x)];
        if (c == 'x') return std::numeric_limits<float>::quiet_NaN();
        return c == '.' ? 0.0F : static_cast<float>(c - '0');
    });
}

Image only(const Image& image, const std::vector<std::string>& names) {
    Image out = image;
    out.channels.clear();
    for (const std::string& name : names) out.channels.push_back(image.channel(name));
    return out;
}

Image layer_of(const Image& image, const std::string& layer) {
    Image out = image;
    std::erase_if(out.channels,
                  [&](const Image::Channel& c) { return split_channel(c.name).layer != layer; });
    for (Image::Channel& c : out.channels) c.name = split_channel(c.name).base;
    return out;
}

Image limited(Image image, float most) {
    for (Image::Channel& c : image.channels)
        for (float& s : c.samples) s = std::min(s, most);
    return image;
}

Image cropped(const Image& image, const Rect& window) {
    Image out = image;
    out.display = out.window = window;
    for (Image::Channel& c : out.channels) {
        c.samples.assign(static_cast<std::size_t>(window.area()), 0);
        out.fill(c.name, [&](int x, int y) { return image.at(c.name, x, y); });
    }
    return out;
}

Image moved(Image image, int dx, int dy) {
    image.display = translate(image.display, dx, dy);
    image.window = translate(image.window, dx, dy);
    return image;
}

Image noise(const Rect& window, const std::vector<std::string>& names, unsigned seed, float low, float high) {
    Image image(window, names);
    std::mt19937 random(seed);
    for (Image::Channel& c : image.channels)
        for (float& s : c.samples) s = low + (high - low) * static_cast<float>(random() >> 8) / 16777216.0F;
    return image;
}

Image read_exr(const std::string& file) {
    const auto source = open_image(file);
    const ImageHeader& header = source->header();
    Image image(header.data_window, std::vector<std::string>{});
    image.display = header.display_window;
    image.metadata = header.metadata;
    for (std::size_t g = 0; g < header.groups.size(); ++g) {
        const ChannelGroup& group = header.groups[g];
        const auto samples = static_cast<std::size_t>(group.window.area());
        std::vector<std::vector<std::byte>> memory;
        std::vector<Plane> planes;
        for (const ChannelInfo& c : group.channels) {
            memory.emplace_back(samples * sample_size(c.type));
            planes.push_back({memory.back().data(),
                              static_cast<std::ptrdiff_t>(sample_size(c.type)) * group.window.width(), c.type,
                              group.window});
        }
        for (int row = 0; row < group.rows(); ++row)
            for (int column = 0; column < group.columns(); ++column)
                source->read_chunk(g, column, row, planes);
        for (std::size_t c = 0; c < planes.size(); ++c) {
            Image part(group.window, {"Y"});
            float* out = part.channels[0].samples.data();
            const std::byte* in = memory[c].data();
            if (planes[c].type == SampleType::kHalf)
                simd::half_to_float(reinterpret_cast<const uint16_t*>(in), out, samples);
            else if (planes[c].type == SampleType::kUint)
                simd::uint_to_float(reinterpret_cast<const uint32_t*>(in), out, samples);
            else
                std::memcpy(out, in, samples * sizeof(float));
            image.channels.push_back({group.channels[c].name, planes[c].type,
                                      std::vector<float>(static_cast<std::size_t>(image.window.area()))});
            image.fill(group.channels[c].name, [&](int x, int y) { return part.at("Y", x, y); });
        }
    }
    return image;
}

namespace {

// Inside the engine the sample of an integer channel is the integer's bits.
void as_integer_bits(std::vector<float>& samples) {
    std::vector<uint32_t> integers(samples.size());
    simd::float_to_uint(samples.data(), integers.data(), samples.size());
    std::memcpy(samples.data(), integers.data(), samples.size() * sizeof(float));
}

}  // namespace

void write_exr(const std::string& file, const Image& image) {
    SinkSpec spec{image.display, image.window, {}, image.metadata, Depth::kAuto, "zip"};
    for (const Image::Channel& c : image.channels) spec.channels.push_back({c.name, c.type});
    const auto sink = create_image(file, spec);
    for (int i = 0, y = sink->region().y0; y < sink->region().y1; ++i, y += sink->chunk_height()) {
        const Rect chunk =
            intersect(sink->region(), {sink->region().x0, y, sink->region().x1, y + sink->chunk_height()});
        std::vector<Bands> bands;
        std::vector<Plane> planes;
        for (std::size_t c = 0; c < image.channels.size(); ++c) {
            Bands& band =
                bands.emplace_back(chunk, std::vector{sink->channels()[c].type}, chunk.y0, chunk.height());
            band.allocate(0, true);
            Image part = cropped(only(image, {image.channels[c].name}), chunk);
            if (sink->channels()[c].type == SampleType::kUint) as_integer_bits(part.channels[0].samples);
            band.store(0, {part.channels[0].samples.data(), chunk.width(), chunk, chunk});
            planes.push_back(band.plane(0, 0));
        }
        sink->commit(sink->encode(i, planes));
    }
    sink->finish();
}

Image plate(const std::string& layer, int frame) {
    const Image all = read_exr(fmt::format(KEYLINE_GRAPHS "/plates/street.{:04}.exr", frame));
    return limited(layer_of(all, "ViewLayer." + layer), 16);
}

Image largest_within(const Image& image, int reach) {
    Image across(image.window, {"Y"}), out(image.window, {"Y"});
    across.fill("Y", [&](int x, int y) {
        float most = 0;
        for (const Image::Channel& c : image.channels)
            for (int dx = -reach; dx <= reach; ++dx)
                most = std::fmax(most, std::abs(image.at(c.name, x + dx, y)));
        return most;
    });
    return out.fill("Y", [&](int x, int y) {
        float most = 0;
        for (int dy = -reach; dy <= reach; ++dy)
            most = std::max(most, std::as_const(across).at("Y", x, y + dy));
        return most;
    });
}

bool same(const Image& a, const Image& b) {
    const auto same_bits = [](const Image::Channel& x, const Image::Channel& y) {
        return std::ranges::equal(x.samples, y.samples, {}, std::bit_cast<uint32_t, float>,
                                  std::bit_cast<uint32_t, float>);
    };
    return compare_images("", "", a, b) && std::ranges::equal(a.channels, b.channels, same_bits);
}

std::ostream& operator<<(std::ostream& out, const Image& image) {
    out << "image, display " << image.display << ", data " << image.window << '\n';
    for (const Image::Channel& c : image.channels) {
        out << "  " << c.name << '\n';
        if (image.window.width() > 24 || image.window.height() > 24) continue;
        for (int y = image.window.y0; y < image.window.y1; ++y) {
            out << "   ";
            for (int x = image.window.x0; x < image.window.x1; ++x)
                out << ' ' << c.samples[offset(image, x, y)];
            out << '\n';
        }
    }
    return out;
}

::testing::AssertionResult compare_images(const char*, const char*, const Image& a, const Image& b) {
    return compare(a, b, [](float, float, int, int) { return false; });
}

::testing::AssertionResult compare_images_near(const char*, const char*, const char*, const Image& a,
                                               const Image& b, double tolerance) {
    return compare(a, b, [&](float va, float vb, int, int) { return near(va, vb, tolerance); });
}

::testing::AssertionResult agree_within_reach(const Image& a, const Image& b, const Image& in, int reach) {
    const Image largest = largest_within(in, reach);
    return compare(a, b, [&](float va, float vb, int x, int y) {
        return near(va, vb, 1e-5 * static_cast<double>(largest.at("Y", x, y)));
    });
}

}  // namespace keyline::testing
