// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/graph/variables.h"
#include "engine/json/json_reader.h"
#include "engine/json/json_writer.h"
#include "engine/node/registry.h"
#include "tests/support/any_value.h"

#include <algorithm>
#include <cstdio>
#include <fmt/format.h>

// Prints graphs of one node, a line each, { "graph": …, "takes": … }: drawn at random, right and wrong, with
// what the loader says of the node.

namespace {

using namespace keyline;
using keyline::testing::AnyValue;
using keyline::testing::Draw;

constexpr unsigned kSeed = 2;
constexpr int kGraphs = 10000;

// As they are at frame 1.
bool loader_takes(const NodeType& type, Value object, const Value& variables) {
    Diagnostics diagnostics;
    VariableSources sources;
    sources.declared = &variables;
    const Variables known(sources, diagnostics);
    for (Member& m : object.members) {
        const auto field = std::ranges::find(type.fields, m.key, &FieldInfo::name);
        if (field != type.fields.end()) m.value = known.evaluate(m.value, field->type, {1}, diagnostics);
    }
    ParamReader reader(diagnostics, type.name, {});
    validate(type.fields, object, reader);
    return diagnostics.ok();
}

Value with_type(Value object, const std::string& type) {
    Value name;
    name.kind = Value::Kind::kString;
    name.text = type;
    object.members.push_back({"type", {}, std::move(name)});
    return object;
}

// Half of them have wrong values in them, half of the others computed ones.
std::string line(const NodeType& type, Draw& draw) {
    AnyValue values(draw, draw.one_in(2) ? 12 : 0);
    if (!values.draws_wrong() && draw.one_in(2)) values.compute();
    const Value object = parse_json(values.object(type.fields), "node.json");
    const Value variables = parse_json(values.variables(), "variables.json");
    JsonWriter json;
    json.begin_object().key("graph").begin_object().field("keyline", 1).field("variables", variables);
    json.key("nodes").begin_object().field("a", with_type(object, type.name)).end_object().end_object();
    return json.field("takes", loader_takes(type, object, variables)).end_object().text();
}

}  // namespace

int main() {
    Draw draw(kSeed);
    const std::vector<std::string> names = registry().names();
    for (int i = 0; i < kGraphs; ++i) std::puts(line(*registry().find(draw.of(names)), draw).c_str());
    return 0;
}
