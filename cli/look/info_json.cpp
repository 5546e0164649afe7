// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/common/window_json.h"
#include "cli/look/info_report.h"
#include "engine/base/channels.h"

#include <concepts>
#include <fmt/format.h>
#include <variant>

namespace keyline::cli {

namespace {

std::vector<std::string> layers_of_part(const ImagePart& part) {
    std::vector<std::string> names;
    for (const FileChannel& c : part.channels) names.push_back(c.name);
    return layers_of(names);
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
    for (const FileChannel& c : part.channels)
        json.begin_object().field("name", c.name).field("type", c.type).end_object();
    json.end_array().key("attributes").begin_object();
    for (const Attribute& a : part.metadata.attributes()) {
        json.key(a.name).begin_object().field("type", a.type).key("value");
        write_value(json, a.value);
        json.end_object();
    }
    json.end_object().end_object();
}

void write_statistics(JsonWriter& json, const std::vector<ChannelStatistics>& all) {
    json.key("statistics").begin_array();
    for (const ChannelStatistics& s : all) {
        json.begin_object().field("channel", s.channel).field("samples", s.samples);
        if (s.finite() > 0) json.field("least", s.least).field("mean", s.mean()).field("largest", s.largest);
        json.field("negative", s.negative).field("infinite", s.infinite).field("nan", s.nan).end_object();
    }
    json.end_array();
}

void write_objects(JsonWriter& json, const std::vector<SeenCryptomatte>& all) {
    json.key("cryptomattes").begin_array();
    for (const SeenCryptomatte& matte : all) {
        json.begin_object().field("name", matte.name).field("unseen", matte.unseen);
        json.key("objects").begin_array();
        for (const SeenObject& o : matte.objects) {
            json.begin_object().field("name", o.name).field("id", fmt::format("{:08x}", o.id));
            json.field("pixels", o.pixels).field("area", o.area);
            write_window(json, "window", o.window);
            json.end_object();
        }
        json.end_array().end_object();
    }
    json.end_array();
}

// A number that JSON has no word for is told in text.
void write_sample(JsonWriter& json, const PixelSample& s) {
    json.begin_object().field("channel", s.channel).field("inside", s.inside).key("value");
    const auto number = static_cast<float>(s.value);
    if (s.value - s.value != 0)
        json.value(fmt::format("{}", number));
    else if (s.type == SampleType::kUint)
        json.value(static_cast<uint32_t>(s.value));
    else
        json.value(number);
    json.end_object();
}

void write_pixel(JsonWriter& json, const Pixel& pixel) {
    json.key("pixel").begin_object().key("samples").begin_array();
    for (const PixelSample& s : pixel.samples) write_sample(json, s);
    json.end_array().key("objects").begin_array();
    for (const Share& s : pixel.objects)
        json.begin_object()
            .field("cryptomatte", s.cryptomatte)
            .field("object", s.object)
            .field("coverage", s.coverage)
            .end_object();
    json.end_array().end_object();
}

void write_findings(JsonWriter& json, const std::vector<Findings>& all) {
    json.key("pixels").begin_array();
    for (const Findings& f : all) {
        json.begin_object().field("part", f.part).field("view", f.view);
        if (f.statistics) write_statistics(json, *f.statistics);
        if (f.objects) write_objects(json, *f.objects);
        if (f.pixel) write_pixel(json, *f.pixel);
        json.end_object();
    }
    json.end_array();
}

}  // namespace

void write_report(JsonWriter& json, const FileReport& report) {
    const ImageDescription& image = report.image;
    json.begin_object().field("file", report.file).field("format", image.format).key("parts").begin_array();
    for (const ImagePart& part : image.parts) write_part(json, part);
    json.end_array();
    if (!report.findings.empty()) write_findings(json, report.findings);
    if (image.fault) json.field("fault", image.fault->what);
    json.end_object();
}

}  // namespace keyline::cli
