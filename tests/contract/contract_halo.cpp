// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/plan/demand.h"
#include "engine/plan/resolve.h"
#include "tests/contract/contract.h"
#include "tests/support/draw.h"
#include "tests/support/interpret.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <exception>
#include <fmt/format.h>
#include <limits>

namespace keyline::testing {

namespace {

constexpr unsigned kSeed = 3;
constexpr int kRim = 24;  // pixels of poison around what an operation may read

constexpr float kPoisons[] = {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                              -1e30F};

// Pixels of a rectangle amid others that must not matter.
struct Framed {
    Rect rect, window;
    std::ptrdiff_t stride;
    std::vector<float> memory;

    Framed(const Rect& r, const Rect& w, float around)
        : rect(r),
          window(w),
          stride(r.width() + 2 * kRim),
          memory(static_cast<std::size_t>(stride) * static_cast<std::size_t>(r.height() + 2 * kRim), around) {
    }
    float* at(int x, int y) { return memory.data() + (y - rect.y0 + kRim) * stride + (x - rect.x0 + kRim); }
    MutView view() { return {at(rect.x0, rect.y0), stride, rect, window}; }
};

// One operation of a node, fed with noise, and with the data of the frame that it stands in.
class Bench {
public:
    Bench(const Op& op, const std::vector<std::shared_ptr<const Datum>>& data, Draw& draw)
        : op_(op), window_(op.outputs.front().window) {
        for (const Link& link : op.links)
            data_.push_back(link.datum.op < 0 ? nullptr
                                              : data[static_cast<std::size_t>(link.datum.op)].get());
        for (const Link& link : op.links)
            for (std::size_t k = 0; k < link.values.size(); ++k)
                images_.push_back(
                    noise(link.window, {"Y"}, static_cast<unsigned>(draw.whole(0, 1 << 20)), -0.25F, 1));
    }

    Complaints compare_regions(Draw& draw) const {
        if (op_.gather) return compare_blocks();
        std::vector<Framed> whole = computed(window_, 0);
        for (int i = 0; i < 8; ++i) {
            const Rect region = some_region(draw);
            for (const float poison : kPoisons) {
                std::vector<Framed> part = computed(region, poison);
                const std::string found = compare(region, part, whole);
                if (!found.empty())
                    return {fmt::format("{} around the demanded pixels of a region of {} × {}: {}", poison,
                                        region.width(), region.height(), found)};
            }
        }
        return {};
    }

    // Each output by itself, while the rows of the others lie on each other.
    Complaints compare_outputs() const {
        if (!op_.operation || op_.outputs.size() < 2) return {};
        const std::vector<Framed> all = computed(window_, 0);
        for (std::size_t wanted = 0; wanted < all.size(); ++wanted) {
            std::vector<Framed> alone(all.size(), Framed(window_, window_, kUntouched));
            compute(window_, 0, alone, [&](std::size_t o) { return o == wanted; });
            if (!std::ranges::equal(all[wanted].memory, alone[wanted].memory, same_bits))
                return {fmt::format("output {} is another where nobody reads the others", wanted)};
        }
        return {};
    }

private:
    static constexpr float kUntouched = 12345;

    static bool same_bits(float a, float b) {
        return std::bit_cast<uint32_t>(a) == std::bit_cast<uint32_t>(b) || (std::isnan(a) && std::isnan(b));
    }

    // A gather: the frame in blocks of several sizes.
    Complaints compare_blocks() const {
        const auto whole = gathered(window_.width() + window_.height(), 0);
        for (const int size : {1, 5, 16})
            for (const float poison : kPoisons)
                if (!gathered(size, poison)->equals(*whole))
                    return {fmt::format("in blocks of {}, with {} around each, the datum is another", size,
                                        poison)};
        return {};
    }

    Rect some_region(Draw& draw) const {
        const int x = draw.whole(window_.x0, window_.x1 - 1), y = draw.whole(window_.y0, window_.y1 - 1);
        return intersect(window_, {x, y, x + draw.whole(1, 20), y + draw.whole(1, 12)});
    }

    // What the operation is given of one input value: noise over `rect`, 0 outside the input's window.
    Framed framed(std::size_t value, const Rect& rect, const Rect& window, float poison) const {
        Framed out(rect, window, poison);
        for (int y = rect.y0; y < rect.y1; ++y)
            for (int x = rect.x0; x < rect.x1; ++x) *out.at(x, y) = images_[value].at("Y", x, y);
        return out;
    }

