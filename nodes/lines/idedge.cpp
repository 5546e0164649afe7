// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/object_ids.h"
#include "engine/node/node_adaptor.h"

#include <algorithm>
#include <bit>
#include <limits>

namespace keyline {

namespace {

enum class Side { kInner, kOuter, kBoth };

constexpr auto words(Side) {
    return std::array{Word<Side>{"inner", Side::kInner, "on the nearer object, one pixel wide"},
                      Word<Side>{"outer", Side::kOuter, "on what is behind it, one pixel wide"},
                      Word<Side>{"both", Side::kBoth, "on either side of the edge, two pixels wide"}};
}

struct Step {
    int x, y;
};
constexpr std::array kSteps{Step{1, 0}, Step{-1, 0}, Step{0, 1}, Step{0, -1}};

// The objects that one call of compute() sees, and how much of a pixel each covers.
class Objects {
public:
    // A single view holds ids that cover their pixels whole; else ids and coverage take turns.
    Objects(std::span<const View> views, bool integers, Scratch& scratch)
        : views_(views), integers_(integers), rect_(views[0].rect) {
        main_ = scratch.take<uint32_t>(static_cast<std::size_t>(rect_.area()));
        for (int y = rect_.y0; y < rect_.y1; ++y)
            for (int x = rect_.x0; x < rect_.x1; ++x) main_[index(x, y)] = find_main(x, y);
    }

    bool has(int x, int y) const { return rect_.contains(x, y); }

    // The object that covers most of a pixel; 0 is none.
    uint32_t main(int x, int y) const { return main_[index(x, y)]; }

    float coverage(int x, int y, uint32_t id) const {
        if (views_.size() == 1) return main(x, y) == id ? 1.0F : 0.0F;
        if (id == 0) return uncovered(x, y);
        float sum = 0;
        for (std::size_t r = 0; r + 1 < views_.size(); r += 2)
            if (bits(*views_[r].at(x, y)) == id) sum += *views_[r + 1].at(x, y);
        return sum;
    }

private:
    std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y - rect_.y0) * static_cast<std::size_t>(rect_.width()) +
               static_cast<std::size_t>(x - rect_.x0);
    }

    // Of an integer they stand in the float, where those of −0 are an id like any other.
    uint32_t bits(float id) const { return id == 0 && !integers_ ? 0 : std::bit_cast<uint32_t>(id); }

    float uncovered(int x, int y) const {
        float rest = 1;
        for (std::size_t r = 1; r < views_.size(); r += 2) rest -= *views_[r].at(x, y);
        return rest > 0 ? rest : 0;
    }

    uint32_t find_main(int x, int y) const {
        if (views_.size() == 1) return bits(*views_[0].at(x, y));
        uint32_t id = 0;
        float most = uncovered(x, y);
        for (std::size_t r = 0; r + 1 < views_.size(); r += 2) {
            const uint32_t other = bits(*views_[r].at(x, y));
            const float covered = *views_[r + 1].at(x, y);
            if (other == 0 || !(covered > most)) continue;
            id = other;
            most = covered;
        }
        return id;
    }

    std::span<const View> views_;
    bool integers_;
    Rect rect_;
    std::span<uint32_t> main_;
};

// Between two pixels that show different objects there is an edge; it lies where their coverage in both
// pixels together says, and a line is drawn along it.
struct IdEdge {
    static constexpr Info info{
        "idedge", "Lines between objects, from their ids or a Cryptomatte, that know whose they are."};

    struct Params {
        Input in;
        std::string layer;
        Side side = Side::kBoth;
        std::optional<Input> depth;

        static constexpr auto fields = declare(
            input(
                &Params::in, "in",
                "One channel of ids, or an image with a Cryptomatte; the lines then are a Cryptomatte of the "
                "same name, so that a cryptomatte node after this one picks lines by their objects' names."),
            field(&Params::layer, "layer", "The Cryptomatte's name; empty where there is but one.")
                .naming(Naming::kCryptomatte),
            field(&Params::side, "side", "Which side of the edge the line is on."),
            input(&Params::depth, "depth",
                  "Where objects are nearer, smaller; without it, or at the same depth, the larger id is.",
                  matte("Z")));
    };
    // The owner is the id of the nearer object.
    static constexpr std::array outputs{"edge", "owner"};

    explicit IdEdge(Params p) : params(std::move(p)) {}

    Stream expand(Builder& builder) const;

    const Params params;
};

