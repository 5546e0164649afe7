// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/common/table.h"
#include "cli/look/info_report.h"
#include "engine/base/channels.h"
#include "engine/base/error.h"
#include "engine/base/print.h"
#include "engine/base/text.h"

#include <algorithm>
#include <concepts>
#include <fmt/format.h>

namespace keyline::cli {

namespace {

constexpr std::size_t kMostNumbers = 16;

// For people: long values are cut.
std::string shown(const Attribute::Value& value) {
    return std::visit(
        []<class T>(const T& v) -> std::string {
            if constexpr (std::same_as<T, std::string>) {
                return in_quotes(v);
            } else if constexpr (std::same_as<T, std::vector<std::string>>) {
                return listed(v);
            } else if constexpr (std::same_as<T, std::vector<std::byte>>) {
                return fmt::format("{} bytes", v.size());
            } else {
                std::string out;
                for (std::size_t i = 0; i < std::min(v.size(), kMostNumbers); ++i)
                    out += fmt::format("{}{}", i > 0 ? " " : "", v[i]);
                return v.size() > kMostNumbers ? out + " …" : out;
            }
        },
        value);
}

void append_line(std::string& out, const char* label, const std::string& text) {
    out += fmt::format("  {:<12}{}\n", label, text);
}

void append_layers(std::string& out, const ImagePart& part, const char* indent) {
    for (const std::vector<FileChannel>& layer : by_layer(part.channels))
        out += indent + describe(layer) + "\n";
}

std::string storage_of(const ImagePart& part) {
    std::string out = part.storage;
    if (part.tile_width > 0) out += fmt::format(" in {} × {}", part.tile_width, part.tile_height);
    if (!part.compression.empty()) out += fmt::format(", {}", part.compression);
    return out;
}

std::string counted(std::size_t n, const char* what) {
    return fmt::format("{} {}{}", n, what, n == 1 ? "" : "s");
}

// Where it is not the display window.
std::string data_of(const ImagePart& part) {
    return part.data_window == part.display_window ? "" : ", data " + to_string(part.data_window);
}

// "part 'depth', view 'left'".
std::string place_of(const Findings& f) {
    std::string out;
    if (!f.part.empty()) out += " of part " + in_quotes(f.part);
    if (!f.view.empty()) out += " in view " + in_quotes(f.view);
    return out;
}

// As people compare them; --json has every digit.
std::string rounded(double number) { return fmt::format("{:.6g}", number); }

std::string statistics_text(const Findings& f) {
    std::vector<Row> rows{{"channel", "least", "mean", "largest", "negative", "infinite", "NaN"}};
    for (const ChannelStatistics& s : *f.statistics) {
        const bool any = s.finite() > 0;
        rows.push_back({escaped(s.channel), any ? rounded(s.least) : "-", any ? rounded(s.mean()) : "-",
                        any ? rounded(s.largest) : "-", std::to_string(s.negative),
                        std::to_string(s.infinite), std::to_string(s.nan)});
    }
    return fmt::format("  statistics{}\n", place_of(f)) + table(rows, "    ");
}

std::string objects_text(const Findings& f) {
    std::string out;
    for (const SeenCryptomatte& matte : *f.objects) {
        out += fmt::format("  {} of {}{}\n", counted(matte.objects.size(), "object"), escaped(matte.name),
                           place_of(f));
        std::vector<Row> rows{{"pixels", "area", "window", "name"}};
        for (const SeenObject& o : matte.objects)
            rows.push_back({std::to_string(o.pixels), fmt::format("{:.1f}", o.area), to_string(o.window),
                            escaped(o.name)});
        out += table(rows, "    ");
        if (matte.unseen > 0)
            out += fmt::format("    {} of the manifest cover nothing\n", counted(matte.unseen, "more name"));
    }
    return out.empty() ? fmt::format("  no Cryptomatte{}\n", place_of(f)) : out;
}

// Exactly: a half's and a float's own shortest text.
std::string exact(const PixelSample& sample) {
    return sample.type == SampleType::kUint ? fmt::format("{:.0f}", sample.value)
                                            : fmt::format("{}", static_cast<float>(sample.value));
}

std::string pixel_text(const Findings& f) {
    std::vector<FileChannel> channels;
    std::vector<std::string> names;
    for (const PixelSample& s : f.pixel->samples) {
        channels.push_back({s.channel, s.inside ? exact(s) : exact(s) + " (outside the data window)"});
        names.push_back(s.channel);
    }
    std::vector<Row> rows;
    std::string layer_before;
    for (const std::size_t i : rgba_order(names)) {
        const ChannelName name = split_channel(names[i]);
        if (rows.empty() || layer_before != name.layer) rows.push_back({escaped(name.layer), ""});
        layer_before = name.layer;
        std::string& line = rows.back().back();
        line += (line.empty() ? "" : "  ") + escaped(name.base) + " " + channels[i].type;
    }
    for (const Share& s : f.pixel->objects)
        rows.push_back(
            {escaped(s.cryptomatte), fmt::format("{} covers {:.4g}", in_quotes(s.object), s.coverage)});
    return fmt::format("  pixel{}\n", place_of(f)) + table(rows, "    ");
}

}  // namespace

std::string short_text(const ImageDescription& image, const std::string& more) {
    const ImagePart& first = image.parts.front();
    std::size_t channels = 0;
    for (const ImagePart& part : image.parts) channels += part.channels.size();
    std::string out =
        fmt::format("{}, {}{}, {}", image.format, to_string(first.display_window),
                    image.parts.size() == 1 ? data_of(first) : "", counted(channels, "channel"));
    if (image.parts.size() > 1) out += fmt::format(" in {}", counted(image.parts.size(), "part"));
    out += more + "\n";
    if (image.parts.size() == 1) {
        append_layers(out, first, "  ");
        return out;
    }
    for (std::size_t i = 0; i < image.parts.size(); ++i) {
        const ImagePart& part = image.parts[i];
        const std::string view = part.view.empty() ? "" : ", view " + in_quotes(part.view);
        out += fmt::format("  part {} {}{}{}{}\n", i, in_quotes(part.name), view, data_of(part),
                           part.storage == "deep" ? ", deep" : "");
        append_layers(out, part, "    ");
    }
    return out;
}

std::string long_text(const std::string& file, const ImageDescription& image) {
    std::string out = fmt::format("{}: {}, {} part{}\n", escaped(file), image.format, image.parts.size(),
                                  image.parts.size() == 1 ? "" : "s");
    for (std::size_t i = 0; i < image.parts.size(); ++i) {
        const ImagePart& part = image.parts[i];
        if (image.parts.size() > 1 || !part.name.empty())
            append_line(out, "part", fmt::format("{} {}", i, in_quotes(part.name)));
        if (!part.view.empty()) append_line(out, "view", escaped(part.view));
        append_line(out, "display", to_string(part.display_window));
        append_line(out, "data", to_string(part.data_window));
        if (!part.storage.empty()) append_line(out, "storage", storage_of(part));
        append_line(out, "channels", std::to_string(part.channels.size()));
        append_layers(out, part, "    ");
        if (!part.metadata.attributes().empty()) append_line(out, "attributes", "");
        for (const Attribute& a : part.metadata.attributes())
            out += fmt::format("    {} ({}): {}\n", escaped(a.name), escaped(a.type), shown(a.value));
    }
    return out;
}

std::string findings_text(const FileReport& report) {
    std::string out;
    for (const Findings& f : report.findings) {
        if (f.statistics) out += statistics_text(f);
        if (f.objects) out += objects_text(f);
        if (f.pixel) out += pixel_text(f);
    }
    return out;
}

}  // namespace keyline::cli
