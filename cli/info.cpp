// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/commands.h"
#include "cli/report.h"
#include "cli/window_json.h"
#include "engine/base/channels.h"
#include "engine/base/print.h"
#include "engine/base/text.h"
#include "engine/io/describe.h"
#include "engine/io/describe_image.h"
#include "engine/json/json_writer.h"

#include <fmt/format.h>
#include <memory>

namespace keyline::cli {

namespace {

struct InfoArguments {
    std::vector<std::string> files;
    bool json = false;
};

std::vector<std::string> layers_of_part(const ImagePart& part) {
    std::vector<std::string> names;
    for (const ChannelInfo& c : part.channels) names.push_back(c.name);
    return layers_of(names);
}

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

// A line a layer.
void append_channels(std::string& out, const ImagePart& part) {
    append_line(out, "channels", std::to_string(part.channels.size()));
    std::vector<ChannelInfo> group;
    for (std::size_t i = 0; i < part.channels.size(); ++i) {
        group.push_back(part.channels[i]);
        const bool last = i + 1 == part.channels.size() || split_channel(part.channels[i + 1].name).layer !=
                                                               split_channel(group[0].name).layer;
        if (!last) continue;
        out += fmt::format("    {}\n", describe(group));
        group.clear();
    }
}

std::string storage_of(const ImagePart& part) {
    std::string out = part.storage;
    if (part.tile_width > 0) out += fmt::format(" in {} × {}", part.tile_width, part.tile_height);
    if (!part.compression.empty()) out += fmt::format(", {}", part.compression);
    return out;
}

std::string text_of(const std::string& file, const ImageDescription& image) {
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
        append_channels(out, part);
        if (!part.metadata.attributes().empty()) append_line(out, "attributes", "");
        for (const Attribute& a : part.metadata.attributes())
            out += fmt::format("    {} ({}): {}\n", escaped(a.name), escaped(a.type), shown(a.value));
    }
    return out;
}

void write_value(JsonWriter& json, const Attribute::Value& value) {
    std::visit(
        [&]<class T>(const T& v) {
            if constexpr (std::same_as<T, std::string>) {
                json.value(v);
            } else if constexpr (std::same_as<T, std::vector<std::byte>>) {
                json.begin_array();
                for (const std::byte b : v) json.value(std::to_integer<int>(b));
                json.end_array();
            } else if constexpr (!std::same_as<T, std::vector<std::string>>) {
                v.size() == 1 ? json.value(v[0]) : json.list(v);
            } else {
                json.list(v);
            }
        },
        value);
}

void write_part(JsonWriter& json, const ImagePart& part) {
    json.begin_object().field("name", part.name).field("view", part.view);
    write_window(json, "displayWindow", part.display_window);
    write_window(json, "dataWindow", part.data_window);
    json.field("storage", part.storage).field("compression", part.compression);
    if (part.tile_width > 0) json.key("tile").list(std::vector{part.tile_width, part.tile_height});
    json.key("layers").list(layers_of_part(part)).key("channels").begin_array();
    for (const ChannelInfo& c : part.channels)
        json.begin_object().field("name", c.name).field("type", sample_type_name(c.type)).end_object();
    json.end_array().key("attributes").begin_object();
    for (const Attribute& a : part.metadata.attributes()) {
        json.key(a.name).begin_object().field("type", a.type).key("value");
        write_value(json, a.value);
        json.end_object();
    }
    json.end_object().end_object();
}

void write_image(JsonWriter& json, const std::string& file, const ImageDescription& image) {
    json.begin_object().field("file", file).field("format", image.format).key("parts").begin_array();
    for (const ImagePart& part : image.parts) write_part(json, part);
    json.end_array();
    if (image.fault) json.field("fault", image.fault->what);
    json.end_object();
}

// A file that can't be read keeps no other from being told.
int run(const InfoArguments& arguments) {
    JsonWriter json(JsonWriter::Style::kIndented);
    json.begin_array();
    std::string text;
    Diagnostics diagnostics;
    for (const std::string& file : arguments.files) {
        try {
            const ImageDescription image = describe_image(file);
            if (arguments.json)
                write_image(json, file, image);
            else
                text += (text.empty() ? "" : "\n") + text_of(file, image);
            if (image.fault) diagnostics.error(*image.fault);
        } catch (const Failure& f) {
            diagnostics.error(f.error());
        }
    }
    print_result(arguments.json ? json.end_array().text() + "\n" : text);
    report(diagnostics);
    return exit_status(diagnostics);
}

}  // namespace

void add_info(CLI::App& program, Chosen& chosen) {
    CLI::App& command = *program.add_subcommand("info", "What image files hold");
    const auto arguments = std::make_shared<InfoArguments>();
    command.add_option("FILE", arguments->files, "Image files")->required()->type_name("");
    command.add_flag("--json", arguments->json, "As JSON: a list with an object a file");
    command.callback([&chosen, arguments] { chosen = [arguments] { return run(*arguments); }; });
}

}  // namespace keyline::cli
