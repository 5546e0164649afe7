// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/node/kinds.h"

#include "engine/node/parts.h"
#include "engine/node/registry.h"

#include <algorithm>
#include <fmt/format.h>

namespace keyline {

namespace {

std::string kind_text(const std::string& data) { return data.empty() ? "pixels" : data; }

// Null: any kind of data.
const char* taken(const Takes& takes) { return takes.kind == Takes::Kind::kData ? takes.data : ""; }

bool fits(const Takes& takes, const std::string& given) {
    const char* kind = taken(takes);
    return kind ? given == kind : !given.empty();
}

bool takes_required(const NodeType& type, const std::string& given) {
    return std::ranges::any_of(type.fields, [&](const FieldInfo& f) {
        return f.required && f.type.kind == TypeInfo::Kind::kInput && fits(f.type.takes, given);
    });
}

bool gives(const NodeType& type, const Takes& takes) {
    return type.kind != NodeKind::kSink && fits(takes, type.gives);
}

// "put a 'trace' between": the nodes that take the one and give the other.
std::string way_between(const std::string& given, const Takes& takes) {
    std::vector<std::string> names;
    for (const auto& [name, type] : registry().types())
        if (gives(type, takes) && takes_required(type, given)) names.push_back(in_quotes(name));
    if (names.empty()) {
        const char* kind = taken(takes);
        return fmt::format("no node turns {} into {}", kind_text(given), kind_text(kind ? kind : "data"));
    }
    std::string list = names[0];
    for (std::size_t i = 1; i < names.size(); ++i) list += (i + 1 < names.size() ? ", " : " or ") + names[i];
    const bool vowel = std::string_view("aeiou").find(list[1]) != std::string_view::npos;
    return fmt::format("put {} {} between", vowel ? "an" : "a", list);
}

}  // namespace

std::optional<KindFault> kind_fault(const std::string& port, const Takes& takes, const std::string& from,
                                    const NodeType& type) {
    if (fits(takes, type.gives)) return std::nullopt;
    const char* kind = taken(takes);
    return KindFault{fmt::format("{} takes {}; {} gives {}", in_quotes(port), kind_text(kind ? kind : "data"),
                                 in_quotes(from), kind_text(type.gives)),
                     way_between(type.gives, takes)};
}

std::optional<KindFault> selector_fault(const std::string& from, const NodeType& type,
                                        const std::string& selector) {
    if (type.gives.empty()) return std::nullopt;
    if (!type.parts)
        return KindFault{
            fmt::format("{} gives {}, which has no channels to pick", in_quotes(from), type.gives),
            fmt::format("write {}", in_quotes(from))};
    if (find_part(*type.parts, selector)) return std::nullopt;
    const std::string hint = did_you_mean(selector, type.parts->names);
    return KindFault{
        fmt::format("{} gives {}, of which none are {}", in_quotes(from), type.gives, in_quotes(selector)),
        hint.empty() ? "known are " + listed(type.parts->names) : hint};
}

}  // namespace keyline
