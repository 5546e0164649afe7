// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/uv_map.h"

#include "engine/base/channels.h"
#include "engine/node/pixel_loop.h"

#include <fmt/format.h>

namespace keyline {

namespace {

constexpr std::array kPatternChannels{"R", "G", "B", "A"};

class Pattern final : public Operation {
public:
    Pattern(double cost, std::function<PatternColor(const UvPlace&)> color)
        : cost_(cost), color_(std::move(color)) {}

    Halo halo() const override { return {1, 1}; }
    double cost() const override { return cost_; }

    void compute(const Inputs& in, Outputs out, Scratch&) const override {
        const UvMap map(in.slot(0));
        const Rect& rect = out[0].rect;
        for (int y = rect.y0; y < rect.y1; ++y)
            for (int x = rect.x0; x < rect.x1; ++x) {
                const UvPlace place = map.at(x, y);
                const PatternColor color = place.alpha == 0 ? PatternColor{} : color_(place);
                for (std::size_t c = 0; c < 3; ++c)
                    *out[c].at(x, y) = with_one_nan(static_cast<float>(color[c] * place.alpha));
                *out[3].at(x, y) = with_one_nan(static_cast<float>(place.alpha));
            }
    }

private:
    double cost_;
    std::function<PatternColor(const UvPlace&)> color_;
};

// In the order in which a UvMap takes them.
std::vector<ValueRef> uv_channels(Builder& builder, const Stream& stream) {
    const bool is_uv = stream.find("U") && stream.find("V");
    const StreamChannel *u = stream.find(is_uv ? "U" : "S"), *v = stream.find(is_uv ? "V" : "T");
    if (!u || !v)
        builder.bad_parameter(
            "uv",
            fmt::format("'uv' needs channels U and V, or S and T; its input has {}", some_of(stream.names())),
            "select the UV pass, as in \"id:UV\"");
    std::vector<ValueRef> values{u->value, v->value};
    if (const StreamChannel* a = stream.find_spelled("A")) values.push_back(a->value);
    return values;
}

}  // namespace

UvPlace UvMap::look_up(int x, int y) const {
    if (!channels_[0].rect.contains(x, y)) return {};
    UvPlace out;
    out.alpha = channels_.size() > 2 ? double{*channels_[2].at(x, y)} : 1.0;
    if (out.alpha == 0) return out;
    out.u = double{*channels_[0].at(x, y)};
    out.v = double{*channels_[1].at(x, y)};
    if (out.alpha == 1) return out;
    out.u /= out.alpha;
    out.v /= out.alpha;
    return out;
}

UvStep UvMap::step(const UvPlace& here, int x, int y, int dx, int dy) const {
    UvStep best;
    double least = std::numeric_limits<double>::infinity();
    for (const int side : {1, -1}) {
        const UvPlace there = look_up(x + side * dx, y + side * dy);
        if (there.alpha == 0) continue;
        const UvStep step{side * (there.u - here.u), side * (there.v - here.v)};
        const double length = std::abs(step.u) + std::abs(step.v);
        if (!(length < least)) continue;  // NaN is no step
        best = step;
        least = length;
    }
    return best;
}

UvPlace UvMap::at(int x, int y) const {
    UvPlace out = look_up(x, y);
    if (out.alpha == 0) return out;
    out.across = step(out, x, y, 1, 0);
    out.down = step(out, x, y, 0, 1);
    return out;
}

Stream add_pattern(Builder& builder, const Input& uv, double cost,
                   std::function<PatternColor(const UvPlace&)> color) {
    Stream stream = builder.input(uv);
    std::vector<Link> links{{stream, uv_channels(builder, stream)}};
    const auto pattern = std::make_shared<const Pattern>(cost, std::move(color));
    stream.window = result_window(*pattern, links, kPatternChannels.size());
    const auto values =
        builder.add(pattern, std::move(links), stream.window, static_cast<int>(kPatternChannels.size()));
    stream.channels.clear();
    for (std::size_t c = 0; c < values.size(); ++c) stream.set(kPatternChannels[c], values[c]);
    return stream;
}

}  // namespace keyline
