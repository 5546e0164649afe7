// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/plan_memory.h"

#include "engine/io/image_module.h"
#include "engine/io/image_sink.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <set>
#include <utility>

namespace keyline {

namespace {

// The program, its libraries and their heaps before a frame is begun; measured with an empty graph.
constexpr std::size_t kProcessBytes = std::size_t{12} << 20;
// A worker's stack as far as it is touched, and the allocator's arena.
constexpr std::size_t kWorkerBytes = std::size_t{512} << 10;

std::size_t process_bytes(const Plan& plan) {
    const bool has_module = module_is_loaded() || std::ranges::any_of(plan.frame.sinks, [](const Sink& sink) {
                                return needs_module(sink.request.file);
                            });
    return kProcessBytes + (has_module ? kModuleBytes : 0);
}

std::size_t scratch_bytes(const Plan& plan, const Sweep& sweep) {
    if (sweep.area.empty()) return 0;
    const Rect middle = sweep.tile(sweep.columns.size() / 2, sweep.rows.size() / 2);
    const std::vector<Rect> regions = step_regions(plan, sweep, middle);
    std::vector<std::size_t> slots(static_cast<std::size_t>(sweep.slots), 0);
    std::size_t largest = 0;
    for (std::size_t i = 0; i < regions.size(); ++i) {
        const auto bytes = static_cast<std::size_t>(regions[i].area()) * sizeof(float);
        largest = std::max(largest, bytes);
        for (const int s : sweep.steps[i].slots) {
            if (s == Step::kUnwanted) continue;
            std::size_t& slot = slots[static_cast<std::size_t>(s)];
            slot = std::max(slot, bytes);
        }
    }
    std::size_t sum = 2 * largest;  // what the operations take for themselves
    for (const std::size_t s : slots) sum += s;
    return sum;
}

SinkShape shape(const Sink& sink) { return sink_shape(sink.request.file, sink.request.spec); }

// Rows waiting to be encoded, and the chunks that are: one a worker.
std::size_t sink_bytes(const Plan& plan, const Sweep& sweep, const Sink& sink) {
    const SinkShape s = shape(sink);
    const int rows = plan.rows_ahead * sweep.tile_height + plan.threads * s.chunk_rows;
    const SinkSpec& spec = sink.request.spec;
    const int most = std::max(spec.display_window.height(), spec.data_window.height());
    return s.row_bytes * static_cast<std::size_t>(std::min(rows, most));
}

// What a worker packs a chunk in: the samples in the file's order, parted and differenced, and compressed.
std::size_t packing_bytes(const Sink& sink) {
    const SinkShape s = shape(sink);
    return 3 * static_cast<std::size_t>(s.chunk_rows) * s.row_bytes;
}

// What a worker has packed in up to a sweep: it stays with the sink.
std::size_t packing_bytes(const Plan& plan, std::size_t sweep) {
    std::size_t sum = 0;
    for (std::size_t s = 0; s <= sweep; ++s)
        for (const Root& root : plan.sweeps[s].roots)
            if (root.kind == Root::Kind::kSink)
                sum += packing_bytes(plan.frame.sinks[static_cast<std::size_t>(root.sink)]);
    return sum;
}

bool is_resident(const Plan& plan, const Store& store) {
    return std::ranges::all_of(store.values,
                               [&](ValueRef v) { return resident_plane(plan.frame, v).data != nullptr; });
}

// What a worker decodes in up to a sweep: it stays with the source.
std::size_t decoding_bytes(const Plan& plan, int sweep) {
    std::set<std::pair<int, std::size_t>> groups;
    for (const Store& store : plan.stores)
        if (store.source_op >= 0 && store.first_sweep <= sweep && !is_resident(plan, store))
            groups.emplace(store.source_op, store.group);
    std::size_t sum = 0;
    for (const auto& [op, group] : groups)
        sum += plan.frame.ops[static_cast<std::size_t>(op)].source->chunk_memory(group);
    return sum;
}

bool is_alive(const Store& store, int sweep) {
    return store.first_sweep <= sweep && sweep <= store.last_sweep;
}

}  // namespace

int live_rows(const Plan& plan, const Sweep& sweep, const Store& store) {
    const auto index = static_cast<std::size_t>(&store - plan.stores.data());
    // One thread computes what is ready before it decodes more.
    const std::size_t in_work = plan.threads == 1 ? 1 : static_cast<std::size_t>(plan.rows_ahead);
    int most = 0;
    for (std::size_t row = 0; row < sweep.rows.size(); ++row) {
        Rect tiles;
        for (std::size_t r = row; r < std::min(sweep.rows.size(), row + in_work); ++r)
            tiles = unite(tiles, sweep.row_rect(r));
        const Rect needed = store_regions(plan, sweep, tiles)[index];
        if (needed.empty()) continue;
        const int first = floor_div(needed.y0 - store.band_origin, store.band_height),
                  last = floor_div(needed.y1 - 1 - store.band_origin, store.band_height);
        most = std::max(most, (last + 1 - first) * store.band_height);
    }
    return std::min(store.region.height(), most);
}

void estimate_memory(Plan& plan) {
    plan.memory_bytes = 0;
    const std::size_t process = process_bytes(plan);
    for (std::size_t s = 0; s < plan.sweeps.size(); ++s) {
        Sweep& sweep = plan.sweeps[s];
        const int index = static_cast<int>(s);
        sweep.scratch_bytes = scratch_bytes(plan, sweep);
        std::size_t worker = kWorkerBytes + sweep.scratch_bytes, frame = 0;
        for (const Store& store : plan.stores) {
            if (!is_alive(store, index) || is_resident(plan, store)) continue;
            const bool passing = store.first_sweep == store.last_sweep && store.source_op >= 0;
            frame += passing ? store.row_bytes() * static_cast<std::size_t>(live_rows(plan, sweep, store))
                             : store.bytes();
        }
        worker += decoding_bytes(plan, index);
        for (const Root& root : sweep.roots) {
            if (root.kind != Root::Kind::kSink) continue;
            const Sink& sink = plan.frame.sinks[static_cast<std::size_t>(root.sink)];
            frame += sink_bytes(plan, sweep, sink);
        }
        worker += packing_bytes(plan, s);
        for (const Op& op : plan.frame.ops)
            if (op.operation && op.operation->reduction() && !op.links.empty())
                frame += op.operation->reduction()->state_bytes(op.links.front().window);
        frame += frame / 64;  // what the allocator adds
        sweep.memory_bytes = process + frame + worker * static_cast<std::size_t>(plan.threads);
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
