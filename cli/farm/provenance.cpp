// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/run/provenance.h"

#include "cli/common/report.h"
#include "cli/farm/commands.h"
#include "engine/base/text.h"
#include "engine/json/json_writer.h"

#include <fmt/format.h>
#include <memory>
#include <optional>
#include <string>

namespace keyline::cli {

namespace {

struct ProvenanceArguments {
    std::string file;
    bool graph = false, json = false;
};

std::string text_of(const Value& object, std::string_view key) {
    const Value* v = object.find(key);
    return v ? escaped(v->text) : "";
}

std::string indented(const Value& value) {
    return JsonWriter(JsonWriter::Style::kIndented).value(value).text() + "\n";
}

std::string summary_of(const std::string& file, const Value& p) {
    std::string out =
        fmt::format("{}\n  output    {}, frame {}\n  digest    {}\n  keyline   {}\n", escaped(file),
                    text_of(p, "output"), text_of(p, "frame"), text_of(p, "digest"), text_of(p, "keyline"));
    if (const Value* ocio = p.find("ocio")) out += fmt::format("  ocio      {}\n", text_of(*ocio, "config"));
    if (const Value* inputs = p.find("inputs"))
        for (const Value& in : inputs->items)
            out += fmt::format("  input     {} {} of {}\n", text_of(in, "content"), text_of(in, "file"),
                               text_of(in, "node"));
    if (const Value* graph = p.find("graph")) out += "\n" + indented(*graph);
    return out;
}

int run(const ProvenanceArguments& arguments) {
    const std::optional<Value> found = read_provenance(arguments.file);
    if (!found)
        fail(ErrorKind::kInput, fmt::format("{}: it does not tell what made it", arguments.file),
             "what 'keyline render' wrote does");
    const Value* graph = found->find("graph");
    if (arguments.graph && graph)
        print_result(indented(*graph));
    else
        print_result(arguments.json ? indented(*found) : summary_of(arguments.file, *found));
    return 0;
}

}  // namespace

void add_provenance(const Command& program) {
    const Command command = program.add("provenance", "What made an output: graph, inputs, versions");
    const auto arguments = std::make_shared<ProvenanceArguments>();
    command.argument("FILE", arguments->file, "An image that Keyline wrote");
    command.flag("--graph", arguments->graph, "Just the graph, as a graph file");
    command.flag("--json", arguments->json, "All of it, as JSON");
    command.runs([arguments] { return run(*arguments); });
}

}  // namespace keyline::cli
