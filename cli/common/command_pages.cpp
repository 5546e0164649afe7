// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/common/command_pages.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <vector>

namespace keyline::cli {

namespace {

std::vector<const CLI::App*> below(const CLI::App& command) {
    return command.get_subcommands([](const CLI::App*) { return true; });
}

std::vector<const CLI::Option*> listed_options(const CLI::App& command, bool are_arguments) {
    return command.get_options([&](const CLI::Option* o) {
        return o->get_positional() == are_arguments && !o->get_group().empty();
    });
}

// "GRAPH", "FILE...", "[TYPE]"
std::string argument_text(const CLI::Option& argument) {
    const std::string name = argument.get_name(true) + (argument.get_expected_max() > 1 ? "..." : "");
    return argument.get_required() ? name : "[" + name + "]";
}

// "render [OPTION]... GRAPH"
std::string usage(const CLI::App& command, const std::string& name) {
    std::string out = name;
    if (!listed_options(command, false).empty()) out += " [OPTION]...";
    if (!below(command).empty()) out += " COMMAND";
    for (const CLI::Option* argument : listed_options(command, true)) out += " " + argument_text(*argument);
    return out;
}

// "-o, --picture FILE"
std::string option_text(const CLI::Option& option) {
    std::string out;
    for (const std::string& name : option.get_snames()) out += (out.empty() ? "-" : ", -") + name;
    for (const std::string& name : option.get_lnames()) out += (out.empty() ? "--" : ", --") + name;
    const bool has_value = option.get_type_size() > 0 && !option.get_type_name().empty();
    return has_value ? out + " " + option.get_type_name() : out;
}

std::string entry(const std::string& what, const std::string& help) {
    return fmt::format("`{}`\n:   {}\n\n", what, help);
}

// Of a command and those below it.
std::string sections(const CLI::App& command, const std::string& above) {
    std::string out;
    for (const CLI::App* c : below(command)) {
        const std::string name = above + " " + c->get_name();
        out += fmt::format("## {}\n\n`{}`\n\n{}\n\n", name, usage(*c, name), c->get_description());
        for (const CLI::Option* o : listed_options(*c, true))
            out += entry(argument_text(*o), o->get_description());
        for (const CLI::Option* o : listed_options(*c, false))
            if (o != c->get_help_ptr()) out += entry(option_text(*o), o->get_description());
        out += sections(*c, name);
    }
    return out;
}

}  // namespace

std::string commands_markdown(const CLI::App& program) {
    const std::string& name = program.get_name();
    std::string out =
        fmt::format("# Synopsis\n\n`{}`\n\n{}\n\n", usage(program, name), program.get_description());
    for (const CLI::Option* o : listed_options(program, false))
        out += entry(option_text(*o), o->get_description());
    return out + "# Commands\n\n" + sections(program, name);
}

}  // namespace keyline::cli
