// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/node/node_adaptor.h"

#include <array>

// A sound node, and one fault for each name that may be defined.
namespace keyline {

class Refused {
public:
    static constexpr Info info{"refused", "Adds a number."};
#ifndef OUTPUTS_FORGOTTEN
    static constexpr std::array outputs{"Y"};
#endif

    struct Params {
#ifdef INPUT_IS_OPTIONAL
        std::optional<Input> in;
#else
        Input in;
#endif
        double amount = 1;
#ifdef INPUT_IN_PAIR
        std::vector<std::pair<double, Input>> more;
#elif defined INPUT_IN_VARIANT
        std::variant<double, std::vector<Input>> more;
#else
        double more = 0;
#endif
        static constexpr auto fields = declare(field(&Params::amount, "amount", "What is added."),
#ifndef NO_INPUT
                                               input(&Params::in, "in", "The image."),
#endif
                                               field(&Params::more, "more", "What is added too."));
    };

    explicit Refused(const Params&) {}

#ifdef HALO_TAKES_A_SLOT
    Halo halo(int) const { return {}; }
#else
    Halo halo() const { return {}; }
#endif
#ifdef DEMAND_WITHOUT_SLOT
    Rect demand(const Rect& out) const { return out; }
#endif
#ifdef EXPAND_IS_NOT_CONST
    Stream expand(Builder&) { return {}; }
#endif
#ifdef COMPUTE_WITHOUT_SCRATCH
    void compute(const Inputs&, Outputs) const {}
#else
    void compute(const Inputs&, Outputs, Scratch&) const {}
#endif
};

KEYLINE_NODE(refused, Refused)

}  // namespace keyline
