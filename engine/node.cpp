// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/node.h"

#include "engine/channels.h"
#include "engine/error.h"
#include "engine/node_adaptor.h"

#include <algorithm>
#include <numeric>

namespace keyline {

namespace {

constexpr std::size_t kLeastBlock = std::size_t{64} << 10;

}  // namespace

void* Scratch::allocate(std::size_t bytes) {
    bytes = (bytes + kCacheLine - 1) / kCacheLine * kCacheLine;
    while (block_ < blocks_.size() && used_ + bytes > blocks_[block_].size) {
        ++block_;
        used_ = 0;
    }
    if (block_ == blocks_.size()) {
        const std::size_t size = std::max(bytes, kLeastBlock);
        blocks_.push_back({make_aligned<std::byte>(size), size});
    }
    void* p = blocks_[block_].memory.get() + used_;
    used_ += bytes;
    return p;
}

void Scratch::reset() {
    used_ = 0, block_ = 0;
    if (blocks_.size() < 2) return;
    const std::size_t size = bytes();
    blocks_.clear();  // first, so that old and new never stand beside each other
    blocks_.push_back({make_aligned<std::byte>(size), size});
}

std::size_t Scratch::bytes() const {
    std::size_t sum = 0;
    for (const Block& b : blocks_) sum += b.size;
    return sum;
}

const char* node_kind_name(NodeKind kind) {
    switch (kind) {
        case NodeKind::kPoint: return "point operation";
        case NodeKind::kStencil: return "stencil";
        case NodeKind::kWholeFrame: return "whole-frame node";
        case NodeKind::kSource: return "source";
        case NodeKind::kSink: return "sink";
        case NodeKind::kCompound: break;
    }
    return "compound";
}

std::vector<ValueRef> take_channels(const Stream& stream, const Takes& takes) {
    const std::vector<std::string> names = stream.names();
    std::vector<std::size_t> taken;
    switch (takes.kind) {
        case Takes::Kind::kAny:
            taken.resize(names.size());
            std::iota(taken.begin(), taken.end(), std::size_t{0});
            break;
        case Takes::Kind::kColour: {
            const ColourChannels c = find_colour(names);
            taken = {c.r, c.g, c.b};
            if (c.a && takes.alpha) taken.push_back(*c.a);
            break;
        }
        case Takes::Kind::kMatte:
            if (const StreamChannel* c = takes.preferred ? stream.find(takes.preferred) : nullptr)
                return {c->value};
            taken = {find_matte(names)};
            break;
        case Takes::Kind::kNamed: {
            std::vector<std::string> wanted;
            for (const char* name : takes.names)
                if (name) wanted.emplace_back(name);
            taken = find_channels(names, wanted);
            break;
        }
    }
    std::vector<ValueRef> values;
    for (const std::size_t i : taken) values.push_back(stream.channels[i].value);
    return values;
}

namespace detail {

const Port& leading_port(const std::vector<Port>& ports) {
    const auto it = std::ranges::find_if(ports, &Port::leading);
    return it == ports.end() ? ports.front() : *it;
}

std::vector<Link> make_links(const std::vector<Port>& ports) {
    std::vector<Link> links;
    for (const Port& port : ports) {
        try {
            links.push_back({port.stream.window, take_channels(port.stream, port.takes)});
            if (!port.needed) links.back().values.clear();
        } catch (const Failure& f) {
            Error e = f.error();
            e.place = port.place;
            throw Failure(std::move(e));
        }
    }
    return links;
}

Stream make_stream(const Port& lead, const Rect& window, const Makes& makes,
                   const std::vector<ValueRef>& values) {
    Stream out = lead.stream;
    out.window = window;
    if (!makes.passes_others) out.channels.clear();
    for (std::size_t i = 0; i < values.size(); ++i) out.set(makes.channels[i], values[i]);
    return out;
}

}  // namespace detail

}  // namespace keyline
