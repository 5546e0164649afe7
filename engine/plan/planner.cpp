// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/plan/planner.h"

#include "engine/io/image_sink.h"
#include "engine/plan/cost.h"
#include "engine/plan/memory.h"
#include "engine/plan/sweeps.h"

#include <algorithm>
#include <fmt/format.h>
#include <limits>
#include <optional>
#include <utility>

namespace keyline {

namespace {

// Tiles that compute half as much again as the picture in one piece would are too small.
constexpr double kTolerableOverhead = 1.5;

// Fewer tiles than this a thread, and threads wait for each other at the end of a sweep.
constexpr double kTilesPerThread = 4;

// Another size of tiles must be so much faster to be taken: what the model does not know of (caches, the
// start of every row) would eat a smaller gain.
constexpr double kWorthwhile = 0.9;

// A worker with more scratch memory than this works past the caches that are its own.
constexpr double kRoomyScratch = 0x8p20;

// Tiles are not made smaller than 8 × 8, nor longer than the executor can count along the largest window.
constexpr int64_t kSmallestTile = 64;
constexpr int kLongestTile = 1 << 14;

// Enough rows of tiles that no thread waits for a row's last one.
int rows_ahead_for(const Plan& plan) {
    std::size_t columns = 1;
    for (const Sweep& s : plan.sweeps) columns = std::max(columns, s.columns.size());
    const auto threads = static_cast<std::size_t>(plan.threads);
    return 2 + static_cast<int>((2 * threads + columns - 1) / columns);
}

std::optional<Choices> with_half_a_tile(Choices c) {
    if (int64_t{c.tile_width} * c.tile_height <= kSmallestTile) return std::nullopt;
    (c.tile_width > c.tile_height ? c.tile_width : c.tile_height) /= 2;
    return c;
}

class Search {
public:
    Search(ResolvedFrame frame, const PlanOptions& options) : options_(options) {
        plan_.frame = std::move(frame);
        plan_.demand = demand(plan_.frame);
        carrying_ = plan_carrying(plan_.frame, plan_.demand, options.held, options.coming);
        alone_ = plan_carrying(plan_.frame, plan_.demand, {}, {});
        plan_.threads = options.threads;
        for (const Sink& sink : plan_.frame.sinks) {
            const SinkRequest& r = sink.request;
            if (r.stream.is_data() || r.file.empty()) {
                plan_.sink_shapes.emplace_back();
                plan_.sink_memory.emplace_back();
            } else {
                plan_.sink_shapes.push_back(sink_shape(r.file, r.spec));
                plan_.sink_memory.push_back(sink_memory(r.file, r.spec));
            }
        }
    }

    Plan run() {
        const Choices best = fastest();
        build(best);
        if (fits(plan_.memory_bytes, best.carry && carries()) && !options_.weigh_all) return std::move(plan_);
        std::vector<std::pair<Weighed, Choices>> all = weigh(best);
        const auto first = std::ranges::find_if(
            all, [&](const auto& w) { return fits(w.first.memory_bytes, w.first.carry); });
        if (first == all.end()) refuse(all.back().first.memory_bytes);
        build(first->second);
        if (options_.weigh_all)
            for (const auto& [weighed, choices] : all) plan_.weighed.push_back(weighed);
        return std::move(plan_);
    }

private:
    void build(const Choices& c) {
        plan_.stores.clear();
        plan_.data.clear();
        plan_.sweeps.clear();
        plan_.carrying = c.carry ? carrying_ : alone_;
        make_sweeps(plan_, c);
        plan_.rows_ahead = std::min(c.rows_ahead, rows_ahead_for(plan_));
        estimate_memory(plan_);
        estimate_time(plan_);
    }

    // Beside frames that still run nothing is carried that would not fit with them.
    bool fits(std::size_t bytes, bool carry) const {
        const std::size_t beside =
            carry ? options_.at_work - std::min(options_.at_work, carrying_.held_bytes()) : 0;
        return options_.memory == 0 || bytes + beside <= options_.memory;
    }

    [[noreturn]] void refuse(std::size_t least) const {
        fail(ErrorKind::kGraph,
             fmt::format("the memory limit is {}; frame {} needs at least {}", memory_text(options_.memory),
                         plan_.frame.frame, memory_text(least)),
             fmt::format("give --memory {}", memory_text(least)));
    }

    // With all the memory that helps.
    Choices fastest() {
        Choices c;
        c.rows_ahead = std::numeric_limits<int>::max();
        if (options_.tile > 0) {
            c.tile_width = c.tile_height = options_.tile;
            return c;
        }
        grow_tiles(c);
        shrink_tiles(c);
        return c;
    }

