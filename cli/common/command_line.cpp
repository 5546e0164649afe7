// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/common/command_line.h"

#include "cli/common/command_pages.h"
#include "cli/common/completion.h"
#include "cli/common/report.h"
#include "engine/base/error.h"
#include "engine/base/text.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <map>
#include <optional>
#include <string_view>
#include <utility>

namespace keyline::cli {

const Option& Option::required() const {
    option_->required();
    return *this;
}

const Option& Option::optional() const {
    option_->required(false);
    return *this;
}

const Option& Option::hidden() const {
    option_->group("");
    return *this;
}

const Option& Option::excludes(const Option& other) const {
    option_->excludes(other.option_);
    return *this;
}

const Option& Option::of_words(const std::string& words) const {
    option_->type_name(words);
    return *this;
}

Command Command::add(const std::string& name, const std::string& help) const {
    return {*app_->add_subcommand(name, help), *chosen_};
}

void Command::needs_one_below() const { app_->require_subcommand(1); }

Option Command::argument(const std::string& name, std::string& value, const std::string& help) const {
    return Option(*app_->add_option(name, value, help)->required()->type_name(""));
}

Option Command::argument(const std::string& name, std::vector<std::string>& values,
                         const std::string& help) const {
    return Option(*app_->add_option(name, values, help)->required()->type_name(""));
}

Option Command::option(const std::string& name, std::string& value, const std::string& value_name,
                       const std::string& help) const {
    return Option(*app_->add_option(name, value, help)->type_name(value_name));
}

Option Command::option(const std::string& name, double& value, NumberRange range,
                       const std::string& value_name, const std::string& help) const {
    return Option(*app_->add_option(name, value, help)
                       ->type_name(value_name)
                       ->check(CLI::Range(range.least, range.most)));
}

Option Command::option(const std::string& name, std::vector<std::string>& values,
                       const std::string& value_name, const std::string& help) const {
    return Option(*app_->add_option(name, values, help)
                       ->type_name(value_name)
                       ->expected(1)
                       ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
                       ->allow_extra_args(false));
}

Option Command::flag(const std::string& name, bool& value, const std::string& help) const {
    return Option(*app_->add_flag(name, value, help));
}

Option Command::flag(const std::string& name, const std::string& help) const {
    return Option(*app_->add_flag(name)->description(help));
}

void Command::runs(Action action) const {
    app_->callback([chosen = chosen_, action = std::move(action)] { *chosen = action; });
}

namespace {

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

}  // namespace

struct CommandLine::State {
    explicit State(const About& about) : app(about.purpose, about.name) {}

    CLI::App app;
    Action chosen;
    std::map<std::string, Action> topics;
};

CommandLine::CommandLine(const About& about) : state_(std::make_unique<State>(about)) {
    CLI::App& app = state_->app;
    app.set_version_flag("--version", about.versions, "The versions of Keyline and its libraries");
    app.set_help_flag("--help,-h", "This help");
    app.formatter(std::make_shared<HelpFormatter>());
    app.footer(about.footer);
    app.require_subcommand(0, 1);  // what follows may be a node that is called as a command is
}

CommandLine::~CommandLine() = default;

Command CommandLine::program() { return {state_->app, state_->chosen}; }

std::string CommandLine::pages() const { return commands_markdown(state_->app); }

void CommandLine::add_topic(const std::string& topic, const Action& print) { state_->topics[topic] = print; }

int CommandLine::run(int argc, char** argv) {
    if (argc > 1 && argv[1] == std::string_view("complete"))
        return print_result(completions(state_->app, {argv + 2, argv + argc})), 0;
    if (argc == 3 && argv[1] == std::string_view("help"))
        if (const auto topic = state_->topics.find(argv[2]); topic != state_->topics.end())
            return topic->second();
    allow_extras(state_->app);
    if (const std::optional<int> done = parse(state_->app, argc, argv)) return *done;
    if (!state_->chosen) fail(ErrorKind::kGraph, "no command", "'keyline --help' lists them");
    return state_->chosen();
}

}  // namespace keyline::cli
