// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/common/completion.h"

#include "cli/common/explanations.h"
#include "cli/common/frames.h"
#include "cli/common/options.h"
#include "engine/base/channels.h"
#include "engine/base/index.h"
#include "engine/base/text.h"
#include "engine/node/registry.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fmt/format.h>
#include <memory>
#include <set>
#include <utility>

namespace keyline::cli {

namespace {

struct Candidate {
    std::string word, about;
};
using Candidates = std::vector<Candidate>;

constexpr const char* kFiles = ":files";

// What was typed, as far as the command line knows it.
struct Typed {
    const CLI::App* command = nullptr;
    std::vector<std::string> arguments;  // without options and their values
    const CLI::Option* open = nullptr;   // the option whose value is being typed
    std::string value;                   // of which this is there
    std::string before;                  // what of the same word stands before the value: "--only="
};

const CLI::Option* option_called(const CLI::App& command, const std::string& name) {
    for (const CLI::Option* o : command.get_options())
        if (!o->get_positional() && o->check_name(name)) return o;
    return nullptr;
}

bool takes_value(const CLI::Option* option) { return option && option->get_type_size() != 0; }

const CLI::App* subcommand_called(const CLI::App& command, const std::string& name) {
    for (const CLI::App* below : command.get_subcommands([](const CLI::App*) { return true; }))
        if (below->check_name(name)) return below;
    return nullptr;
}

Typed understand(const CLI::App& program, const std::vector<std::string>& words) {
    Typed out;
    out.command = &program;
    for (std::size_t i = 0; i + 1 < words.size(); ++i) {
        const std::string& word = words[i];
        if (out.open) {
            out.open = nullptr;
        } else if (word.starts_with('-') && word.find('=') == std::string::npos) {
            const CLI::Option* option = option_called(*out.command, word);
            if (takes_value(option)) out.open = option;
        } else if (const CLI::App* below =
                       out.arguments.empty() ? subcommand_called(*out.command, word) : nullptr) {
            out.command = below;
        } else if (!word.starts_with('-')) {
            out.arguments.push_back(word);
        }
    }
    out.value = words.empty() ? "" : words.back();
    const std::size_t equals = out.value.find('=');
    if (!out.open && out.value.starts_with("--") && equals != std::string::npos) {
        const CLI::Option* option = option_called(*out.command, out.value.substr(0, equals));
        if (takes_value(option)) out.open = option;
        out.before = out.value.substr(0, equals + 1);
        out.value.erase(0, equals + 1);
    }
    return out;
}

// The first sentence; a list of candidates has room for no more.
std::string first_clause(const std::string& text) { return text.substr(0, text.find_first_of(";:(")); }

Candidates commands_of(const CLI::App& command) {
    Candidates out;
    for (const CLI::App* below : command.get_subcommands([](const CLI::App*) { return true; }))
        if (!below->get_group().empty())
            out.push_back({below->get_name(), first_clause(below->get_description())});
    return out;
}

Candidates options_of(const CLI::App& command) {
    Candidates out;
    for (const CLI::Option* o : command.get_options())
        if (!o->get_positional() && !o->get_group().empty())
            for (const std::string& name : o->get_lnames())
                out.push_back({"--" + name, first_clause(o->get_description())});
    return out;
}

// The argument that comes next; the last may be given again and again.
const CLI::Option* next_argument(const Typed& typed) {
    std::vector<const CLI::Option*> all;
    for (const CLI::Option* o : typed.command->get_options())
        if (o->get_positional()) all.push_back(o);
    if (all.empty()) return nullptr;
    const std::size_t at = typed.arguments.size();
    if (at < all.size()) return all[at];
    return all.back()->get_expected_max() > 1 ? all.back() : nullptr;
}

// The graph that the command is about; null where there is none, or nothing of it can be read.
std::unique_ptr<const Graph> graph_of(const Typed& typed) {
    if (typed.arguments.empty() || typed.arguments.front() == "-") return nullptr;
    GraphArguments arguments;
    arguments.graph = typed.arguments.front();
    return load_quietly(arguments);
}

enum class Which { kAll, kWritten, kShown };

Candidates nodes_of(const Graph& graph, const char* end, Which which = Which::kAll) {
    Candidates out;
    for (const GraphNode& node : graph.nodes()) {
        const bool is_sink = node.type->kind == NodeKind::kSink;
        if (which == Which::kAll || is_sink == (which == Which::kWritten))
            out.push_back({node.id + end, node.type->name});
    }
    return out;
}

// "edges:" and each layer and channel of what the node makes.
Candidates layers_of_node(const Graph& graph, const std::string& id) {
    std::string unheard_note;
    Diagnostics unheard;
    const std::vector<int> frames = frames_to_check(graph, {}, unheard_note);
    Candidates out;
    check_frames(graph, {frames.front()}, {}, unheard, [&](const ResolvedFrame& frame) {
        for (const NodeStream& s : frame.streams) {
            if (graph.nodes()[index(s.node)].id != id) continue;
            const std::vector<std::string> names = s.stream.names();
            for (const std::string& layer : layers_of(names)) out.push_back({id + ":" + layer, "layer"});
            for (const std::string& name : names) out.push_back({id + ":" + name, "channel"});
        }
    });
    return out;
}

Candidates nodes_and_layers(const Graph& graph, const std::string& typed) {
    const std::size_t colon = typed.find(':');
    return colon == std::string::npos ? nodes_of(graph, "", Which::kShown)
                                      : layers_of_node(graph, typed.substr(0, colon));
}

// "blur." and then "blur.sigma="
Candidates parameters(const Graph& graph, const std::string& typed) {
    const std::size_t dot = typed.find('.');
    if (dot == std::string::npos) return nodes_of(graph, ".");
    const int node = graph.index_of(typed.substr(0, dot));
    Candidates out;
    if (node >= 0)
        for (const FieldInfo& f : graph.nodes()[index(node)].type->fields)
            out.push_back({typed.substr(0, dot + 1) + f.name + "=", f.help});
    return out;
}

std::vector<std::string> parted(const std::string& text, char by) {
    std::vector<std::string> out;
    std::size_t begin = 0;
    for (std::size_t end = 0; end != std::string::npos; begin = end + 1) {
        end = text.find(by, begin);
        out.push_back(text.substr(begin, end - begin));
    }
    return out;
}

Candidates variables(const Graph& graph) {
    Candidates out;
    for (const auto& [name, value] : graph.variables().given()) out.push_back({name + "=", value.shown()});
    return out;
}

Candidates node_types() {
    Candidates out;
    for (const auto& [name, type] : registry().types()) out.push_back({name, type.help});
    return out;
}

Candidates codes() {
    Candidates out;
    for (const Explanation& e : explanations()) out.push_back({std::string(e.code), std::string(e.title)});
    return out;
}

Candidates words_of(const std::string& kind) {
    Candidates out;
    for (const std::string& word : parted(kind, '|')) out.push_back({word, ""});
    return out;
}

Candidates values_of_graph(const Graph& graph, const Typed& typed, const std::string& kind) {
    if (kind == "NODE.NAME=VALUE") return parameters(graph, typed.value);
    if (kind == "NODE[:NAME]=FILE") return nodes_of(graph, "=");
    if (kind == "NAME=VALUE") return variables(graph);
    return typed.open ? nodes_of(graph, "", Which::kWritten) : nodes_and_layers(graph, typed.value);
}

// Of an option's value, or an argument, by what the help calls it.
Candidates values(const Typed& typed, const std::string& kind) {
    static const std::set<std::string> kNamesOfFiles{"FILE", "DIR",     "GRAPH",  "IMAGE", "A",
                                                     "B",    "STROKES", "PIXELS", "TRUTH"};
    static const std::set<std::string> kOfGraphs{"NODE", "NODE.NAME=VALUE", "NODE[:NAME]=FILE", "NAME=VALUE"};
    if (kind.find('|') != std::string::npos) return words_of(kind);
    if (kNamesOfFiles.contains(kind)) return {{kFiles, ""}};
    if (kind == "SPEC") return {{"all", "every frame on disk"}};
    if (kind == "TYPE") return node_types();
    if (kind == "CODE") return codes();
    if (!kOfGraphs.contains(kind)) return {};
    const std::unique_ptr<const Graph> graph = graph_of(typed);
    return graph ? values_of_graph(*graph, typed, kind) : Candidates{};
}

Candidates candidates(const Typed& typed) {
    if (typed.open) return values(typed, typed.open->get_type_name());
    if (typed.value.starts_with('-')) return options_of(*typed.command);
    if (const Candidates commands = commands_of(*typed.command); !commands.empty()) return commands;
    const CLI::Option* argument = next_argument(typed);
    if (!argument) return {};
    const std::string kind = argument->get_type_name();
    return values(typed, kind.empty() ? argument->get_name(true) : kind);
}

}  // namespace

std::string completions(const CLI::App& program, const std::vector<std::string>& words) {
    const Typed typed = understand(program, words);
    std::string out;
    std::set<std::string> told;
    for (const Candidate& c : candidates(typed)) {
        if (c.word == kFiles)
            out += std::string(kFiles) + "\n";
        else if (c.word.starts_with(typed.value) && told.insert(c.word).second)
            out += fmt::format("{}{}\t{}\n", typed.before, escaped(c.word), escaped(c.about));
    }
    return out;
}

}  // namespace keyline::cli
