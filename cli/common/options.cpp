// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/common/options.h"

#include "cli/common/frames.h"
#include "engine/graph/read_text.h"
#include "engine/params/frames.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <fmt/format.h>

namespace keyline::cli {

namespace {

constexpr int kMostThreads = 1024;
constexpr int kLargestTile = 1 << 20;

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

PathMap read_path_map(const std::string& file, Diagnostics& diagnostics) {
    try {
        return PathMap::parse(read_text(file, "the path map"), file);
    } catch (const Failure& f) {
        Error e = f.error();
        if (e.place.file.empty()) e.place = {"--path-map " + file, 0, 0};
        diagnostics.error(std::move(e));
        return {};
    }
}

LoadOptions read_load_options(const GraphArguments& a, OptionReader& reader, Diagnostics& diagnostics) {
    LoadOptions out;
    out.set = reader.assignments("--set", a.set, "NODE.NAME=VALUE");
    out.var = reader.assignments("--var", a.var, "NAME=VALUE");
    out.vars = a.vars;
    out.outputs = reader.assignments("--output", a.output, "NODE=FILE or NODE:NAME=FILE");
    out.output_type = "write";
    out.only = a.only;
    out.added = a.added;
    out.root = a.root;
    if (!a.path_map.empty()) out.path_map = read_path_map(a.path_map, diagnostics);
    return out;
}

void read_frames(const GraphArguments& a, const std::string& option, LoadedGraph& loaded) {
    if (option == kAllFrames) return;  // the graph has to be loaded first
    if (option == "-" && a.graph == "-")
        fail(ErrorKind::kGraph, "the graph comes by standard input too", "give one of them as a file");
    const std::string text = frames_text(option);
    loaded.no_frames = text.empty();
    if (!loaded.no_frames) loaded.options.frames = parse_frames(text);
}

void read_all_frames(const GraphArguments& a, LoadedGraph& loaded, Diagnostics& diagnostics) {
    if (a.frames != kAllFrames || !loaded.graph) return;
    loaded.options.frames = loaded.graph->frames_on_disk();
    if (!loaded.options.frames.empty()) return;
    diagnostics.error({ErrorKind::kGraph,
                       {"--frames all", 0, 0},
                       {},
                       "no frame of what the graph reads was found on disk",
                       "say which frames, as in --frames 1-24"});
}

void read_render_options(const GraphArguments& a, OptionReader& reader, LoadedGraph& loaded) {
    RenderOptions& out = loaded.options;
    loaded.threads = usable_threads();
    loaded.memory = usable_memory();
    reader.read("--threads", a.threads, [&](const std::string& s) {
        loaded.threads = {static_cast<std::size_t>(parse_count(s, 1, kMostThreads)), "--threads"};
    });
    reader.read("--memory", a.memory, [&](const std::string& s) {
        loaded.memory = {parse_size(s), "--memory"};
        out.memory_place = {"--memory " + s, 0, 0};
    });
    out.threads = static_cast<int>(std::min<std::size_t>(loaded.threads.amount, kMostThreads));
    out.memory = loaded.memory.amount;
    out.memory_by = loaded.memory.by;
    out.ocio = a.ocio;
    reader.read("--frames", a.frames, [&](const std::string& s) { read_frames(a, s, loaded); });
    reader.read("--tile", a.tile, [&](const std::string& s) { out.tile = parse_count(s, 1, kLargestTile); });
}

}  // namespace

void add_graph_options(const Command& command, GraphArguments& a) {
    command.argument("GRAPH", a.graph, "The graph file; - for standard input");
    add_graph_value_options(command, a);
}

void add_graph_value_options(const Command& command, GraphArguments& a) {
    command.option(
        "--frames", a.frames, "SPEC",
        "Frames: A, A-B, A-BxS or A-B:S, joined by commas (--frames=-5-5 where A is negative); all "
        "that are on disk: all; a list in a file: @FILE, by standard input: -");
    command.option("--set", a.set, "NODE.NAME=VALUE",
                   "Set a parameter or an input; VALUE is JSON where it is JSON, else a string");
    command.option("--var", a.var, "NAME=VALUE", "Set a variable of the graph");
    command.option("--vars", a.vars, "FILE", "Take variables from a JSON file, over the graph's own");
    command.option("--only", a.only, "NODE", "Run just this write");
    command.option("--output", a.output, "NODE[:NAME]=FILE",
                   "Write that node's result instead of the graph's writes");
    command.option("--ocio", a.ocio, "FILE",
                   "The OpenColorIO config; else the graph's, else $OCIO, else the built-in one");
    command.option(
        "--path-map", a.path_map, "FILE",
        "Where folders of other machines lie on this one: path mapping rules of Open Job Description");
    command.option("--root", a.root, "DIR",
                   "The folder that relative paths are relative to, instead of the graph's");
}

void add_machine_options(const Command& command, GraphArguments& a) {
    command.option("--threads", a.threads, "N",
                   "Worker threads; all cores that the task may use when absent");
    command.option("--tile", a.tile, "N", "Tile size in pixels; the planner's choice when absent");
    command.option(
        "--memory", a.memory, "SIZE",
        "The most memory of the whole process, as 512M or 4G; when absent half of the machine's, or most of "
        "what a render farm allots to the task");
}

std::string shell_word(const std::string& text) {
    constexpr std::string_view kPlain =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-+=./:,@%";
    if (!text.empty() && text.find_first_not_of(kPlain) == std::string::npos) return text;
    std::string out = "'";
    for (const char c : text) out += c == '\'' ? "'\\''" : std::string(1, c);
    return out + "'";
}

std::string options_text(const GraphArguments& a) {
    std::string out = shell_word(a.graph);
    const auto add = [&](const char* name, const std::string& value) {
        if (!value.empty()) out += fmt::format(" {} {}", name, shell_word(value));
    };
    for (const std::string& s : a.set) add("--set", s);
    for (const std::string& s : a.vars) add("--vars", s);
    for (const std::string& s : a.var) add("--var", s);
    add("--ocio", a.ocio);
    add("--root", a.root);
    add("--path-map", a.path_map);
    return out;
}

std::string command_of(const GraphArguments& a) { return "keyline render " + options_text(a); }

static int frame_to_check(const LoadedGraph& loaded) {
    if (!loaded.options.frames.empty()) return loaded.options.frames.front();
    return loaded.graph->first_frame().value_or(1);
}

LoadedGraph load_graph(const GraphArguments& arguments, Diagnostics& diagnostics) {
    OptionReader reader(diagnostics);
    LoadedGraph out;
    read_render_options(arguments, reader, out);
    out.options.session = std::make_shared<Session>();
    out.options.command = command_of(arguments);
    LoadOptions load = read_load_options(arguments, reader, diagnostics);
    if (!out.options.frames.empty()) load.frame = out.options.frames.front();
    out.options.ocio = load.path_map.map(out.options.ocio.string());
    out.graph = Graph::load_what_is_sound(arguments.graph, load, diagnostics);
    read_all_frames(arguments, out, diagnostics);
    const char* config = std::getenv("OCIO");
    if (out.graph && out.options.ocio.empty() && out.graph->ocio().empty() && config && *config)
        out.options.ocio = config;
    if (diagnostics.ok()) return out;
    if (out.graph) check_what_is_sound(*out.graph, frame_to_check(out), out.options, diagnostics);
    out.graph.reset();
    return out;
}

std::unique_ptr<const Graph> load_quietly(const GraphArguments& arguments) {
    Diagnostics unheard;
    OptionReader reader(unheard);
    return Graph::load_what_is_sound(arguments.graph, read_load_options(arguments, reader, unheard), unheard);
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

std::chrono::milliseconds parse_duration(const std::string& text) {
    constexpr std::string_view kUnits = "smh";
    constexpr std::array<double, 3> kSeconds{1, 60, 3600};
    constexpr double kWeek = 7 * 24 * 3600;
    double number = 0;
    const char* end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data(), end, number, std::chars_format::fixed);
    const std::size_t unit = rest == end ? 0 : kUnits.find(*rest);
    if (error != std::errc{} || unit == std::string_view::npos || rest + (rest == end ? 0 : 1) != end)
        fail(ErrorKind::kGraph, "it must be a time, as 90s, 10m or 2h; seconds without a unit");
    const double seconds = number * kSeconds.at(unit);
    if (!(seconds >= 0.001 && seconds <= kWeek)) fail(ErrorKind::kGraph, "it must be from 1 ms to a week");
    return std::chrono::milliseconds(static_cast<int64_t>(1000 * seconds));
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
