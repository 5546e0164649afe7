// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/params/path_map.h"

#include "engine/base/error.h"
#include "engine/json/json_reader.h"

#include <algorithm>
#include <fmt/format.h>
#include <functional>

namespace keyline {

namespace {

constexpr const char* kVersion = "pathmapping-1.0";

[[noreturn]] void refuse(const Place& place, std::string what, std::string hint = {}) {
    throw Failure({ErrorKind::kGraph, place, {}, std::move(what), std::move(hint)});
}

char folded(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

bool same_name(std::string_view a, std::string_view b, bool is_windows) {
    return is_windows ? std::ranges::equal(a, b, {}, folded, folded) : a == b;
}

// "/shows/a/" has the names "", "shows" and "a"; "\\server\share" has "", "", "server" and "share".
std::vector<std::string> names_in(std::string_view path, bool is_windows) {
    const std::string_view separators = is_windows ? "/\\" : "/";
    std::vector<std::string> out;
    for (std::size_t begin = 0; begin <= path.size();) {
        const std::size_t end = std::min(path.find_first_of(separators, begin), path.size());
        out.emplace_back(path.substr(begin, end - begin));
        begin = end + 1;
    }
    while (!out.empty() && out.back().empty()) out.pop_back();
    return out;
}

bool is_absolute(std::string_view path, bool is_windows) {
    const bool from_root = path.starts_with('/') || (is_windows && path.starts_with('\\'));
    return from_root || (is_windows && path.size() > 1 && path[1] == ':');
}

const std::string& text_of(const Value& rule, const char* key) {
    const Value* v = rule.find(key);
    if (!v) refuse(rule.place, fmt::format("a rule must have {}", in_quotes(key)));
    if (!v->is(Value::Kind::kString) || v->text.empty())
        refuse(v->place, fmt::format("{} is {}; it must be a path or a word", in_quotes(key), v->shown()));
    return v->text;
}

bool is_windows_format(const Value& rule) {
    const std::string& format = text_of(rule, "source_path_format");
    if (format != "POSIX" && format != "WINDOWS")
        refuse(rule.find("source_path_format")->place,
               fmt::format("'source_path_format' is {}; it must be POSIX or WINDOWS", in_quotes(format)));
    return format == "WINDOWS";
}

void refuse_unknown_keys(const Value& object, const std::vector<std::string>& known) {
    for (const Member& m : object.members)
        if (std::ranges::find(known, m.key) == known.end())
            refuse(m.key_place, "unknown key " + in_quotes(m.key), did_you_mean(m.key, known));
}

// The list of rules; null where the file is `{}`.
const Value* rules_in(const Value& root) {
    if (!root.is(Value::Kind::kObject)) refuse(root.place, "path mapping rules are an object");
    refuse_unknown_keys(root, {"version", "path_mapping_rules"});
    const Value* rules = root.find("path_mapping_rules");
    if (root.members.empty()) return nullptr;
    if (text_of(root, "version") != kVersion)
        refuse(root.find("version")->place, fmt::format("'version' must be {}", in_quotes(kVersion)));
    if (!rules) return nullptr;
    if (!rules->is(Value::Kind::kArray)) refuse(rules->place, "'path_mapping_rules' must be a list of rules");
    return rules;
}

}  // namespace

PathMap PathMap::parse(std::string_view text, const std::string& name) {
    PathMap out;
    const Value root = parse_json(text, name);
    const Value* rules = rules_in(root);
    if (!rules) return out;
    for (const Value& rule : rules->items) {
        if (!rule.is(Value::Kind::kObject)) refuse(rule.place, "a rule is an object");
        refuse_unknown_keys(rule, {"source_path_format", "source_path", "destination_path"});
        Rule r{is_windows_format(rule), {}, text_of(rule, "destination_path")};
        const std::string& source = text_of(rule, "source_path");
        if (!is_absolute(source, r.is_windows))
            refuse(rule.find("source_path")->place,
                   fmt::format("'source_path' is {}; it must be absolute", in_quotes(source)));
        r.names = names_in(source, r.is_windows);
        while (r.destination.size() > 1 && r.destination.ends_with('/')) r.destination.pop_back();
        out.rules_.push_back(std::move(r));
    }
    std::ranges::stable_sort(out.rules_, std::greater{}, [](const Rule& r) { return r.names.size(); });
    return out;
}

std::string PathMap::map(const std::string& path) const {
    for (const Rule& rule : rules_) {
        const std::vector<std::string> names = names_in(path, rule.is_windows);
        const auto same = [&](const std::string& a, const std::string& b) {
            return same_name(a, b, rule.is_windows);
        };
        if (names.size() < rule.names.size() ||
            !std::equal(rule.names.begin(), rule.names.end(), names.begin(), same))
            continue;
        std::string out = rule.destination;
        for (std::size_t i = rule.names.size(); i < names.size(); ++i)
            out += (out.ends_with('/') ? "" : "/") + names[i];
        return out;
    }
    return path;
}

}  // namespace keyline
