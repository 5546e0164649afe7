// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/surface_places.h"

#include "engine/base/channels.h"

#include <algorithm>
#include <fmt/format.h>
#include <string>
#include <vector>

namespace keyline {

Stream surface_places(Builder& builder, const Input& input, const char* parameter) {
    static const std::vector<std::vector<std::string>> kinds{
        {"U", "V"}, {"S", "T"}, {"X", "Y", "Z"}, {"R", "G", "B"}};
    const Stream in = builder.input(input);
    // R G B are coordinates where the file says so, in a layer P or Position.
    const auto serves = [&](const std::string& name) {
        const StreamChannel* c = in.find_spelled(name);
        return c && (name != "R" || c->holds == Holds::kData);
    };
    const auto names =
        std::ranges::find_if(kinds, [&](const auto& kind) { return std::ranges::all_of(kind, serves); });
    if (names == kinds.end())
        builder.bad_parameter(
            parameter,
            fmt::format("'{}' needs channels U and V, S and T, or X, Y and Z; its input has {}", parameter,
                        some_of(in.names())),
            "select the pass, as in \"id:UV\" or \"id:Position\"");
    Stream out = in;
    out.channels.clear();
    for (const std::string& name : *names) out.set(name, *in.find_spelled(name));
    return out;
}

}  // namespace keyline
