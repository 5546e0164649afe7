// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/color_operation.h"

#include "engine/channels.h"
#include "engine/node_adaptor.h"

#include <algorithm>
#include <cstring>

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
        const std::span<const View> from = in[Input{{}, {}, {}, 0}];
        const Rect& rect = out[0].rect;
        const auto n = static_cast<std::size_t>(rect.width());
        for (int y = rect.y0; y < rect.y1; ++y) {
            for (std::size_t c = 0; c < 3; ++c) std::memcpy(out[c].row(y), from[c].row(y), n * sizeof(float));
            const float* alpha = from.size() > 3 ? from[3].row(y) : nullptr;
            transform.apply_premultiplied(out[0].row(y), out[1].row(y), out[2].row(y), alpha, n);
        }
    }

    ColorTransform transform;
};

}  // namespace

Stream convert_colour(Builder& builder, const Stream& stream, const ColorTransform& transform) {
    if (transform.identity()) return stream;
    return add_operation(builder, ColorConvert{transform}, {stream});
}

Stream convert_layers(Builder& builder, const Stream& stream, const ColorTransform& transform) {
    if (transform.identity()) return stream;
    Stream result = stream;
    std::vector<std::string> layers = layers_of(stream.names());
    layers.insert(layers.begin(), "");
    for (const std::string& layer : layers) {
        Stream part = stream;
        part.channels.clear();
        for (const char* base : {"R", "G", "B", "A"})
            if (const StreamChannel* c = stream.find(join_channel(layer, base)))
                part.channels.push_back({base, c->value});
        if (!part.find("R") || !part.find("G") || !part.find("B")) continue;
        const Stream converted = convert_colour(builder, part, transform);
        for (const StreamChannel& c : converted.channels) result.set(join_channel(layer, c.name), c.value);
        result.metadata = converted.metadata;
    }
    return result;
}

}  // namespace keyline
