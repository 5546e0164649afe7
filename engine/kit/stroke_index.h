// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/kit/strokes.h"

#include <cstdint>
#include <unordered_map>
#include <vector>

// Strokes by place: whether something runs along one of them.

namespace KEYLINE_API keyline {

class StrokeIndex {
public:
    // What is farther from a stroke than `within` pixels is not beside it.
    explicit StrokeIndex(double within) : within_(within) {}

    void add(const Stroke& stroke);
    std::size_t bytes() const { return count_ * sizeof(Piece); }  // about

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
    static uint64_t cell(int64_t column, int64_t row);
    bool is_beside(const Piece& piece, const Along& along) const;
    // visit(piece) of all that may be within `reach` of a place, until it returns true; whether it did.
    template <class Visit>
    bool any_near(double x, double y, double reach, const Visit& visit) const;

    double within_;
    std::unordered_map<uint64_t, std::vector<Piece>> pieces_;  // by the cell that they begin in
    std::vector<Piece> long_;                                  // that reach far from there
    double longest_ = 0;                                       // of the others
    std::size_t count_ = 0;
    int strokes_ = 0;
};

}  // namespace keyline
