// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/color_operation.h"
#include "engine/node/node_adaptor.h"

namespace keyline {

namespace {

struct Look {
    static constexpr Info info{"look", "Gives R G B a look of the OpenColorIO config; other channels pass."};

    struct Params {
        Input in;
        std::string look;
        std::string space = "scene_linear";
        bool inverse = false;
        Map<std::string> context;

        static constexpr auto fields = declare(
            input(&Params::in, "in", "The image.", colour()),
            field(&Params::look, "look", "The look's name; several as \"+grade, -warm\"; empty for none."),
            field(&Params::space, "space", "The space, or role, that the image is in and stays in.")
                .naming(Naming::kColorSpace),
            field(&Params::inverse, "inverse", "Whether to take the look back."),
            field(&Params::context, "context", kContextHelp));
    };

    explicit Look(Params p) : params(std::move(p)) {}

    Stream expand(Builder& builder) const {
        const Stream in = builder.input(params.in);
        const Nature::For kept = in.nature_of_colour().colour_for;
        return convert_colour(builder, in,
                              builder.colors(params.context)->look(params.space, params.look, params.inverse),
                              {kept, kept});
    }

    const Params params;
};

}  // namespace

KEYLINE_NODE(look, Look)

}  // namespace keyline
