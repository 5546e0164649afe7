// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/kit/by_place.h"
#include "engine/kit/strokes.h"

#include <cstddef>

// Strokes by place: whether something runs along one of them.

namespace KEYLINE_API keyline {

class StrokeIndex {
public:
    // What is farther from a stroke than `within` pixels is not beside it.
    explicit StrokeIndex(double within) : within_(within) {}

    void add(const Stroke& stroke);
    std::size_t bytes() const { return pieces_.size() * sizeof(Piece); }  // about

    struct Along {
        double x = 0, y = 0, tx = 0, ty = 0;  // a place and a direction of length 1
        StrokeKind kind = StrokeKind::kUser;
    };
    // Whether a stroke goes the same way there, within 37 degrees; before its first vertex and behind its
    // last it does not.  One of another kind may go it backwards: strokes of one kind that run against each
    // other are both sides of something thin.
    bool has(const Along& along) const;

    // How far ahead the first stroke lies that was not the `except`th to be added, counted from 0; infinity
    // where there is none within `reach` pixels.
    double ahead(const Along& from, double reach, int except) const;

    friend bool operator==(const StrokeIndex&, const StrokeIndex&) = default;

private:
    struct Piece {
        double x, y, dx, dy;  // from a vertex to the next
        StrokeKind kind;
        bool first, last;  // of a stroke that is not closed
        int stroke;
        friend bool operator==(const Piece&, const Piece&) = default;
    };
    bool is_beside(const Piece& piece, const Along& along) const;

    double within_;
    ByPlace<Piece> pieces_;
    int strokes_ = 0;
};

}  // namespace keyline
