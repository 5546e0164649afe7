// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tests/nodes/plate.h"

#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <optional>
#include <string>
#include <vector>

// Shading from passes, pixel by pixel and in double, as its definition says it.

namespace keyline::testing {

using V3 = std::array<double, 3>;

inline double dot(const V3& a, const V3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

inline V3 unit(const V3& v) {
    const double length = std::hypot(v[0], v[1], v[2]);
    return length == 0 ? V3{} : V3{v[0] / length, v[1] / length, v[2] / length};
}

inline V3 minus(const V3& a, const V3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

inline double smoothstep(double low, double high, double x) {
    if (!(x < high)) return std::isnan(x) ? 0 : 1;
    const double t = x <= low ? 0 : (x - low) / (high - low);
    return t * t * (3 - 2 * t);
}

inline double mix(double a, double b, double t) { return a * (1 - t) + b * t; }

struct TestLight {
    std::optional<V3> direction = {}, position = {};
    int falloff = 0;
    V3 color{1, 1, 1};
    double intensity = 1;
    std::string shadow = {};
};

struct LightHere {
    V3 L, C;
    double v;
};

struct PixelHere {
    V3 Cs, N, P;
    double Os;
    std::vector<LightHere> lights;
};

// The images of a shading node's inputs by port name (and by node name for the lights' shadows), and its
// lights.
struct ShadedScene {
    std::map<std::string, Image> images;
    std::vector<TestLight> lights;
    bool colored_lights = true;

    V3 vector(const std::string& image, int x, int y) const {
        const Image& i = images.at(image);
        return {double{i.at("X", x, y)}, double{i.at("Y", x, y)}, double{i.at("Z", x, y)}};
    }
    double matte(const std::string& image, int x, int y) const {
        return images.contains(image) ? double{images.at(image).at("A", x, y)} : 1.0;
    }

    LightHere light_at(const TestLight& light, const PixelHere& p, int x, int y) const {
        const V3 to = light.direction ? *light.direction : minus(*light.position, p.P);
        LightHere out{unit(to), light.color, 0};
        const double shadow = matte("shadow", x, y) * matte(light.shadow, x, y);
        for (double& c : out.C) c *= light.intensity * shadow / (light.falloff == 2 ? dot(to, to) : 1.0);
        out.v = 0.5 * (1 + dot(out.L, p.N));
        return out;
    }

    PixelHere at(int x, int y) const {
        const Image& albedo = images.at("albedo");
        PixelHere p;
        const bool has_alpha = albedo.has("A");
        p.Os = images.contains("coverage") ? matte("coverage", x, y) : has_alpha ? albedo.at("A", x, y) : 1.0;
        const char* names[] = {"R", "G", "B"};
        for (std::size_t c = 0; c < 3; ++c) {
            p.Cs[c] = double{albedo.at(names[c], x, y)};
            if (has_alpha) p.Cs[c] = p.Os == 0 ? 0 : p.Cs[c] / p.Os;
        }
        p.N = unit(vector("normal", x, y));
        if (images.contains("position")) p.P = vector("position", x, y);
        for (const TestLight& light : lights) p.lights.push_back(light_at(light, p, x, y));
        return p;
    }

    // The node's result where `color` is C.
    Image shaded(const std::function<V3(const PixelHere&)>& color) const {
        const Image& albedo = images.at("albedo");
        Image out(albedo.window, {"R", "G", "B", "A", "Y"});
        out.display = albedo.display;
        for (int y = out.window.y0; y < out.window.y1; ++y)
            for (int x = out.window.x0; x < out.window.x1; ++x) {
                const PixelHere p = at(x, y);
                if (p.N == V3{} || p.Os == 0) continue;
                const V3 C = color(p);
                out.at("R", x, y) = static_cast<float>(p.Os * C[0]);
                out.at("G", x, y) = static_cast<float>(p.Os * C[1]);
                out.at("B", x, y) = static_cast<float>(p.Os * C[2]);
                out.at("A", x, y) = static_cast<float>(p.Os);
                out.at("Y", x, y) = static_cast<float>(p.Os * (0.299 * C[0] + 0.587 * C[1] + 0.114 * C[2]));
            }
        return out;
    }

    std::string lights_json() const {
        std::string out;
        const auto list = [](const V3& v) { return fmt::format("[{}, {}, {}]", v[0], v[1], v[2]); };
        for (const TestLight& l : lights) {
            out += out.empty() ? "{ " : ", { ";
            out +=
                l.direction ? "\"direction\": " + list(*l.direction) : "\"position\": " + list(*l.position);
            if (colored_lights)
                out += fmt::format(", \"color\": {}, \"intensity\": {}, \"falloff\": {}", list(l.color),
                                   l.intensity, l.falloff);
            if (!l.shadow.empty()) out += fmt::format(", \"shadow\": \"{}\"", l.shadow);
            out += " }";
        }
        return "[" + out + "]";
    }

    // What the node makes of it.
    Image run(const std::string& type, Json params, const RunOptions& options = {}) const {
        for (const char* port : {"albedo", "coverage", "normal", "position", "shadow"})
            if (images.contains(port)) params.set(port, port);
        params.set("type", type).set("lights", Json::verbatim(lights_json()));
        return run_graph(Json{{"shaded", params}}, "shaded", images, options);
    }
    std::string error(const std::string& type, const Json& params = {}) const {
        try {
            run(type, params);
        } catch (const Failure& f) {
            return f.what();
        }
        return "";
    }
};

// Every input there is, at random; normals of all lengths, and none at one pixel of eight.
inline ShadedScene random_scene(const Rect& window, unsigned seed, bool premultiplied) {
    ShadedScene scene;
    scene.images["albedo"] = noise(window, {"R", "G", "B"}, seed, 0, 0.9F);
    if (premultiplied) scene.images["albedo"] = noise(window, {"R", "G", "B", "A"}, seed, 0.1F, 0.9F);
    scene.images["normal"] = noise(window, {"X", "Y", "Z"}, seed + 1, -1, 1);
    scene.images["position"] = noise(window, {"X", "Y", "Z"}, seed + 2, -1, 1);
    scene.images["shadow"] = noise(window, {"A"}, seed + 3);
    scene.images["mine"] = noise(window, {"A"}, seed + 4);
    for (const char* channel : {"X", "Y", "Z"})
        scene.images["normal"].fill(channel, [&](int x, int y) {
            return (x + 3 * y) % 8 == 0 ? 0 : scene.images["normal"].at(channel, x, y);
        });
    return scene;
}

// Albedo, coverage and normals of a render, lit from both sides.
inline ShadedScene plate_scene() {
    ShadedScene scene;
    scene.images["albedo"] = plate("ViewLayer.DiffCol", {"R", "G", "B"});
    scene.images["coverage"] = plate("ViewLayer.Combined", {"A"});
    scene.images["normal"] = plate("ViewLayer.Normal", {"X", "Y", "Z"});
    scene.lights = {{.direction = V3{1, -1, 1.5}}, {.direction = V3{-2, -1, 0.3}, .intensity = 0.5}};
    return scene;
}

inline const V3 kRed{1, 0.3, 0.2}, kBlue{0.2, 0.5, 1};

// Lights of every kind.
inline std::vector<TestLight> mixed_lights() {
    return {{.direction = V3{0.3, -2, 1}, .color = kRed, .intensity = 0.7},
            {.position = V3{2, 1.5, -2}, .color = kBlue},
            {.position = V3{-2, 1, 2}, .falloff = 2, .intensity = 3, .shadow = "mine"}};
}

}  // namespace keyline::testing
