// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/common/report.h"
#include "cli/graphs/commands.h"
#include "engine/graph/group.h"
#include "engine/graph/group_search.h"
#include "engine/node/reference.h"
#include "engine/node/registry.h"

#include <memory>

namespace keyline::cli {

namespace {

struct NodesArguments {
    std::string type;
    bool markdown = false;
};

int print_group(const std::filesystem::path& file) {
    Diagnostics diagnostics;
    const auto group = read_group(file, {}, diagnostics);
    report(diagnostics);
    if (group) print_result(node_text(group->type));
    return exit_status(diagnostics);
}

int run(const NodesArguments& arguments) {
    if (arguments.markdown)
        print_result(reference_markdown(types_of(shipped_groups())));
    else if (arguments.type.empty())
        print_result(node_list_text(types_of(named_groups())));
    else if (const NodeType* type = registry().find(arguments.type))
        print_result(node_text(*type));
    else if (const auto file = group_file(arguments.type, {}); !file.empty())
        return print_group(file);
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
    command.flag("--markdown", arguments->markdown, "The whole reference as Markdown").excludes(type);
    command.runs([arguments] { return run(*arguments); });
}

}  // namespace keyline::cli
