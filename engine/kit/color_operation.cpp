// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/color_operation.h"

#include "engine/base/channels.h"
#include "engine/node/node_adaptor.h"
#include "engine/node/pixel_loop.h"

#include <algorithm>
#include <cstring>
#include <optional>

namespace keyline {

namespace {

struct ColorConvert {
    struct Params {
        Input in;
        static constexpr auto fields = declare(input(&Params::in, "in", "", colour()));
    };
    static constexpr std::array outputs{"R", "G", "B"};
    static constexpr bool passes_others = true;

    void edit(Metadata& metadata) const {
        metadata.erase("chromaticities");
        metadata.erase("ICCProfile");  // OpenImageIO's name for it
    }
    double cost() const { return 60; }

    void compute(const Inputs& in, Outputs out, Scratch&) const {
        const std::span<const View> from = in.slot(0);
        const Rect& rect = out[0].rect;
        const auto n = static_cast<std::size_t>(rect.width());
        for (int y = rect.y0; y < rect.y1; ++y) {
            for (std::size_t c = 0; c < 3; ++c) std::memcpy(out[c].row(y), from[c].row(y), n * sizeof(float));
            const float* alpha = from.size() > 3 ? from[3].row(y) : nullptr;
            transform.apply_premultiplied(out[0].row(y), out[1].row(y), out[2].row(y), alpha, n);
            for (std::size_t c = 0; c < 3; ++c)
                std::transform(out[c].row(y), out[c].row(y) + n, out[c].row(y), with_one_nan);
        }
    }

    ColorTransform transform;
};

}  // namespace

namespace {

// The R G B A of a layer, under those names; nothing where it is no colour: ids and measures may stand in
// channels of these names too.
std::optional<Stream> colour_of(const Stream& stream, const std::string& layer) {
    Stream colour = stream;
    colour.channels.clear();
    for (const char* base : {"R", "G", "B", "A"})
        if (const StreamChannel* c = stream.find_spelled(join_channel(layer, base))) {
            if (c->exact() || c->holds != Holds::kColour) return {};
            colour.set(base, *c);
        }
    if (!colour.find("R") || !colour.find("G") || !colour.find("B")) return {};
    return colour;
}

// The stream's R G B are known to be meant for that.
Stream said(Stream stream, Nature::For colour_for, bool divided) {
    Nature nature = stream.nature_of_colour();
    nature.colour_for = colour_for;
    nature.divided = divided;
    stream.set_nature_of_colour(nature);
    return stream;
}

void tell_of_mistakes(Builder& builder, const Stream& stream, Nature::For from) {
    const StreamChannel* red = stream.find_spelled("R");
    if (!red) return;
    if (red->holds == Holds::kData)
        builder.warn(Code::kDataConverted, "R G B are measured, as normals are, and no colour",
                     "leave the conversion out");
    const Nature nature = stream.nature_of_colour();
    if (from == Nature::For::kScene && nature.colour_for == Nature::For::kDisplay)
        builder.warn(Code::kShownTwice,
                     "the colour is made for a display already, and is taken for scene-linear",
                     "convert it once; what a file for the screen holds, its 'read' makes scene-linear by "
                     "'colorspace'");
    if (nature.divided && stream.find_spelled("A"))
        builder.warn(Code::kDividedTwice,
                     "R G B are divided by A already, and are divided once more around the conversion",
                     "put a 'premultiply' before it");
}

}  // namespace

Nature::For colour_for(const ColorConfig& colors, const std::string& space) {
    switch (colors.space_for(space)) {
        case ColorConfig::SpaceFor::kScene: return Nature::For::kScene;
        case ColorConfig::SpaceFor::kDisplay: return Nature::For::kDisplay;
        case ColorConfig::SpaceFor::kUnknown: break;
    }
    return Nature::For::kUnknown;
}

Stream convert_colour(Builder& builder, const Stream& stream, const ColorTransform& transform,
                      const Conversion& conversion) {
    if (transform.identity()) return said(stream, conversion.to, stream.nature_of_colour().divided);
    tell_of_mistakes(builder, stream, conversion.from);
    // Division by A was told: once is enough.
    return said(add_operation(builder, ColorConvert{transform}, {stream}), conversion.to, false);
}

Stream convert_layers(Builder& builder, const Stream& stream, const ColorTransform& transform,
                      const Conversion& conversion) {
    Stream result = stream;
    std::vector<std::string> layers = layers_of(stream.names());
    layers.insert(layers.begin(), "");
    for (const std::string& layer : layers) {
        const std::optional<Stream> colour = colour_of(stream, layer);
        if (!colour) continue;
        const Stream converted = convert_colour(builder, *colour, transform, conversion);
        for (const StreamChannel& c : converted.channels)
            result.set(stream.find_spelled(join_channel(layer, c.name))->name, c);
        result.window = unite(result.window, converted.window);
        result.metadata = converted.metadata;
    }
    return result;
}

}  // namespace keyline
