// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/io/image_sink.h"
#include "engine/plan/plan.h"
#include "engine/run/tiles.h"

#include <atomic>
#include <compare>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace keyline {

// A piece of work for one thread.
struct Job {
    enum class Kind { kBegin, kDecode, kTile, kEncode, kEndSweep, kFinish };
    Kind kind = Kind::kTile;
    int which = 0;   // kDecode: the store; kEncode: the root; kFinish: the sink
    int row = 0;     // kDecode: the band; kTile: the row of tiles; kEncode: the chunk
    int column = 0;  // kDecode: the column of chunks; kTile: of tiles
    friend auto operator<=>(const Job&, const Job&) = default;
};

// Does the work; a Failure that names no node is thrown on with this one.
template <class F>
auto naming(const std::string& title, int frame, const F& work) {
    try {
        return work();
    } catch (const Failure& f) {
        rethrow_with(f, [&](Error& e) {
            if (e.node.empty()) e.node = title + ", frame " + std::to_string(frame);
        });
    }
}

// The bookkeeping of one sweep: which bands of which stores a row of tiles waits for, which rows an output's
// chunk waits for, and who is the last to need a band.
//
//     chunks decoded → band complete → rows of tiles ready → tiles → chunk of rows complete → encoded,
//     committed
//
// Rows are worked on in order and only a few at once, so that what is held stays small when nothing has to
// outlive the sweep.  Nobody gets farther ahead of a chunk that is being encoded: files take their chunks in
// order, and what is encoded too early waits in memory.  Locking is as in FrameRun.
class SweepRun {
public:
    SweepRun(const Plan& plan, int sweep, FrameState& state, std::vector<std::unique_ptr<ImageSink>>& sinks);

    std::optional<Job> next();
    void run(const Job& job, TileWorker& worker);
    void completed(const Job& job);
    bool done() const;
    bool has_decoded_all() const { return decodes_left_ == 0; }
    // How much of it is done, by rows of tiles: 0 to 1.
    double part() const {
        return rows_.empty() ? 0 : static_cast<double>(lowest_row_) / static_cast<double>(rows_.size());
    }

    // By sink of the plan: values that half couldn't hold.
    const std::vector<std::size_t>& overflowed() const { return overflowed_; }

private:
    struct Read {  // a store decoded in this sweep
        int store = 0;
        int first_column = 0, columns = 0;  // of chunks
        std::vector<int> waiting;           // by band: chunks not decoded yet
    };
    struct Row {  // of tiles
        int bands_missing = 0;
        int tiles_left = 0;
        int tiles_started = 0;
    };
    struct Output {  // a sink written in this sweep
        int root = 0, sink = 0;
        std::vector<int> rows_missing;      // by chunk
        std::vector<EncodedChunk> encoded;  // by chunk: waiting for those before it
        std::vector<bool> ready;
        int next_commit = 0;
        std::vector<bool> ended;  // by chunk: encoded
        int oldest = 0;           // the first chunk that is not

        int chunks() const { return static_cast<int>(rows_missing.size()); }
    };
    struct Fold {  // a gather mapped in this sweep
        int root = 0;
        std::map<int64_t, std::unique_ptr<Gather::Partial>> waiting;  // by tile
        int64_t next = 0;
    };

    void plan_reads();
    void plan_rows();
    void plan_outputs();
    void plan_folds();
    int due_row(int store, int band) const;
    Rect row_rect(int row) const;
    int columns() const { return static_cast<int>(sweep_.columns.size()); }
    int last_open_row() const;
    void start_rows();
    void row_done(int row);
    void release_bands(int row);
    void chunk_row_done(Output& output, int row);
    void chunk_ended(Output& output, int chunk);

    std::optional<Job> next_encode();
    std::optional<Job> next_tile();
    void run_decode(const Job& job, int worker) const;
    void run_tile(const Job& job, TileWorker& worker);
    void run_encode(const Job& job, int worker);
    void commit_ready(Output& output);
    void fold(Fold& f, int64_t tile, std::unique_ptr<Gather::Partial> partial);

    const Plan& plan_;
    const Sweep& sweep_;
    const int index_;
    FrameState& state_;
    std::vector<std::unique_ptr<ImageSink>>& sinks_;

    std::vector<Read> reads_;
    std::vector<std::pair<int, Job>> decodes_;  // by the row that is due, in that order
    std::size_t next_decode_ = 0;
    std::size_t decodes_left_ = 0;
    std::vector<std::vector<Rect>> row_needs_;  // by row of tiles and store
    std::vector<std::vector<int>> users_;       // by store and band: rows of tiles still to read it
    std::vector<Row> rows_;
    int lowest_row_ = 0;  // the first that is not done
    int started_rows_ = 0;
    std::vector<Output> outputs_;
    std::deque<Job> encodes_;
    std::vector<Fold> folds_;

    std::mutex fold_mutex_, commit_mutex_;  // the order inside is fixed; these only keep it to one thread
    std::mutex count_mutex_;
    std::vector<std::size_t> overflowed_;
};

}  // namespace keyline
