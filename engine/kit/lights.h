// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/node/node_adaptor.h"
#include "engine/simd/shading.h"

#include <algorithm>

// What the nodes that shade from passes have in common: the surface, and the lights on it.

namespace KEYLINE_API keyline {

// Where a light is: one of the two.
struct LightPlace {
    std::optional<std::array<double, 3>> direction, position;

    static constexpr auto fields =
        declare(field(&LightPlace::direction, "direction",
                      "Towards a light so far away that it comes from there for every pixel; of any length."),
                field(&LightPlace::position, "position",
                      "Where a near light is, in world space; the node then needs its 'position' input."));
};

struct Light : LightPlace {
    int falloff = 0;
    Color color{1, 1, 1};
    double intensity = 1;
    std::optional<Input> shadow;

    static constexpr auto fields =
        declare(field(&Light::direction, "direction", std::get<0>(LightPlace::fields).help),
                field(&Light::position, "position", std::get<1>(LightPlace::fields).help),
                field(&Light::falloff, "falloff",
                      "0: as bright from everywhere; 2: divided by the square of the distance to 'position'.",
                      between(0, 2)),
                field(&Light::color, "color", "Of its light."),
                field(&Light::intensity, "intensity", "By how much its colour is multiplied."),
                input(&Light::shadow, "shadow", "Where the light arrives: 1 is lit, 0 in shadow.", matte()));
};

// Reports lights that are nowhere or in two places, and those that need a connected `position`.
void check_place(const LightPlace& place, std::size_t item, bool has_position, Check& check);
void check_light(const LightPlace& light, std::size_t item, bool has_position, Check& check);
void check_light(const Light& light, std::size_t item, bool has_position, Check& check);
void no_lights(Check& check);

template <class L>
void check_lights(const std::vector<L>& lights, bool has_position, Check& check) {
    if (lights.empty()) no_lights(check);
    for (std::size_t i = 0; i < lights.size(); ++i) check_light(lights[i], i, has_position, check);
}

// Base of the Params of a node that shades.
struct Surface {
    Input albedo;
    std::optional<Input> coverage;
    Input normal;
};

// Whether an optional port is this one.
inline bool is_input(const std::optional<Input>& port, const Input& in) {
    return port && port->slot == in.slot;
}

// The inputs of Surface, then the node's own fields.
template <class... Fields>
constexpr auto declare_surface(Fields... own) {
    return declare(
        input(&Surface::albedo, "albedo",
              "The colour of the surfaces, without light; with an A it counts as multiplied by 'coverage'.",
              colour()),
        input(&Surface::coverage, "coverage",
              "How much of a pixel is surface; else the albedo's A, or all of it.", matte()),
        input(&Surface::normal, "normal",
              "In world space, of any length; where it is 0 0 0 the result is black and transparent.",
              named("X", "Y", "Z")),
        own...);
}

inline constexpr std::array kShadedChannels{"R", "G", "B", "A", "Y"};

// Some pixels of one row; what is known of them stays in the cache.
struct RowPart {
    int x, y, n;
};
inline constexpr int kRunLength = 256;

// Calls body(RowPart) until the rectangle is covered.
template <class Body>
void for_each_run(const Rect& rect, const Body& body) {
    for (int y = rect.y0; y < rect.y1; ++y)
        for (int x = rect.x0; x < rect.x1; x += kRunLength)
            body(RowPart{x, y, std::min(kRunLength, rect.x1 - x)});
}

simd::ShadedRows shaded_rows(Outputs out, const RowPart& run);

// X Y Z of an input.
simd::XyzRows xyz_rows(std::span<const View> views, const RowPart& run);

// Rows of vectors for one run after the other, in a worker's scratch memory.
simd::UnitRows take_vectors(Scratch& scratch);

// The surface that a run of pixels shows.
class SurfaceRun {
public:
    SurfaceRun(const Surface& surface, const Inputs& in, Scratch& scratch);

    void read(const RowPart& run);
    const simd::SurfaceRows& rows() const { return rows_; }
    const simd::UnitRows& normal() const { return normal_; }

private:
    std::span<const View> albedo_, coverage_, normals_;
    simd::UnitRows normal_;
    std::span<double> covered_;
    simd::SurfaceRows rows_;
};

// Lights made ready for the kernels; shared by all threads.
class Lighting {
public:
    explicit Lighting(const std::vector<LightPlace>& lights);
    explicit Lighting(const std::vector<Light>& lights);

    struct Item {
        std::optional<std::array<double, 3>> toward;  // of length 1; none: from `position`
        std::array<double, 3> position{}, color{1, 1, 1};
        bool falls_off = false;
        std::optional<Input> shadow;
    };
    const std::vector<Item>& items() const { return items_; }
    bool need_position() const {
        return std::ranges::any_of(items_, [](const Item& light) { return !light.toward; });
    }
    std::size_t size() const { return items_.size(); }

private:
    std::vector<Item> items_;
};

// How the lights meet a run of pixels.
class LightRun {
public:
    LightRun(const Lighting& lights, const std::optional<Input>& position, const std::optional<Input>& shadow,
             const Inputs& in, Scratch& scratch);

    // `eye`: the unit vectors to it, where L·V is wanted.
    void read(const RowPart& run, const simd::UnitRows& normal, const simd::UnitRows* eye = nullptr);
    std::span<const simd::LightRows> rows() const { return rows_; }

private:
    struct Memory {
        double *facing, *reach, *own;
    };
    const Lighting& lights_;
    const Inputs& in_;
    std::span<const View> position_, shadow_;
    simd::UnitRows toward_;
    double* inverse_square_;
    std::span<Memory> memory_;
    std::span<simd::LightRows> rows_;
};

}  // namespace keyline
