// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/color_operation.h"
#include "engine/node/node_adaptor.h"

namespace keyline {

namespace {

struct Lut {
    static constexpr Info info{
        "lut", "Applies a look-up table or a colour decision from a file to R G B; other channels pass."};

    struct Params {
        Input in;
        FileName file;
        std::string id;
        bool inverse = false;

        static constexpr auto fields = declare(
            input(&Params::in, "in", "The image, in the space that the file is for.", colour()),
            field(
                &Params::file, "file",
                "Of a kind that OpenColorIO reads: .cube, .spi1d, .spi3d, .csp, .3dl, .clf, .cc, .ccc, .cdl "
                "…; a run of # stands for the frame number.")
                .required(),
            field(&Params::id, "id", "Which of a file's colour corrections; empty for the first."),
            field(&Params::inverse, "inverse", "Whether to take it back."));
    };

    explicit Lut(Params p) : params(std::move(p)) {}

    Stream expand(Builder& builder) const {
        const std::filesystem::path file = params.file.at(builder.frame());
        builder.file(file);
        return convert_colour(builder, builder.input(params.in),
                              builder.colors().file(file, params.id, params.inverse));
    }

    const Params params;
};

}  // namespace

KEYLINE_NODE(lut, Lut)

}  // namespace keyline
