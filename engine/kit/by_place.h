// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

// Pieces of lines by the cells of a grid that they may pass.

namespace KEYLINE_API keyline {

template <class Piece>
class ByPlace {
public:
    // A piece on the way from (x, y) to (x + dx, y + dy).
    void add(double x, double y, double dx, double dy, Piece piece) {
        const auto number = static_cast<uint32_t>(pieces_.size());
        pieces_.push_back(std::move(piece));
        if (!(std::fabs(dx) + std::fabs(dy) <= kLong)) return long_.push_back(number);
        const int64_t left = cell_of(std::min(x, x + dx)), right = cell_of(std::max(x, x + dx));
        for (int64_t row = cell_of(std::min(y, y + dy)); row <= cell_of(std::max(y, y + dy)); ++row)
            for (int64_t column = left; column <= right; ++column) add_to(key(column, row), number);
    }

    std::size_t size() const { return pieces_.size(); }

    // visit(piece) of all that may be within `reach` of a place, until it returns true; whether it did.
    // Others are visited too, and some more than once.
    template <class Visit>
    bool any_near(double x, double y, double reach, const Visit& visit) const {
        const double cells = 2 * reach / kCell + 1;
        if (!(cells * cells <= static_cast<double>(pieces_.size())))
            return std::ranges::any_of(pieces_, visit);
        for (int64_t row = cell_of(y - reach); row <= cell_of(y + reach); ++row)
            for (int64_t column = cell_of(x - reach); column <= cell_of(x + reach); ++column)
                for (uint32_t i = first_in(key(column, row)); i != kNone; i = entries_[i].next)
                    if (visit(pieces_[entries_[i].piece])) return true;
        return std::ranges::any_of(long_, [&](uint32_t i) { return visit(pieces_[i]); });
    }

    friend bool operator==(const ByPlace&, const ByPlace&) = default;

private:
    static constexpr double kCell = 4,
                            kLong = 16;  // pixels; what is longer is in too many cells
    static constexpr uint32_t kNone = UINT32_MAX;

    // Of the list of a cell.
    struct Entry {
        uint32_t piece = 0, next = kNone;
        friend bool operator==(const Entry&, const Entry&) = default;
    };
    struct Cell {
        uint64_t key = 0;
        uint32_t first = kNone, last = kNone;
        friend bool operator==(const Cell&, const Cell&) = default;
    };

    static int64_t cell_of(double v) { return static_cast<int64_t>(std::floor(v / kCell)); }
    static uint64_t key(int64_t column, int64_t row) {
        return uint64_t{static_cast<uint32_t>(row)} << 32 | static_cast<uint32_t>(column);
    }

    // Where a cell is in the table, or would be: the table has room.
    std::size_t place_of(uint64_t key) const {
        const std::size_t mask = cells_.size() - 1;
        std::size_t i = (key * 0x9E3779B97F4A7C15U >> 32U) & mask;
        while (cells_[i].first != kNone && cells_[i].key != key) i = (i + 1) & mask;
        return i;
    }

    uint32_t first_in(uint64_t key) const { return cells_.empty() ? kNone : cells_[place_of(key)].first; }

    void add_to(uint64_t key, uint32_t piece) {
        if (2 * (used_ + 1) > cells_.size()) make_room();
        const auto entry = static_cast<uint32_t>(entries_.size());
        entries_.push_back({piece, kNone});
        Cell& cell = cells_[place_of(key)];
        if (cell.first == kNone) {
            cell = {key, entry, entry};
            ++used_;
            return;
        }
        entries_[cell.last].next = entry;
        cell.last = entry;
    }

    void make_room() {
        std::vector<Cell> before(std::max<std::size_t>(64, 2 * cells_.size()));
        std::swap(before, cells_);
        for (const Cell& cell : before)
            if (cell.first != kNone) cells_[place_of(cell.key)] = cell;
    }

    std::vector<Piece> pieces_;
    std::vector<uint32_t> long_;  // of them, those in no cell
    std::vector<Entry> entries_;
    std::vector<Cell> cells_;  // a table with open addresses, its size a power of two
    std::size_t used_ = 0;     // of it
};

}  // namespace keyline
