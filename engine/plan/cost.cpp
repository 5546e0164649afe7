// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/plan/cost.h"

#include "engine/base/index.h"

#include <algorithm>

namespace keyline {

namespace {

// Nanoseconds of one thread, measured on an EPYC 9005 with --profile and with and without --memory 64M:
// bench/lines.json at 4K, a plate of 33 channels, ZIP in and out; the tile with --tile 8 against --tile 64.
constexpr double kOfCost = 0.05;  // a unit of Operation::cost(), a pixel
constexpr double kLoad = 0.45;    // a sample from a store to floats
constexpr double kKeep = 3;       // a sample held until a later sweep
constexpr double kDecode = 0.8;   // a byte unpacked, wanted or not
constexpr double kEncode = 6.6;   // a byte packed
constexpr double kTile = 3000;    // a tile, whatever is computed in it

// Of work that `threads` share, the last piece is done while the others have nothing to do (Graham's bound):
// one piece takes as long on many threads as on one.
double shared(double work, double pieces, double threads) {
    const double together = std::max(1.0, std::min(threads, pieces));
    return work * (1 / together + (1 - 1 / together) / std::max(1.0, pieces));
}

// What a tile costs in computing.
double computing(const Plan& plan, const Sweep& sweep, const Rect& tile) {
    const std::vector<Rect> regions = step_regions(plan, sweep, tile);
    double sum = 0;
    for (std::size_t i = 0; i < regions.size(); ++i) {
        const Step& step = sweep.steps[i];
        const Op& op = plan.frame.ops[index(step.op)];
        const double cost = step.kind == Step::Kind::kLoad ? kLoad : kOfCost * op.operation->cost();
        // A stencil may work on all that it reads: a blur in x and y blurs the rows above and below in x.
        Rect worked = regions[i];
        if (step.kind == Step::Kind::kCompute)
            worked = intersect(grow(worked, op.operation->halo()), op.outputs.front().window);
        sum += cost * static_cast<double>(worked.area());
    }
    return sum;
}

// All tiles, from a few: there may be millions.  Each counts by its area, as those at the edges are parts.
double computing(const Plan& plan, const Sweep& sweep) {
    double sampled = 0, area = 0, width = 0, height = 0;
    for (const Rect& tile : sample_tiles(sweep)) {
        sampled += computing(plan, sweep, tile);
        area += static_cast<double>(tile.area());
    }
    for (std::size_t column = 0; column < sweep.columns.size(); ++column)
        width += sweep.tile(column, 0).width();
    for (std::size_t row = 0; row < sweep.rows.size(); ++row) height += sweep.row_rect(row).height();
    return area > 0 ? sampled / area * width * height : 0;
}

double keeping(const Store& store) {
    const bool is_kept = store.held < 0 && store.last_sweep > store.first_sweep;
    return is_kept
               ? kKeep * static_cast<double>(store.values.size()) * static_cast<double>(store.region.area())
               : 0;
}

// A task is a chunk.
double decoding(const Plan& plan, const Store& store) {
    const Op& op = plan.frame.ops[index(store.source_op)];
    const ChannelGroup& group = op.source->header().groups[store.group];
    double pixel = 0;
    for (const ChannelInfo& c : group.channels) pixel += static_cast<double>(sample_size(c.type));
    const double chunks = static_cast<double>(store.region.area()) /
                          (static_cast<double>(group.chunk_width) * group.chunk_height);
    return shared(kDecode * pixel * static_cast<double>(store.region.area()), chunks, plan.threads);
}

double leaving(const Plan& plan, const Root& root) {
    const auto pixels = static_cast<double>(root.region.area());
    if (root.kind == Root::Kind::kKeep) return 0;  // the store's
    // What becomes of a datum costs the same in every plan of the frame: it ranks none.
    if (root.kind == Root::Kind::kMap) return kOfCost * pixels / plan.threads;
    const auto sink = static_cast<std::size_t>(root.sink);
    double pixel = 0;
    for (const ChannelInfo& c : plan.frame.sinks[sink].request.spec.channels)
        pixel += static_cast<double>(sample_size(c.type));
    const double chunks = root.region.height() / std::max(1.0, double(plan.sink_shapes[sink].chunk_rows));
    return shared(kEncode * pixel * pixels, chunks, plan.threads);
}

double nanoseconds(const Plan& plan, const Sweep& sweep) {
    if (sweep.area.empty()) return 0;
    const double columns = static_cast<double>(sweep.columns.size()),
                 rows = static_cast<double>(sweep.rows.size());
    // No more tiles are in work than lie in the rows that are open.
    const double threads = std::min<double>(plan.threads, columns * plan.rows_ahead);
    const double tiles = columns * rows;
    double sum = shared(computing(plan, sweep) + kTile * tiles, tiles, threads);
    for (const int store : sweep.reads) sum += decoding(plan, plan.stores[index(store)]);
    for (const Root& root : sweep.roots) sum += leaving(plan, root);
    return sum;
}

}  // namespace

double carrying_saves(const Plan& plan) {
    double sum = 0;
    for (const Store& store : plan.stores) {
        if (!store.carry_until) continue;
        if (store.source_op >= 0) {
            sum += decoding(plan, store);
            continue;
        }
        const Op& op = plan.frame.ops[index(store.values.front().op)];
        sum += kOfCost * op.operation->cost() * static_cast<double>(store.region.area()) / plan.threads;
    }
    for (const PlannedDatum& d : plan.data)
        if (d.carry_until)
            sum += kOfCost * static_cast<double>(plan.frame.info({d.op, 0}).window.area()) / plan.threads;
    return sum / 1e9;
}

double tiling_overhead(const Plan& plan, const Sweep& sweep) {
    const double whole = computing(plan, sweep, sweep.area);
    return whole > 0 ? computing(plan, sweep) / whole : 1;
}

void estimate_time(Plan& plan) {
    plan.seconds = 0;
    for (Sweep& sweep : plan.sweeps) {
        sweep.seconds = nanoseconds(plan, sweep) / 1e9;
        plan.seconds += sweep.seconds;
    }
    for (const Store& store : plan.stores) plan.seconds += keeping(store) / plan.threads / 1e9;
}

}  // namespace keyline
