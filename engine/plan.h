// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/demand.h"
#include "engine/resolve.h"

#include <cstddef>
#include <string>
#include <vector>

namespace keyline {

// How a frame will be computed.  A plan is data: made from headers alone, printed, tested and costed before a
// pixel exists.  It decides nothing about what the pixels are.
//
// A frame is computed in sweeps.  A sweep goes over the frame once, tile by tile; each tile visits the whole
// chain of operations.  A whole-frame node ends a sweep: the next one may use its result.

// Samples that outlive a tile, by bands of rows: decoded from a source, or a computed value kept for a later
// sweep.
struct Store {
    std::vector<ValueRef> values;  // one plane each
    std::vector<SampleType> types;
    Rect region;          // what is kept of each value
    int band_origin = 0;  // bands are rows [band_origin + i·band_height, …)
    int band_height = 0;
    int source_op = -1;  // decoded from this source, by chunks of `group`; -1: computed
    std::size_t group = 0;
    int first_sweep = 0, last_sweep = 0;  // made in the one, last used in the other

    int first_band() const { return floor_div(region.y0 - band_origin, band_height); }
    int end_band() const { return floor_div(region.y1 - 1 - band_origin, band_height) + 1; }
    Rect band(int i) const {
        const int y = band_origin + i * band_height;
        return intersect(region, {region.x0, y, region.x1, y + band_height});
    }
    std::size_t row_bytes() const;
    std::size_t bytes() const { return row_bytes() * static_cast<std::size_t>(region.height()); }
};

// One value needed while a tile is computed.
struct Step {
    enum class Kind { kLoad, kCompute, kApply };
    Kind kind = Kind::kCompute;
    int op = -1;
    int output = 0;          // kLoad: of the operation
    int store = -1;          // kLoad: from this store
    int plane = 0;           // kLoad: and its plane
    std::vector<int> slots;  // scratch buffers of the outputs, or kUnwanted
    static constexpr int kUnwanted = -1;
};

// Where a value read by a step, or leaving a tile, comes from.
struct Operand {
    int step = -1;
    int output = 0;
};

// What a sweep is for.
struct Root {
    enum class Kind { kMap, kSink, kKeep };
    Kind kind = Kind::kSink;
    int op = -1;     // kMap: the whole-frame operation; kKeep: whose result it is
    int sink = -1;   // kSink
    int store = -1;  // kKeep
    Rect region;     // what of it there is to compute
    std::vector<Operand>
        operands;                 // kMap: its links' values, flat; kSink: a channel each; kKeep: a plane each
    std::vector<bool> untouched;  // kSink: by channel; its samples go from store to file as they are
};

struct Sweep {
    Rect area;  // the union of the roots' regions
    int tile_width = 0, tile_height = 0;
    // Of the grid of tiles through the origin, those that a root's region lies in: what lies between regions
    // far apart costs nothing.
    std::vector<int> columns, rows;
    std::vector<Step> steps;                     // in an order in which each comes after what it reads
    std::vector<std::vector<Operand>> operands;  // by step: its links' values, flat
    int slots = 0;                               // scratch buffers
    std::vector<Root> roots;
    std::vector<int> reads;         // stores decoded in this sweep
    std::size_t scratch_bytes = 0;  // of one worker, at most
    std::size_t memory_bytes = 0;   // of the process while this sweep runs, estimated

    // Both count from 0, over `columns` and `rows`.
    Rect tile(std::size_t column, std::size_t row) const {
        const int x = columns[column] * tile_width;
        return intersect(row_rect(row), {x, area.y0, x + tile_width, area.y1});
    }
    Rect row_rect(std::size_t row) const {
        const int y = rows[row] * tile_height;
        return intersect(area, {area.x0, y, area.x1, y + tile_height});
    }
};

// A way to compute the frame that the planner weighed.
struct Weighed {
    bool keep_sources, keep_computed;  // for a later sweep, or decode and compute again
    int tile_width, tile_height, rows_ahead;
    double work;  // as Plan's
    std::size_t memory_bytes;
};

struct Plan {
    ResolvedFrame frame;
    Demand demand;
    std::vector<Store> stores;
    std::vector<Sweep> sweeps;
    int threads = 1;
    int rows_ahead = 1;            // tile rows that may be in work at once
    std::size_t memory_bytes = 0;  // the most that the process will use, estimated
    double work = 0;               // seconds of one thread, estimated: plan_cost.h
    std::vector<Weighed> weighed;  // with PlanOptions::weigh_all; from the fastest to the smallest

    std::string text() const;  // for people: `keyline plan`
};

struct PlanOptions {
    int threads = 1;
    int tile = 0;            // 0: the planner's choice
    std::size_t memory = 0;  // bytes for the whole process; 0: no limit
    bool weigh_all = false;  // for people: what there was to choose from, too
};

// Throws Failure (kGraph) where the memory is less than the least that the frame can be computed in.
Plan make_plan(ResolvedFrame frame, const PlanOptions& options);

// The regions of every step of a sweep that one tile needs.
std::vector<Rect> step_regions(const Plan& plan, const Sweep& sweep, const Rect& tile);

// The region of each store that a tile, or a row of them, reads.
std::vector<Rect> store_regions(const Plan& plan, const Sweep& sweep, const Rect& tile);

// What of a sink's channel a tile writes.
Rect sink_region(const Plan& plan, const Root& root, std::size_t channel, const Rect& tile);

}  // namespace keyline
