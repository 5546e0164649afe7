// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/aligned.h"
#include "engine/base/error.h"
#include "engine/plan/plan.h"
#include "engine/run/bands.h"
#include "engine/run/stats.h"

#include <memory>
#include <vector>

namespace keyline {

// What a frame in work holds outside its tiles, who read and write it.
struct FrameState {
    // By store of the plan; null where not alive.  Other frames may read those that are whole.
    std::vector<std::shared_ptr<Bands>> stores;
    std::vector<std::unique_ptr<Bands>> sinks;              // by sink: rows waiting to be encoded
    std::vector<std::unique_ptr<Gather::State>> gathering;  // by operation: folded so far; null: not in work
    std::vector<std::shared_ptr<const Datum>> data;         // by operation; null where not alive
    Recorder* recorder = nullptr;                           // null: nothing is recorded
};

// A node broke a promise, with what there is to compute to see it again.
class TileFailure : public Failure {
public:
    TileFailure(Error error, const Op& op, const Rect& tile_region)
        : Failure(std::move(error)), node(op.node), frame(op.frame), region(tile_region) {}
    const int node, frame;
    const Rect region;
};

// The data that an operation reads, by slot; null where a slot takes pixels.
void collect_data(const Op& op, const FrameState& state, std::vector<const Datum*>& out);

// Completes what an operation threw, while it is being caught, with the operation and the frame.  `where`
// goes into what only a programmer understands; `region` is what was to be computed, if it was pixels.
[[noreturn]] void rethrow_of(const Op& op, const std::string& where, const Rect& region = {});

// What a tile leaves beside the samples in FrameState.
struct TileResult {
    std::vector<std::unique_ptr<Gather::Partial>> partials;  // by root of the sweep: what map() made
    std::vector<std::size_t> overflowed;                     // by root: values that half can't hold
};

// One worker's memory.  A tile is computed in it from stores to roots, one operation after the other.
class TileWorker {
public:
    explicit TileWorker(int id) : id_(id) {}
    int id() const { return id_; }

    TileResult compute(const Plan& plan, const Sweep& sweep, FrameState& state, const Rect& tile);

private:
    struct Buffer {
        AlignedArray<float> memory;
        std::size_t size = 0;
        float* with(std::size_t floats);  // room for so many; what was in it may be gone
    };

    MutView buffer(int slot, const Rect& rect, const Rect& window);
    MutView unwanted(std::size_t output, const Rect& rect, const Rect& window);
    void run_step(std::size_t i);
    void run_compute(std::size_t i, const Op& op, Outputs outputs);
    const MutView* result_of(const Operand& operand) const;
    void gather(const Operand& operand, const Link& link, ValueRef value, const Rect& rect, const Rect& end);
    void run_root(std::size_t i, TileResult& result);
    std::unique_ptr<Gather::Partial> run_map(const Root& root);
    std::size_t run_sink(const Root& root);

    Timed timed(Activity activity, const std::string& title) const;

    const int id_;

    // The tile in work.
    const Plan* plan_ = nullptr;
    const Sweep* sweep_ = nullptr;
    FrameState* state_ = nullptr;
    Rect tile_;
    std::vector<Rect> regions_;                  // by step
    std::vector<std::vector<MutView>> results_;  // by step and output

    std::vector<Buffer> buffers_;   // by slot
    std::vector<int> holds_;        // by slot: the step whose output lies in it
    std::vector<Buffer> unwanted_;  // a row, by output of the step in work
    Scratch scratch_;
    std::vector<View> views_;
    std::vector<Inputs::Range> slots_;
    std::vector<const Datum*> inputs_data_;
};

}  // namespace keyline
