// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/channels.h"
#include "engine/node_adaptor.h"

#include <algorithm>
#include <fmt/format.h>

namespace keyline {

namespace {

class Level final : public Operation {
public:
    explicit Level(double value) : value_(static_cast<float>(value)) {}
    void compute(const Inputs&, Outputs out, Scratch&) const override {
        for (int y = out[0].rect.y0; y < out[0].rect.y1; ++y)
            std::fill_n(out[0].row(y), out[0].rect.width(), value_);
    }
    double cost() const override { return 1; }

private:
    float value_;
};

// Nothing is copied: a channel under another name is the same channel, of its file's type.
struct Shuffle {
    static constexpr Info info{"shuffle", "Makes an image of channels of its input under other names."};

    using From = std::variant<std::string, double>;
    struct Params {
        Input in;
        Map<From> channels;

        static constexpr auto fields =
            declare(input(&Params::in, "in", "Where the channels come from."),
                    field(&Params::channels, "channels",
                          "By the name of each new channel the one it is, or a number for all its pixels.")
                        .required());
    };

    static void check(const Params& p, Check& c) {
        if (p.channels.entries.empty())
            c.error("channels", "'channels' is empty", "name one channel at least");
    }

    explicit Shuffle(const Params& p) : params(p) {}

    Stream expand(Builder& builder) const {
        const Stream in = builder.input(params.in);
        Stream out = in;
        out.channels.clear();
        for (const auto& [name, from] : params.channels.entries) {
            const auto* level = std::get_if<double>(&from);
            out.set(name, level ? builder.add(std::make_shared<const Level>(*level), {}, in.window, 1).front()
                                : channel(builder, in, std::get<std::string>(from)));
        }
        return out;
    }

    const Params params;

private:
    static ValueRef channel(Builder& builder, const Stream& in, const std::string& name) {
        const std::vector<Picked> picked = select_channels(in.names(), name);
        if (picked.size() > 1)
            builder.bad_parameter(
                "channels", fmt::format("{} is a layer of {} channels", in_quotes(name), picked.size()),
                fmt::format("name one of them, as {}", in_quotes(name + "." + picked[0].name)));
        return in.channels[picked[0].index].value;
    }
};

}  // namespace

KEYLINE_NODE(shuffle, Shuffle)

}  // namespace keyline
