// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/kit/numbers.h"
#include "engine/node/node_adaptor.h"
#include "engine/node/registry.h"

#include <algorithm>
#include <atomic>
#include <cmath>

// Nodes that Keyline does not have, to see that the engine runs them.

namespace keyline::testing {

// Cuts the data window: what lies outside is demanded from nobody.
struct Crop {
    static constexpr Info info{"cut_out", "A part of the image."};
    struct Params {
        Input in;
        std::array<int, 4> window{};
        static constexpr auto fields = declare(input(&Params::in, "in", "The image."),
                                               field(&Params::window, "window", "x0, y0, x1, y1."));
    };
    explicit Crop(const Params& p) : params(p) {}
    Stream expand(Builder& builder) const {
        Stream stream = builder.input(params.in);
        const auto& w = params.window;
        stream.window = intersect(stream.window, {w[0], w[1], w[2], w[3]});
        return stream;
    }
    const Params params;
};

// Moves the pixels inside the data window: demands another region than it computes, and has no halo.
struct Shift {
    static constexpr Info info{"shift", "Moves the pixels, not the window."};
    struct Params {
        Input in;
        std::array<int, 2> by{};
        static constexpr auto fields =
            declare(input(&Params::in, "in", "The image."), field(&Params::by, "by", "In x and y."));
    };
    explicit Shift(const Params& p) : dx(p.by[0]), dy(p.by[1]) {}
    Rect demand(const Rect& out, int) const { return translate(out, -dx, -dy); }
    void compute(const View& in, const MutView& out, Scratch&) const {
        for (int y = out.rect.y0; y < out.rect.y1; ++y)
            for (int x = out.rect.x0; x < out.rect.x1; ++x)
                *out.at(x, y) = in.rect.contains(x - dx, y - dy) ? *in.at(x - dx, y - dy) : 0;
    }
    const int dx, dy;
};

// A pixel less the one of an earlier frame.
struct Change {
    static constexpr Info info{"change", "What changed since an earlier frame."};
    struct Params {
        Input in;
        int since = 1;
        static constexpr auto fields =
            declare(input(&Params::in, "in", "The image."),
                    field(&Params::since, "since", "How many frames earlier.", between(0, 3)));
    };
    explicit Change(const Params& p) : params(p) {}

    struct Subtract {
        struct Params {
            Input now, then;
            static constexpr auto fields =
                declare(input(&Params::now, "now", "", matte()), input(&Params::then, "then", "", matte()));
        };
        static constexpr std::array outputs{"Y"};
        void compute(const Inputs& in, Outputs out, Scratch&) const {
            const View &now = in.slot(0)[0], &then = in.slot(1)[0];
            for (int y = out[0].rect.y0; y < out[0].rect.y1; ++y)
                for (int i = 0; i < out[0].rect.width(); ++i)
                    out[0].row(y)[i] = now.row(y)[i] - then.row(y)[i];
        }
    };

    Stream expand(Builder& builder) const {
        return add_operation(
            builder, Subtract{},
            {builder.input(params.in), builder.input(params.in, builder.frame() - params.since)});
    }
    const Params params;
};

// A kind of data.
struct Points {
    static constexpr const char* kind = "points";
    std::vector<std::array<int, 2>> at;
    std::size_t bytes() const { return at.size() * sizeof(at[0]); }
    friend bool operator==(const Points&, const Points&) = default;
};

// A source of points: a square's corners.  It counts how often it is read.
struct PointFile {
    static constexpr Info info{"point_file", "Four points."};
    using Gives = Points;
    struct Params {
        int size = 10;
        static constexpr auto fields =
            declare(field(&Params::size, "size", "Of the square.", between(1, 50)));
    };
    explicit PointFile(const Params& p) : size(p.size) {}

    struct Reading final : Derivation {
        explicit Reading(int s) : size(s) {}
        const char* gives() const override { return Points::kind; }
        std::shared_ptr<const Datum> derive(const Inputs&) const override {
            ++reads();
            return make_datum(Points{{{0, 0}, {size, 0}, {0, size}, {size, size}}});
        }
        std::size_t datum_bytes() const override { return 4 * sizeof(Points::at[0]); }
        std::filesystem::path file() const override { return "corners.points"; }
        const int size;
    };
    Stream read(Builder& builder) const { return builder.add_source(std::make_shared<const Reading>(size)); }

