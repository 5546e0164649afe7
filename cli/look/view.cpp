// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/common/report.h"
#include "cli/common/temporary_folder.h"
#include "cli/look/commands.h"
#include "cli/look/pictures.h"
#include "cli/look/terminal_picture.h"
#include "engine/look/linear_picture.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <fstream>
#include <iterator>
#include <memory>
#include <unistd.h>

namespace keyline::cli {

namespace {

struct ViewArguments {
    GraphArguments graph;
    std::vector<std::string> nodes;
    std::string file, channel, range, as, compare, pixels;
};

constexpr int kMostMagnified = 256;  // pixels across

double number_of(const std::string& text) {
    double out = 0;
    const char* end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data(), end, out);
    if (error != std::errc{} || rest != end || !std::isfinite(out))
        fail(ErrorKind::kGraph, "it must be auto, or A,B");
    return out;
}

std::optional<std::array<double, 2>> read_range(const std::string& text) {
    if (text.empty() || text == "auto") return std::nullopt;
    try {
        const std::size_t comma = std::min(text.find(','), text.size());
        const std::array range{number_of(text.substr(0, comma)),
                               number_of(text.substr(std::min(comma + 1, text.size())))};
        if (range[0] >= range[1]) fail(ErrorKind::kGraph, "the smaller number comes first");
        return range;
    } catch (const Failure& f) {
        rethrow_with(f, [&](Error& e) { e.place = {"--range " + text, 0, 0}; });
    }
}

std::unique_ptr<const Graph> graph_of(const GraphArguments& arguments) {
    if (arguments.graph == "-")
        fail(ErrorKind::kGraph, "the graph is read twice, which standard input can't be",
             "give it as a file");
    refuse_outputs(arguments);
    return load_quietly(arguments);
}

// Where no node of the graph can be shown, its own faults say why.
int tell_what_is_wrong(const ViewArguments& arguments) {
    Diagnostics diagnostics;
    load_graph(arguments.graph, diagnostics);
    if (diagnostics.ok()) fail(ErrorKind::kGraph, "the graph has no node that gives pixels or strokes");
    report(diagnostics);
    return exit_status(diagnostics);
}

// Of --pixel-grid.
std::array<int, 4> read_region(const std::string& text) {
    std::array<int, 4> out{};
    try {
        std::size_t begin = 0;
        for (std::size_t i = 0; i < out.size(); ++i) {
            const std::size_t end = std::min(text.find(',', begin), text.size());
            if (begin > text.size() || (end == text.size()) != (i + 1 == out.size()))
                fail(ErrorKind::kGraph, "it must be X,Y,WIDTH,HEIGHT");
            out[i] = parse_count(text.substr(begin, end - begin), i < 2 ? -kMaxCoordinate : 1,
                                 i < 2 ? kMaxCoordinate : kMostMagnified);
            begin = end + 1;
        }
    } catch (const Failure& f) {
        rethrow_with(f, [&](Error& e) { e.place = {"--pixel-grid " + text, 0, 0}; });
    }
    return out;
}

std::string picture_of(PictureNodes& added, const ViewArguments& arguments,
                       const std::vector<std::string>& nodes, const TemporaryFolder& folder) {
    if (arguments.compare.empty())
        return nodes.size() == 1 ? added.show(nodes[0]) : added.sheet(nodes, folder / "names.json");
    if (arguments.nodes.size() != 2)
        throw Failure(
            {ErrorKind::kGraph, {"--compare " + arguments.compare, 0, 0}, {}, "it takes two nodes", {}});
    if (arguments.compare == "wipe") return added.wiped(nodes[0], nodes[1]);
    if (arguments.compare == "difference") return added.difference(nodes[0], nodes[1]);
    throw Failure({ErrorKind::kGraph,
                   {"--compare " + arguments.compare, 0, 0},
                   {},
                   "it must be wipe or difference",
                   {}});
}

// One node's picture, or a sheet of several; `size` is what it has to fit into, where that is bounded.
int make(const ViewArguments& arguments, const std::string& file,
         const std::optional<std::array<int, 2>>& size) {
    const std::unique_ptr<const Graph> graph = graph_of(arguments.graph);
    if (!graph) return tell_what_is_wrong(arguments);
    std::vector<std::string> nodes = arguments.nodes;
    if (nodes.empty()) nodes = nodes_to_show(*graph);
    if (nodes.empty()) return tell_what_is_wrong(arguments);
    const TemporaryFolder folder;
    PictureNodes added(*graph, {arguments.channel, read_range(arguments.range)});
    std::string picture = picture_of(added, arguments, nodes, folder);
    if (!arguments.pixels.empty())
        picture = added.magnified(picture, read_region(arguments.pixels), folder / "grid.json");
    if (size) picture = added.fitted(picture, *size);
    GraphArguments all = arguments.graph;
    all.only = {added.write(picture, file)};
    all.added = added.text();
    return render_pictures(all);
}

std::string contents(const std::string& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

// Of a picture as a display takes it, cut to what was filled.
Bitmap bitmap_of(const std::string& file) {
    const auto source = open_image(file);
    const LinearPicture picture =
        linear_picture(*source, "", source->header().data_window, Encoding::kLinear);
    Bitmap out{picture.width, picture.height, {}};
    for (std::size_t i = 0; i < picture.rgb[0].size(); ++i)
        for (const std::vector<float>& channel : picture.rgb)
            out.rgb.push_back(static_cast<uint8_t>(std::lround(channel[i] * 255)));
    return out;
}

std::string terminal_text(TerminalKind kind, const std::string& file) {
    switch (kind) {
        case TerminalKind::kKitty: return kitty_text(contents(file));
        case TerminalKind::kIterm: return iterm_text(contents(file));
        case TerminalKind::kSixel: return sixel_text(bitmap_of(file));
        case TerminalKind::kBlocks: break;
    }
    return blocks_text(bitmap_of(file));
}

int show_in_terminal(const ViewArguments& arguments) {
    if (arguments.as.empty() && isatty(STDOUT_FILENO) == 0)
        fail(ErrorKind::kGraph, "standard output is no terminal",
             "give a file with -o, or --as kitty, iterm, sixel or blocks");
    const TerminalKind kind = terminal_kind(arguments.as);
    const TerminalSize size = terminal_size();
    const bool as_file = kind == TerminalKind::kKitty || kind == TerminalKind::kIterm;
    const std::array most = kind == TerminalKind::kBlocks
                                ? std::array{size.columns, 2 * (size.rows - 1)}
                                : std::array{8 * size.columns, 16 * (size.rows - 1)};
    const TemporaryFolder folder;
    const std::string file = folder / (as_file ? "picture.png" : "picture.exr");
    const int status = make(arguments, file, most);
    if (status == 0) print_result(terminal_text(kind, file));
    return status;
}

int run(const ViewArguments& arguments) {
    return arguments.file.empty() ? show_in_terminal(arguments)
                                  : make(arguments, std::filesystem::absolute(arguments.file).string(), {});
}

}  // namespace

void add_view(const Command& program) {
    const Command command =
        program.add("view", "Show what nodes make, whatever it is: a picture, or a sheet of several nodes");
    const auto arguments = std::make_shared<ViewArguments>();
    command.argument("GRAPH", arguments->graph.graph, "The graph file");
    command.argument("NODE", arguments->nodes, "Nodes, or NODE:LAYER; all of them when absent").optional();
    command.option("-o,--picture", arguments->file, "FILE",
                   "Write the picture; it is shown in the terminal when absent");
    command.option("--channel", arguments->channel, "NAME",
                   "Show this layer or channel of each node, not its colour");
    command.option(
        "--range", arguments->range, "A,B",
        "What numbers are shown black and white; auto, each frame's least and largest, when absent");
    command.option("--compare", arguments->compare, "wipe|difference",
                   "Two nodes in one picture: half of each, or how far apart they look");
    command.option("--pixel-grid", arguments->pixels, "X,Y,WIDTH,HEIGHT",
                   "Show this region alone, each pixel large, with lines between them");
    command.option("--as", arguments->as, "kitty|iterm|sixel|blocks",
                   "How the terminal shows pictures; found out when absent");
    add_graph_value_options(command, arguments->graph);
    add_machine_options(command, arguments->graph);
    command.runs([arguments] { return run(*arguments); });
}

}  // namespace keyline::cli
