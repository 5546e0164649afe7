// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/tiled_node.h"

#include <algorithm>
#include <stdexcept>

namespace keyline::bench {

namespace {

constexpr int kPadding = 16;  // a node may touch what a vector's width adds to a row

const Op& operation_of(const Plan& plan) {
    const auto op = std::ranges::find_if(
        plan.frame.ops, [](const Op& o) { return o.operation && o.title.starts_with("node 'result'"); });
    if (op == plan.frame.ops.end()) throw std::runtime_error("node 'result' computes nothing");
    return *op;
}

}  // namespace

TiledNode::TiledNode(const std::string& nodes, const Picture& picture)
    : graph_(nodes, picture, 1),
      plan_(graph_.plan()),
      op_(&operation_of(plan_)),
      window_{0, 0, picture.width, picture.height},
      samples_(picture.planes[0]) {
    samples_.resize(samples_.size() + kPadding);
    const Sweep& sweep = plan_.sweeps.back();
    tile_.resize(static_cast<std::size_t>(sweep.tile_width + kPadding) *
                 static_cast<std::size_t>(sweep.tile_height + 1));
}

void TiledNode::run() {
    const Sweep& sweep = plan_.sweeps.back();
    for (std::size_t row = 0; row < sweep.rows.size(); ++row)
        for (std::size_t column = 0; column < sweep.columns.size(); ++column)
            compute(sweep.tile(column, row));
}

void TiledNode::compute(const Rect& tile) {
    const Rect seen = intersect(op_->operation->demand(tile, 0), window_);
    const View all{samples_.data(), window_.width(), window_, window_};
    const View in{all.at(seen.x0, seen.y0), all.stride, seen, window_};
    const MutView out{tile_.data(), tile.width() + kPadding, tile, window_};
    constexpr Inputs::Range kOne{0, 1};
    constexpr const Datum* kNoDatum = nullptr;
    op_->operation->compute(Inputs({&in, 1}, {&kOne, 1}, {&kNoDatum, 1}), {&out, 1}, scratch_);
    scratch_.reset();
}

}  // namespace keyline::bench
