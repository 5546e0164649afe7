// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/common/options.h"
#include "cli/common/report.h"
#include "cli/graphs/commands.h"
#include "engine/base/text.h"
#include "engine/graph/group_search.h"
#include "engine/io/text_file.h"
#include "engine/node/reference.h"

#include <filesystem>
#include <fmt/format.h>
#include <memory>

namespace keyline::cli {

namespace {

constexpr const char* kFileName = "keyline.schema.json";

int run(const std::string& folder) {
    const std::string schema = schema_json(types_of(named_groups())) + "\n";
    if (folder.empty()) return print_result(schema), 0;
    const std::filesystem::path file = std::filesystem::path(folder) / kFileName;
    write_text_file(file, schema);
    print_result(fmt::format("{}: name it in \"$schema\" of a graph, or in the editor's settings\n",
                             escaped(std::filesystem::absolute(file).lexically_normal().string())));
    return 0;
}

}  // namespace

void add_schema(const Command& program) {
    const Command command = program.add("schema", "The JSON Schema of graph files, for editors");
    const auto folder = std::make_shared<std::string>();
    command.option("--install", *folder, "DIR",
                   fmt::format("Write it into this folder, as {}, instead of printing it", kFileName));
    command.runs([folder] { return run(*folder); });
}

}  // namespace keyline::cli
