// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/author/graph_test.h"
#include "engine/graph/read_text.h"
#include "engine/json/json_reader.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>

namespace keyline::cli {

namespace {

using Kind = Value::Kind;

[[noreturn]] void refuse(const Place& place, std::string what, std::string hint = {}) {
    throw Failure({ErrorKind::kGraph, place, {}, std::move(what), std::move(hint)});
}

const Value& of_kind(const Value& value, Kind kind, std::string_view key) {
    if (!value.is(kind))
        refuse(value.place,
               fmt::format("'{}' is {}; it must be {}", key, kind_name(value.kind), kind_name(kind)));
    return value;
}

void refuse_unknown(const Value& object, const std::vector<std::string>& known) {
    for (const Member& m : object.members)
        if (std::ranges::find(known, m.key) == known.end()) {
            const std::string hint = did_you_mean(m.key, known);
            refuse(m.key_place, "unknown key " + in_quotes(m.key),
                   hint.empty() ? "known are " + listed(known) : hint);
        }
}

// A number, or { "absolute": …, "relative": … }.
Tolerance read_tolerance(const Value& value) {
    const auto number = [](const Value& v) {
        if (of_kind(v, Kind::kNumber, "tolerance").number < 0) refuse(v.place, "a tolerance is at least 0");
        return v.number;
    };
    if (!value.is(Kind::kObject)) return {number(value), 0};
    refuse_unknown(value, {"absolute", "relative"});
    Tolerance out;
    if (const Value* v = value.find("absolute")) out.absolute = number(*v);
    if (const Value* v = value.find("relative")) out.relative = number(*v);
    return out;
}

GraphTest read_test(const Member& member, const std::string& file) {
    static const std::vector<std::string> kKnown{"about",     "graph",     "nodes",  "images",
                                                 "variables", "set",       "output", "frame",
                                                 "expect",    "tolerance", "error",  "warning"};
    const Value& value = of_kind(member.value, Kind::kObject, member.key);
    refuse_unknown(value, kKnown);
    GraphTest out;
    out.name = member.key;
    out.file = file;
    out.folder = std::filesystem::absolute(file).parent_path().string();
    out.place = member.key_place;
    const auto text = [&](const char* key) {
        const Value* v = value.find(key);
        return v ? of_kind(*v, Kind::kString, key).text : std::string();
    };
    const auto object = [&](const char* key) {
        const Value* v = value.find(key);
        if (v) return of_kind(*v, Kind::kObject, key);
        Value none;
        none.kind = Kind::kObject;
        return none;
    };
    out.graph = text("graph");
    out.output = text("output");
    out.error = text("error");
    out.warning = text("warning");
    out.nodes = object("nodes");
    out.images = object("images");
    out.values = object("variables");
    out.set = object("set").members;
    if (const Value* v = value.find("frame"))
        out.frame = static_cast<int>(std::lround(of_kind(*v, Kind::kNumber, "frame").number));
    if (const Value* v = value.find("expect")) out.expected = *v;
    if (const Value* v = value.find("tolerance")) out.tolerance = read_tolerance(*v);
    if (out.graph.empty() == out.nodes.members.empty())
        refuse(out.place, "a test has either a 'graph' or 'nodes'");
    if (!out.expected && out.error.empty() && out.warning.empty())
        refuse(out.place, "the test expects nothing", "give it 'expect', 'error' or 'warning'");
    if (out.output.empty() && out.nodes.members.size() == 1) out.output = out.nodes.members.front().key;
    if (out.output.empty()) refuse(out.place, "'output' is missing", "name the node that is looked at");
    return out;
}

}  // namespace

std::vector<GraphTest> read_graph_tests(const std::string& file, Diagnostics& diagnostics) {
    std::vector<GraphTest> out;
    const auto unless_it_fails = [&](const auto& read) {
        try {
            read();
        } catch (const Failure& f) {
            diagnostics.error(f.error());
        }
    };
    unless_it_fails([&] {
        const Value root = parse_json(read_text(file, "the tests"), file);
        of_kind(root, Kind::kObject, "the file");
        refuse_unknown(root, {"keyline", "about", "tests"});
        const Value* tests = root.find("tests");
        if (!tests) refuse(root.place, "'tests' is missing", "it holds the tests by their names");
        for (const Member& m : of_kind(*tests, Kind::kObject, "tests").members)
            unless_it_fails([&] { out.push_back(read_test(m, file)); });
    });
    return out;
}

}  // namespace keyline::cli
