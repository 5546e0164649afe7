// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/plan/carry.h"

#include "engine/base/index.h"
#include "engine/plan/plan.h"

#include <algorithm>
#include <fmt/format.h>
#include <optional>
#include <set>

namespace keyline {

namespace {

bool is_resident(const ResolvedFrame& frame, int op) {
    return frame.ops[index(op)].source && !frame.ops[index(op)].outputs.empty() &&
           resident_plane(frame, {op, 0}).data != nullptr;
}

std::vector<ValueRef> reads_of(const Op& op) {
    std::vector<ValueRef> out;
    for (const Link& link : op.links) {
        out.insert(out.end(), link.values.begin(), link.values.end());
        if (link.datum.op >= 0) out.push_back(link.datum);
    }
    return out;
}

std::vector<ValueRef> roots_of(const ResolvedFrame& frame) {
    std::vector<ValueRef> out;
    for (const Sink& sink : frame.sinks) {
        const Stream& stream = sink.request.stream;
        for (const StreamChannel& c : stream.channels) out.push_back(c.value);
        if (stream.datum.op >= 0) out.push_back(stream.datum);
    }
    return out;
}

// How much of each value there is: of those that are held, and of those that the frame makes.
class There {
public:
    There(const ResolvedFrame& frame, const Demand& demand, std::span<const Carried> held) {
        for (const Carried& h : held)
            for (std::size_t i = 0; i < h.keys.size(); ++i) regions_[h.keys[i]] = h.regions[i];
        for (std::size_t i = 0; i < frame.ops.size(); ++i) {
            const Op& op = frame.ops[i];
            if (!op.digest.known() || !demand.needs(i)) continue;
            for (int o = 0; o < static_cast<int>(op.outputs.size()); ++o) {
                const Rect& made = demand.of({static_cast<int>(i), o});
                const auto [it, is_new] = regions_.try_emplace({op.digest, o}, made);
                if (!is_new && !it->second.contains(made)) it->second = made;
            }
        }
    }

    bool has(const ValueKey& key, const Rect& region, bool is_exact) const {
        const auto it = regions_.find(key);
        if (it == regions_.end()) return false;
        return is_exact ? it->second == region : it->second.contains(region);
    }

private:
    std::map<ValueKey, Rect> regions_;
};

using Wants = std::map<ValueKey, LastUse>;

Wants wants_of(std::span<const ComingFrame> coming, const There& there) {
    Wants wants;
    const auto is_there = [&](const ValueKey& key, const Rect& region, bool is_exact) {
        return there.has(key, region, is_exact);
    };
    for (std::size_t turn = 0; turn < coming.size(); ++turn)
        for (const ValueKey& key : coming[turn].wanted(is_there)) wants[key] = {turn, coming[turn].frame()};
    return wants;
}

class Carrier {
public:
    Carrier(const ResolvedFrame& frame, const Demand& demand) : frame_(frame), demand_(demand) {
        for (std::size_t i = 0; i < frame.ops.size(); ++i)
            ops_.emplace(frame.ops[i].digest, static_cast<int>(i));
    }

    Carrying run(std::span<const Carried> held, const Wants& wants) {
        for (const Carried& h : held) take(h, wants);
        find_needed();
        leave(wants);
        return std::move(out_);
    }

private:
    const Op& op(int i) const { return frame_.ops[index(i)]; }
    Rect region_of(ValueRef v) const { return op(v.op).makes_data() ? Rect{} : demand_.of(v); }

    void take(const Carried& held, const Wants& wants) {
        std::vector<std::pair<ValueRef, std::size_t>> found;
        if (finds_the_same(held))
            for (std::size_t plane = 0; plane < held.keys.size(); ++plane) find(held, plane, found);
        std::optional<LastUse> last;
        for (const ValueKey& key : held.keys)
            if (const auto it = wants.find(key); it != wants.end()) last = std::max(last, {it->second});
        if (found.empty() && !last) return;
        for (const auto& [value, plane] : found)
            out_.found.try_emplace(value, Carrying::Found{out_.held.size(), plane});
        out_.held.push_back(held);
        out_.held.back().until = last ? last->frame : frame_.frame;
    }

