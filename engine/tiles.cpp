// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/tiles.h"

#include <algorithm>
#include <cstring>
#include <fmt/format.h>

namespace keyline {

namespace {

constexpr std::ptrdiff_t kRowFloats = 16;  // rows start on a cache line
constexpr std::size_t kSlack = 16;         // a vector that starts on the last pixel stays inside the buffer

std::ptrdiff_t stride_of(const Rect& rect) {
    return (rect.width() + kRowFloats - 1) / kRowFloats * kRowFloats;
}

std::string rect_text(const Rect& r) { return fmt::format("[{},{} – {},{})", r.x0, r.y0, r.x1, r.y1); }

// Completes what a node threw with the node, the frame and the tile.
[[noreturn]] void rethrow(const Op& op, const Rect& tile) {
    const std::string title = fmt::format("{}, frame {}", op.title, op.frame);
    try {
        throw;
    } catch (const Failure& f) {
        Error e = f.error();
        if (e.node.empty()) e.node = title;
        throw Failure(std::move(e));
    } catch (const std::bad_alloc&) {
        throw Failure(
            {ErrorKind::kFailed, {}, title, "out of memory", "give a smaller --memory or fewer --threads"});
    } catch (const std::exception& e) {
        throw Failure(
            {ErrorKind::kInternal, {}, title, fmt::format("{} in tile {}", e.what(), rect_text(tile)), {}});
    }
}

}  // namespace

TileResult TileWorker::compute(const Plan& plan, const Sweep& sweep, FrameData& data, const Rect& tile) {
    plan_ = &plan;
    sweep_ = &sweep;
    data_ = &data;
    tile_ = tile;
    regions_ = step_regions(plan, sweep, tile);
    results_.resize(std::max(results_.size(), sweep.steps.size()));
    buffers_.resize(std::max(buffers_.size(), static_cast<std::size_t>(sweep.slots)));
    for (std::size_t i = 0; i < sweep.steps.size(); ++i) {
        const Op& op = plan.frame.ops[static_cast<std::size_t>(sweep.steps[i].op)];
        try {
            const Activity activity =
                sweep.steps[i].kind == Step::Kind::kLoad ? Activity::kLoad : Activity::kCompute;
            Timed time = timed(activity, op.title);
            time.pixels(regions_[i].area(), intersect(regions_[i], tile).area());
            run_step(i);
        } catch (...) {
            rethrow(op, tile);
        }
    }
    TileResult result;
    result.partials.resize(sweep.roots.size());
    result.overflowed.resize(sweep.roots.size());
    for (std::size_t i = 0; i < sweep.roots.size(); ++i) run_root(i, result);
    return result;
}

Timed TileWorker::timed(Activity activity, const std::string& title) const {
    const int sweep = static_cast<int>(sweep_ - plan_->sweeps.data());
    return {data_->recorder, activity, title, plan_->frame.frame, sweep, id_};
}

float* TileWorker::Buffer::with(std::size_t floats) {
    if (size < floats) {
        memory.reset();  // first, so that old and new never stand beside each other
        memory = make_aligned<float>(floats);
        size = floats;
    }
    return memory.get();
}

MutView TileWorker::buffer(int slot, const Rect& rect, const Rect& window) {
    const std::ptrdiff_t stride = stride_of(rect);
    const auto rows = static_cast<std::size_t>(rect.height());
    return {buffers_[static_cast<std::size_t>(slot)].with(static_cast<std::size_t>(stride) * rows + kSlack),
            stride, rect, window};
}

// All rows lie on each other: what nobody reads takes no way through memory.
MutView TileWorker::unwanted(std::size_t output, const Rect& rect, const Rect& window) {
    unwanted_.resize(std::max(unwanted_.size(), output + 1));
    return {unwanted_[output].with(static_cast<std::size_t>(stride_of(rect)) + kSlack), 0, rect, window};
}

void TileWorker::run_step(std::size_t i) {
    const Step& step = sweep_->steps[i];
    const Op& op = plan_->frame.ops[static_cast<std::size_t>(step.op)];
    std::vector<MutView>& outputs = results_[i];
    outputs.clear();
    if (regions_[i].empty()) return;
    const auto first = static_cast<std::size_t>(step.output);
    if (step.kind == Step::Kind::kLoad) {
        const Bands& store = *data_->stores[static_cast<std::size_t>(step.store)];
        if (const auto view =
                store.view(static_cast<std::size_t>(step.plane), regions_[i], op.outputs[first].window))
            return outputs.push_back(*view);
    }
    for (std::size_t o = 0; o < step.slots.size(); ++o) {
        const Rect& window = op.outputs[first + o].window;
        outputs.push_back(step.slots[o] == Step::kUnwanted ? unwanted(o, regions_[i], window)
                                                           : buffer(step.slots[o], regions_[i], window));
    }
    switch (step.kind) {
        case Step::Kind::kLoad:
            data_->stores[static_cast<std::size_t>(step.store)]->load(static_cast<std::size_t>(step.plane),
                                                                      outputs[0]);
            break;
        case Step::Kind::kCompute: run_compute(i, op, outputs); break;
        case Step::Kind::kApply:
            op.operation->reduction()->apply(*data_->reductions[static_cast<std::size_t>(step.op)], outputs,
                                             scratch_);
            break;
    }
    scratch_.reset();
}

void TileWorker::run_compute(std::size_t i, const Op& op, Outputs outputs) {
    views_.clear();
    slots_.clear();
    std::size_t next = 0;
    for (std::size_t slot = 0; slot < op.links.size(); ++slot) {
        const Link& link = op.links[slot];
        const Rect rect = view_of_link(op, static_cast<int>(slot), regions_[i]);
        slots_.push_back({views_.size(), link.values.size()});
        for (const ValueRef v : link.values) gather(sweep_->operands[i][next++], link, v, rect);
    }
    op.operation->compute(Inputs(views_, slots_), outputs, scratch_);
}

// A view of `rect`: of the buffer itself where all of it was computed, else of a copy with zeros around.
void TileWorker::gather(const Operand& operand, const Link& link, ValueRef value, const Rect& rect) {
    const Rect valid =
        operand.step < 0 ? Rect{} : intersect(intersect(rect, link.window), plan_->frame.info(value).window);
    const MutView* from = nullptr;
    if (!valid.empty())
        from = &results_[static_cast<std::size_t>(operand.step)][static_cast<std::size_t>(operand.output)];
    if (from && valid == rect) {
        views_.push_back({from->at(rect.x0, rect.y0), from->stride, rect, link.window});
        return;
    }
    const std::ptrdiff_t stride = stride_of(rect);
    const std::span<float> memory =
        scratch_.floats(static_cast<std::size_t>(stride) * static_cast<std::size_t>(rect.height()) + kSlack);
    std::ranges::fill(memory, 0.0F);
    const MutView copy{memory.data(), stride, rect, link.window};
    for (int y = valid.y0; y < valid.y1; ++y)
        std::memcpy(copy.at(valid.x0, y), from->at(valid.x0, y),
                    static_cast<std::size_t>(valid.width()) * sizeof(float));
    views_.push_back(copy);
}

void TileWorker::run_root(std::size_t i, TileResult& result) {
    const Root& root = sweep_->roots[i];
    const std::string& title = root.kind == Root::Kind::kSink
                                   ? plan_->frame.sinks[static_cast<std::size_t>(root.sink)].title
                                   : plan_->frame.ops[static_cast<std::size_t>(root.op)].title;
    const Timed time = timed(root.kind == Root::Kind::kMap ? Activity::kMap : Activity::kKeep, title);
    switch (root.kind) {
        case Root::Kind::kMap: result.partials[i] = run_map(root); break;
        case Root::Kind::kSink: result.overflowed[i] = run_sink(root); break;
        case Root::Kind::kKeep: {
            Bands& bands = *data_->stores[static_cast<std::size_t>(root.store)];
            const Operand& o = root.operands[0];
            if (o.step < 0 || results_[static_cast<std::size_t>(o.step)].empty()) break;
            MutView view = results_[static_cast<std::size_t>(o.step)][static_cast<std::size_t>(o.output)];
            const Rect rect = intersect(tile_, root.region);
            view.data = view.at(rect.x0, rect.y0);
            view.rect = rect;
            if (!rect.empty()) bands.store(0, view);
            break;
        }
    }
    scratch_.reset();
}

std::unique_ptr<Memory> TileWorker::run_map(const Root& root) {
    const Op& op = plan_->frame.ops[static_cast<std::size_t>(root.op)];
    const Rect block = intersect(tile_, root.region);
    if (block.empty()) return nullptr;
    views_.clear();
    slots_.clear();
    std::size_t next = 0;
    for (const Link& link : op.links) {
        slots_.push_back({views_.size(), link.values.size()});
        for (const ValueRef v : link.values) gather(root.operands[next++], link, v, block);
    }
    try {
        return op.operation->reduction()->map(*data_->reductions[static_cast<std::size_t>(root.op)],
                                              Inputs(views_, slots_), block, scratch_);
    } catch (...) {
        rethrow(op, tile_);
    }
}

std::size_t TileWorker::run_sink(const Root& root) {
    Bands& bands = *data_->sinks[static_cast<std::size_t>(root.sink)];
    std::size_t overflowed = 0;
    for (std::size_t k = 0; k < root.operands.size(); ++k) {
        const Operand& o = root.operands[k];
        const Rect rect = intersect(sink_region(*plan_, root, k, tile_), bands.region());
        if (o.step < 0 || rect.empty()) continue;
        const Step& step = sweep_->steps[static_cast<std::size_t>(o.step)];
        if (root.untouched[k]) {
            bands.copy(k, *data_->stores[static_cast<std::size_t>(step.store)],
                       static_cast<std::size_t>(step.plane), rect);
            continue;
        }
        MutView view = results_[static_cast<std::size_t>(o.step)][static_cast<std::size_t>(o.output)];
        view.data = view.at(rect.x0, rect.y0);
        view.rect = rect;
        overflowed += bands.store(k, view);
    }
    return overflowed;
}

}  // namespace keyline
