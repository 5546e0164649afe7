// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/lights.h"

#include <cmath>
#include <fmt/format.h>

namespace keyline {

namespace {

constexpr const char* kLights = "lights";

// Its largest component first becomes 1, so that no square overflows.
std::array<double, 3> unit(const std::array<double, 3>& v) {
    const double most = std::max({std::abs(v[0]), std::abs(v[1]), std::abs(v[2])});
    const double x = v[0] / most, y = v[1] / most, z = v[2] / most;
    const double length = std::sqrt(x * x + y * y + z * z);
    return {x / length, y / length, z / length};
}

Lighting::Item placed(const LightPlace& place) {
    Lighting::Item item;
    if (place.direction)
        item.toward = unit(*place.direction);
    else
        item.position = place.position.value();
    return item;
}

std::span<double> take_row(Scratch& scratch) { return scratch.take<double>(kRunLength); }

const float* matte_row(std::span<const View> views, const RowPart& run) {
    return views.empty() ? nullptr : views[0].at(run.x, run.y);
}

}  // namespace

void check_place(const LightPlace& place, std::size_t item, bool has_position, Check& check) {
    const std::string light = fmt::format("light {}", item + 1);
    if (place.direction && place.position)
        check.error(kLights, item, light + " has both a 'direction' and a 'position'",
                    "leave one of them out");
    else if (place.position && !has_position)
        check.error(kLights, item, light + " has a 'position', but the node's input 'position' is missing",
                    "connect the position pass, or give the light a 'direction'");
    else if (!place.direction && !place.position)
        check.error(kLights, item, light + " has neither a 'direction' nor a 'position'", "give it one");
    else if (place.direction == std::array<double, 3>{})
        check.error(kLights, item, fmt::format("the 'direction' of {} is [0, 0, 0]", light),
                    "give the vector towards the light, such as [0, 0, 1]");
}

void check_light(const LightPlace& light, std::size_t item, bool has_position, Check& check) {
    check_place(light, item, has_position, check);
}

void check_light(const Light& light, std::size_t item, bool has_position, Check& check) {
    check_place(light, item, has_position, check);
    if (light.falloff == 1)
        check.error(kLights, item,
                    fmt::format("the 'falloff' of light {} is 1; it must be 0 or 2", item + 1));
    else if (light.falloff != 0 && light.direction)
        check.error(kLights, item,
                    fmt::format("light {} has a 'falloff' of {}, but no place to measure distances from",
                                item + 1, light.falloff),
                    "give it a 'position' instead of its 'direction', or leave 'falloff' out");
}

void no_lights(Check& check) {
    check.error(kLights, "'lights' is empty",
                R"(give one light at least, such as { "direction": [0, 0, 1] })");
}

simd::ShadedRows shaded_rows(Outputs out, const RowPart& run) {
    const auto row = [&](std::size_t c) { return out[c].at(run.x, run.y); };
    return {row(0), row(1), row(2), row(3), row(4)};
}

simd::XyzRows xyz_rows(std::span<const View> views, const RowPart& run) {
    return {views[0].at(run.x, run.y), views[1].at(run.x, run.y), views[2].at(run.x, run.y)};
}

simd::UnitRows take_vectors(Scratch& scratch) {
    return {take_row(scratch).data(), take_row(scratch).data(), take_row(scratch).data()};
}

SurfaceRun::SurfaceRun(const Surface& surface, const Inputs& in, Scratch& scratch)
    : albedo_(in[surface.albedo]),
      coverage_(in[surface.coverage]),
      normals_(in[surface.normal]),
      normal_(take_vectors(scratch)),
      covered_(take_row(scratch)),
      rows_{nullptr, nullptr, nullptr, albedo_.size() > 3, covered_.data()} {
    if (coverage_.empty()) coverage_ = albedo_.subspan(3);
}

void SurfaceRun::read(const RowPart& run) {
    simd::unit_row(xyz_rows(normals_, run), run.n, normal_);
    simd::covered_row(matte_row(coverage_, run), normal_, run.n, covered_.data());
    rows_.r = albedo_[0].at(run.x, run.y);
    rows_.g = albedo_[1].at(run.x, run.y);
    rows_.b = albedo_[2].at(run.x, run.y);
}

Lighting::Lighting(const std::vector<LightPlace>& lights) {
    for (const LightPlace& light : lights) items_.push_back(placed(light));
}

Lighting::Lighting(const std::vector<Light>& lights) {
    for (const Light& light : lights) {
        Item item = placed(light);
        item.color = {light.color.r * light.intensity, light.color.g * light.intensity,
                      light.color.b * light.intensity};
        item.falls_off = light.falloff == 2;
        item.shadow = light.shadow;
        items_.push_back(item);
    }
}

LightRun::LightRun(const Lighting& lights, const std::optional<Input>& position,
                   const std::optional<Input>& shadow, const Inputs& in, Scratch& scratch)
    : lights_(lights),
      in_(in),
      position_(in[position]),
      shadow_(in[shadow]),
      toward_(take_vectors(scratch)),
      inverse_square_(take_row(scratch).data()),
      memory_(scratch.take<Memory>(lights.size())),
      rows_(scratch.take<simd::LightRows>(lights.size())) {
    for (Memory& m : memory_)
        m = {take_row(scratch).data(), take_row(scratch).data(), take_row(scratch).data()};
}

void LightRun::read(const RowPart& run, const simd::UnitRows& normal, const simd::UnitRows* eye) {
    for (std::size_t i = 0; i < lights_.size(); ++i) {
        const Lighting::Item& light = lights_.items()[i];
        const Memory& m = memory_[i];
        const auto meet = [&](const auto& toward) {
            simd::dot_row(normal, toward, run.n, m.facing);
            if (eye != nullptr) simd::dot_row(*eye, toward, run.n, m.own);
        };
        if (light.toward) {
            meet(*light.toward);
        } else {
            simd::toward_row(xyz_rows(position_, run), light.position, run.n, toward_, inverse_square_);
            meet(toward_);
        }
        const double* falloff = light.falls_off ? inverse_square_ : nullptr;
        const float *own = matte_row(in_[light.shadow], run), *shared = matte_row(shadow_, run);
        const bool whole = falloff == nullptr && own == nullptr && shared == nullptr;
        if (!whole) simd::reach_row(falloff, own, shared, run.n, m.reach);
        rows_[i] = {m.facing, whole ? nullptr : m.reach, m.own, light.color};
    }
}

}  // namespace keyline