    // All operations of the frame that make it: two nodes may read one file.
    void find(const Carried& held, std::size_t plane, std::vector<std::pair<ValueRef, std::size_t>>& found) {
        const ValueKey& key = held.keys[plane];
        for (auto [it, end] = ops_.equal_range(key.op); it != end; ++it) {
            const ValueRef v{it->second, key.output};
            const bool is_wanted = held.is_datum ? demand_.data[index(v.op)] : !demand_.of(v).empty();
            if (is_wanted && held.regions[plane].contains(region_of(v))) found.emplace_back(v, plane);
        }
    }

    // Whether the operations behind it would find what they found, if they ran in this frame.
    bool finds_the_same(const Carried& held) const {
        return std::ranges::all_of(held.behind, [&](const Carried::Behind& b) {
            const auto it = ops_.find(b.digest);
            return it != ops_.end() && demand_.region(index(it->second)) == b.region;
        });
    }

    void need(ValueRef v) {
        const bool is_demanded = op(v.op).makes_data() ? demand_.data[index(v.op)] : !demand_.of(v).empty();
        if (is_demanded && !out_.is_found(v)) out_.needed[index(v.op)] = true;
    }

    // Backward, as demand() does, but not through what is there.
    void find_needed() {
        out_.needed.resize(frame_.ops.size(), false);
        for (const ValueRef v : roots_of(frame_)) need(v);
        for (std::size_t i = frame_.ops.size(); i-- > 0;)
            if (out_.needed[i])
                for (const ValueRef v : reads_of(frame_.ops[i])) need(v);
    }

    void leave(const Wants& wants) {
        std::set<ValueKey> left;
        for (std::size_t i = 0; i < frame_.ops.size(); ++i) {
            const Op& made = frame_.ops[i];
            if (!out_.needed[i] || is_resident(frame_, static_cast<int>(i))) continue;
            for (int o = 0; o < static_cast<int>(made.outputs.size()); ++o) {
                const auto it = wants.find({made.digest, o});
                const ValueRef v{static_cast<int>(i), o};
                if (it == wants.end() || out_.is_found(v) || (!made.makes_data() && demand_.of(v).empty()))
                    continue;
                if (left.insert(it->first).second) out_.wanted[v] = it->second;
            }
        }
    }

