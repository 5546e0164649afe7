// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/common/report.h"
#include "cli/graphs/commands.h"
#include "cli/graphs/nodes_json.h"
#include "engine/graph/group.h"
#include "engine/graph/group_search.h"
#include "engine/node/reference.h"
#include "engine/node/registry.h"

#include <memory>

namespace keyline::cli {

namespace {

struct NodesArguments {
    std::string type;
    bool markdown = false, json = false;
};

int print_type(const NodeType& type, bool json) {
    print_result(json ? nodes_json({&type, 1}) : node_text(type));
    return 0;
}

int print_group(const std::filesystem::path& file, bool json) {
    Diagnostics diagnostics;
    const auto group = read_group(file, {}, diagnostics);
    report(diagnostics);
    if (group) print_type(group->type, json);
    return exit_status(diagnostics);
}

std::string all_as_json() {
    std::vector<NodeType> types;
    for (const auto& [name, type] : registry().types()) types.push_back(type);
    for (NodeType& group : types_of(named_groups())) types.push_back(std::move(group));
    return nodes_json(types);
}

int run(const NodesArguments& arguments) {
    if (arguments.markdown)
        print_result(reference_markdown(types_of(shipped_groups())));
    else if (arguments.type.empty() && arguments.json)
        print_result(all_as_json());
    else if (arguments.type.empty())
        print_result(node_list_text(types_of(named_groups())));
    else if (const NodeType* type = registry().find(arguments.type))
        return print_type(*type, arguments.json);
    else if (const auto file = group_file(arguments.type, {}); !file.empty())
        return print_group(file, arguments.json);
    else
        fail(ErrorKind::kGraph, "there is no node type " + in_quotes(arguments.type),
             near_type(arguments.type, {}));
    return 0;
}

}  // namespace

void add_nodes(const Command& program) {
    const Command command = program.add("nodes", "The node reference: all types, or one in full");
    const auto arguments = std::make_shared<NodesArguments>();
    const Option type =
        command.argument("TYPE", arguments->type, "A node type, or a group by its name or file").optional();
    const Option markdown =
        command.flag("--markdown", arguments->markdown, "The whole reference as Markdown").excludes(type);
    command.flag("--json", arguments->json, "As JSON: a list with an object a type").excludes(markdown);
    command.runs([arguments] { return run(*arguments); });
}

}  // namespace keyline::cli
