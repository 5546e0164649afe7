// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/common/commands.h"
#include "cli/common/machine.h"
#include "cli/common/report.h"
#include "cli/manual.h"
#include "engine/color/color.h"
#include "engine/color/opencolorio_log.h"
#include "engine/io/versions.h"

#include <csignal>
#include <exception>
#include <fmt/format.h>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

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
    out.reserve(commands.size());
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
    const CLI::App* above = command.get_parent();
    return above ? full_name(*above) + " " + command.get_name() : command.get_name();
}

// What was typed and nothing knows: an option, a command, or one argument too many.
[[noreturn]] void refuse_extra(const CLI::App& command, const std::string& extra) {
    const std::string help = fmt::format("'{} --help' lists them", full_name(command));
    if (extra.starts_with('-')) {
        const std::string name = extra.substr(0, extra.find('='));
        std::string hint = did_you_mean(name, options_of(command));
        fail(ErrorKind::kGraph, fmt::format("unknown option {}", in_quotes(name)),
             hint.empty() ? help : hint);
    }
    const auto below = command.get_subcommands([](const CLI::App*) { return true; });
    if (below.empty())
        fail(ErrorKind::kGraph, fmt::format("one argument too many: {}", in_quotes(extra)),
             fmt::format("see '{} --help'", full_name(command)));
    std::string hint = did_you_mean(extra, names_of(below));
    fail(ErrorKind::kGraph, fmt::format("unknown command {}", in_quotes(extra)), hint.empty() ? help : hint);
}

// Of a command and those below it that were given.
void refuse_extras(const CLI::App& command) {
    for (const std::string& extra : command.remaining()) refuse_extra(command, extra);
    for (const CLI::App* below : command.get_subcommands()) refuse_extras(*below);
}

void allow_extras(CLI::App& command) {
    command.allow_extras();
    for (CLI::App* below : command.get_subcommands({})) allow_extras(*below);
}

// CLI11 takes the next argument for the value of "--root=": in a script, that of a variable that is not set.
void refuse_empty_values(const std::vector<std::string_view>& arguments) {
    for (const std::string_view a : arguments)
        if (a.starts_with("--") && a.find('=') == a.size() - 1)
            fail(ErrorKind::kGraph, fmt::format("the value of {} is empty", a.substr(0, a.size() - 1)),
                 "give one, or leave the option out");
}

// An option is told with the kind of its value; what may stand with what is the help's to say in words.
class HelpFormatter final : public CLI::Formatter {
public:
    HelpFormatter() {
        column_width(32);
        label("Positionals", "Arguments");
        label("Subcommands", "Commands");
        label("SUBCOMMAND", "COMMAND");
    }
    std::string make_option_opts(const CLI::Option* option) const override {
        const bool many = option->get_positional() && option->get_expected_max() > 1;
        const std::string value = option->get_type_size() == 0 ? "" : option->get_type_name();
        return (value.empty() ? "" : " " + value) + (many ? " ..." : "");
    }
};

bool asks_for_the_manual(const std::vector<std::string_view>& arguments) {
    return arguments == std::vector<std::string_view>{"help", "graphs"};
}

// `keyline help check` is `keyline check --help`.
std::vector<const char*> with_help_as_option(int argc, char** argv) {
    std::vector<const char*> out(argv, argv + argc);
    if (argc < 2 || out[1] != std::string_view("help")) return out;
    out.erase(out.begin() + 1);
    out.push_back("--help");
    return out;
}

// Fills in what is to be done; an exit status where that is all.
std::optional<int> parse(CLI::App& program, int argc, char** argv) {
    refuse_empty_values({argv + 1, argv + argc});
    const std::vector<const char*> arguments = with_help_as_option(argc, argv);
    try {
        program.parse(static_cast<int>(arguments.size()), arguments.data());
    } catch (const CLI::Success& e) {  // --help, --version
        refuse_extras(program);
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
    hear_opencolorio([](const std::string& message) { print_library_warning("OpenColorIO", message); });
    std::signal(SIGPIPE, SIG_IGN);  // a reader that goes away is a write that fails
    std::signal(SIGXFSZ, SIG_IGN);  // and so is a file that grows beyond what the system allows
    CLI::App program("Keyline renders node graphs for toon looks.", "keyline");
    program.set_version_flag("--version", version_text, "The versions of Keyline and its libraries");
    program.set_help_flag("--help,-h", "This help");
    program.formatter(std::make_shared<HelpFormatter>());
    program.footer(
        "Examples:\n"
        "  keyline check toon.json\n"
        "  keyline render toon.json --frames 1-24\n"
        "  keyline render toon.json --frames 12 --output blur=look.exr --set blur.sigma=3\n"
        "  keyline help render\n"
        "  keyline help graphs       the language of graph files");
    Chosen chosen;
    add_render(program, chosen);
    add_check(program, chosen);
    add_plan(program, chosen);
    add_fmt(program, chosen);
    add_lsp(program, chosen);
    add_nodes(program, chosen);
    add_schema(program, chosen);
    add_info(program, chosen);
    add_diff(program, chosen);
    add_view(program, chosen);
    add_draw(program, chosen);
    add_measure(program, chosen);
    add_verify(program, chosen);
    add_provenance(program, chosen);
    add_submit(program, chosen);
    program.require_subcommand(0, 1);  // what follows may be a node that is called as a command is
    allow_extras(program);

    std::optional<int> done;
    if (asks_for_the_manual({argv + 1, argv + argc}))
        chosen = [] { return print_result(manual_of_graphs()), 0; };
    else
        done = parse(program, argc, argv);
    if (!done && !chosen) fail(ErrorKind::kGraph, "no command", "'keyline --help' lists them");
    const int status = done ? *done : chosen();
    finish_results();
    return status;
}

}  // namespace

int main(int argc, char** argv) {
    fill_closed_streams();
    give_large_blocks_back();
    try {
        return run(argc, argv);
    } catch (...) {
        const Error error = error_of(std::current_exception());
        print_error(error);
        return exit_status(error);
    }
}
