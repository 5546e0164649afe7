// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/node/node_adaptor.h"

#include <fmt/format.h>

namespace keyline {

namespace {

struct Crop {
    static constexpr Info info{"crop",
                               "Keeps a region; outside it the image is 0. The display window stays."};

    struct Params {
        Input in;
        std::array<int, 4> region{};

        static constexpr auto fields =
            declare(input(&Params::in, "in", "The image; each of its channels keeps its type."),
                    field(&Params::region, "region", "Left, top, width and height of what is kept.",
                          between(-(1 << 24), 1 << 24, "pixels"))
                        .required());
    };

    static void check(const Params& p, Check& c) {
        if (p.region[2] < 0 || p.region[3] < 0)
            c.error("region", fmt::format("the region is {} × {} pixels", p.region[2], p.region[3]),
                    "give [left, top, width, height]");
    }

    explicit Crop(const Params& p)
        : in(p.in), region{p.region[0], p.region[1], p.region[0] + p.region[2], p.region[1] + p.region[3]} {}

    Stream expand(Builder& builder) const {
        Stream stream = builder.input(in);
        stream.window = intersect(stream.window, region);
        for (StreamChannel& c : stream.channels) c.value = builder.clip(c.value, stream.window);
        return stream;
    }

    const Input in;
    const Rect region;
};

}  // namespace

KEYLINE_NODE(crop, Crop)

}  // namespace keyline
