// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/look/page.h"

#include "cli/common/base64.h"
#include "engine/base/text.h"

#include <fmt/format.h>
#include <fstream>
#include <iterator>

namespace keyline::cli {

namespace {

constexpr const char* kStyle = R"(
body { margin: 0; display: flex; height: 100vh; font: 14px/1.4 system-ui, sans-serif; color: #222; background: #f4f5f7; }
main { flex: 1; overflow: auto; }
main svg { display: block; }
main g.node { cursor: pointer; }
main g.chosen polygon, main g.chosen path { stroke: #0a64c8; stroke-width: 3; }
aside { width: 38%; min-width: 320px; overflow: auto; background: #fff; border-left: 1px solid #c8ccd2; padding: 12px 18px; }
aside section { display: none; }
aside section.shown { display: block; }
h2 { margin: 0; font-size: 18px; } h2 small { color: #678; font-weight: normal; }
img { max-width: 100%; margin: 10px 0; background: repeating-conic-gradient(#ddd 0 25%, #fff 0 50%) 0 0 / 16px 16px; }
table { border-collapse: collapse; margin: 10px 0; width: 100%; }
td, th { text-align: left; padding: 2px 8px 2px 0; vertical-align: top; border-bottom: 1px solid #eee; overflow-wrap: anywhere; }
td:first-child { white-space: nowrap; width: 1%; padding-right: 18px; }
td.number, th.number { text-align: right; font-variant-numeric: tabular-nums; white-space: nowrap; }
)";

constexpr const char* kScript = R"(
const show = (index) => {
  for (const shown of document.querySelectorAll(".shown, .chosen")) shown.classList.remove("shown", "chosen");
  document.getElementById("about" + index)?.classList.add("shown");
  document.getElementById("node" + index)?.classList.add("chosen");
};
for (const node of document.querySelectorAll("main g.node"))
  node.addEventListener("click", () => show(node.id.slice(4)));
show(document.querySelector("aside section").id.slice(5));
)";

std::string contents(const std::string& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

std::string rows_of(const std::vector<std::pair<std::string, std::string>>& pairs) {
    std::string out;
    for (const auto& [name, value] : pairs)
        out += fmt::format("<tr><td>{}</td><td>{}</td></tr>\n", for_xml(name), for_xml(value));
    return out.empty() ? "" : "<table>\n" + out + "</table>\n";
}

std::string statistics_of_node(const std::vector<ChannelStatistics>& all) {
    if (all.empty()) return "";
    std::string out = "<table>\n<tr><th>channel</th>";
    for (const char* name : {"least", "mean", "largest", "NaN", "infinite"})
        out += fmt::format("<th class=\"number\">{}</th>", name);
    out += "</tr>\n";
    for (const ChannelStatistics& s : all)
        out += fmt::format(
            "<tr><td>{}</td><td class=\"number\">{:.5g}</td><td class=\"number\">{:.5g}</td>"
            "<td class=\"number\">{:.5g}</td><td class=\"number\">{}</td><td class=\"number\">{}</td></tr>\n",
            for_xml(s.channel), s.least, s.mean(), s.largest, s.nan, s.infinite);
    return out + "</table>\n";
}

std::string section_of(const PageNode& node) {
    std::string out = fmt::format("<section id=\"about{}\">\n<h2>{} <small>{}</small></h2>\n<p>{}</p>\n",
                                  node.index, for_xml(node.id), for_xml(node.type), for_xml(node.help));
    if (!node.picture.empty())
        out += fmt::format("<img alt=\"{}\" src=\"data:image/jpeg;base64,{}\">\n", for_xml(node.id),
                           base64(contents(node.picture)));
    return out + rows_of(node.parameters) + rows_of(node.facts) + statistics_of_node(node.statistics) +
           "</section>\n";
}

// What stands before the drawing's element is for files of their own.
std::string_view element_of(std::string_view svg) {
    return svg.substr(std::min(svg.find("<svg"), svg.size()));
}

}  // namespace

std::string page_of(const std::string& title, const std::string& svg, const std::vector<PageNode>& nodes) {
    std::string out = fmt::format(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta "
        "charset=\"utf-8\">\n<title>{}</title>\n<style>{}</style>\n</head>\n"
        "<body>\n<main>\n{}</main>\n<aside>\n",
        for_xml(title), kStyle, element_of(svg));
    for (const PageNode& node : nodes) out += section_of(node);
    return out + fmt::format("</aside>\n<script>{}</script>\n</body>\n</html>\n", kScript);
}

}  // namespace keyline::cli
