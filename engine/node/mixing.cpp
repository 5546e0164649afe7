// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/node/mixing.h"

#include "engine/node/ids.h"
#include "engine/node/pixel_loop.h"

#include <algorithm>

namespace keyline {

namespace {

class Opaque final : public Operation {
public:
    void compute(const Inputs&, Outputs out, Scratch&) const override {
        for (int y = out[0].rect.y0; y < out[0].rect.y1; ++y)
            std::fill_n(out[0].row(y), out[0].rect.width(), 1.0F);
    }
    double cost() const override { return 1; }
};

// before (1 − k) + after k; exactly the one or the other where k is 0 or 1, whatever stands in the other.
float mixed(float before, float after, float k) {
    const float between = before * (1 - k) + after * k;
    return k == 0 ? before : k == 1 ? after : between;
}

// One channel: before and after, each of which may be missing, and the mask.
class Mix final : public Operation {
public:
    explicit Mix(double mix) : mix_(static_cast<float>(mix)) {}

    void compute(const Inputs& in, Outputs out, Scratch& scratch) const override {
        const View before = channel(in[slot(0)], out[0].rect, scratch),
                   after = channel(in[slot(1)], out[0].rect, scratch);
        const float mix = mix_;
        if (in[slot(2)].empty())
            for_each_pixel(
                out[0], [mix](float b, float a) { return mixed(b, a, mix); }, before, after);
        else
            for_each_pixel(
                out[0], [mix](float b, float a, float m) { return mixed(b, a, mix * m); }, before, after,
                in[slot(2)][0]);
    }

private:
    static Input slot(int s) { return {{}, {}, {}, s}; }

    // The channel of a slot; one row of zeros for all rows where there is none.
    static View channel(std::span<const View> views, const Rect& rect, Scratch& scratch) {
        if (!views.empty()) return views[0];
        const auto zeros = scratch.floats(static_cast<std::size_t>(rect.width()));
        std::ranges::fill(zeros, 0.0F);
        return {zeros.data(), 0, rect, rect};
    }

    float mix_;
};

Link link_to(const Stream& stream, const std::string& channel) {
    const StreamChannel* c = stream.find_spelled(channel);
    return c ? Link(stream, {c->value}) : Link();
}

Link mask_link(Builder& builder, const Mixed& mixed) {
    if (!mixed.mask) return {};
    const Stream stream = builder.input(*mixed.mask);
    return {stream, take_channels(builder, stream, matte())};
}

}  // namespace

Stream with_alpha(Builder& builder, Stream stream) {
    if (!stream.find_spelled("A"))
        stream.set("A", builder.add(std::make_shared<const Opaque>(), {}, stream.window, 1).front());
    return stream;
}

Stream mix_back(Builder& builder, const Stream& before, const Stream& after, const Mixed& mixed) {
    const auto both = [&](const char* name) { return before.find_spelled(name) && after.find_spelled(name); };
    const bool opaque = both("R") && (before.find_spelled("A") || after.find_spelled("A"));
    const Stream from = opaque ? with_alpha(builder, before) : before,
                 to = opaque ? with_alpha(builder, after) : after;
    Stream result = from;
    result.display = to.display;
    result.metadata = to.metadata;
    result.window = unite(from.window, to.window);
    const bool whole = mixed.mix == 1 && !mixed.mask;
    const auto operation = std::make_shared<const Mix>(mixed.mix);
    const Link mask = mask_link(builder, mixed);
    Stream ids = to;  // that would have to be mixed
    ids.channels.clear();
    for (const StreamChannel& c : to.channels) {
        const StreamChannel* same = from.find_spelled(c.name);
        if (same && same->value == c.value) continue;
        const std::string name = same ? same->name : c.name;
        if (whole) {
            result.set(name, c);
        } else if (c.exact() || (same && same->exact())) {
            ids.channels.push_back(same ? *same : c);
            if (!same) result.set(c);
        } else {
            std::vector<Link> links{link_to(from, name), link_to(to, c.name), mask};
            StreamChannel mixed_channel{
                name, builder.add(operation, std::move(links), result.window, 1).front(), c.holds};
            if (same && same->nature == c.nature) mixed_channel.nature = c.nature;
            result.set(std::move(mixed_channel));
        }
    }
    tell_of_ids(builder, ids);
    return result;
}

}  // namespace keyline
