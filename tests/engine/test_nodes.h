// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/node_adaptor.h"
#include "engine/registry.h"

#include <algorithm>

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
            const View &now = in[Input{{}, {}, {}, 0}][0], &then = in[Input{{}, {}, {}, 1}][0];
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

template <class... Nodes>
void register_test_nodes() {
    const auto add = []<class Node>(std::type_identity<Node>) {
        if (!registry().find(Node::info.name)) registry().add(make_node_type<Node>());
    };
    (add(std::type_identity<Nodes>{}), ...);
}

}  // namespace keyline::testing
