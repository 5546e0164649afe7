// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/common/report.h"
#include "cli/graphs/commands.h"
#include "engine/base/text.h"
#include "engine/graph/read_text.h"
#include "engine/io/text_file.h"
#include "engine/json/json_layout.h"

#include <fmt/format.h>
#include <memory>
#include <string>
#include <vector>

namespace keyline::cli {

namespace {

struct FmtArguments {
    std::vector<std::string> files;
    bool check = false;
};

// Of one file; false where it differs and was only to be looked at.
bool format(const std::string& file, bool only_check) {
    const std::string text = read_text(file, "the graph");
    const std::string formatted = json_layout(text, file);
    if (only_check) {
        if (formatted != text)
            print_message(fmt::format("{}: not in the layout that 'keyline fmt' gives it", escaped(file)));
        return formatted == text;
    }
    if (file == "-")
        print_result(formatted);
    else if (formatted != text)
        write_text_file(file, formatted);
    return true;
}

// One that can't be read or written keeps no other from being formatted.
int run(const FmtArguments& arguments) {
    Diagnostics diagnostics;
    bool all_are = true;
    for (const std::string& file : arguments.files) {
        try {
            all_are = format(file, arguments.check) && all_are;
        } catch (const Failure& f) {
            diagnostics.error(f.error());
        }
    }
    report(diagnostics);
    return diagnostics.ok() ? (all_are ? 0 : 1) : exit_status(diagnostics);
}

}  // namespace

void add_fmt(const Command& program) {
    const Command command = program.add("fmt", "Lay graph files out as they should be");
    const auto arguments = std::make_shared<FmtArguments>();
    command.argument("FILE", arguments->files,
                     "Files, changed in place; - for standard input to standard output");
    command.flag("--check", arguments->check, "Change nothing: tell which would be, with status 1");
    command.runs([arguments] { return run(*arguments); });
}

}  // namespace keyline::cli
