// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/node/node_adaptor.h"

#include <algorithm>

namespace keyline {

namespace {

using Rgba = std::array<double, 4>;

// Every pixel alike: an operation without inputs.
struct Fill {
    void compute(const Inputs&, Outputs out, Scratch&) const {
        for (std::size_t c = 0; c < out.size(); ++c)
            for (int y = out[c].rect.y0; y < out[c].rect.y1; ++y)
                std::fill_n(out[c].row(y), out[c].rect.width(), value[c]);
    }

    std::array<float, 4> value;
};

struct Constant {
    static constexpr Info info{"constant", "One colour all over."};

    struct Params {
        std::variant<Color, Rgba> color;
        std::optional<std::array<int, 2>> size;
        std::optional<Input> like;

        static constexpr auto fields = declare(
            field(&Params::color, "color",
                  "Three numbers or \"#rrggbb\", opaque; or four, premultiplied R G B A."),
            field(&Params::size, "size", "Width and height.", between(1, 1 << 20, "pixels").tested_to(64)),
            input(&Params::like, "like", "An input whose windows to take instead."));
    };
    static constexpr std::array outputs{"R", "G", "B", "A"};

    static void check(const Params& p, Check& c) {
        if (p.size.has_value() != p.like.has_value()) return;
        c.error("size", p.size ? "'size' and 'like' are both given" : "neither 'size' nor 'like' is given",
                "give one of them");
    }

    explicit Constant(const Params& p) : params(p) {}

    Stream expand(Builder& builder) const {
        Stream stream = params.like ? builder.input(*params.like) : Stream{};
        if (params.size) stream.display = stream.window = {0, 0, (*params.size)[0], (*params.size)[1]};
        stream.window = stream.extent();
        stream.channels.clear();
        const auto values =
            builder.add(make_operation(std::make_shared<const Fill>(Fill{rgba()})), {}, stream.window, 4);
        for (std::size_t i = 0; i < outputs.size(); ++i) stream.set(outputs[i], values[i]);
        return stream;
    }

    const Params params;

private:
    std::array<float, 4> rgba() const {
        const Color* c = std::get_if<Color>(&params.color);
        const Rgba v = c ? Rgba{c->r, c->g, c->b, 1} : std::get<Rgba>(params.color);
        std::array<float, 4> out{};
        std::ranges::transform(v, out.begin(), [](double d) { return static_cast<float>(d); });
        return out;
    }
};

}  // namespace

KEYLINE_NODE(constant, Constant)

}  // namespace keyline
