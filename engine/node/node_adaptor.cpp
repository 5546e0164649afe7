// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/node/node_adaptor.h"

#include "engine/base/error.h"

#include <algorithm>
#include <optional>
#include <string_view>

namespace keyline::detail {

const Port& leading_port(const std::vector<Port>& ports) {
    const auto it = std::ranges::find_if(ports, &Port::leading);
    return it == ports.end() ? ports.front() : *it;
}

namespace {

// Kinds are compared when a graph is loaded; here they can only differ inside a compound.
void check_kind(const Port& port) {
    const bool takes_data = port.takes.kind == Takes::Kind::kData;
    if (takes_data != port.stream.is_data() ||
        (takes_data && port.takes.data && port.takes.data != port.stream.data))
        fail(ErrorKind::kInternal, "an operation is given another kind of value than it takes");
}

Link make_link(Builder& builder, const Port& port) {
    if (!port.connected) return {};
    check_kind(port);
    Link link(port.stream, take_channels(builder, port.stream, port.takes));
    if (!port.needed) link = {link.window, link.extent, {}};
    return link;
}

}  // namespace

std::vector<Link> make_links(Builder& builder, const std::vector<Port>& ports) {
    std::vector<Link> links;
    for (const Port& port : ports) {
        try {
            links.push_back(make_link(builder, port));
        } catch (const Failure& f) {
            rethrow_with(f, [&](Error& e) { e.place = port.place; });
        }
    }
    return links;
}

Nature nature_of(const std::vector<Port>& ports) {
    std::optional<Nature> agreed;
    bool differs = false;
    for (const Port& port : ports) {
        const bool is_colour =
            port.takes.kind == Takes::Kind::kColour ||
            (port.takes.kind == Takes::Kind::kNamed && port.takes.names[0] == std::string_view("R"));
        if (!port.connected || !is_colour) continue;
        const Nature nature = port.stream.nature_of_colour();
        if (!agreed) agreed = nature;
        agreed->divided = agreed->divided && nature.divided;
        if (agreed->colour_for == Nature::For::kUnknown) agreed->colour_for = nature.colour_for;
        differs = differs ||
                  (nature.colour_for != Nature::For::kUnknown && nature.colour_for != agreed->colour_for);
    }
    if (differs) agreed->colour_for = Nature::For::kUnknown;
    return agreed.value_or(Nature{});
}

Stream make_stream(const Port& lead, const Rect& window, const Makes& makes,
                   const std::vector<ValueRef>& values, const Nature& nature) {
    Stream out = lead.stream;
    out.window = window;
    out.data.clear();
    out.datum = {};
    if (!makes.passes_others) out.channels.clear();
    for (std::size_t i = 0; i < values.size(); ++i) {
        const StreamChannel* own = out.find_spelled(makes.channels[i]);  // whose name it keeps
        StreamChannel made{own ? own->name : makes.channels[i], values[i]};
        made.nature.slope = nature.slope;
        out.set(std::move(made));
    }
    if (std::ranges::find(makes.channels, "R") != makes.channels.end()) out.set_nature_of_colour(nature);
    return out;
}

Stream make_data_stream(const std::vector<Port>& ports, const char* kind, ValueRef datum) {
    Stream out = ports.empty() ? Stream{} : leading_port(ports).stream;
    out.channels.clear();
    out.data = kind;
    out.datum = datum;
    return out;
}

}  // namespace keyline::detail
