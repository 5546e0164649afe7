// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/measure/motion.h"

#include <cmath>
#include <cstddef>
#include <optional>

// Where things go from a frame to the one after it, or to the one before.

namespace keyline {

struct Way {
    double x = 0, y = 0;  // down
};

class Field {
public:
    Field(const MotionPass& pass, bool forward) : pass_(pass), forward_(forward) {}

    std::optional<Way> at(double x, double y) const {
        const std::optional<std::size_t> i = pixel(x, y);
        if (!i) return {};
        const auto channel = [&](std::size_t c) { return double{pass_.vector[c][*i]}; };
        const Way out = forward_ ? Way{-channel(2), channel(3)} : Way{channel(0), -channel(1)};
        return std::isfinite(out.x) && std::isfinite(out.y) ? std::optional(out) : std::nullopt;
    }

    // Infinitely far where it is not known.
    double depth_at(double x, double y) const {
        const std::optional<std::size_t> i = pixel(x, y);
        return i && !pass_.depth.empty() ? double{pass_.depth[*i]} : 1e30;
    }

private:
    std::optional<std::size_t> pixel(double x, double y) const {
        const int column = static_cast<int>(std::floor(x)), row = static_cast<int>(std::floor(y));
        if (!pass_.window.contains(column, row)) return {};
        return static_cast<std::size_t>(row - pass_.window.y0) *
                   static_cast<std::size_t>(pass_.window.width()) +
               static_cast<std::size_t>(column - pass_.window.x0);
    }

    const MotionPass& pass_;
    bool forward_;
};

}  // namespace keyline