    // Large halos want large tiles, or most of the work is done again by the neighbours.  What a node reads
    // more than it makes (a picture made smaller) is no reason: a larger tile would read no less of it.
    void grow_tiles(Choices& choices) {
        build(choices);
        while (overhead() >= kTolerableOverhead) {
            const double seconds = plan_.seconds;
            const std::optional<Choices> larger = with_twice_a_tile(choices);
            if (!larger) return;
            build(*larger);
            if (plan_.seconds > kWorthwhile * seconds) return;
            choices = *larger;
        }
    }

    // Nothing where the tile covers all there is, or too few tiles would be left for the threads.
    std::optional<Choices> with_twice_a_tile(Choices c) const {
        Rect area;
        for (const Sweep& s : plan_.sweeps) area = unite(area, s.area);
        const bool wide = c.tile_width >= std::min(area.width(), kLongestTile),
                   high = c.tile_height >= std::min(area.height(), kLongestTile);
        if ((wide && high) || tiles() < 2 * kTilesPerThread * plan_.threads) return std::nullopt;
        if (!high && (c.tile_height < c.tile_width || wide))
            c.tile_height *= 2;
        else
            c.tile_width *= 2;
        return c;
    }

    // A picture that becomes small has few tiles of the usual size, and each of them reads much.
    void shrink_tiles(Choices& choices) {
        build(choices);
        const double usual = plan_.seconds;
        while (const std::optional<Choices> smaller = with_half_a_tile(choices)) {
            const double seconds = plan_.seconds, scratch = most_scratch();
            const bool few = tiles() < kTilesPerThread * plan_.threads;
            build(*smaller);
            const bool faster = few && plan_.seconds < kWorthwhile * seconds;
            const bool leaner = scratch > kRoomyScratch && most_scratch() < kWorthwhile * scratch &&
                                kWorthwhile * plan_.seconds < usual;
            if (!faster && !leaner) return;
            choices = *smaller;
        }
    }

    double overhead() const {
        double most = 1;
        for (const Sweep& s : plan_.sweeps) most = std::max(most, tiling_overhead(plan_, s));
        return most;
    }

    // Of the sweep that takes longest: it is the one that threads must share well.
    double tiles() const {
        const auto longest = std::ranges::max_element(plan_.sweeps, {}, &Sweep::seconds);
        if (longest == plan_.sweeps.end()) return 0;
        return static_cast<double>(longest->columns.size()) * static_cast<double>(longest->rows.size());
    }

    double most_scratch() const {
        std::size_t most = 0;
        for (const Sweep& s : plan_.sweeps) most = std::max(most, s.scratch_bytes);
        return static_cast<double>(most);
    }

    // What trades time for memory: fewer rows at once, nothing kept from sweep to sweep, smaller tiles.
    std::vector<Choices> candidates(Choices c) const {
        std::vector<Choices> out;
        if (std::exchange(c.carry, false) && carries()) out.push_back(c);
        c.rows_ahead = 2;
        for (std::optional<Choices> tile = c; tile; tile = with_half_a_tile(c)) {
            c = *tile;
            for (const auto& [sources, computed] : {std::pair{true, true}, {true, false}, {false, false}}) {
                out.push_back(c);
                out.back().keep_sources = sources;
                out.back().keep_computed = computed;
                if (!carries()) continue;
                out.push_back(out.back());
                out.back().carry = true;
            }
            if (options_.tile > 0) break;
        }
        out.push_back(out.back());
        out.back().carry = false;
        out.back().rows_ahead = 1;
        return out;
    }

    bool carries() const { return !carrying_.held.empty() || !carrying_.wanted.empty(); }

    // The best and, from the fastest to the smallest, the others; each needs less memory than those before.
    std::vector<std::pair<Weighed, Choices>> weigh(const Choices& best) {
        build(best);
        const double saved = carrying_saves(plan_);
        const auto weighed = [&](const Choices& c) {
            build(c);
            // What isn't left for coming frames is to be paid in them.
            const double seconds = plan_.seconds + (c.carry ? 0 : saved);
            return std::pair(Weighed{c.keep_sources, c.keep_computed, c.tile_width, c.tile_height,
                                     plan_.rows_ahead, c.carry && carries(), seconds, plan_.memory_bytes},
                             c);
        };
        std::vector<std::pair<Weighed, Choices>> others, out{weighed(best)};
        for (const Choices& c : candidates(best)) others.push_back(weighed(c));
        std::ranges::stable_sort(others, {}, [](const auto& w) { return w.first.seconds; });
        for (const auto& w : others)
            if (w.first.memory_bytes < out.back().first.memory_bytes) out.push_back(w);
        return out;
    }

    Plan plan_;
    const PlanOptions options_;
    Carrying carrying_, alone_;  // with what earlier frames left and coming ones want; without
};

}  // namespace

Plan make_plan(ResolvedFrame frame, const PlanOptions& options) {
    return Search(std::move(frame), options).run();
}

}  // namespace keyline
