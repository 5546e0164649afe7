// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/plan_cost.h"

#include <algorithm>

namespace keyline {

namespace {

// Nanoseconds of one thread, measured on an EPYC 9005 with --profile and with and without --memory 64M:
// bench/lines.json at 4K, a plate of 33 channels, ZIP in and out.
constexpr double kOfCost = 0.05;  // a unit of Operation::cost(), a pixel
constexpr double kLoad = 0.45;    // a sample from a store to floats
constexpr double kKeep = 3;       // a sample held until a later sweep
constexpr double kDecode = 0.8;   // a byte unpacked, wanted or not
constexpr double kEncode = 6.6;   // a byte packed

// What a tile in the middle of a sweep costs in computing, and what it would without halos.
struct TileCost {
    double spent = 0, wanted = 0;
};

Rect middle_tile(const Sweep& sweep) {
    const Rect tile = intersect({0, 0, sweep.tile_width, sweep.tile_height},
                                {0, 0, sweep.area.width(), sweep.area.height()});
    return translate(tile, sweep.area.x0 + (sweep.area.width() - tile.width()) / 2,
                     sweep.area.y0 + (sweep.area.height() - tile.height()) / 2);
}

// How many of these there are; those at the edges are parts.
double tiles(const Sweep& sweep) {
    double width = 0, height = 0;
    for (std::size_t column = 0; column < sweep.columns.size(); ++column)
        width += sweep.tile(column, 0).width();
    for (std::size_t row = 0; row < sweep.rows.size(); ++row) height += sweep.row_rect(row).height();
    return width * height / static_cast<double>(middle_tile(sweep).area());
}

TileCost tile_cost(const Plan& plan, const Sweep& sweep) {
    const Rect tile = middle_tile(sweep);
    const std::vector<Rect> regions = step_regions(plan, sweep, tile);
    TileCost sum;
    for (std::size_t i = 0; i < regions.size(); ++i) {
        const Step& step = sweep.steps[i];
        const Op& op = plan.frame.ops[static_cast<std::size_t>(step.op)];
        const double cost = step.kind == Step::Kind::kLoad ? kLoad : kOfCost * op.operation->cost();
        // A stencil may work on all that it reads: a blur in x and y blurs the rows above and below in x.
        Rect worked = regions[i];
        if (step.kind == Step::Kind::kCompute)
            worked = intersect(grow(worked, op.operation->halo()), op.outputs.front().window);
        sum.spent += cost * static_cast<double>(worked.area());
        sum.wanted += cost * static_cast<double>(std::min(worked.area(), tile.area()));
    }
    return sum;
}

double keeping(const Store& store) {
    const bool is_kept = store.last_sweep > store.first_sweep;
    return is_kept
               ? kKeep * static_cast<double>(store.values.size()) * static_cast<double>(store.region.area())
               : 0;
}

double decoding(const Plan& plan, const Store& store) {
    const Op& op = plan.frame.ops[static_cast<std::size_t>(store.source_op)];
    double pixel = 0;
    for (const ChannelInfo& c : op.source->header().groups[store.group].channels)
        pixel += static_cast<double>(sample_size(c.type));
    return kDecode * pixel * static_cast<double>(store.region.area());
}

double leaving(const Plan& plan, const Root& root) {
    const auto pixels = static_cast<double>(root.region.area());
    if (root.kind == Root::Kind::kKeep) return 0;  // the store's
    if (root.kind == Root::Kind::kMap) return kOfCost * pixels;
    double pixel = 0;
    for (const ChannelInfo& c : plan.frame.sinks[static_cast<std::size_t>(root.sink)].request.spec.channels)
        pixel += static_cast<double>(sample_size(c.type));
    return kEncode * pixel * pixels;
}

}  // namespace

double halo_overhead(const Plan& plan, const Sweep& sweep) {
    if (sweep.area.empty()) return 1;
    const TileCost cost = tile_cost(plan, sweep);
    return cost.wanted > 0 ? cost.spent / cost.wanted : 1;
}

void estimate_work(Plan& plan) {
    double nanoseconds = 0;
    for (const Store& store : plan.stores) nanoseconds += keeping(store);
    for (const Sweep& sweep : plan.sweeps) {
        if (sweep.area.empty()) continue;
        nanoseconds += tile_cost(plan, sweep).spent * tiles(sweep);
        for (const int store : sweep.reads)
            nanoseconds += decoding(plan, plan.stores[static_cast<std::size_t>(store)]);
        for (const Root& root : sweep.roots) nanoseconds += leaving(plan, root);
    }
    plan.work = nanoseconds / 1e9;
}

}  // namespace keyline