    static std::atomic<int>& reads() {
        static std::atomic<int> count = 0;
        return count;
    }
    const int size;
};

// A gather in one round: the sum of all samples to a thousandth.
struct SumOfAll {
    static constexpr Info info{"sum_of_all", "The sum of all samples, in thousandths."};
    struct Params {
        Input in;
        static constexpr auto fields = declare(input(&Params::in, "in", "A matte.", matte()));
    };
    SumOfAll() = default;
    explicit SumOfAll(const Params&) {}
    using State = int64_t;
    using Partial = int64_t;
    static State start(const Rect&) { return 0; }
    static Partial map(State, const Inputs& in, const Rect& block, Scratch&) {
        int64_t sum = 0;
        for (int y = block.y0; y < block.y1; ++y)
            for (int i = 0; i < block.width(); ++i)
                sum += static_cast<int64_t>(std::floor(in.slot(0)[0].row(y)[i] * 1000.0F));
        return sum;
    }
    static void fold(State& sum, Partial block) { sum += block; }
    static Numbers finish(State sum) {
        ++finished();
        return {{static_cast<double>(sum)}};
    }
    static std::size_t state_bytes(const Rect&) { return sizeof(State); }
    static std::size_t partial_bytes(const Rect&) { return sizeof(Partial); }
    static std::size_t datum_bytes(const Rect&) { return sizeof(double); }

    static std::atomic<int>& finished() {
        static std::atomic<int> count = 0;
        return count;
    }
};

// A gather in two rounds that reads a datum too: how many samples are above the mean of a sum.
struct CountAbove {
    static constexpr Info info{"count_above", "How many samples are above the mean."};
    struct Params {
        Input in, sum;
        static constexpr auto fields =
            declare(input(&Params::in, "in", "A matte.", matte()),
                    input(&Params::sum, "sum", "Of its samples.", data<Numbers>()));
    };
    explicit CountAbove(const Params&) {}
    struct State {
        int64_t pixels = 0, above = 0;
        bool counted = false;
    };
    using Partial = int64_t;
    static int rounds() { return 2; }
    static State start(const Rect&) { return {}; }
    static Partial map(const State& s, const Inputs& in, const Rect& block, Scratch&) {
        if (!s.counted) return block.area();
        const double mean = in.datum<Numbers>(1).values[0] / 1000 / static_cast<double>(s.pixels);
        int64_t above = 0;
        for (int y = block.y0; y < block.y1; ++y)
            for (int i = 0; i < block.width(); ++i) above += in.slot(0)[0].row(y)[i] > mean ? 1 : 0;
        return above;
    }
    static void fold(State& s, Partial n) { (s.counted ? s.above : s.pixels) += n; }
    static void end_round(State& s) { s.counted = true; }
    static Numbers finish(State s) { return {{static_cast<double>(s.above)}}; }
    static std::size_t state_bytes(const Rect&) { return sizeof(State); }
    static std::size_t partial_bytes(const Rect&) { return sizeof(Partial); }
    static std::size_t datum_bytes(const Rect&) { return sizeof(double); }
};

// Derived from two data: points moved by a number.
struct MovePoints {
    static constexpr Info info{"move_points", "Moves points to the right, by a number modulo 16."};
    struct Params {
        Input points, by;
        static constexpr auto fields = declare(input(&Params::points, "points", "", data<Points>()),
                                               input(&Params::by, "by", "", data<Numbers>()));
    };
    explicit MovePoints(const Params&) {}
    static Points derive(const Inputs& in) {
        Points out = in.datum<Points>(0);
        for (auto& [x, y] : out.at) x += static_cast<int>(std::fmod(in.datum<Numbers>(1).values[0], 16));
        return out;
    }
    static std::size_t datum_bytes() { return 4 * sizeof(Points::at[0]); }
};

// A point operation on pixels and data: 1 at the points, and the first number where there are any.
struct DrawPoints {
    static constexpr Info info{"draw_points", "Draws points over an image."};
    struct Params {
        Input in, points;
        std::optional<Input> number;
        static constexpr auto fields = declare(input(&Params::in, "in", "A matte.", matte()),
                                               input(&Params::points, "points", "", data<Points>()),
                                               input(&Params::number, "number", "", data<Numbers>()));
    };
    static constexpr std::array outputs{"Y"};
    explicit DrawPoints(const Params& p) : in(p.in), points(p.points), number(p.number) {}
    void compute(const Inputs& inputs, Outputs out, Scratch&) const {
        const Numbers* numbers = inputs.datum<Numbers>(number);
        const float added = numbers ? static_cast<float>(numbers->values[0]) : 0;
        for (int y = out[0].rect.y0; y < out[0].rect.y1; ++y)
            for (int i = 0; i < out[0].rect.width(); ++i) out[0].row(y)[i] = inputs[in][0].row(y)[i] + added;
        for (const auto& [x, y] : inputs.datum<Points>(points).at)
            if (out[0].rect.contains(x, y)) *out[0].at(x, y) = 1;
    }
    const Input in, points;
    const std::optional<Input> number;
};

template <class... Nodes>
void register_test_nodes() {
    const auto add = []<class Node>(std::type_identity<Node>) {
        if (!registry().find(Node::info.name)) registry().add(make_node_type<Node>());
    };
    (add(std::type_identity<Nodes>{}), ...);
}

}  // namespace keyline::testing
