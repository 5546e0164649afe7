// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/look/diff_report.h"

#include "cli/common/table.h"
#include "cli/common/window_json.h"
#include "engine/base/error.h"
#include "engine/base/print.h"
#include "engine/base/text.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace keyline::cli {

namespace {

struct Percentile {
    const char *title, *key;
    double share;
};
constexpr std::array<Percentile, 3> kPercentiles{
    {{"50 %", "p50", 0.5}, {"95 %", "p95", 0.95}, {"99 %", "p99", 0.99}}};

std::string rounded(double number) { return fmt::format("{:.4g}", number); }

std::string window_text(const char* what, const Rect& a, const Rect& b) {
    return fmt::format("  {}: {}, and {}\n", what, to_string(a), to_string(b));
}

std::string only_text(const std::string& file, const std::vector<std::string>& names) {
    return names.empty() ? "" : fmt::format("  only in {}: {}\n", escaped(file), listed(names));
}

Row row_of(const ChannelDifference& c) {
    Row row{escaped(c.channel), std::to_string(c.different)};
    const bool any = c.largest > 0 || c.infinite > 0;
    if (c.is_id) {
        row.insert(row.end(), 3 + kPercentiles.size(), "-");
        row.back() = "ids";
        return row;
    }
    row.push_back(c.infinite > 0 ? "infinite" : rounded(c.largest));
    row.push_back(any ? fmt::format("({}, {})", c.x, c.y) : "-");
    row.push_back(rounded(c.mean()));
    for (const Percentile& p : kPercentiles) row.push_back(rounded(c.counts.percentile(p.share)));
    return row;
}

std::string channels_text(const PictureDifferences& found) {
    std::vector<Row> rows{{"channel", "different", "largest", "at", "mean"}};
    for (const Percentile& p : kPercentiles) rows[0].emplace_back(p.title);
    std::size_t same = 0;
    for (const ChannelDifference& c : found.channels)
        if (c.different == 0 && c.largest == 0 && c.infinite == 0)
            ++same;
        else
            rows.push_back(row_of(c));
    if (rows.size() == 1) return "";
    return table(rows, "  ") + (same > 0 ? fmt::format("  {} more are the same\n", same) : "");
}

std::vector<std::string> attribute_names(const PictureDifferences& found) {
    std::vector<std::string> out;
    for (const AttributeDifference& d : found.attributes) out.push_back(d.name);
    return out;
}

void write_channel(JsonWriter& json, const ChannelDifference& c) {
    json.begin_object().field("channel", c.channel).field("samples", c.samples);
    json.field("different", c.different).field("ids", c.is_id);
    if (!c.is_id) {
        json.field("infinite", c.infinite).field("largest", c.largest).field("mean", c.mean());
        for (const Percentile& p : kPercentiles) json.field(p.key, c.counts.percentile(p.share));
        json.field("x", c.x).field("y", c.y);
    }
    json.end_object();
}

}  // namespace

bool DiffReport::differ(bool with_attributes) const {
    return found.display || found.data || !found.only_in_a.empty() || !found.only_in_b.empty() ||
           (with_attributes && !found.attributes.empty()) ||
           std::ranges::any_of(found.channels, [](const ChannelDifference& c) { return c.different > 0; });
}

std::string diff_text(const std::string& a, const std::string& b, const DiffReport& r) {
    std::string out;
    if (r.found.display) out += window_text("display windows", r.display_a, r.display_b);
    if (r.found.data) out += window_text("data windows", r.data_a, r.data_b);
    out += only_text(a, r.found.only_in_a) + only_text(b, r.found.only_in_b);
    for (const TypeDifference& t : r.found.types)
        out += fmt::format("  types of {}: {}, and {}\n", escaped(t.channel), sample_type_name(t.a),
                           sample_type_name(t.b));
    if (const auto names = attribute_names(r.found); !names.empty())
        out += fmt::format("  attributes: {}\n", listed(names));
    out += channels_text(r.found);
    if (r.flip)
        out += fmt::format("  FLIP: mean {}, largest {} at ({}, {})\n", rounded(r.flip->mean),
                           rounded(double{r.flip->largest}), r.flip->x, r.flip->y);
    return out.empty() || r.view.empty() ? out : fmt::format("  view {}\n", in_quotes(r.view)) + out;
}

void write_diff(JsonWriter& json, const DiffReport& r) {
    json.begin_object().field("view", r.view);
    json.field("displayWindowsDiffer", r.found.display).field("dataWindowsDiffer", r.found.data);
    json.key("onlyInA").list(r.found.only_in_a).key("onlyInB").list(r.found.only_in_b);
    json.key("types").begin_array();
    for (const TypeDifference& t : r.found.types)
        json.begin_object()
            .field("channel", t.channel)
            .field("a", sample_type_name(t.a))
            .field("b", sample_type_name(t.b))
            .end_object();
    json.end_array().key("attributes").list(attribute_names(r.found)).key("channels").begin_array();
    for (const ChannelDifference& c : r.found.channels) write_channel(json, c);
    json.end_array();
    if (r.flip)
        json.key("flip")
            .begin_object()
            .field("mean", r.flip->mean)
            .field("largest", r.flip->largest)
            .field("x", r.flip->x)
            .field("y", r.flip->y)
            .end_object();
    json.end_object();
}

}  // namespace keyline::cli
