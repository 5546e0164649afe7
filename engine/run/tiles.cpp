// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/run/tiles.h"

#include "engine/base/index.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <fmt/format.h>

namespace keyline {

namespace {

constexpr std::ptrdiff_t kRowFloats = 16;  // rows start on a cache line
constexpr std::size_t kSlack = 16;         // a vector that starts on the last pixel stays inside the buffer

std::ptrdiff_t stride_of(const Rect& rect) {
    return (rect.width() + kRowFloats - 1) / kRowFloats * kRowFloats;
}

}  // namespace

void rethrow_of(const Op& op, const std::string& where, const Rect& region) {
    const std::string title = fmt::format("{}, frame {}", op.title, op.frame);
    try {
        throw;
    } catch (const Failure& f) {
        rethrow_with(f, [&](Error& e) {
            if (e.node.empty()) e.node = title;
        });
    } catch (const std::bad_alloc&) {
        throw Failure({ErrorKind::kFailed,
                       {},
                       title,
                       "out of memory",
                       "give a smaller --memory or fewer --threads",
                       Passing::kMemory});
    } catch (const std::exception& e) {
        Error error{ErrorKind::kInternal, {}, title, fmt::format("{} {}", e.what(), where), {}};
        if (region.empty()) throw Failure(std::move(error));
        throw TileFailure(std::move(error), op, region);
    }
}

void collect_data(const Op& op, const FrameState& state, std::vector<const Datum*>& out) {
    out.clear();
    for (const Link& link : op.links) {
        out.push_back(link.datum.op < 0 ? nullptr : state.data[index(link.datum.op)].get());
        assert((link.datum.op < 0 || out.back()) && "a datum is read that is not made yet, or dropped");
    }
}

TileResult TileWorker::compute(const Plan& plan, const Sweep& sweep, FrameState& state, const Rect& tile) {
    plan_ = &plan;
    sweep_ = &sweep;
    state_ = &state;
    tile_ = tile;
    // What each step has to compute depends on the tile: at the frame's edges less, and nothing where a value
    // is 0 all over it.
    regions_ = step_regions(plan, sweep, tile);
    results_.resize(std::max(results_.size(), sweep.steps.size()));
    buffers_.resize(std::max(buffers_.size(), static_cast<std::size_t>(sweep.slots)));
    holds_.assign(buffers_.size(), -1);
    for (std::size_t i = 0; i < sweep.steps.size(); ++i) {
        const Op& op = plan.frame.ops[index(sweep.steps[i].op)];
        try {
            const Activity activity =
                sweep.steps[i].kind == Step::Kind::kLoad ? Activity::kLoad : Activity::kCompute;
            Timed time = timed(activity, op.title);
            time.pixels(regions_[i].area(), intersect(regions_[i], tile).area());
            run_step(i);
        } catch (...) {
            rethrow_of(op, "in " + to_string(regions_[i]), regions_[i]);
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
    return {state_->recorder, activity, title, plan_->frame.frame, sweep, id_};
}

// A buffer is kept for the next tile and never shrinks: all tiles but those at the edges are of one size.
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
    return {buffers_[index(slot)].with(static_cast<std::size_t>(stride) * rows + kSlack), stride, rect,
            window};
}

// All rows lie on each other: what nobody reads takes no way through memory.
MutView TileWorker::unwanted(std::size_t output, const Rect& rect, const Rect& window) {
    unwanted_.resize(std::max(unwanted_.size(), output + 1));
    return {unwanted_[output].with(static_cast<std::size_t>(stride_of(rect)) + kSlack), 0, rect, window};
}

void TileWorker::run_step(std::size_t i) {
    const Step& step = sweep_->steps[i];
    const Op& op = plan_->frame.ops[index(step.op)];
    std::vector<MutView>& outputs = results_[i];
    outputs.clear();
    if (regions_[i].empty()) return;
    const auto first = static_cast<std::size_t>(step.output);
    // Floats that lie in memory whole need no copy: the view goes straight there.
    if (step.kind == Step::Kind::kLoad) {
        const Bands& store = *state_->stores[index(step.store)];
        if (const auto view =
                store.view(static_cast<std::size_t>(step.plane), regions_[i], op.outputs[first].window))
            return outputs.push_back(*view);
    }
    for (std::size_t o = 0; o < step.slots.size(); ++o) {
        const Rect& window = op.outputs[first + o].window;
        if (step.slots[o] != Step::kUnwanted) holds_[index(step.slots[o])] = static_cast<int>(i);
        outputs.push_back(step.slots[o] == Step::kUnwanted ? unwanted(o, regions_[i], window)
                                                           : buffer(step.slots[o], regions_[i], window));
    }
    if (step.kind == Step::Kind::kLoad)
        state_->stores[index(step.store)]->load(static_cast<std::size_t>(step.plane), outputs[0]);
    else
        run_compute(i, op, outputs);
    // Copies of inputs and what the operation took are gone before the next step: scratch never adds up.
    scratch_.reset();
}

void TileWorker::run_compute(std::size_t i, const Op& op, Outputs outputs) {
    // The operands of a step stand in the order of its links, one a channel.
    views_.clear();
    slots_.clear();
    std::size_t next = 0;
    for (std::size_t slot = 0; slot < op.links.size(); ++slot) {
        const Link& link = op.links[slot];
        const Rect rect = view_of_link(op, static_cast<int>(slot), regions_[i]);
        slots_.push_back({views_.size(), link.values.size()});
        const Rect end = end_of_link(op, static_cast<int>(slot));
        for (const ValueRef v : link.values) gather(sweep_->operands[i][next++], link, v, rect, end);
    }
    collect_data(op, *state_, inputs_data_);
    op.operation->compute(Inputs(views_, slots_, inputs_data_), outputs, scratch_);
}

// What a step has made for this tile.
const MutView* TileWorker::result_of(const Operand& operand) const {
    const auto step = static_cast<std::size_t>(operand.step),
               output = static_cast<std::size_t>(operand.output);
    assert(output < results_[step].size() && "a step reads what none has written");
    const int slot = sweep_->steps[step].slots[output];
    assert(slot != Step::kUnwanted && "a step reads what was planned for nobody");
    // A load may be a view of a store, which lies in no slot.
    assert((sweep_->steps[step].kind == Step::Kind::kLoad || holds_[index(slot)] == operand.step) &&
           "a slot is read after another step has written it");
    static_cast<void>(slot);
    return &results_[step][output];
}

// A view of `rect`: of the buffer itself where all of it was computed, else of a copy with zeros around.
void TileWorker::gather(const Operand& operand, const Link& link, ValueRef value, const Rect& rect,
                        const Rect& end) {
    const Rect valid =
        operand.step < 0 ? Rect{} : intersect(intersect(rect, link.window), plan_->frame.info(value).window);
    const MutView* from = nullptr;
    if (!valid.empty()) from = result_of(operand);
    assert((!from || from->rect.contains(valid)) && "a tile computed less of a value than is read of it");
    if (from && valid == rect) {
        views_.push_back({from->at(rect.x0, rect.y0), from->stride, rect, end});
        return;
    }
    const std::ptrdiff_t stride = stride_of(rect);
    const std::span<float> memory =
        scratch_.floats(static_cast<std::size_t>(stride) * static_cast<std::size_t>(rect.height()) + kSlack);
    std::ranges::fill(memory, 0.0F);
    const MutView copy{memory.data(), stride, rect, end};
    for (int y = valid.y0; y < valid.y1; ++y)
        std::memcpy(copy.at(valid.x0, y), from->at(valid.x0, y),
                    static_cast<std::size_t>(valid.width()) * sizeof(float));
    views_.push_back(copy);
}

void TileWorker::run_root(std::size_t i, TileResult& result) {
    const Root& root = sweep_->roots[i];
    const std::string& title = root.kind == Root::Kind::kSink ? plan_->frame.sinks[index(root.sink)].title
                                                              : plan_->frame.ops[index(root.op)].title;
    const Timed time = timed(root.kind == Root::Kind::kMap ? Activity::kMap : Activity::kKeep, title);
    switch (root.kind) {
        case Root::Kind::kMap: result.partials[i] = run_map(root); break;
        case Root::Kind::kSink: result.overflowed[i] = run_sink(root); break;
        case Root::Kind::kKeep: {
            Bands& bands = *state_->stores[index(root.store)];
            const Operand& o = root.operands[0];
            // The tile lies beside what is kept.
            if (o.step < 0 || results_[index(o.step)].empty()) break;
            MutView view = *result_of(o);
            const Rect rect = intersect(tile_, root.region);
            assert(view.rect.contains(rect) && "a tile computed less of a value than is kept of it");
            view.data = view.at(rect.x0, rect.y0);
            view.rect = rect;
            if (!rect.empty()) bands.store(0, view);
            break;
        }
    }
    scratch_.reset();
}

std::unique_ptr<Gather::Partial> TileWorker::run_map(const Root& root) {
    const Op& op = plan_->frame.ops[index(root.op)];
    const Rect block = intersect(tile_, root.region);
    if (block.empty()) return nullptr;  // a tile of another root's
    views_.clear();
    slots_.clear();
    std::size_t next = 0;
    for (const Link& link : op.links) {
        slots_.push_back({views_.size(), link.values.size()});
        for (const ValueRef v : link.values) gather(root.operands[next++], link, v, block, link.extent);
    }
    collect_data(op, *state_, inputs_data_);
    try {
        return op.gather->map(*state_->gathering[index(root.op)], Inputs(views_, slots_, inputs_data_), block,
                              scratch_);
    } catch (...) {
        rethrow_of(op, "in " + to_string(block), block);
    }
}

std::size_t TileWorker::run_sink(const Root& root) {
    Bands& bands = *state_->sinks[index(root.sink)];
    // Channel by channel: they may have data windows of their own, and the band is 0 outside them.
    std::size_t overflowed = 0;
    for (std::size_t k = 0; k < root.operands.size(); ++k) {
        const Operand& o = root.operands[k];
        const Rect rect = intersect(sink_region(*plan_, root, k, tile_), bands.region());
        if (o.step < 0 || rect.empty()) continue;
        const Step& step = sweep_->steps[index(o.step)];
        // Straight from one band to the other, without a way through floats.
        if (root.untouched[k]) {
            bands.copy(k, *state_->stores[index(step.store)], static_cast<std::size_t>(step.plane), rect);
            continue;
        }
        MutView view = *result_of(o);
        assert(view.rect.contains(rect) && "a tile computed less of a value than is written of it");
        view.data = view.at(rect.x0, rect.y0);
        view.rect = rect;
        overflowed += bands.store(k, view);
    }
    return overflowed;
}

}  // namespace keyline
