// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/look/pictures.h"

#include "cli/common/frames.h"
#include "cli/common/report.h"
#include "cli/common/signals.h"
#include "cli/look/lettering.h"
#include "engine/io/other_formats.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fstream>
#include <set>

namespace keyline::cli {

namespace {

constexpr const char* kStrokes = "strokes";

bool can_be_shown(const GraphNode& node) {
    return node.type->kind != NodeKind::kSink && (node.type->gives.empty() || node.type->gives == kStrokes);
}

std::vector<std::string> all_ids(const Graph& graph) {
    std::vector<std::string> out;
    for (const GraphNode& n : graph.nodes()) out.push_back(n.id);
    return out;
}

// Colour that has been through a display transform somewhere is not sent through one again.
bool is_for_display(const Graph& graph, int node) {
    static const std::set<std::string> kDisplays{"display", "falsecolor"};
    std::set<int> seen;
    std::vector<int> open{node};
    while (!open.empty()) {
        const int i = open.back();
        open.pop_back();
        if (!seen.insert(i).second) continue;
        if (kDisplays.contains(graph.nodes()[static_cast<std::size_t>(i)].type->name)) return true;
        open.insert(open.end(), graph.links(i).begin(), graph.links(i).end());
    }
    return false;
}

// Users know nothing of nodes that were added for them.
Error without_added(Error e) {
    if (e.place.file == "added nodes") e.place = {}, e.node.clear();
    return e;
}

// How large a magnified region becomes, and a pixel of it.
constexpr int kMagnified = 1024, kLeastCell = 4, kMostCell = 64;

// Lines between the pixels of a magnified region, as strokes.
std::string grid_text(int width, int height, int cell) {
    std::string lines;
    const auto add = [&](int x0, int y0, int x1, int y1) {
        lines += fmt::format("{}{{ \"width\": 1, \"points\": [[{}, {}], [{}, {}]] }}",
                             lines.empty() ? "" : ", ", x0, y0, x1, y1);
    };
    for (int x = 1; x < width; ++x) add(x * cell, 0, x * cell, height * cell);
    for (int y = 1; y < height; ++y) add(0, y * cell, width * cell, y * cell);
    return fmt::format(
        R"({{ "strokes": 1, "display": [0, 0, {0}, {1}], "window": [0, 0, {0}, {1}], "lines": [{2}] }})",
        width * cell, height * cell, lines);
}

// What goes wrong is told as in a render.
class Teller final : public RenderObserver {
public:
    void warning(const Error& e) override { print_message(without_added(e).warning_text()); }
    void error(const Error& e) override { print_message(without_added(e).text()); }
};

// What may have been meant by the name of no node: a group's is none, those inside of it have one.
std::string hint_for(const Graph& graph, const std::string& id) {
    std::vector<std::string> inside;
    for (const GraphNode& n : graph.nodes())
        if (n.id.starts_with(id + "/")) inside.push_back(n.id);
    return inside.empty() ? did_you_mean(id, all_ids(graph)) : "it is a group, of " + listed(inside);
}

}  // namespace

std::vector<std::string> nodes_to_show(const Graph& graph) {
    std::vector<std::string> out;
    for (const int i : graph.order()) {
        const GraphNode& node = graph.nodes()[static_cast<std::size_t>(i)];
        if (can_be_shown(node)) out.push_back(node.id);
    }
    return out;
}

PictureNodes::PictureNodes(const Graph& graph, PictureOptions options)
    : graph_(graph), options_(std::move(options)) {
    json_.begin_object();
}

// No node of a file has a digit there.
std::string PictureNodes::next() { return fmt::format("picture/{}", ++count_); }

JsonWriter& PictureNodes::begin(const std::string& id, const char* type) {
    return json_.key(id).begin_object().field("type", type);
}

std::string PictureNodes::source_of(const std::string& node) {
    const std::string id = node.substr(0, node.find(':'));
    const int index = graph_.index_of(id);
    if (index < 0) fail(ErrorKind::kGraph, "there is no node " + in_quotes(id), hint_for(graph_, id));
    const GraphNode& shown = graph_.nodes()[static_cast<std::size_t>(index)];
    if (!can_be_shown(shown))
        fail(ErrorKind::kGraph, fmt::format("{} gives nothing to be seen", shown.title()),
             "name a node that gives pixels or strokes");
    if (shown.type->gives == kStrokes) {
        std::string drawn = next();
        begin(drawn, "draw").field("in", node).end_object();
        return drawn;
    }
    return options_.channel.empty() ? node : id + ":" + options_.channel;
}

std::string PictureNodes::show(const std::string& node) {
    const std::string source = source_of(node);
    const bool is_shown = is_for_display(graph_, graph_.index_of(node.substr(0, node.find(':'))));
    std::string out = next();
    begin(out, "falsecolor").field("in", source);
    if (options_.range) json_.key("range").list(std::vector(options_.range->begin(), options_.range->end()));
    json_.field("referred", is_shown ? "display" : "scene").end_object();
    return out;
}

std::string PictureNodes::wiped(const std::string& left, const std::string& right) {
    constexpr int kLine = 2;
    const std::string pictures[] = {show(left), show(right)};
    const std::string half = next(), line = next(), thin = next(), both = next();
    std::string out = next();
    begin(half, "crop").field("in", pictures[0]).key("region").begin_array();
    json_.value("= x").value("= y").value("= floor(width / 2)").value("= height").end_array().end_object();
    begin(line, "constant").key("color").list(std::vector{1, 1, 1}).field("like", pictures[1]).end_object();
    begin(thin, "crop").field("in", line).key("region").begin_array();
    json_.value("= x + floor(width / 2) - 1")
        .value("= y")
        .value(kLine)
        .value("= height")
        .end_array()
        .end_object();
    begin(both, "over").field("fg", half).field("bg", pictures[1]).end_object();
    begin(out, "over").field("fg", thin).field("bg", both).end_object();
    return out;
}

std::string PictureNodes::difference(const std::string& a, const std::string& b) {
    const std::string pictures[] = {show(a), show(b)};
    const std::string apart = next();
    std::string out = next();
    begin(apart, "math")
        .field("in", pictures[0])
        .field("op", "subtract")
        .field("b", pictures[1])
        .end_object();
    begin(out, "math").field("in", apart).field("op", "abs").end_object();
    return out;
}

std::string PictureNodes::magnified(const std::string& picture, const std::array<int, 4>& region,
                                    const std::string& grid) {
    const auto& [x, y, width, height] = region;
    const int cell = std::clamp(kMagnified / std::max(width, height), kLeastCell, kMostCell);
    const std::string large = next(), below = next(), framed = next(), read = next(), lines = next();
    std::string out = next();
    begin(large, "transform").field("in", picture).field("scale", cell).field("filter", "nearest");
    json_.key("center").list(std::vector{0, 0}).key("translate").list(std::vector{-x * cell, -y * cell});
    json_.end_object();
    begin(below, "constant").key("size").list(std::vector{width * cell, height * cell}).end_object();
    begin(framed, "over").field("fg", large).field("bg", below).end_object();
    std::ofstream(grid) << grid_text(width, height, cell);
    begin(read, "strokes_read").field("file", grid).end_object();
    begin(lines, "draw").field("in", read).key("color").list(std::vector{0.3, 0.3, 0.3}).end_object();
    begin(out, "over").field("fg", lines).field("bg", framed).end_object();
    return out;
}

std::string PictureNodes::show_small(const std::string& node, int width, int height) {
    const std::string whole = show(node);
    std::string out = next();
    begin(out, "reformat").field("in", whole).key("size").list(std::vector{width, height});
    json_.field("filter", "box").end_object();
    return out;
}

std::string PictureNodes::fitted(const std::string& picture, const std::array<int, 2>& most) {
    std::string out = next();
    begin(out, "reformat").field("in", picture).key("size").list(std::vector(most.begin(), most.end()));
    json_.field("filter", "box").end_object();
    return out;
}

std::string PictureNodes::sheet(const std::vector<std::string>& nodes, const std::string& names) {
    constexpr int kWidth = 320, kHeight = 180, kGap = 12, kLettering = 24;
    const auto count = static_cast<int>(nodes.size());
    const int columns = std::max(1, static_cast<int>(std::ceil(std::sqrt(count))));
    const int rows = (count + columns - 1) / columns;
    const int width = kGap + columns * (kWidth + kGap), height = rows * (kHeight + kLettering + kGap) + kGap;
    std::string below = next();
    begin(below, "constant").key("color").list(std::vector{0.13, 0.13, 0.15});
    json_.key("size").list(std::vector{width, height}).end_object();
    Lettering lettering(width, height);
    for (int i = 0; i < count; ++i) {
        const std::string& node = nodes[static_cast<std::size_t>(i)];
        const int x = kGap + i % columns * (kWidth + kGap);
        const int y = kGap + i / columns * (kHeight + kLettering + kGap);
        const std::string small = show_small(node, kWidth, kHeight), moved = next(), over = next();
        begin(moved, "transform").field("in", small).key("translate").list(std::vector{x, y});
        json_.field("filter", "nearest").end_object();
        begin(over, "over").field("fg", moved).field("bg", below).end_object();
        lettering.add(node, x + 1, y + kHeight + kLettering - 6, kWidth - 2);
        below = over;
    }
    std::ofstream(names) << lettering.text();
    const std::string read = next(), drawn = next(), out = next();
    begin(read, "strokes_read").field("file", names).end_object();
    begin(drawn, "draw").field("in", read).key("color").list(std::vector{0.85, 0.85, 0.82}).end_object();
    begin(out, "over").field("fg", drawn).field("bg", below).end_object();
    return out;
}

std::string PictureNodes::write(const std::string& picture, const std::string& file) {
    std::string out = next();
    begin(out, "write").field("in", picture).field("file", file);
    json_.key("channels").list(std::vector<std::string>{"R", "G", "B"});
    if (is_other_format(file)) json_.field("depth", "uint8");
    json_.end_object();
    return out;
}

std::string PictureNodes::write_samples(const std::string& node, const std::string& file) {
    std::string out = next();
    begin(out, "write").field("in", node).field("file", file).field("depth", "float").end_object();
    return out;
}

void refuse_outputs(const GraphArguments& arguments) {
    if (!arguments.only.empty() || !arguments.output.empty())
        fail(ErrorKind::kGraph,
             "--only and --output choose what a render writes; here no write of the graph runs",
             "leave them out");
}

int render_pictures(const GraphArguments& arguments) {
    Diagnostics diagnostics;
    LoadedGraph loaded = load_graph(arguments, diagnostics);
    std::string note;
    if (loaded.graph)
        loaded.options.frames = {frames_to_check(*loaded.graph, loaded.options.frames, note).front()};
    if (!note.empty()) print_message(note);
    report(diagnostics);
    if (!diagnostics.ok()) return exit_status(diagnostics);
    loaded.options.provenance = false;
    const StopOnSignal stop;
    Teller teller;
    return render(*loaded.graph, loaded.options, teller, stop.requested()).status();
}

}  // namespace keyline::cli
