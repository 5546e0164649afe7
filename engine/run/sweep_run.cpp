// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/run/sweep_run.h"

#include "engine/base/index.h"

#include <algorithm>
#include <fmt/format.h>

namespace keyline {

namespace {

bool covers(const Plan& plan, const Sink& sink, const Rect& rect) {
    const Stream& stream = sink.request.stream;
    return stream.window.contains(rect) && std::ranges::all_of(stream.channels, [&](const StreamChannel& c) {
               return plan.frame.info(c.value).window.contains(rect);
           });
}

// What of a plane lies in a region: neither faults nor findings depend on what else shares its store.
Plane part_of(Plane plane, const Rect& region) {
    const Rect part = intersect(plane.rect, region);
    plane.data = part.empty() ? nullptr : plane.at(part.x0, part.y0);
    plane.rect = part;
    return plane;
}

}  // namespace

SweepRun::SweepRun(const Plan& plan, int sweep, FrameState& state,
                   std::vector<std::unique_ptr<ImageSink>>& sinks)
    : plan_(plan),
      sweep_(plan.sweeps[index(sweep)]),
      index_(sweep),
      state_(state),
      sinks_(sinks),
      overflowed_(plan.frame.sinks.size(), 0) {
    plan_rows();
    plan_reads();
    plan_outputs();
    plan_folds();
}

Rect SweepRun::row_rect(int row) const { return sweep_.row_rect(index(row)); }

void SweepRun::plan_rows() {
    rows_.resize(sweep_.rows.size());
    for (int r = 0; r < static_cast<int>(rows_.size()); ++r) {
        rows_[index(r)].tiles_left = columns();
        // What the tiles of a row read of each store, together: bands span the frame's width.
        row_needs_.push_back(store_regions(plan_, sweep_, row_rect(r)));
    }
    // Counted once, before the first tile: a band is given back by whoever is the last to need it, in
    // whatever order the rows end.
    users_.resize(plan_.stores.size());
    for (std::size_t s = 0; s < plan_.stores.size(); ++s) {
        const Store& store = plan_.stores[s];
        if (store.region.empty()) continue;
        users_[s].resize(index(store.end_band() - store.first_band()), 0);
        for (const auto& needs : row_needs_)
            for (int b = store.first_band(); !needs[s].empty() && b < store.end_band(); ++b)
                if (!intersect(store.band(b), needs[s]).empty()) ++users_[s][index(b - store.first_band())];
    }
}

// The row of tiles that needs a band first.  A band that none needs is kept for a later sweep.
int SweepRun::due_row(int store, int band) const {
    const Rect rect = plan_.stores[index(store)].band(band);
    for (std::size_t r = 0; r < row_needs_.size(); ++r)
        if (!intersect(rect, row_needs_[r][index(store)]).empty()) return static_cast<int>(r);
    return static_cast<int>(rows_.size()) - 1;
}

void SweepRun::plan_reads() {
    for (const int s : sweep_.reads) {
        if (state_.stores[index(s)]->is_resident()) continue;
        const Store& store = plan_.stores[index(s)];
        const ChannelGroup& group =
            plan_.frame.ops[index(store.source_op)].source->header().groups[store.group];
        Read read;
        read.store = s;
        read.first_column = (store.region.x0 - group.window.x0) / group.chunk_width;
        read.columns = (store.region.x1 - 1 - group.window.x0) / group.chunk_width + 1 - read.first_column;
        read.waiting.assign(index(store.end_band() - store.first_band()), read.columns);
        // A band that nobody reads is decoded only where a later sweep will.
        const bool passing = store.first_sweep == store.last_sweep;
        for (int b = store.first_band(); b < store.end_band(); ++b) {
            if (passing && users_[index(s)][index(b - store.first_band())] == 0) continue;
            const int due = due_row(s, b);
            for (int c = 0; c < read.columns; ++c)
                decodes_.push_back({due, {Job::Kind::kDecode, s, b, read.first_column + c}});
            for (std::size_t r = 0; r < rows_.size(); ++r)
                if (!intersect(store.band(b), row_needs_[r][index(s)]).empty()) ++rows_[r].bands_missing;
        }
        reads_.push_back(std::move(read));
    }
    // By the row that waits for them, over all files: no file runs ahead and fills the memory.
    std::ranges::stable_sort(decodes_, {}, &std::pair<int, Job>::first);
    decodes_left_ = decodes_.size();
}

void SweepRun::plan_outputs() {
    for (std::size_t i = 0; i < sweep_.roots.size(); ++i) {
        if (sweep_.roots[i].kind != Root::Kind::kSink) continue;
        Output out;
        out.root = static_cast<int>(i);
        out.sink = sweep_.roots[i].sink;
        const Bands& bands = *state_.sinks[index(out.sink)];
        const int chunks = bands.end_band() - bands.first_band();
        for (int c = 0; c < chunks; ++c) {
            int missing = 0;
            // Chunks and rows of tiles have heights of their own: a chunk waits for every row that it
            // crosses.
            for (int r = 0; r < static_cast<int>(rows_.size()); ++r)
                missing += !intersect(bands.rect(bands.first_band() + c), row_rect(r)).empty() ? 1 : 0;
            out.rows_missing.push_back(missing);
            if (missing == 0)
                encodes_.push_back({Job::Kind::kEncode, static_cast<int>(outputs_.size()), c, 0});
        }
        out.encoded.resize(index(chunks));
        out.ready.resize(index(chunks), false);
        out.ended.resize(index(chunks), false);
        outputs_.push_back(std::move(out));
    }
}

void SweepRun::plan_folds() {
    for (std::size_t i = 0; i < sweep_.roots.size(); ++i) {
        if (sweep_.roots[i].kind != Root::Kind::kMap) continue;
        Fold f;
        f.root = static_cast<int>(i);
        folds_.push_back(std::move(f));
    }
}

// Rows below this one may be worked on.
int SweepRun::last_open_row() const {
    int lowest = lowest_row_;
    for (const Output& out : outputs_) {
        if (out.oldest == out.chunks() || out.rows_missing[index(out.oldest)] > 0) continue;
        const Bands& bands = *state_.sinks[index(out.sink)];
        const int end = bands.rect(bands.first_band() + out.oldest).y1;
        while (lowest > 0 && row_rect(lowest - 1).y0 >= end) --lowest;
    }
    return std::min(static_cast<int>(rows_.size()), lowest + plan_.rows_ahead);
}

// What a row of tiles writes is allocated when the row is opened.
void SweepRun::start_rows() {
    for (; started_rows_ < last_open_row(); ++started_rows_) {
        const Rect rect = row_rect(started_rows_);
        for (const Output& out : outputs_) {
            Bands& bands = *state_.sinks[index(out.sink)];
            for (int b = bands.first_band(); b < bands.end_band(); ++b)
                if (!bands.allocated(b) && !intersect(bands.rect(b), rect).empty())
                    bands.allocate(b, !covers(plan_, plan_.frame.sinks[index(out.sink)], bands.rect(b)));
        }
        for (const Root& root : sweep_.roots) {
            if (root.kind != Root::Kind::kKeep) continue;
            Bands& bands = *state_.stores[index(root.store)];
            for (int b = bands.first_band(); b < bands.end_band(); ++b)
                if (!bands.allocated(b) && !intersect(bands.rect(b), rect).empty()) bands.allocate(b, false);
        }
    }
}

// What frees memory comes first (encoding), then what uses what is there (tiles), and only then what takes
// more (decoding).
std::optional<Job> SweepRun::next() {
    if (auto job = next_encode()) return job;
    start_rows();  // now that the memory of rows done is on its way back
    if (auto job = next_tile()) return job;
    if (next_decode_ == decodes_.size()) return std::nullopt;
    const auto& [due, job] = decodes_[next_decode_];
    if (due >= last_open_row() && !rows_.empty()) return std::nullopt;
    ++next_decode_;
    Bands& bands = *state_.stores[index(job.which)];
    if (!bands.allocated(job.row)) bands.allocate(job.row, false);
    return job;
}

std::optional<Job> SweepRun::next_encode() {
    const auto it = std::ranges::find_if(encodes_, [&](const Job& job) {
        const Output& out = outputs_[index(job.which)];
        return job.row < out.oldest + plan_.threads;  // as the memory is estimated
    });
    if (it == encodes_.end()) return std::nullopt;
    const Job job = *it;
    encodes_.erase(it);
    // Rows that no tile lies in are all zeros.
    Bands& bands = *state_.sinks[index(outputs_[index(job.which)].sink)];
    const int band = bands.first_band() + job.row;
    if (!bands.allocated(band)) bands.allocate(band, true);
    return job;
}

std::optional<Job> SweepRun::next_tile() {
    // The lowest row that has all it waits for: rows end in order as far as the decoding lets them.
    for (int r = lowest_row_; r < last_open_row(); ++r) {
        Row& row = rows_[index(r)];
        if (row.bands_missing > 0 || row.tiles_started == columns()) continue;
        return Job{Job::Kind::kTile, 0, r, row.tiles_started++};
    }
    return std::nullopt;
}

void SweepRun::run(const Job& job, TileWorker& worker) {
    switch (job.kind) {
        case Job::Kind::kDecode: run_decode(job, worker.id()); break;
        case Job::Kind::kTile: run_tile(job, worker); break;
        case Job::Kind::kEncode: run_encode(job, worker.id()); break;
        default: break;
    }
}

void SweepRun::run_decode(const Job& job, int worker) const {
    const Store& store = plan_.stores[index(job.which)];
    const Op& op = plan_.frame.ops[index(store.source_op)];
    const Bands& bands = *state_.stores[index(job.which)];
    Timed time(state_.recorder, Activity::kRead, op.title, plan_.frame.frame, index_, worker);
    const auto pixels = bands.rect(job.row).area() * static_cast<int64_t>(store.values.size());
    time.pixels(pixels, pixels);
    time.bytes(static_cast<int64_t>(store.row_bytes()) * bands.rect(job.row).height());
    // A plane without memory tells the reader that nobody wants the channel.
    std::vector<Plane> planes(op.source->header().groups[store.group].channels.size());
    for (std::size_t i = 0; i < store.values.size(); ++i)
        planes[op.source_channel[index(store.values[i].output)]] =
            part_of(bands.plane(job.row, i), plan_.demand.of(store.values[i]));
    naming(op.title, op.frame, [&] { op.source->read_chunk(store.group, job.column, job.row, planes); });
}

void SweepRun::run_tile(const Job& job, TileWorker& worker) {
    const Rect tile = sweep_.tile(index(job.column), index(job.row));
    TileResult result = worker.compute(plan_, sweep_, state_, tile);
    const int64_t number = int64_t{job.row} * columns() + job.column;  // tiles may be of one pixel
    for (Fold& f : folds_) fold(f, number, std::move(result.partials[index(f.root)]));
    const std::lock_guard lock(count_mutex_);
    for (const Output& out : outputs_) overflowed_[index(out.sink)] += result.overflowed[index(out.root)];
}

// In row-major order of the tiles, whatever the order in which they were computed.
void SweepRun::fold(Fold& f, int64_t tile, std::unique_ptr<Gather::Partial> partial) {
    const int op = sweep_.roots[index(f.root)].op;
    const Gather& gather = *plan_.frame.ops[index(op)].gather;
    // A tile that comes too early waits; the one that was missing folds all that wait behind it.
    const std::lock_guard lock(fold_mutex_);
    f.waiting.emplace(tile, std::move(partial));
    for (auto it = f.waiting.begin(); it != f.waiting.end() && it->first == f.next;
         it = f.waiting.erase(it), ++f.next)
        if (it->second) gather.fold(*state_.gathering[index(op)], *it->second);
}

void SweepRun::run_encode(const Job& job, int worker) {
    Output& out = outputs_[index(job.which)];
    const Bands& bands = *state_.sinks[index(out.sink)];
    const int band = bands.first_band() + job.row;
    Timed time(state_.recorder, Activity::kEncode, plan_.frame.sinks[index(out.sink)].title,
               plan_.frame.frame, index_, worker);
    const auto pixels = bands.rect(band).area() * static_cast<int64_t>(bands.types().size());
    time.pixels(pixels, pixels);
    int64_t sample_bytes = 0;
    for (const SampleType type : bands.types())
        sample_bytes += bands.rect(band).area() * static_cast<int64_t>(sample_size(type));
    time.bytes(sample_bytes);
    std::vector<Plane> planes;
    for (std::size_t i = 0; i < bands.types().size(); ++i) planes.push_back(bands.plane(band, i));
    naming(plan_.frame.sinks[index(out.sink)].title, plan_.frame.frame, [&] {
        // Packed outside the lock, by as many as there are; files take their chunks in order.
        EncodedChunk chunk = sinks_[index(out.sink)]->encode(job.row, planes);
        const std::lock_guard lock(commit_mutex_);
        out.encoded[index(job.row)] = std::move(chunk);
        out.ready[index(job.row)] = true;
        commit_ready(out);
    });
}

// A file whose chunks lie in order is read from its front to its back, and its bytes depend on no schedule.
void SweepRun::commit_ready(Output& out) {
    for (; index(out.next_commit) < out.ready.size() && out.ready[index(out.next_commit)]; ++out.next_commit)
        sinks_[index(out.sink)]->commit(std::move(out.encoded[index(out.next_commit)]));
}

void SweepRun::completed(const Job& job) {
    switch (job.kind) {
        case Job::Kind::kDecode: {
            --decodes_left_;
            const Store& store = plan_.stores[index(job.which)];
            const auto read = std::ranges::find(reads_, job.which, &Read::store);
            if (--read->waiting[index(job.row - store.first_band())] > 0) break;
            for (std::size_t r = 0; r < rows_.size(); ++r)
                if (!intersect(store.band(job.row), row_needs_[r][index(job.which)]).empty())
                    --rows_[r].bands_missing;
            break;
        }
        case Job::Kind::kTile:
            if (--rows_[index(job.row)].tiles_left == 0) row_done(job.row);
            break;
        case Job::Kind::kEncode: {
            Output& out = outputs_[index(job.which)];
            Bands& bands = *state_.sinks[index(out.sink)];
            bands.release(bands.first_band() + job.row, true);
            chunk_ended(out, job.row);
            break;
        }
        default: break;
    }
}

// Bands go before chunks come: encoding allocates.
void SweepRun::row_done(int row) {
    release_bands(row);
    for (Output& out : outputs_) chunk_row_done(out, row);
    while (index(lowest_row_) < rows_.size() && rows_[index(lowest_row_)].tiles_left == 0) ++lowest_row_;
}

void SweepRun::release_bands(int row) {
    for (std::size_t s = 0; s < plan_.stores.size(); ++s) {
        const Store& store = plan_.stores[s];
        // What a later sweep or another frame reads stays whole, so that it need not be decoded in part.
        if (store.held >= 0 || store.last_sweep != index_ || row_needs_[index(row)][s].empty()) continue;
        for (int b = store.first_band(); b < store.end_band(); ++b) {
            if (intersect(store.band(b), row_needs_[index(row)][s]).empty()) continue;
            if (--users_[s][index(b - store.first_band())] == 0)
                state_.stores[s]->release(b, store.first_sweep == index_);
        }
    }
}

void SweepRun::chunk_row_done(Output& output, int row) {
    const Bands& bands = *state_.sinks[index(output.sink)];
    const Rect rect = row_rect(row);
    for (int c = 0; c < static_cast<int>(output.rows_missing.size()); ++c) {
        if (intersect(bands.rect(bands.first_band() + c), rect).empty()) continue;
        if (--output.rows_missing[index(c)] == 0)
            encodes_.push_back({Job::Kind::kEncode, static_cast<int>(&output - outputs_.data()), c, 0});
    }
}

void SweepRun::chunk_ended(Output& output, int chunk) {
    output.ended[index(chunk)] = true;
    while (output.oldest < output.chunks() && output.ended[index(output.oldest)]) ++output.oldest;
}

bool SweepRun::done() const {
    return decodes_left_ == 0 && index(lowest_row_) == rows_.size() &&
           std::ranges::all_of(outputs_, [](const Output& o) { return o.oldest == o.chunks(); });
}

}  // namespace keyline