    const ResolvedFrame& frame_;
    const Demand& demand_;
    std::multimap<Digest, int> ops_;
    Carrying out_;
};

std::string title_of(const Op& op) {
    if (op.source) return op.source->header().file.lexically_normal().string();
    return fmt::format("{}, frame {}", op.title, op.frame);
}

// What a value was made by, from the files on.
void add_behind(const Plan& plan, int from, Carried& held) {
    std::vector<int> open{from};
    std::set<int> seen;
    while (!open.empty()) {
        const int i = open.back();
        open.pop_back();
        if (!seen.insert(i).second) continue;
        const Op& op = plan.frame.ops[index(i)];
        if (op.source) held.sources.push_back(op.source);
        if (op.operation) held.behind.push_back({op.digest, plan.demand.region(index(i)), op.operation});
        for (const ValueRef v : reads_of(op)) open.push_back(v.op);
    }
    // What came to this frame itself brings along what is behind it.
    for (Carried::Behind& b : held.behind)
        for (const Carried& earlier : plan.carrying.held)
            for (const Carried::Behind& known : earlier.behind)
                if (known.digest == b.digest && known.region == b.region) b.operation = known.operation;
}

Carried held_store(const Plan& plan, int s) {
    const Store& store = plan.stores[index(s)];
    Carried held;
    for (const ValueRef v : store.values) {
        held.keys.push_back({plan.frame.ops[index(v.op)].digest, v.output});
        held.regions.push_back(plan.demand.of(v));
    }
    held.title = title_of(plan.frame.ops[index(store.values.front().op)]);
    held.types = store.types;
    held.region = store.region;
    held.band_origin = store.band_origin;
    held.band_height = store.band_height;
    held.bytes = store.bytes();
    held.until = *store.carry_until;
    held.made_as = s;
    add_behind(plan, store.values.front().op, held);
    return held;
}

Carried held_datum(const Plan& plan, const PlannedDatum& datum) {
    Carried held;
    held.is_datum = true;
    held.title = title_of(plan.frame.ops[index(datum.op)]);
    held.keys = {{plan.frame.ops[index(datum.op)].digest, 0}};
    held.regions = {Rect{}};
    held.bytes = datum.bytes;
    held.until = *datum.carry_until;
    held.made_as = datum.op;
    add_behind(plan, datum.op, held);
    return held;
}

}  // namespace

ComingFrame::ComingFrame(const ResolvedFrame& resolved, const Demand& demand)
    : frame_(resolved.frame), roots_(roots_of(resolved)) {
    for (std::size_t i = 0; i < resolved.ops.size(); ++i) {
        const Op& op = resolved.ops[i];
        Part part;
        part.digest = op.digest;
        part.is_source = op.source != nullptr;
        part.is_resident = is_resident(resolved, static_cast<int>(i));
        part.is_data = op.makes_data();
        part.regions = demand.regions[i];
        if (part.is_data) part.regions.assign(1, {});
        part.reads = reads_of(op);
        part.is_dear = part.is_source || (op.operation && !op.operation->point());
        for (const Link& link : op.links)
            for (const ValueRef v : link.values)
                if (!parts_[index(v.op)].is_source) part.is_dear |= parts_[index(v.op)].is_dear;
        parts_.push_back(std::move(part));
    }
}

bool ComingFrame::shares_with(const ComingFrame& other) const {
    std::set<Digest> digests;
    for (const Part& p : parts_)
        if ((p.is_source && !p.is_resident) || p.is_data) digests.insert(p.digest);
    return std::ranges::any_of(other.parts_,
                               [&](const Part& p) { return p.digest.known() && digests.contains(p.digest); });
}

std::vector<ValueKey> ComingFrame::wanted(const IsThere& is_there) const {
    std::vector<ValueKey> out;
    std::vector<ValueRef> open = roots_;
    std::set<ValueRef> seen;
    while (!open.empty()) {
        const ValueRef v = open.back();
        open.pop_back();
        const Part& part = parts_[index(v.op)];
        const Rect& region = part.regions[index(v.output)];
        if (part.is_resident || (region.empty() && !part.is_data) || !seen.insert(v).second) continue;
        const bool is_computed = !part.is_source && !part.is_data;
        if (part.digest.known() && (part.is_dear || part.is_data) &&
            is_there({part.digest, v.output}, region, is_computed))
            out.push_back({part.digest, v.output});
        else
            open.insert(open.end(), part.reads.begin(), part.reads.end());
    }
    return out;
}

std::size_t Carrying::held_bytes() const {
    std::size_t sum = 0;
    for (const Carried& h : held) sum += h.bytes;
    return sum;
}

Carrying plan_carrying(const ResolvedFrame& frame, const Demand& demand, std::span<const Carried> held,
                       std::span<const ComingFrame> coming) {
    return Carrier(frame, demand).run(held, wants_of(coming, There(frame, demand, held)));
}

std::vector<Carried> to_hand_on(const Plan& plan) {
    std::vector<Carried> out;
    for (std::size_t s = 0; s < plan.stores.size(); ++s)
        if (plan.stores[s].carry_until) out.push_back(held_store(plan, static_cast<int>(s)));
    for (const PlannedDatum& d : plan.data)
        if (d.carry_until) out.push_back(held_datum(plan, d));
    return out;
}

}  // namespace keyline
