// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/color_operation.h"
#include "engine/node/node_adaptor.h"

namespace keyline {

namespace {

struct Display {
    static constexpr Info info{"display",
                               "Makes R G B ready for a display, through one of its OpenColorIO views."};

    struct Params {
        Input in;
        std::string display;
        std::string view;
        std::string from = "scene_linear";
        Map<std::string> context;

        static constexpr auto fields =
            declare(input(&Params::in, "in", "The image to show.", colour()),
                    field(&Params::display, "display", "The display; empty takes the config's default.")
                        .naming(Naming::kDisplay),
                    field(&Params::view, "view", "The view; empty takes the display's default.")
                        .naming(Naming::kView),
                    field(&Params::from, "from", "The space, or role, that the input is in.")
                        .naming(Naming::kColorSpace),
                    field(&Params::context, "context", kContextHelp));
    };

    explicit Display(Params p) : params(std::move(p)) {}

    Stream expand(Builder& builder) const {
        const auto colors = builder.colors(params.context);
        return convert_colour(builder, builder.input(params.in),
                              colors->display(params.from, params.display, params.view),
                              {colour_for(*colors, params.from), Nature::For::kDisplay});
    }

    const Params params;
};

}  // namespace

KEYLINE_NODE(display, Display)

}  // namespace keyline
