// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/graph/scope.h"

#include <algorithm>

namespace keyline {

namespace {

std::string with_selector(std::string link, const std::string& selector) {
    if (selector.empty()) return link;
    return link + (link.find(':') == std::string::npos ? ":" : ".") + selector;
}

std::string text_of(const Value& link, const Variables& variables, int frame) {
    Diagnostics ignored;  // told where the group is used
    return variables.substitute(link, frame, ignored).text;
}

// False where it leads nowhere, and what holds it does without.
bool make_whole(const Scope& scope, const TypeInfo& type, int frame, Value& value) {
    if (type.kind == TypeInfo::Kind::kInput && value.is(Value::Kind::kString)) {
        const auto whole = whole_link(scope, value.text, frame);
        if (whole) value.text = *whole;
        return whole.has_value();
    }
    if (type.kind == TypeInfo::Kind::kList)
        std::erase_if(value.items, [&](Value& v) { return !make_whole(scope, type.items[0], frame, v); });
    if (type.kind == TypeInfo::Kind::kMap)
        std::erase_if(value.members,
                      [&](Member& m) { return !make_whole(scope, type.items[0], frame, m.value); });
    if (type.kind == TypeInfo::Kind::kObject) make_links_whole(scope, type.fields, frame, value);
    return true;
}

}  // namespace

void make_links_whole(const Scope& scope, const std::vector<FieldInfo>& fields, int frame, Value& object) {
    if (!scope.outer && scope.groups.empty()) return;
    std::erase_if(object.members, [&](Member& m) {
        const auto field = std::ranges::find(fields, m.key, &FieldInfo::name);
        return field != fields.end() && !make_whole(scope, field->type, frame, m.value);
    });
}

std::optional<std::string> whole_link(const Scope& scope, const std::string& link, int frame) {
    const std::size_t colon = std::min(link.find(':'), link.size());
    const std::string id = link.substr(0, colon);
    std::string selector = link.substr(std::min(colon + 1, link.size()));
    const std::size_t slash = id.find('/');
    const auto around = scope.groups.find(id.substr(0, slash));
    if (slash != std::string::npos && around != scope.groups.end())
        return whole_link(*around->second.inside, link.substr(slash + 1), frame);
    if (const auto input = scope.inputs.find(id); input != scope.inputs.end()) {
        if (!input->second) return std::nullopt;
        auto out = whole_link(*scope.outer, text_of(*input->second, *scope.outer->variables, frame), frame);
        return out ? std::optional(with_selector(std::move(*out), selector)) : std::nullopt;
    }
    const auto group = scope.groups.find(id);
    if (group == scope.groups.end() || group->second.outputs.empty())
        return with_selector(scope.prefix + id, selector);
    const auto& outputs = group->second.outputs;
    auto output = std::ranges::find(outputs, selector, &GroupUse::Output::name);
    if (output == outputs.end())
        output = outputs.begin();
    else
        selector.clear();
    const Scope& inside = *group->second.inside;
    if (!group->second.passes.empty())
        return whole_link(inside, with_selector(group->second.passes, selector), frame);
    auto out = whole_link(inside, text_of(output->link, *inside.variables, frame), frame);
    return out ? std::optional(with_selector(std::move(*out), selector)) : std::nullopt;
}

}  // namespace keyline
