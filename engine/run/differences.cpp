// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/run/provenance.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>

namespace keyline {

namespace {

// A null stands for what is not there.
const Value& in(const Value& object, std::string_view key) {
    static const Value none;
    const Value* found = object.find(key);
    return found ? *found : none;
}

std::string text_of(const Value& object, std::string_view key) { return in(object, key).text; }

std::string path_to(const std::string& where, const std::string& key) {
    return where.empty() ? key : where + "." + key;
}

// Two objects member by member; the order of members is nobody's concern.
class Differences {
public:
    // What stands in the graphs.  `where` names the objects: "smooth".
    void compare(const std::string& where, const Value& was, const Value& is) {
        for (const Member& m : is.members) compare_member(path_to(where, m.key), was.find(m.key), &m.value);
        for (const Member& m : was.members)
            if (!is.find(m.key)) compare_member(path_to(where, m.key), &m.value, nullptr);
    }

    void compare_nodes(const Value& was, const Value& is) {
        for (const Member& m : is.members) {
            const Value* before = was.find(m.key);
            if (before)
                compare(m.key, *before, m.value);
            else
                out.push_back(fmt::format("the node {} is new", in_quotes(m.key)));
        }
        for (const Member& m : was.members)
            if (!is.find(m.key)) out.push_back(fmt::format("the node {} is gone", in_quotes(m.key)));
    }

    // Lists of what was read: by node and name.
    void compare_inputs(const Value& was, const Value& is) {
        const auto before = contents(was), now = contents(is);
        for (const auto& [input, content] : now) {
            const auto found = before.find(input);
            const char* what = found == before.end() ? "was not read" : "is another one";
            if (found == before.end() || found->second != content) tell(input, what);
        }
        for (const auto& [input, content] : before)
            if (!now.contains(input)) tell(input, "is not read any more");
    }

    void compare_versions(const Value& was, const Value& is) {
        for (const Member& m : is.members)
            if (const Value* before = was.find(m.key); before && before->shown() != m.value.shown())
                out.push_back(fmt::format("the node type {} has version {}, and had {}", in_quotes(m.key),
                                          m.value.shown(), before->shown()));
    }

    std::vector<std::string> out;

private:
    using Input = std::pair<std::string, std::string>;  // node, file

    static std::map<Input, std::string> contents(const Value& inputs) {
        std::map<Input, std::string> out;
        for (const Value& i : inputs.items)
            out[{text_of(i, "node"), text_of(i, "file")}] += text_of(i, "content");
        return out;
    }

    void tell(const Input& input, const char* what) {
        out.push_back(
            fmt::format("the input {} of {} {}", in_quotes(input.second), in_quotes(input.first), what));
    }

    static std::string shown(const Value* v) { return v ? v->shown() : "not given"; }

    void compare_member(const std::string& where, const Value* was, const Value* is) {
        const bool both = was && is;
        if (both && was->is(Value::Kind::kObject) && is->is(Value::Kind::kObject))
            return compare(where, *was, *is);
        if (both && equal(*was, *is)) return;
        out.push_back(fmt::format("{} is {}, and was {}", in_quotes(where), shown(is), shown(was)));
    }

    static bool equal(const Value& a, const Value& b) {
        if (a.kind != b.kind || a.items.size() != b.items.size() || a.members.size() != b.members.size())
            return false;
        if (a.is(Value::Kind::kString) && a.text != b.text) return false;
        const auto same_member = [&](const Member& m) {
            const Value* other = b.find(m.key);
            return other && equal(m.value, *other);
        };
        return a.number == b.number && a.boolean == b.boolean &&
               std::ranges::equal(a.items, b.items, equal) && std::ranges::all_of(a.members, same_member);
    }
};

}  // namespace

std::vector<std::string> differences(const Value& was, const Value& is) {
    Differences found;
    const Value &graph_was = in(was, "graph"), &graph_is = in(is, "graph");
    found.compare_nodes(in(graph_was, "nodes"), in(graph_is, "nodes"));
    found.compare("variables", in(graph_was, "variables"), in(graph_is, "variables"));
    found.compare_inputs(in(was, "inputs"), in(is, "inputs"));
    found.compare_versions(in(was, "nodes"), in(is, "nodes"));
    if (text_of(in(was, "ocio"), "content") != text_of(in(is, "ocio"), "content"))
        found.out.emplace_back("the colour config is another one");
    return found.out;
}

}  // namespace keyline
