// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/base/channels.h"
#include "engine/node/node_adaptor.h"

namespace keyline {

namespace {

struct Pack {
    static constexpr Info info{"pack", "Puts several images into one, each as a layer."};

    struct Params {
        Map<Input> layers;

        static constexpr auto fields =
            declare(input(&Params::layers, "layers",
                          "By layer name the image; \"\" keeps its channels' names. Display window and "
                          "metadata come from the first.")
                        .required());
    };

    static void check(const Params& p, Check& c) {
        if (p.layers.entries.empty()) c.error("layers", "'layers' is empty", "name one image at least");
    }

    explicit Pack(const Params& p) : params(p) {}

    Stream expand(Builder& builder) const {
        Stream out = builder.input(params.layers.entries.front().second);
        out.channels.clear();
        for (const auto& [layer, in] : params.layers.entries) {
            const Stream stream = builder.input(in);
            out.window = unite(out.window, stream.window);
            for (const StreamChannel& c : stream.channels) {
                const std::string name = join_channel(layer, c.name);
                if (out.find(name))
                    builder.bad_parameter("layers", "two layers have a channel " + in_quotes(name),
                                          "give one of them another name");
                out.set(name, c);
            }
        }
        return out;
    }

    const Params params;
};

}  // namespace

KEYLINE_NODE(pack, Pack)

}  // namespace keyline
