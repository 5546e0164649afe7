// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/plan/memory.h"

#include "engine/base/aligned.h"
#include "engine/base/index.h"
#include "engine/io/image_sink.h"
#include "engine/io/other_formats.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <numeric>
#include <set>
#include <string_view>
#include <utility>

namespace keyline {

namespace {

// The program, its libraries and their heaps before a frame is begun; measured with an empty graph,
// optimised.
constexpr std::size_t kProcessBytes = std::size_t{14} << 20;
// A worker's stack as far as it is touched, and the allocator's arena.
constexpr std::size_t kWorkerBytes = std::size_t{512} << 10;

std::size_t process_bytes(const Plan& plan) {
    const bool has_helper =
        picture_helper_runs() || std::ranges::any_of(plan.frame.sinks, [](const Sink& sink) {
            const SinkRequest& r = sink.request;
            return !r.stream.is_data() && !r.file.empty() && is_other_format(r.file);
        });
    return kProcessBytes + (has_helper ? kPictureHelperBytes : 0);
}

// A buffer of a tile worker, whose rows start on cache lines.
std::size_t buffer_bytes(const Rect& region) {
    constexpr std::size_t kLine = kCacheLine / sizeof(float);
    const std::size_t stride = (static_cast<std::size_t>(region.width()) + kLine - 1) / kLine * kLine;
    return stride * static_cast<std::size_t>(region.height()) * sizeof(float);
}

// What a worker computes tiles in.  Its buffers stay from sweep to sweep, each as large as it ever was.
struct WorkerScratch {
    std::vector<std::size_t> slots;
    std::size_t own = 0;  // what operations take for themselves: about two of their largest views

    void add(const Plan& plan, const Sweep& sweep) {
        slots.resize(std::max(slots.size(), static_cast<std::size_t>(sweep.slots)), 0);
        for (const Rect& tile : sample_tiles(sweep)) {
            const std::vector<Rect> regions = step_regions(plan, sweep, tile);
            for (std::size_t i = 0; i < regions.size(); ++i) {
                const std::size_t bytes = buffer_bytes(regions[i]);
                own = std::max(own, 2 * bytes);
                for (const int s : sweep.steps[i].slots)
                    if (s != Step::kUnwanted) slots[index(s)] = std::max(slots[index(s)], bytes);
            }
        }
    }
    std::size_t bytes() const { return std::accumulate(slots.begin(), slots.end(), own); }
};

int64_t chunks_of(const Plan& plan, std::size_t sink) {
    const SinkSpec& spec = plan.frame.sinks[sink].request.spec;
    const int64_t rows = std::max(spec.display_window.height(), spec.data_window.height());
    return rows / std::max(1, plan.sink_shapes[sink].chunk_rows) + 1;
}

const ChannelGroup& group_of(const Plan& plan, const Store& store) {
    return plan.frame.ops[index(store.source_op)].source->header().groups[store.group];
}

// Rows waiting to be encoded, and the chunks that are: one a worker.
std::size_t sink_bytes(const Plan& plan, const Sweep& sweep, std::size_t sink) {
    const SinkShape& shape = plan.sink_shapes[sink];
    const SinkSpec& spec = plan.frame.sinks[sink].request.spec;
    const int64_t rows = int64_t{plan.rows_ahead} * sweep.tile_height +
                         std::min<int64_t>(plan.threads, chunks_of(plan, sink)) * shape.chunk_rows;
    const int64_t most = std::max(spec.display_window.height(), spec.data_window.height());
    return shape.row_bytes * static_cast<std::size_t>(std::min(rows, most));
}

bool is_resident(const Plan& plan, const Store& store) {
    return std::ranges::all_of(store.values,
                               [&](ValueRef v) { return resident_plane(plan.frame, v).data != nullptr; });
}

// The rows of tiles from which the needs of a sweep are looked at: all, or so many spread over it.  The steps
// are odd, so that they meet bands and tiles in every position to each other.
std::vector<std::size_t> sampled_rows(const Sweep& sweep) {
    constexpr std::size_t kMost = 32;
    const std::size_t step = sweep.rows.size() <= kMost ? 1 : sweep.rows.size() / kMost | 1;
    std::vector<std::size_t> out;
    for (std::size_t row = 0; row < sweep.rows.size(); row += step) out.push_back(row);
    return out;
}

// By store: the rows that are held at once of what only passes through a sweep.
std::vector<int64_t> passing_rows(const Plan& plan, const Sweep& sweep) {
    std::vector<int64_t> most(plan.stores.size(), 0);
    // One thread computes what is ready before it decodes more.
    const std::size_t in_work = plan.threads == 1 ? 1 : static_cast<std::size_t>(plan.rows_ahead);
    for (const std::size_t row : sampled_rows(sweep)) {
        Rect tiles;
        for (std::size_t r = row; r < std::min(sweep.rows.size(), row + in_work); ++r)
            tiles = unite(tiles, sweep.row_rect(r));
        const std::vector<Rect> needed = store_regions(plan, sweep, tiles);
        for (std::size_t s = 0; s < needed.size(); ++s) {
            const Store& store = plan.stores[s];
            if (needed[s].empty()) continue;
            const int64_t first = floor_div(needed[s].y0 - store.band_origin, store.band_height),
                          last = floor_div(needed[s].y1 - 1 - store.band_origin, store.band_height);
            most[s] = std::max(most[s], (last + 1 - first) * store.band_height);
        }
    }
    for (std::size_t s = 0; s < most.size(); ++s)
        most[s] = std::min<int64_t>(most[s], plan.stores[s].region.height());
    return most;
}

// Chunks that were decoded at once in the sweeps so far, by source and group: each had buffers or a helper
// process of its own, which stay with the source.
class Decoders {
public:
    // No more at once than the rows in work need, nor than there are threads.
    void add(const Plan& plan, const Sweep& sweep, const std::vector<int64_t>& rows) {
        for (const int i : sweep.reads) {
            const Store& store = plan.stores[index(i)];
            if (is_resident(plan, store)) continue;
            const ChannelGroup& group = group_of(plan, store);
            const int64_t columns =
                std::min(group.columns(), floor_div(store.region.width() - 1, group.chunk_width) + 2);
            const int64_t bands = (rows[index(i)] + store.band_height - 1) / store.band_height;
            int64_t& most = at_once_[{store.source_op, store.group}];
            most = std::max(most, std::min<int64_t>(plan.threads, bands * columns));
        }
    }

