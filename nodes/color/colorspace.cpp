// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/color_operation.h"
#include "engine/node/node_adaptor.h"

namespace keyline {

namespace {

struct Colorspace {
    static constexpr Info info{"colorspace",
                               "Converts R G B from one OpenColorIO space to another; other channels pass."};

    struct Params {
        Input in;
        std::string from = "scene_linear";
        std::string to;
        Map<std::string> context;

        static constexpr auto fields =
            declare(input(&Params::in, "in", "The image to convert.", colour()),
                    field(&Params::from, "from", "The space, or role, that the input is in.")
                        .naming(Naming::kColorSpace),
                    field(&Params::to, "to", "The space, or role, to convert to.")
                        .required()
                        .naming(Naming::kColorSpace),
                    field(&Params::context, "context", kContextHelp));
    };

    explicit Colorspace(Params p) : params(std::move(p)) {}

    Stream expand(Builder& builder) const {
        const auto colors = builder.colors(params.context);
        const ColorTransform transform = colors->convert(params.from, params.to);
        return convert_colour(builder, builder.input(params.in), transform,
                              {colour_for(*colors, params.from), colour_for(*colors, params.to)});
    }

    const Params params;
};

}  // namespace

KEYLINE_NODE(colorspace, Colorspace)

}  // namespace keyline
