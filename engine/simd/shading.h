// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"

#include <array>
#include <span>

// Shading from passes, on rows; rows.h says what is common to all kernels.  In double throughout: the edge of
// a tone multiplies what was lost before it by a hundred.

namespace KEYLINE_API keyline {
namespace simd {

struct XyzRows {
    const float *x, *y, *z;
};
struct UnitRows {
    double *x, *y, *z;
};

// out = v ÷ |v|; 0 0 0 where the length is 0 or infinite.
void unit_row(const XyzRows& v, int n, const UnitRows& out);

// The unit vector from each position to a point, 0 0 0 at the point itself, and 1 ÷ distance², there 0.
void toward_row(const XyzRows& position, const std::array<double, 3>& point, int n, const UnitRows& out,
                double* inverse_square);

// out = a · b
void dot_row(const UnitRows& a, const std::array<double, 3>& b, int n, double* out);
void dot_row(const UnitRows& a, const UnitRows& b, int n, double* out);

// out = coverage (null: 1), but 0 where the normal is 0 0 0.
void covered_row(const float* coverage, const UnitRows& normal, int n, double* out);

// out = by × a × b; null ones are 1.
void reach_row(const double* by, const float* a, const float* b, int n, double* out);

// A colour Cs on part of each pixel, Os.
struct SurfaceRows {
    const float *r, *g, *b;
    bool premultiplied;  // the colour is Cs × Os, else Cs
    const double* coverage;
};

// Os × C, Os, and the NTSC grey of the former; all 0 where Os is 0.
struct ShadedRows {
    float *r, *g, *b, *a, *y;
};

// A light as a row of pixels meets it; L is the unit vector to it, N the normal, V that to the eye.
struct LightRows {
    const double* facing;  // L · N
    const double* reach;   // what falloff and shadows leave of its colour; null: 1
    double* own;           // phong: L · V; cel: room for n tones
    std::array<double, 3> color;
};

struct SmoothStep {
    double low, high;  // where they are equal, 1 from there on
};

struct CelTones {
    bool continuous;  // a tone is v itself, else the step of v
    SmoothStep transition;
    double shade;                   // what a light in the back leaves of Cs
    double light;                   // by how much a light's colour × Cs is multiplied
    std::array<double, 3> ambient;  // the matte colour is Cs × (ambient + diffuse × brightness)
    double diffuse;

    bool has_highlight;
    double threshold;      // v of lights that count for the highlight is above it
    SmoothStep highlight;  // of Σ v²
    double tint;           // the highlight is tint × Cs + gleam + Σ shine × light's colour
    double gleam, shine;
};
void cel_row(const SurfaceRows& surface, std::span<const LightRows> lights, const CelTones& tones, int n,
             const ShadedRows& out);

struct GoochTones {
    std::array<double, 3> cool, warm;
    double alpha, beta;
};
// Of the lights, `facing` counts alone.
void gooch_row(const SurfaceRows& surface, std::span<const LightRows> lights, const GoochTones& tones, int n,
               const ShadedRows& out);

struct PhongTones {
    std::array<double, 3> ambient;  // × Cs
    double diffuse, specular, exponent;
};
// `normal_toward_eye`: N · V.
void phong_row(const SurfaceRows& surface, std::span<const LightRows> lights, const double* normal_toward_eye,
               const PhongTones& tones, int n, const ShadedRows& out);

}  // namespace simd
}  // namespace keyline