    std::size_t bytes(const Plan& plan) const {
        std::size_t sum = 0;
        int last = -1;  // of a source's groups the first tells what it holds
        for (const auto& [group, n] : at_once_) {
            const ImageSource& source = *plan.frame.ops[index(group.first)].source;
            sum += static_cast<std::size_t>(n) * source.chunk_memory(group.second);
            if (std::exchange(last, group.first) != group.first) sum += source.held_memory();
        }
        return sum;
    }

private:
    std::map<std::pair<int, std::size_t>, int64_t> at_once_;
};

// What is encoded in up to a sweep: it stays with the sink.
std::size_t encoding_bytes(const Plan& plan, std::size_t sweep) {
    std::size_t sum = 0;
    for (std::size_t s = 0; s <= sweep; ++s)
        for (const Root& root : plan.sweeps[s].roots) {
            if (root.kind != Root::Kind::kSink) continue;
            const auto sink = static_cast<std::size_t>(root.sink);
            sum += plan.sink_memory[sink].encode *
                   static_cast<std::size_t>(std::min<int64_t>(plan.threads, chunks_of(plan, sink)));
        }
    return sum;
}

std::size_t text_bytes(const Metadata& metadata, std::string_view ending) {
    std::size_t sum = 0;
    for (const Attribute& a : metadata.attributes())
        if (const auto* text = std::get_if<std::string>(&a.value); text && a.name.ends_with(ending))
            sum += text->size();
    return sum;
}

// How many times over a source holds the texts of its header.
constexpr std::size_t kInSource = 5;

// What earlier frames left, and the headers of the files that it came from.
std::size_t bytes_of_earlier_frames(const Plan& plan) {
    std::set<const ImageSource*> counted;
    for (const Op& op : plan.frame.ops) counted.insert(op.source.get());
    std::size_t sum = plan.carrying.held_bytes();
    for (const Carried& held : plan.carrying.held)
        for (const auto& source : held.sources)
            if (counted.insert(source.get()).second)
                sum += kInSource * text_bytes(source->header().metadata, "");
    return sum + sum / 64;
}

// Headers are small but for texts, and those but for the manifests of Cryptomattes, which may be megabytes.
// How many times over they are held was measured with manifests of 4 and 9 MB.
std::size_t header_bytes(const Plan& plan) {
    constexpr std::size_t kInSink = 6, kParsed = 6;
    std::size_t sum = 0;
    for (const Op& op : plan.frame.ops)
        if (op.source)
            sum += kInSource * text_bytes(op.source->header().metadata, "") +
                   kParsed * text_bytes(op.source->header().metadata, "/manifest");
    for (const Sink& sink : plan.frame.sinks) sum += kInSink * text_bytes(sink.request.spec.metadata, "");
    return sum;
}

std::size_t store_bytes(const Plan& plan, std::size_t index, const std::vector<int64_t>& rows) {
    std::size_t sum = 0;
    for (std::size_t s = 0; s < plan.stores.size(); ++s) {
        const Store& store = plan.stores[s];
        const int now = static_cast<int>(index);
        if (store.held >= 0 || now < store.first_sweep || now > store.last_sweep || is_resident(plan, store))
            continue;
        const bool passing = store.first_sweep == store.last_sweep && store.source_op >= 0;
        sum += passing ? store.row_bytes() * static_cast<std::size_t>(rows[s]) : store.bytes();
    }
    return sum;
}

// Data, from the sweep that they are made at the end of.
std::size_t data_bytes(const Plan& plan, int sweep) {
    std::size_t sum = 0;
    for (const PlannedDatum& d : plan.data)
        if (d.held < 0 && d.made_before <= sweep + 1 && sweep <= d.last_sweep) sum += d.bytes;
    return sum;
}

// What gathers have folded so far, and the partials that may wait for one that is folded before them: those
// of all tiles in work but one.
std::size_t gathering_bytes(const Plan& plan, const Sweep& sweep) {
    const auto rows = std::min(sweep.rows.size(), static_cast<std::size_t>(plan.rows_ahead));
    const std::size_t in_work = plan.threads == 1 ? 1 : rows * sweep.columns.size();
    std::size_t sum = 0;
    for (const Root& root : sweep.roots) {
        if (root.kind != Root::Kind::kMap) continue;
        const Op& op = plan.frame.ops[index(root.op)];
        const Rect tile{0, 0, std::min(sweep.tile_width, root.region.width()),
                        std::min(sweep.tile_height, root.region.height())};
        sum += op.gather->state_bytes(op.outputs.front().window) + in_work * op.gather->partial_bytes(tile);
    }
    return sum;
}

}  // namespace

void estimate_memory(Plan& plan) {
    std::size_t always = process_bytes(plan) + header_bytes(plan) + bytes_of_earlier_frames(plan);
    for (const SinkMemory& memory : plan.sink_memory) always += memory.held;
    plan.memory_bytes = always + data_bytes(plan, -1);
    WorkerScratch scratch;
    Decoders decoders;
    for (std::size_t s = 0; s < plan.sweeps.size(); ++s) {
        Sweep& sweep = plan.sweeps[s];
        const std::vector<int64_t> rows = passing_rows(plan, sweep);
        scratch.add(plan, sweep);
        decoders.add(plan, sweep, rows);
        sweep.scratch_bytes = scratch.bytes();
        const std::size_t workers =
            (kWorkerBytes + sweep.scratch_bytes) * static_cast<std::size_t>(plan.threads) +
            decoders.bytes(plan) + encoding_bytes(plan, s);
        std::size_t frame =
            store_bytes(plan, s, rows) + data_bytes(plan, static_cast<int>(s)) + gathering_bytes(plan, sweep);
        for (const Root& root : sweep.roots)
            if (root.kind == Root::Kind::kSink)
                frame += sink_bytes(plan, sweep, static_cast<std::size_t>(root.sink));
        frame += frame / 64;  // what the allocator adds
        sweep.memory_bytes = always + frame + workers;
        plan.memory_bytes = std::max(plan.memory_bytes, sweep.memory_bytes);
    }
}

std::string memory_text(std::size_t bytes) {
    constexpr double kMega = 1024.0 * 1024.0, kGiga = 1024.0 * kMega;
    const auto b = static_cast<double>(bytes);
    if (b < 10 * kGiga) return fmt::format("{:.0f}M", std::max(1.0, std::ceil(b / kMega)));
    return fmt::format("{:.0f}G", std::ceil(b / kGiga));
}

}  // namespace keyline
