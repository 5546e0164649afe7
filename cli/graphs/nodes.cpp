// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/common/report.h"
#include "cli/graphs/commands.h"
#include "engine/graph/group.h"
#include "engine/node/reference.h"
#include "engine/node/registry.h"

#include <memory>

namespace keyline::cli {

namespace {

struct NodesArguments {
    std::string type;
    bool markdown = false;
};

int run(const NodesArguments& arguments) {
    if (arguments.markdown) {
        print_result(reference_markdown());
    } else if (arguments.type.empty()) {
        print_result(node_list_text());
    } else if (is_group(arguments.type)) {
        Diagnostics diagnostics;
        const auto group = read_group(arguments.type, {}, diagnostics);
        report(diagnostics);
        if (group) print_result(node_text(group->type));
        return exit_status(diagnostics);
    } else {
        const NodeType* type = registry().find(arguments.type);
        if (!type) {
            std::string hint = did_you_mean(arguments.type, registry().names());
            fail(ErrorKind::kGraph, "there is no node type " + in_quotes(arguments.type),
                 hint.empty() ? "'keyline nodes' lists them" : hint);
        }
        print_result(node_text(*type));
    }
    return 0;
}

}  // namespace

void add_nodes(const Command& program) {
    const Command command = program.add("nodes", "The node reference: all types, or one in full");
    const auto arguments = std::make_shared<NodesArguments>();
    const Option type =
        command.argument("TYPE", arguments->type, "A node type, or the file of a group").optional();
    command.flag("--markdown", arguments->markdown, "The whole reference as Markdown").excludes(type);
    command.runs([arguments] { return run(*arguments); });
}

}  // namespace keyline::cli
