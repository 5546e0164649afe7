// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/node/node_adaptor.h"

namespace keyline {

namespace {

// What every node with a mask does, by itself.
struct Keymix {
    static constexpr Info info{"keymix", "Shows a where a mask is and b elsewhere."};

    struct Params : Mixed {
        Input a, b;

        static constexpr auto fields = declare_mixed(
            input(&Params::a, "a", "What the mask shows."),
            input(&Params::b, "b", "What is seen elsewhere; its other channels pass.").leading());
    };

    explicit Keymix(const Params& p) : a(p.a), b(p.b) {}

    Stream expand(Builder& builder) const {
        Stream stream = builder.input(a);
        const Stream lead = builder.input(b);
        stream.display = lead.display;
        stream.metadata = lead.metadata;
        return stream;
    }

    const Input a, b;
};

}  // namespace

KEYLINE_NODE(keymix, Keymix)

}  // namespace keyline
