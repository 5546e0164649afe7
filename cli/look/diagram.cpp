// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/look/diagram.h"

#include "cli/common/base64.h"
#include "cli/common/run_program.h"
#include "engine/base/error.h"
#include "engine/base/index.h"
#include "engine/base/text.h"

#include <algorithm>
#include <fmt/format.h>
#include <fstream>
#include <iterator>
#include <set>

namespace keyline::cli {

namespace {

constexpr std::size_t kMostText = 34;  // of a parameter's value, in characters

std::string cut(const std::string& text, std::size_t most) {
    if (text.size() <= most) return text;
    std::size_t end = most;  // not inside of a character
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80) --end;
    return text.substr(0, end) + "…";
}

bool is_input(const NodeType& type, const std::string& name) {
    const auto field =
        std::ranges::find(type.fields, name, [](const FieldInfo& f) { return std::string(f.name); });
    return field != type.fields.end() && field->type.kind == TypeInfo::Kind::kInput;
}

std::string line(const std::string& text, const char* color) {
    return fmt::format(R"(<TR><TD ALIGN="LEFT"><FONT POINT-SIZE="9" COLOR="{}">{}</FONT></TD></TR>)", color,
                       for_xml(text));
}

std::string label_of(const GraphNode& node, const Diagram& diagram) {
    std::string out;
    if (const auto it = diagram.thumbnails.find(node.id); it != diagram.thumbnails.end())
        out += fmt::format(R"(<TR><TD><IMG SRC="{}"/></TD></TR>)", for_xml(it->second));
    const std::string name = node.id.substr(node.id.rfind('/') + 1);
    out += fmt::format(R"(<TR><TD ALIGN="LEFT"><B>{}</B>  <FONT COLOR="#667788">{}</FONT></TD></TR>)",
                       for_xml(name), for_xml(node.type->name));
    for (const Member& m : node.object.members)
        if (!is_input(*node.type, m.key))
            out += line(m.key + "  " + cut(m.value.shown(), kMostText), "#333333");
    const auto faults = diagram.faults.find(node.id);
    if (faults != diagram.faults.end())
        for (const std::string& fault : faults->second) out += line(cut(fault, 2 * kMostText), "#b00020");
    const bool is_faulty = faults != diagram.faults.end();
    return fmt::format(
        R"(<TABLE BORDER="{}" CELLBORDER="0" CELLSPACING="0" CELLPADDING="3" STYLE="ROUNDED" COLOR="{}" BGCOLOR="{}">{}</TABLE>)",
        is_faulty ? 2 : 1, is_faulty ? "#d00020" : "#8899aa", is_faulty ? "#fff0f0" : "#ffffff", out);
}

std::string node_text(const Graph& graph, int i, const Diagram& diagram) {
    const GraphNode& node = graph.nodes()[index(i)];
    return fmt::format("  n{} [id=\"node{}\" label=<{}>];\n", i, i, label_of(node, diagram));
}

// What a node reads and by which selection; without its parameters, where these are wrong, only which nodes.
std::vector<std::pair<int, std::string>> reads(const Graph& graph, int node, int frame) {
    Diagnostics unheard;
    std::vector<std::pair<int, std::string>> out;
    if (const auto parsed = graph.at(node, frame, unheard))
        for (const Input& in : parsed->inputs())
            if (const int from = graph.index_of(in.node); from >= 0) out.emplace_back(from, in.selector);
    if (out.empty())
        for (const int from : graph.links(node)) out.emplace_back(from, "");
    return out;
}

// "outer" of "outer/inner"; empty for a node of the graph's own.
std::string group_of(const std::string& id) {
    return id.substr(0, id.find('/') == std::string::npos ? 0 : id.find('/'));
}

std::string contents(const std::string& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

std::string data_address(const std::string& png) { return "data:image/png;base64," + base64(contents(png)); }

}  // namespace

std::string dot_text(const Graph& graph, const Diagram& diagram) {
    std::string out =
        "digraph {\n  rankdir=LR; bgcolor=\"#f4f5f7\"; nodesep=0.25; ranksep=0.6;\n"
        "  node [shape=plain fontname=\"Helvetica\" fontsize=11];\n"
        "  edge [color=\"#667788\" fontname=\"Helvetica\" fontsize=8 fontcolor=\"#556677\" arrowsize=0.6];\n";
    std::map<std::string, std::string> groups;
    for (const int i : graph.order()) {
        const std::string group = group_of(graph.nodes()[index(i)].id);
        (group.empty() ? out : groups[group]) += node_text(graph, i, diagram);
    }
    int count = 0;
    for (const auto& [name, nodes] : groups)
        out += fmt::format(
            "  subgraph cluster{} {{ label=<<B>{}</B>>; fontname=\"Helvetica\"; fontsize=11; style=rounded; "
            "color=\"#99aabb\"; bgcolor=\"#e8ecf1\";\n{}  }}\n",
            count++, for_xml(name), nodes);
    for (const int i : graph.order())
        for (const auto& [from, selector] : reads(graph, i, diagram.frame))
            out += fmt::format("  n{} -> n{} [label=\"{}\"];\n", from, i, for_xml(cut(selector, kMostText)));
    return out + "}\n";
}

std::string svg_of(const std::string& dot, const Diagram& diagram) {
    ProgramResult result;
    try {
        result = run_program({"dot", "-Tsvg"}, dot);
    } catch (const Failure& f) {
        rethrow_with(f, [](Error& e) {
            e.what = "the graph is laid out by Graphviz: " + e.what;
            e.hint = "install it, on Debian as graphviz";
        });
    }
    if (result.status != 0)
        fail(ErrorKind::kFailed,
             fmt::format("dot, which lays the graph out, ended with status {}", result.status));
    for (const auto& [node, file] : diagram.thumbnails) {
        const std::size_t at = result.out.find('"' + for_xml(file) + '"');
        if (at != std::string::npos) result.out.replace(at + 1, for_xml(file).size(), data_address(file));
    }
    return result.out;
}

}  // namespace keyline::cli
