// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/commands.h"
#include "cli/report.h"
#include "engine/io/color.h"
#include "engine/io/versions.h"

#include <csignal>
#include <exception>
#include <fmt/format.h>
#include <new>
#include <optional>

namespace {

using namespace keyline;
using namespace keyline::cli;

std::string version_text() {
    std::string out = fmt::format("keyline {}\n", keyline_version());
    for (const LibraryVersion& v : library_versions()) out += fmt::format("  {:<14} {}\n", v.name, v.version);
    out.pop_back();  // the command line's own end of line
    return out;
}

std::vector<std::string> names_of(const std::vector<const CLI::App*>& commands) {
    std::vector<std::string> out;
    for (const CLI::App* c : commands) out.push_back(c->get_name());
    return out;
}

std::vector<std::string> options_of(const CLI::App& command) {
    std::vector<std::string> out;
    for (const CLI::Option* o : command.get_options())
        for (const std::string& name : o->get_lnames()) out.push_back("--" + name);
    return out;
}

std::string full_name(const CLI::App& command) {
    return command.get_parent() ? command.get_parent()->get_name() + " " + command.get_name()
                                : command.get_name();
}

// What was typed and nothing knows: an option, a command, or one argument too many.
[[noreturn]] void refuse_extra(const CLI::App& program, const CLI::App& command, const std::string& extra) {
    const std::string help = fmt::format("'{} --help' lists them", full_name(command));
    if (extra.starts_with('-')) {
        const std::string name = extra.substr(0, extra.find('='));
        std::string hint = did_you_mean(name, options_of(command));
        fail(ErrorKind::kGraph, fmt::format("unknown option {}", in_quotes(name)),
             hint.empty() ? help : hint);
    }
    if (&command != &program)
        fail(ErrorKind::kGraph, fmt::format("one argument too many: {}", in_quotes(extra)),
             fmt::format("see '{} --help'", full_name(command)));
    std::string hint = did_you_mean(extra, names_of(program.get_subcommands({})));
    fail(ErrorKind::kGraph, fmt::format("unknown command {}", in_quotes(extra)), hint.empty() ? help : hint);
}

void refuse_extras(const CLI::App& program) {
    for (const std::string& extra : program.remaining()) refuse_extra(program, program, extra);
    for (const CLI::App* command : program.get_subcommands())
        for (const std::string& extra : command->remaining()) refuse_extra(program, *command, extra);
}

// CLI11 takes the next argument for the value of "--root=": in a script, that of a variable that is not set.
void refuse_empty_values(const std::vector<std::string_view>& arguments) {
    for (const std::string_view a : arguments)
        if (a.starts_with("--") && a.find('=') == a.size() - 1)
            fail(ErrorKind::kGraph, fmt::format("the value of {} is empty", a.substr(0, a.size() - 1)),
                 "give one, or leave the option out");
}

// Fills in what is to be done; an exit status where that is all.
std::optional<int> parse(CLI::App& program, int argc, char** argv) {
    refuse_empty_values({argv + 1, argv + argc});
    try {
        program.parse(argc, argv);
    } catch (const CLI::Success& e) {  // --help, --version
        return program.exit(e);
    } catch (const CLI::ParseError& e) {
        // An unknown option may be why something else seems to be missing.
        refuse_extras(program);
        const auto commands = program.get_subcommands();
        fail(ErrorKind::kGraph, e.what(),
             fmt::format("see '{} --help'", full_name(commands.empty() ? program : *commands.front())));
    }
    refuse_extras(program);
    return std::nullopt;
}

int run(int argc, char** argv) {
    clear_ocio_environment();
    std::signal(SIGPIPE, SIG_IGN);  // a reader that goes away is a write that fails
    std::signal(SIGXFSZ, SIG_IGN);  // and so is a file that grows beyond what the system allows
    CLI::App program("Keyline renders node graphs for toon looks.", "keyline");
    program.set_version_flag("--version", version_text, "The versions of Keyline and its libraries");
    program.set_help_flag("--help,-h", "This help");
    program.get_formatter()->column_width(32);
    Chosen chosen;
    add_render(program, chosen);
    add_check(program, chosen);
    add_plan(program, chosen);
    add_nodes(program, chosen);
    add_info(program, chosen);
    program.allow_extras();
    for (CLI::App* command : program.get_subcommands({})) command->allow_extras();

    const std::optional<int> done = parse(program, argc, argv);
    if (!done && !chosen) fail(ErrorKind::kGraph, "no command", "'keyline --help' lists them");
    const int status = done ? *done : chosen();
    finish_results();
    return status;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        return run(argc, argv);
    } catch (const Failure& f) {
        print_message(f.error().text());
        return exit_status(f.error().kind);
    } catch (const std::bad_alloc&) {
        print_message("error: out of memory; a smaller --memory makes a render use less of it");
    } catch (const std::exception& e) {
        print_message(fmt::format("error: internal: {}", e.what()));
    }
    return 1;
}
