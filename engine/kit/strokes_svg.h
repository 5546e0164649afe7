// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/kit/strokes.h"

#include <string>

// Strokes as SVG, for programs in which people draw.

namespace KEYLINE_API keyline {

struct SvgStyle {
    enum class Layers { kKind, kObject };
    enum class Width { kOutline, kStroke, kSplit };

    Layers layers = Layers::kKind;
    Width width = Width::kOutline;
    Color color;             // of strokes that have none of their own
    double tolerance = 0.2;  // pixels between curves and points
};

std::string strokes_svg(const Strokes& strokes, const SvgStyle& style);

}  // namespace keyline
