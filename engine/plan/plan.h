// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/base/print.h"
#include "engine/io/sink_memory.h"
#include "engine/plan/carry.h"
#include "engine/plan/demand.h"
#include "engine/plan/resolve.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace KEYLINE_API keyline {

// How a frame will be computed.  A plan is data: made from headers alone, printed, tested and costed before a
// pixel exists.  It decides nothing about what the pixels are.
//
// A frame is computed in sweeps.  A sweep goes over the frame once, tile by tile; each tile visits the whole
// chain of operations.  A gather needs a sweep to itself: its datum is there when the sweep has ended, and
// the next one may use it.  Data that derive from it are made between the two.

// Samples that outlive a tile, by bands of rows: decoded from a source, or a computed value kept for a later
// sweep, or either of an earlier frame.
struct Store {
    std::vector<ValueRef> values;  // one plane each
    std::vector<SampleType> types;
    Rect region;          // what is kept of each value
    int band_origin = 0;  // bands are rows [band_origin + i·band_height, …)
    int band_height = 0;
    int source_op = -1;  // decoded from this source, by chunks of `group`; -1: computed
    std::size_t group = 0;
    int first_sweep = 0, last_sweep = 0;  // made in the one, last used in the other
    int held = kHere;                     // of Carrying::held: an earlier frame made it
    std::optional<int> carry_until;       // the last frame that uses it; it then outlives the last sweep
    static constexpr int kHere = -1;

    int first_band() const { return floor_div(region.y0 - band_origin, band_height); }
    int end_band() const { return floor_div(region.y1 - 1 - band_origin, band_height) + 1; }
    Rect band(int i) const {
        const int y = band_origin + i * band_height;
        return intersect(region, {region.x0, y, region.x1, y + band_height});
    }
    std::size_t row_bytes() const;
    std::size_t bytes() const { return row_bytes() * static_cast<std::size_t>(region.height()); }
};

// "decoded from 0: 0.0 0.1, 40 × 20 at (0, 0), bands of 16 rows, sweeps 1 to 2"
std::string to_string(const Store& store);

// A datum, from when it is made until the last who reads it.
struct PlannedDatum {
    int op = -1;
    int made_before = 0;             // this sweep begins; as many as there are sweeps: after the last
    int last_sweep = 0;              // that reads it; as many as there are sweeps: a sink does
    std::size_t bytes = 0;           // estimated
    int held = Store::kHere;         // as of a store
    std::optional<int> carry_until;  // likewise
};

// One value needed while a tile is computed.
struct Step {
    enum class Kind { kLoad, kCompute };
    Kind kind = Kind::kCompute;
    int op = -1;
    int output = 0;          // kLoad: of the operation
    int store = -1;          // kLoad: from this store
    int plane = 0;           // kLoad: and its plane
    std::vector<int> slots;  // scratch buffers of the outputs, or kUnwanted
    static constexpr int kUnwanted = -1;
};

std::string to_string(const Step& step);  // "compute 3 into 0 1"

// Where a value read by a step, or leaving a tile, comes from.
struct Operand {
    int step = -1;
    int output = 0;
};

// What a sweep is for.
struct Root {
    enum class Kind { kMap, kSink, kKeep };
    Kind kind = Kind::kSink;
    int op = -1;     // kMap: the gather; kKeep: whose result it is
    int sink = -1;   // kSink
    int store = -1;  // kKeep
    Rect region;     // what of it there is to compute
    std::vector<Operand>
        operands;                 // kMap: its links' values, flat; kSink: a channel each; kKeep: a plane each
    std::vector<bool> untouched;  // kSink: by channel; its samples go from store to file as they are
};

std::string to_string(const Root& root);  // "sink 0, 40 × 20 at (0, 0)"

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
    std::size_t memory_bytes = 0;   // of the process and its helpers while this sweep runs, estimated
    double seconds = 0;             // estimated: cost.h

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

// A line for itself, one a step and one a root.
std::string to_string(const Sweep& sweep);

// A way to compute the frame that the planner weighed.
struct Weighed {
    bool keep_sources, keep_computed;  // for a later sweep, or decode and compute again
    int tile_width, tile_height, rows_ahead;
    bool carry;      // what coming frames want too, or make it again in each
    double seconds;  // as Plan's
    std::size_t memory_bytes;
};

struct Plan {
    ResolvedFrame frame;
    Demand demand;
    Carrying carrying;
    std::vector<Store> stores;
    std::vector<PlannedDatum> data;  // in an order in which each comes after those that it derives from
    std::vector<Sweep> sweeps;       // none where there is nothing but data
    int threads = 1;
    int rows_ahead = 1;                  // tile rows that may be in work at once
    std::vector<SinkShape> sink_shapes;  // by sink
    std::vector<SinkMemory> sink_memory;
    std::size_t memory_bytes = 0;  // the most that the process and its helpers will use, estimated
    double seconds = 0;            // on so many threads, estimated: cost.h
    std::vector<Weighed> weighed;  // where the planner was asked for all; the one it likes best first

    // What it adds for later frames.
    std::size_t carried_bytes() const;

    std::string text() const;  // for people: `keyline plan`
};

// A few of a sweep's tiles, spread evenly: what they are like, all are.
std::vector<Rect> sample_tiles(const Sweep& sweep);

// The regions of every step of a sweep that one tile needs.
std::vector<Rect> step_regions(const Plan& plan, const Sweep& sweep, const Rect& tile);

// The region of each store that a tile, or a row of them, reads.
std::vector<Rect> store_regions(const Plan& plan, const Sweep& sweep, const Rect& tile);

// What of a sink's channel a tile writes.
Rect sink_region(const Plan& plan, const Root& root, std::size_t channel, const Rect& tile);

}  // namespace keyline
