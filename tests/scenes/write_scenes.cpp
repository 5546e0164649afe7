// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/cryptomatte.h"
#include "engine/kit/strokes_json.h"
#include "tests/support/image.h"
#include "tests/support/scene.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdio>
#include <fmt/format.h>
#include <fstream>
#include <numbers>

// Writes scenes whose lines are known, as a renderer would, with 64 samples a pixel: FOLDER/NAME.exr, and
// FOLDER/NAME.json, the lines.

namespace {

using namespace keyline;
using namespace keyline::testing;

constexpr Rect kFrame{0, 0, 240, 160};
constexpr Camera kCamera{{120, 80}, 240};
constexpr int kSamples = 64;

struct NamedScene {
    const char* name;
    Scene scene;
};

std::vector<Point> star(Point centre, double outer, double inner, int rays, double degrees) {
    std::vector<Point> out;
    for (int i = 0; i < 2 * rays; ++i) {
        const double angle = (degrees + 180.0 * i / rays) * std::numbers::pi / 180;
        const double radius = i % 2 == 0 ? outer : inner;
        out.push_back({centre.x + radius * std::cos(angle), centre.y + radius * std::sin(angle)});
    }
    return out;
}

Scene shapes() {
    return {.window = kFrame,
            .camera = kCamera,
            .things = {disc("wall", {80.3, 71.6}, 52, 9), disc("moon", {131.7, 60.2}, 30, 7),
                       polygon("star", star({170.4, 100.7}, 44, 20, 5, 11), 6),
                       disc("coin", {110.2, 112.9}, 12, 5), disc("bead", {148.6, 88.1}, 5, 4)}};
}

Scene balls() {
    constexpr double kGround = 1;
    const Vec3 large{-0.9, 0.1, 6}, small{0.8, 0.65, 4.6};
    constexpr double kLarge = 1.3, kSmall = 0.5;
    return {.window = kFrame,
            .camera = kCamera,
            .things = {ground("ground", kCamera, kGround), sphere("large", kCamera, large, kLarge),
                       sphere("small", kCamera, small, kSmall)},
            .contacts = {contact(kCamera, large, kLarge, kGround), contact(kCamera, small, kSmall, kGround)}};
}

Scene wires() {
    return {
        .window = kFrame,
        .camera = kCamera,
        .things = {disc("behind", {118.3, 84.9}, 48, 9), wire("w0.6", {12.2, 20.7}, {228.1, 41.3}, 0.6, 5),
                   wire("w0.9", {18.4, 141.2}, {221.7, 66.8}, 0.9, 5),
                   wire("w1.4", {60.1, 12.4}, {92.6, 150.3}, 1.4, 6),
                   wire("w3", {150.8, 10.2}, {171.9, 152.7}, 3, 6)}};
}

// A colour for each thing, lit from the upper left: what an edge detector on the picture has.
double shade_of(const Scene& scene, uint32_t id, int x, int y) {
    constexpr std::array kGreys{0.35, 0.7, 0.5, 0.85, 0.2};
    const Point centre{x + 0.5, y + 0.5};
    for (std::size_t i = 0; i < scene.things.size(); ++i) {
        if (cryptomatte_id(scene.things[i].name) != id) continue;
        const auto hit = scene.things[i].hit(centre);
        const Vec3 n = hit ? hit->normal : Vec3{0, 0, 1};
        const double light = std::max(0.0, -0.5 * n.x - 0.6 * n.y + 0.62 * std::fabs(n.z));
        return kGreys[i % kGreys.size()] * (0.35 + 0.65 * light);
    }
    return 0;
}

void add_picture(Image& image, const Scene& scene) {
    Image::Channel picture{"Combined.Y", SampleType::kFloat, {}};
    for (int y = image.window.y0; y < image.window.y1; ++y)
        for (int x = image.window.x0; x < image.window.x1; ++x) {
            double sum = 0;
            for (const auto& [id, coverage] : {std::pair{"CryptoObject00.r", "CryptoObject00.g"},
                                               {"CryptoObject00.b", "CryptoObject00.a"},
                                               {"CryptoObject01.r", "CryptoObject01.g"},
                                               {"CryptoObject01.b", "CryptoObject01.a"}})
                sum += double{image.at(coverage, x, y)} *
                       shade_of(scene, std::bit_cast<uint32_t>(image.at(id, x, y)), x, y);
            picture.samples.push_back(static_cast<float>(sum));
        }
    image.channels.push_back(std::move(picture));
}

// The points of lines that follow each other are a stroke.
Strokes strokes_of(const std::vector<TruePoint>& lines) {
    constexpr double kApart = 0.1;  // pixels: more than points of one line are
    Strokes out{kFrame, kFrame, {}, {}};
    constexpr int kEach = 12;  // of the points, which lie closer than a drawing needs
    const TruePoint* last = nullptr;
    int between = 0;
    for (const TruePoint& p : lines) {
        const bool goes_on = last && last->near == p.near && last->far == p.far &&
                             std::hypot(p.at.x - last->at.x, p.at.y - last->at.y) < kApart;
        if (!goes_on) {
            out.strokes.emplace_back();
            out.strokes.back().kind = StrokeKind::kOutline;
            out.strokes.back().near = cryptomatte_id(p.near);
            out.names.emplace(cryptomatte_id(p.near), p.near);
        }
        last = &p;
        if (goes_on && ++between < kEach) continue;
        between = 0;
        StrokeVertex v;
        v.x = p.at.x;
        v.y = p.at.y;
        out.strokes.back().vertices.push_back(v);
    }
    arrange(out);
    return out;
}

void write(const std::string& folder, const NamedScene& named) {
    Image passes = passes_of(named.scene, kSamples);
    for (Image::Channel& channel : passes.channels) channel.type = SampleType::kFloat;
    add_picture(passes, named.scene);
    write_exr(fmt::format("{}/{}.exr", folder, named.name), passes);
    std::ofstream(fmt::format("{}/{}.json", folder, named.name))
        << strokes_json(strokes_of(lines_of(named.scene)));
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fputs("Usage: keyline_scenes FOLDER\n", stderr);
        return 2;
    }
    for (const NamedScene& scene : {NamedScene{"shapes", shapes()}, {"balls", balls()}, {"wires", wires()}})
        write(argv[1], scene);
    return 0;
}
