// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/kit/by_place.h"
#include "engine/kit/ink.h"
#include "engine/kit/strokes.h"
#include "engine/node/node_adaptor.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

// What each pixel of a drawing belongs to, and where along its stroke it is.

namespace KEYLINE_API keyline {

// A value at a vertex, and how far it is to the next one's.
struct Along {
    double from = 0, by = 0;
    double at(double share) const { return from + share * by; }
    friend bool operator==(const Along&, const Along&) = default;
};

// Strokes as pieces from vertex to vertex, by place.
struct LinePlaces {
    static constexpr const char* kind = "places along strokes";

    struct Piece {
        uint32_t stroke = 0;
        Along x, y, u, width, depth;
        friend bool operator==(const Piece&, const Piece&) = default;
    };
    // The nearest place on the way of a stroke.
    struct Place {
        double u = 0, width = 0, depth = 0;
        double across = 0;  // from −1 on the left of the stroke to 1 on the right, where its owner is
    };

    std::vector<uint32_t> owners;  // of each stroke
    ByPlace<Piece> pieces;
    double widest = 0;

    std::optional<Place> nearest(uint32_t stroke, double x, double y) const;
    std::size_t bytes() const { return owners.size() * sizeof(uint32_t) + pieces.size() * sizeof(Piece); }
    friend bool operator==(const LinePlaces&, const LinePlaces&) = default;
};

LinePlaces line_places(const Strokes& strokes);

struct FindLinePlaces {
    struct Params {
        Input strokes;
        static constexpr auto fields = declare(input(&Params::strokes, "strokes", "", data<Strokes>()));
    };
    static LinePlaces derive(const Inputs& in) { return line_places(in.datum<Strokes>(0)); }
    static std::size_t datum_bytes() { return kUsualStrokes; }
};

// Of each pixel, by the stroke that covers most of it, the first of those that cover as much: how much, whose
// it is and which, as bits; where along it the pixel is; and 0.
struct LayLineValues {
    struct Params {
        Input ink, places;
        static constexpr auto fields = declare(input(&Params::ink, "ink", "", data<Ink>()),
                                               input(&Params::places, "places", "", data<LinePlaces>()));
    };
    enum Output { kEdge, kOwner, kStroke, kU, kV, kWidth, kDepth, kNothing };
    static constexpr std::array outputs{"edge", "owner", "id", "u", "v", "width", "Z", "nothing"};

    static void compute(const Inputs& in, Outputs out, Scratch& scratch);
};

}  // namespace keyline
