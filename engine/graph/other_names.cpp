// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/graph/other_names.h"

#include "engine/base/error.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <fmt/format.h>
#include <utility>

namespace keyline {

namespace {

// Names of Nuke's, Blender's and oiiotool's nodes and commands, in small letters and nothing else; what
// follows "is" in the message.
constexpr std::array<std::pair<std::string_view, std::string_view>, 66> kNames{{
    {"add", "'math' here, with \"op\": \"add\""},
    {"alphaover", "'over' here"},
    {"bilateral", "'smooth' here for strokes; of pixels there is none"},
    {"blur", "'gaussian' here"},
    {"brightness", "'grade' here"},
    {"cc", "'grade' here"},
    {"channelcopy", "'shuffle' here"},
    {"clamp", "'math' here, with \"op\": \"clamp\""},
    {"colorbalance", "'grade' here"},
    {"colorcorrect", "'grade' here"},
    {"colorramp", "'ramp' here"},
    {"combinecolor", "'shuffle' here"},
    {"comp", "'over' here"},
    {"composite", "'over' here"},
    {"copy", "'shuffle' here"},
    {"difference", "'merge' here, with \"operation\": \"difference\""},
    {"dilateerode", "'dilate' or 'erode' here"},
    {"dissolve", "'keymix' here"},
    {"edgedetect", "'canny' here"},
    {"exposure", "'grade' here, with 'multiply'"},
    {"exr", "'read' or 'write' here"},
    {"fileoutput", "'write' here"},
    {"filtererode", "'erode' here"},
    {"findedges", "'canny' here"},
    {"freestyle", "'trace' here, with 'draw' behind it"},
    {"gain", "'grade' here, with 'multiply'"},
    {"gamma", "'grade' here, with 'gamma'"},
    {"gaussianblur", "'gaussian' here"},
    {"hsv", "'cdl' here, with 'saturation'"},
    {"image", "'read' here"},
    {"input", "'read' here"},
    {"invert", "'math' here, with \"op\": \"invert\""},
    {"kernel", "'gaussian', 'gradient' or 'laplacian' here"},
    {"lineart", "'trace' here, with 'draw' behind it"},
    {"load", "'read' here"},
    {"luma", "'ycolor' here"},
    {"luminance", "'ycolor' here"},
    {"maximum", "'dilate' here"},
    {"median", "'despeckle' here"},
    {"minimum", "'erode' here"},
    {"mix", "'keymix' here"},
    {"mixcolor", "'merge' here"},
    {"multiply", "'math' or 'merge' here"},
    {"ociocdltransform", "'cdl' here"},
    {"ociocolorspace", "'colorspace' here"},
    {"ociodisplay", "'display' here"},
    {"ociofiletransform", "'lut' here"},
    {"ociolooktransform", "'look' here"},
    {"output", "'write' here"},
    {"premult", "'premultiply' here"},
    {"renderlayers", "'read' here"},
    {"resample", "'reformat' here"},
    {"resize", "'reformat' here"},
    {"rgbtobw", "'ycolor' here"},
    {"rotate", "'transform' here"},
    {"saturation", "'cdl' here, with 'saturation'"},
    {"save", "'write' here"},
    {"scale", "'reformat' here; for a part of the picture 'transform'"},
    {"separatecolor", "'shuffle' here"},
    {"shufflecopy", "'shuffle' here"},
    {"sobel", "'gradient' here, with \"operator\": \"sobel\""},
    {"solid", "'constant' here"},
    {"switch", "a variable here: \"in\": \"${which}\" takes the node that it names"},
    {"translate", "'transform' here"},
    {"unpremult", "'unpremultiply' here"},
    {"vectorfield", "'lut' here"},
}};

}  // namespace

std::string own_name_of(std::string_view type) {
    std::string plain;
    for (const char c : type)
        if (std::isalpha(static_cast<unsigned char>(c)) != 0)
            plain += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    const auto it = std::ranges::find(kNames, plain, &decltype(kNames)::value_type::first);
    return it == kNames.end() ? "" : fmt::format("{} is {}", in_quotes(type), it->second);
}

}  // namespace keyline
