// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/options.h"

#include "cli/machine.h"
#include "engine/frames.h"

#include <charconv>
#include <cmath>
#include <cstdlib>
#include <fmt/format.h>

namespace keyline::cli {

namespace {

constexpr int kMostThreads = 1024;
constexpr int kLargestTile = 1 << 20;

// May be given any number of times, with one value each.
void add_repeatable(CLI::App& command, const std::string& name, std::vector<std::string>& values,
                    const std::string& value_name, const std::string& help) {
    command.add_option(name, values, help)
        ->type_name(value_name)
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->allow_extra_args(false);
}

// Reads options one by one; a fault is told with the option as its place, and the next one is read.
class OptionReader {
public:
    explicit OptionReader(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

    template <class Read>
    void read(const std::string& name, const std::string& text, Read&& take) {
        if (text.empty()) return;
        try {
            take(text);
        } catch (const Failure& f) {
            Error e = f.error();
            e.place = {name + " " + text, 0, 0};
            diagnostics_.error(std::move(e));
        }
    }

    std::vector<OptionValue> assignments(const std::string& name, const std::vector<std::string>& texts,
                                         const char* form) {
        std::vector<OptionValue> out;
        for (const std::string& text : texts) {
            const std::string option = name + " " + text;
            const auto equals = text.find('=');
            if (equals == std::string::npos || equals == 0)
                diagnostics_.error(
                    {ErrorKind::kGraph, {option, 0, 0}, {}, fmt::format("it must be {}", form), {}});
            else
                out.push_back({text.substr(0, equals), text.substr(equals + 1), option});
        }
        return out;
    }

private:
    Diagnostics& diagnostics_;
};

LoadOptions read_load_options(const GraphArguments& a, OptionReader& reader) {
    LoadOptions out;
    out.set = reader.assignments("--set", a.set, "NODE.NAME=VALUE");
    out.var = reader.assignments("--var", a.var, "NAME=VALUE");
    out.outputs = reader.assignments("--output", a.output, "NODE=FILE or NODE:NAME=FILE");
    out.output_type = "write";
    out.only = a.only;
    out.root = a.root;
    return out;
}

RenderOptions read_render_options(const GraphArguments& a, OptionReader& reader) {
    RenderOptions out;
    out.threads = available_cores();
    out.memory = available_memory() / 2;
    out.ocio = a.ocio;
    reader.read("--frames", a.frames, [&](const std::string& s) { out.frames = parse_frames(s); });
    reader.read("--threads", a.threads,
                [&](const std::string& s) { out.threads = parse_count(s, 1, kMostThreads); });
    reader.read("--tile", a.tile, [&](const std::string& s) { out.tile = parse_count(s, 1, kLargestTile); });
    reader.read("--memory", a.memory, [&](const std::string& s) { out.memory = parse_size(s); });
    return out;
}

}  // namespace

CLI::Option* add_value_option(CLI::App& command, const std::string& name, std::string& value,
                              const std::string& value_name, const std::string& help) {
    return command.add_option(name, value, help)->type_name(value_name);
}

void add_graph_options(CLI::App& command, GraphArguments& a) {
    command.add_option("GRAPH", a.graph, "The graph file")->required()->type_name("");
    add_value_option(command, "--frames", a.frames, "SPEC",
                     "Frames: A, A-B, A-BxS, joined by commas; --frames=-5-5 where A is negative");
    add_repeatable(command, "--set", a.set, "NODE.NAME=VALUE",
                   "Set a parameter or an input; VALUE is JSON where it is JSON, else a string");
    add_repeatable(command, "--var", a.var, "NAME=VALUE", "Set a variable of the graph");
    add_repeatable(command, "--only", a.only, "NODE", "Run just this write");
    add_repeatable(command, "--output", a.output, "NODE[:NAME]=FILE",
                   "Write that node's result instead of the graph's writes");
    add_value_option(command, "--ocio", a.ocio, "FILE",
                     "The OpenColorIO config; else the graph's, else $OCIO, else the built-in one");
    add_value_option(command, "--root", a.root, "DIR",
                     "The folder that relative paths are relative to, instead of the graph's");
}

void add_machine_options(CLI::App& command, GraphArguments& a) {
    add_value_option(command, "--threads", a.threads, "N", "Worker threads; all cores when absent");
    add_value_option(command, "--tile", a.tile, "N", "Tile size in pixels; the planner's choice when absent");
    add_value_option(
        command, "--memory", a.memory, "SIZE",
        "The most memory of the whole process, as 512M or 4G; half of the machine's when absent");
}

int frame_to_check(const LoadedGraph& loaded) {
    if (!loaded.options.frames.empty()) return loaded.options.frames.front();
    return loaded.graph->first_frame_on_disk().value_or(1);
}

LoadedGraph load_graph(const GraphArguments& arguments, Diagnostics& diagnostics) {
    OptionReader reader(diagnostics);
    LoadedGraph out;
    out.options = read_render_options(arguments, reader);
    out.graph = Graph::load_what_is_sound(arguments.graph, read_load_options(arguments, reader), diagnostics);
    const char* config = std::getenv("OCIO");
    if (out.graph && out.options.ocio.empty() && out.graph->ocio().empty() && config && *config)
        out.options.ocio = config;
    if (diagnostics.ok()) return out;
    if (out.graph) check_what_is_sound(*out.graph, frame_to_check(out), out.options, diagnostics);
    out.graph.reset();
    return out;
}

std::size_t parse_size(const std::string& text) {
    constexpr std::string_view kUnits = "KMGT";
    double number = 0;
    const char* end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data(), end, number, std::chars_format::fixed);
    const auto unit = rest == end ? 0 : kUnits.find(static_cast<char>(std::toupper(*rest))) + 1;
    const bool has_unit = rest != end && unit > 0 && unit <= kUnits.size();
    if (error != std::errc{} || rest + (has_unit ? 1 : 0) != end)
        fail(ErrorKind::kGraph, "it must be a number of bytes, or one with K, M, G or T, as 512M or 4G");
    const double bytes = std::ldexp(number, 10 * static_cast<int>(unit));
    if (!(bytes >= 1 && bytes < std::ldexp(1.0, 62)))
        fail(ErrorKind::kGraph, "it must be from 1 byte to 4194303T");
    return static_cast<std::size_t>(bytes);
}

int parse_count(const std::string& text, int least, int most) {
    int number = 0;
    const char* end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data(), end, number);
    if (error != std::errc{} || rest != end || number < least || number > most)
        fail(ErrorKind::kGraph, fmt::format("it must be a whole number from {} to {}", least, most));
    return number;
}

}  // namespace keyline::cli
