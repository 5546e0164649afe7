// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/base/bad_value.h"
#include "engine/base/channels.h"
#include "engine/node/node_adaptor.h"

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
            if (const auto* level = std::get_if<double>(&from)) {
                out.window = in.extent();
                out.set(name, builder.add(std::make_shared<const Level>(*level), {}, in.extent(), 1).front());
            } else {
                out.set(name, channel(in, std::get<std::string>(from)));
            }
        }
        return out;
    }

    const Params params;

private:
    static const StreamChannel& channel(const Stream& in, const std::string& name) {
        const std::vector<Picked> picked = select(in, name);
        if (picked.size() > 1)
            throw BadValue(name, fmt::format("{} is a layer of {} channels", in_quotes(name), picked.size()),
                           fmt::format("name one of them, as {}", in_quotes(name + "." + picked[0].name)));
        return in.channels[picked[0].index];
    }

    static std::vector<Picked> select(const Stream& in, const std::string& name) {
        try {
            return select_channels(in.names(), name);
        } catch (const Failure& f) {
            throw BadValue(name, f.error().what, f.error().hint);
        }
    }
};

}  // namespace

KEYLINE_NODE(shuffle, Shuffle)

}  // namespace keyline
