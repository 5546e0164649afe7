// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/aligned.h"
#include "engine/bands.h"
#include "engine/plan.h"
#include "engine/stats.h"

#include <memory>
#include <vector>

namespace keyline {

// The samples and states of a frame in work that tiles read and write.
struct FrameData {
    std::vector<std::unique_ptr<Bands>> stores;       // by store of the plan; null where not alive
    std::vector<std::unique_ptr<Bands>> sinks;        // by sink: rows waiting to be encoded
    std::vector<std::unique_ptr<Memory>> reductions;  // by operation: the folded state
    Recorder* recorder = nullptr;                     // null: nothing is recorded
};

// What a tile leaves beside the samples in FrameData.
struct TileResult {
    std::vector<std::unique_ptr<Memory>> partials;  // by root of the sweep: what map() made
    std::vector<std::size_t> overflowed;            // by root: values that half can't hold
};

// One worker's memory.  A tile is computed in it from stores to roots, one operation after the other.
class TileWorker {
public:
    explicit TileWorker(int id) : id_(id) {}
    int id() const { return id_; }

    TileResult compute(const Plan& plan, const Sweep& sweep, FrameData& data, const Rect& tile);

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
    void gather(const Operand& operand, const Link& link, ValueRef value, const Rect& rect);
    void run_root(std::size_t i, TileResult& result);
    std::unique_ptr<Memory> run_map(const Root& root);
    std::size_t run_sink(const Root& root);

    Timed timed(Activity activity, const std::string& title) const;

    const int id_;

    // The tile in work.
    const Plan* plan_ = nullptr;
    const Sweep* sweep_ = nullptr;
    FrameData* data_ = nullptr;
    Rect tile_;
    std::vector<Rect> regions_;                  // by step
    std::vector<std::vector<MutView>> results_;  // by step and output

    std::vector<Buffer> buffers_;   // by slot
    std::vector<Buffer> unwanted_;  // a row, by output of the step in work
    Scratch scratch_;
    std::vector<View> views_;
    std::vector<Inputs::Range> slots_;
};

}  // namespace keyline