class EdgeLine final : public Operation {
public:
    static constexpr int kOutputs = 3;  // the line, its owner, and nothing

    EdgeLine(Side side, bool integers) : side_(side), integers_(integers) {}

    // The line may lie up to half a pixel beyond the pixel beside the edge.
    Halo halo() const override { return {2, 2}; }
    double cost() const override { return 60; }

    void compute(const Inputs& in, Outputs out, Scratch& scratch) const override {
        const Objects objects(in.slot(0), integers_, scratch);
        const std::span<const View> depth = in.slot(1);
        const Rect& rect = out[0].rect;
        for (int y = rect.y0; y < rect.y1; ++y)
            for (int x = rect.x0; x < rect.x1; ++x) {
                Line line;
                for (const Step& step : kSteps) {
                    const Line other = along(objects, depth.empty() ? nullptr : depth.data(), x, y, step);
                    if (other.covers > line.covers) line = other;
                }
                *out[0].at(x, y) = line.covers;
                *out[1].at(x, y) = std::bit_cast<float>(line.owner);
                *out[2].at(x, y) = 0;
            }
    }

private:
    struct Line {
        float covers = 0;    // of the pixel
        uint32_t owner = 0;  // the object that it belongs to
    };

    // The line at the edge before or behind the next pixel in one direction, whichever covers more of this
    // one.
    Line along(const Objects& objects, const View* depth, int x, int y, const Step& step) const {
        const int x1 = x + step.x, y1 = y + step.y, x2 = x1 + step.x, y2 = y1 + step.y;
        if (!objects.has(x1, y1)) return {};
        const Line near = between(objects, depth, {x, y}, {x1, y1}, 0);
        const Line far = objects.has(x2, y2) ? between(objects, depth, {x1, y1}, {x2, y2}, -1) : Line{};
        return far.covers > near.covers ? far : near;
    }

    // The line at the edge between the centres of two neighbours, over the pixel that begins at `start`,
    // counted from where p begins towards q.
    Line between(const Objects& objects, const View* depth, Step p, Step q, float start) const {
        const uint32_t a = objects.main(p.x, p.y), b = objects.main(q.x, q.y);
        if (a == b) return {};
        const float of_a = objects.coverage(p.x, p.y, a) + objects.coverage(q.x, q.y, a);
        const float of_b = objects.coverage(p.x, p.y, b) + objects.coverage(q.x, q.y, b);
        const float edge = 2 * of_a / (of_a + of_b);
        const bool of_p = is_nearer(depth, p, q, a, b);
        const bool on_p = side_ == Side::kBoth || (side_ == Side::kInner) == of_p;
        const bool on_q = side_ == Side::kBoth || !on_p;
        const float from = std::max(start, edge - (on_p ? 1.0F : 0.0F));
        const float to = std::min(start + 1, edge + (on_q ? 1.0F : 0.0F));
        return to > from ? Line{to - from, of_p ? a : b} : Line{};
    }

    // Nothing is never nearer than an object, whatever a renderer writes for its depth.
    static bool is_nearer(const View* depth, Step p, Step q, uint32_t a, uint32_t b) {
        if (a == 0 || b == 0) return a != 0;
        const auto at = [&](Step s) {
            return depth && depth->rect.contains(s.x, s.y) ? *depth->at(s.x, s.y)
                                                           : std::numeric_limits<float>::infinity();
        };
        const float of_p = at(p), of_q = at(q);
        if (of_p < of_q || of_q < of_p) return of_p < of_q;
        return a > b;
    }

    Side side_;
    bool integers_;
};

Stream IdEdge::expand(Builder& builder) const {
    Stream stream = builder.input(params.in);
    const ObjectIds ids = find_object_ids(builder, stream, params.layer);
    std::vector<Link> links{{stream, ids.values}, {}};
    if (params.depth) links[1] = link_depth(builder, *params.depth);
    const auto edge_line = std::make_shared<const EdgeLine>(params.side, ids.integers);
    stream.window = result_window(*edge_line, links, EdgeLine::kOutputs);
    const auto line = builder.add(edge_line, std::move(links), stream.window, EdgeLine::kOutputs);
    stream.channels.clear();
    stream.set(outputs[0], line[0]);
    stream.set({outputs[1], line[1], Holds::kId, ids.integers});
    if (ids.crypto) add_cryptomatte(stream, *ids.crypto, {line[1], line[0]}, line[2]);
    return stream;
}

}  // namespace

KEYLINE_NODE(idedge, IdEdge)

}  // namespace keyline
