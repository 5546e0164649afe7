// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/color_operation.h"
#include "engine/node/node_adaptor.h"

namespace keyline {

namespace {

struct NamedTransform {
    static constexpr Info info{
        "namedtransform",
        "Applies a transform that the OpenColorIO config names to R G B; other channels pass."};

    struct Params {
        Input in;
        std::string transform;
        bool inverse = false;
        Map<std::string> context;

        static constexpr auto fields =
            declare(input(&Params::in, "in", "The image, in the space that the transform is for.", colour()),
                    field(&Params::transform, "transform", "The transform's name.").required(),
                    field(&Params::inverse, "inverse", "Whether to take it back."),
                    field(&Params::context, "context", kContextHelp));
    };

    explicit NamedTransform(Params p) : params(std::move(p)) {}

    Stream expand(Builder& builder) const {
        return convert_colour(builder, builder.input(params.in),
                              builder.colors(params.context)->named(params.transform, params.inverse));
    }

    const Params params;
};

}  // namespace

KEYLINE_NODE(namedtransform, NamedTransform)

}  // namespace keyline
