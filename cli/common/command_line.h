// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

// The command line, as the commands declare it.  A parsing library stands behind it that no command includes:
// it takes the compiler longer than all that a command says.

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace keyline::cli {

struct NumberRange {
    double least, most;
};

// One option or argument; copies are the same one.
class Option {
public:
    explicit Option(CLI::Option& option) : option_(&option) {}

    const Option& required() const;
    const Option& optional() const;
    const Option& hidden() const;  // known, and not listed by --help
    const Option& excludes(const Option& other) const;
    const Option& of_words(const std::string& words) const;  // "bash|zsh|fish", which is what --help says

private:
    CLI::Option* option_;
};

// What a command does, once the line is read: returns the exit status, throws Failure.
using Action = std::function<int()>;

// One command; copies are the same one.  What is declared is written into variables that must live until the
// command has been done: a command keeps them with its action.
class Command {
public:
    Command(CLI::App& app, Action& chosen) : app_(&app), chosen_(&chosen) {}

    // A command below this one.
    Command add(const std::string& name, const std::string& help) const;
    void needs_one_below() const;

    // By its place, and required; of a list, one or more.
    Option argument(const std::string& name, std::string& value, const std::string& help) const;
    Option argument(const std::string& name, std::vector<std::string>& values, const std::string& help) const;

    // By its name, "--frames" or "-o,--picture", and optional; VALUE_NAME is what --help calls the value,
    // and how shells know what to offer: "FILE", "NODE", "one|of|these".
    Option option(const std::string& name, std::string& value, const std::string& value_name,
                  const std::string& help) const;
    Option option(const std::string& name, double& value, NumberRange range, const std::string& value_name,
                  const std::string& help) const;
    // Given any number of times, with one value each.
    Option option(const std::string& name, std::vector<std::string>& values, const std::string& value_name,
                  const std::string& help) const;
    Option flag(const std::string& name, bool& value, const std::string& help) const;
    Option flag(const std::string& name, const std::string& help) const;  // taken, and without effect

    // Done where the user names this command.
    void runs(Action action) const;

private:
    CLI::App* app_;
    Action* chosen_;
};

struct About {
    std::string name, purpose, footer;
    std::function<std::string()> versions;  // for --version
};

// The whole line.
class CommandLine {
public:
    explicit CommandLine(const About& about);
    ~CommandLine();
    CommandLine(const CommandLine&) = delete;
    CommandLine& operator=(const CommandLine&) = delete;

    Command program();

    // All commands with their options, as Markdown.
    std::string pages() const;

    // What `keyline help TOPIC` prints, for a topic that is no command.
    void add_topic(const std::string& topic, const Action& print);

    // Reads the line and does what it says; one that begins with "complete" is a shell that asks what may
    // come next (completion.h).  Throws Failure where it can't be read: with the nearest word for what
    // nothing knows.
    int run(int argc, char** argv);

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace keyline::cli
