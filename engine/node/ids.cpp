// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/node/ids.h"

#include "engine/base/channels.h"
#include "engine/base/error.h"

#include <algorithm>
#include <bit>
#include <fmt/format.h>
#include <numeric>

namespace keyline {

namespace {

class Number final : public Operation {
public:
    void compute(const Inputs& in, Outputs out, Scratch&) const override {
        const View& from = in.slot(0)[0];
        const Rect& rect = out[0].rect;
        for (int y = rect.y0; y < rect.y1; ++y)
            for (int x = rect.x0; x < rect.x1; ++x)
                *out[0].at(x, y) = static_cast<float>(std::bit_cast<uint32_t>(*from.at(x, y)));
    }
    double cost() const override { return 1; }
};

// The names of the channels that pick, for a message.
template <class Pick>
std::vector<std::string> names_of(const std::vector<StreamChannel>& channels, const Pick& pick) {
    std::vector<std::string> out;
    for (const StreamChannel& c : channels)
        if (pick(c)) out.push_back(c.name);
    return out;
}

bool is_id(const StreamChannel& c) { return c.holds == Holds::kId; }

std::string hold_ids(const std::vector<std::string>& names) {
    return fmt::format("{} hold{} ids", some_of(names), names.size() == 1 ? "s" : "");
}

// An alpha, too, would be taken for the strength of an edge, or for a depth, where a port prefers another
// channel and finds a picture.
void refuse_colour(const std::vector<std::string>& names, const char* preferred) {
    if (names.size() == 1 || !find_spelled(names, "R") || !find_spelled(names, "G") ||
        !find_spelled(names, "B"))
        return;
    fail(Code::kUnknownChannel, ErrorKind::kGraph,
         fmt::format("there is no channel {}; the input is colour, and its A is none", in_quotes(preferred)),
         "connect what makes it, or take one channel, as in ':A'");
}

std::vector<std::size_t> matte_of(const std::vector<std::string>& names, const char* preferred) {
    if (!preferred) return {find_matte(names)};
    if (const auto i = find_spelled(names, preferred)) return {*i};
    refuse_colour(names, preferred);
    return {find_matte(names)};
}

// A Cryptomatte's r g b a are no colour to choose from; where they are all that is selected they are found,
// to be refused.
ColourChannels colour_of(const Stream& stream) {
    std::vector<std::string> names = stream.names();
    const StreamChannel* r = stream.find_spelled("R");
    if (!r || !r->exact())
        for (std::size_t i = 0; i < names.size(); ++i)
            if (stream.channels[i].exact()) names[i] = split_channel(names[i]).layer;
    return find_colour(names);
}

std::vector<std::size_t> taken_by(const Stream& stream, const Takes& takes) {
    const std::vector<std::string> names = stream.names();
    switch (takes.kind) {
        case Takes::Kind::kAny: {
            std::vector<std::size_t> all(names.size());
            std::iota(all.begin(), all.end(), std::size_t{0});
            return all;
        }
        case Takes::Kind::kColour: {
            const ColourChannels c = colour_of(stream);
            if (c.a && takes.alpha) return {c.r, c.g, c.b, *c.a};
            return {c.r, c.g, c.b};
        }
        case Takes::Kind::kMatte: return matte_of(names, takes.preferred);
        case Takes::Kind::kNamed: {
            std::vector<std::string> wanted;
            for (const char* name : takes.names)
                if (name) wanted.emplace_back(name);
            return find_channels(names, wanted);
        }
        case Takes::Kind::kData: break;
    }
    return {};
}

}  // namespace

void tell_of_ids(Builder& builder, const Stream& stream, const char* instead) {
    const auto names = names_of(stream.channels, is_id);
    if (!names.empty())
        builder.warn(fmt::format("{}, which can't be computed with: {}", hold_ids(names), instead));
}

ValueRef as_number(Builder& builder, const StreamChannel& channel, const Rect& window) {
    if (!channel.integer) return channel.value;
    return builder.add(std::make_shared<const Number>(), {{window, window, {channel.value}}}, window, 1)
        .front();
}

std::vector<ValueRef> take_channels(Builder& builder, const Stream& stream, const Takes& takes) {
    std::vector<StreamChannel> taken;
    for (const std::size_t i : taken_by(stream, takes)) taken.push_back(stream.channels[i]);
    if (const auto ids = names_of(taken, is_id); !ids.empty()) {
        if (takes.kind == Takes::Kind::kColour)
            fail(Code::kUnknownChannel, ErrorKind::kGraph, hold_ids(ids) + ", which are no colour",
                 "take a layer of colour");
        builder.warn(hold_ids(ids) + ", which are taken for numbers");
    }
    std::vector<ValueRef> values;
    for (const StreamChannel& c : taken) values.push_back(as_number(builder, c, stream.window));
    return values;
}

}  // namespace keyline