    struct Gathered {
        std::vector<Framed> memory;
        std::vector<View> views;
        std::vector<Inputs::Range> slots;
        std::vector<const Datum*> data;
        Inputs inputs() const { return {views, slots, data}; }
    };
    template <class RectOf>
    Gathered gather(const RectOf& rect_of, float poison) const {
        Gathered g;
        g.data = data_;
        for (std::size_t s = 0; s < op_.links.size(); ++s) {
            g.slots.push_back({g.memory.size(), op_.links[s].values.size()});
            for (std::size_t k = 0; k < op_.links[s].values.size(); ++k)
                g.memory.push_back(framed(g.memory.size(), rect_of(static_cast<int>(s)),
                                          end_of_link(op_, static_cast<int>(s)), poison));
        }
        for (Framed& f : g.memory) g.views.push_back(f.view());
        return g;
    }

    std::vector<Framed> computed(const Rect& region, float poison) const {
        std::vector<Framed> out(op_.outputs.size(), Framed(region, window_, kUntouched));
        compute(region, poison, out, [](std::size_t) { return true; });
        return out;
    }
    template <class Wanted>
    void compute(const Rect& region, float poison, std::vector<Framed>& out, const Wanted& wanted) const {
        const Gathered g = gather([&](int slot) { return view_of_link(op_, slot, region); }, poison);
        std::vector<MutView> views;
        for (Framed& f : out) views.push_back(f.view());
        for (std::size_t o = 0; o < views.size(); ++o)
            if (!wanted(o)) views[o].stride = 0;
        Scratch scratch;
        op_.operation->compute(g.inputs(), views, scratch);
    }

    std::shared_ptr<const Datum> gathered(int size, float poison) const {
        const Gather& gathering = *op_.gather;
        Scratch scratch;
        const auto state = gathering.start(window_);
        for (int round = 1;; ++round) {
            for (int y = window_.y0; y < window_.y1; y += size)
                for (int x = window_.x0; x < window_.x1; x += size) {
                    const Rect block = intersect(window_, {x, y, x + size, y + size});
                    const Gathered g = gather([&](int) { return block; }, poison);
                    gathering.fold(*state, *gathering.map(*state, g.inputs(), block, scratch));
                    scratch.reset();
                }
            if (round == gathering.rounds()) return gathering.finish(*state);
            gathering.end_round(*state);
        }
    }

    // What of a computed region is not as in the whole, or lies beside it; "" where all is well.
    static std::string compare(const Rect& region, std::vector<Framed>& part, std::vector<Framed>& whole) {
        for (std::size_t o = 0; o < part.size(); ++o)
            for (int y = region.y0 - kRim; y < region.y1 + kRim; ++y)
                for (int x = region.x0 - kRim; x < region.x1 + kRim; ++x) {
                    const bool inside = region.contains(x, y);
                    const float wanted = inside ? *whole[o].at(x, y) : kUntouched, got = *part[o].at(x, y);
                    if (same_bits(wanted, got)) continue;
                    return inside ? fmt::format("{} at {},{}, which is {} in the whole", got, x, y, wanted)
                                  : fmt::format("{} was written at {},{}, outside the region", got, x, y);
                }
        return "";
    }

    const Op& op_;
    const Rect window_;
    std::vector<Image> images_;       // by value of all links
    std::vector<const Datum*> data_;  // by link
};

// What check(bench, draw) says of the first operation that it complains of.
template <class Check>
Complaints check_operations(const NodeType& type, const Check& check) {
    Draw draw(kSeed);
    for (int i = 0; i < 8; ++i) {
        NodeCase c;
        try {
            c = draw_case(type, draw);
            const ResolvedFrame frame = c.resolve(false);
            const auto data = interpret_all(frame).data;
            for (const Op& op : frame.ops) {
                if ((!op.operation && !op.gather) || op.outputs.front().window.empty()) continue;
                const Complaints found = check(Bench(op, data, draw), draw);
                if (!found.empty()) return {found.front() + "\n" + c.text()};
            }
        } catch (const std::exception& e) {
            return {fmt::format("threw: {}\n{}", e.what(), c.text())};
        }
    }
    return {};
}

}  // namespace

Complaints check_halo(const NodeType& type) {
    return check_operations(type, [](const Bench& bench, Draw& draw) { return bench.compare_regions(draw); });
}

Complaints check_outputs(const NodeType& type) {
    return check_operations(type, [](const Bench& bench, Draw&) { return bench.compare_outputs(); });
}

}  // namespace keyline::testing
