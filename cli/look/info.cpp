// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/common/options.h"
#include "cli/common/report.h"
#include "cli/common/sequences.h"
#include "cli/look/commands.h"
#include "cli/look/info_report.h"
#include "engine/base/text.h"
#include "engine/look/views.h"
#include "engine/params/frames.h"

#include <fmt/format.h>
#include <memory>
#include <optional>

namespace keyline::cli {

namespace {

struct InfoArguments {
    std::vector<std::string> files;
    std::string at;
    bool all = false, statistics = false, objects = false, json = false;

    bool ask_for_pixels() const { return statistics || objects || !at.empty(); }
};

struct Point {
    int x = 0, y = 0;
};

// Of --at.
std::optional<Point> read_point(const std::string& text) {
    if (text.empty()) return std::nullopt;
    try {
        const std::size_t comma = text.find(',');
        if (comma == std::string::npos) fail(ErrorKind::kGraph, "it must be X,Y");
        return Point{parse_count(text.substr(0, comma), -kMaxCoordinate, kMaxCoordinate),
                     parse_count(text.substr(comma + 1), -kMaxCoordinate, kMaxCoordinate)};
    } catch (const Failure& f) {
        rethrow_with(f, [&](Error& e) { e.place = {"--at " + text, 0, 0}; });
    }
}

// What is wrong with a manifest keeps nothing from being told.
void warn_of_manifests(const std::string& file, const std::vector<SeenCryptomatte>& all,
                       Diagnostics& diagnostics) {
    for (const SeenCryptomatte& matte : all)
        for (const std::string& fault : matte.faults)
            diagnostics.warning(
                {ErrorKind::kInput, {}, {}, fmt::format("{}: {}: {}", file, matte.name, fault), {}});
}

Findings findings_of(const InfoArguments& arguments, const std::optional<Point>& at, const PartView& view) {
    Findings out{view.part, view.view, {}, {}, {}};
    if (arguments.statistics) out.statistics = statistics_of(*view.source);
    if (arguments.objects) out.objects = objects_of(*view.source);
    if (at) out.pixel = pixel_of(*view.source, at->x, at->y);
    return out;
}

FileReport look_at(const InfoArguments& arguments, const std::optional<Point>& at, const std::string& file,
                   Diagnostics& diagnostics) {
    FileReport out{file, describe_image(file), {}};
    if (out.image.fault) diagnostics.error(*out.image.fault);
    if (out.image.fault || !arguments.ask_for_pixels()) return out;
    for (const PartView& view : open_views(file, out.image, diagnostics)) {
        out.findings.push_back(findings_of(arguments, at, view));
        if (const auto& objects = out.findings.back().objects) warn_of_manifests(file, *objects, diagnostics);
    }
    return out;
}

// A file that can't be read keeps no other from being told.
std::vector<FileReport> look_at_all(const InfoArguments& arguments, Diagnostics& diagnostics) {
    const std::optional<Point> at = read_point(arguments.at);
    std::vector<FileReport> out;
    const auto unless_it_fails = [&](const auto& look) {
        try {
            look();
        } catch (const Failure& f) {
            diagnostics.error(f.error());
        }
    };
    for (const std::string& name : arguments.files)
        unless_it_fails([&] {
            for (const std::string& file : files_of(name))
                unless_it_fails([&] { out.push_back(look_at(arguments, at, file, diagnostics)); });
        });
    return out;
}

std::string missing_text(const std::vector<int>& missing) {
    return missing.empty() ? "" : fmt::format(", {} missing: {}", missing.size(), format_frames(missing));
}

// A sequence is told once.
std::string folded_text(const std::vector<FileReport>& reports) {
    std::vector<std::string> files, told;
    for (const FileReport& r : reports) {
        files.push_back(r.file);
        told.push_back(short_text(r.image));
    }
    std::string out;
    for (const Sequence& s : fold_sequences(files, told)) {
        const std::string frames = s.frames.empty() ? "" : " " + format_frames(s.frames);
        out += fmt::format("{}{}{}: {}", out.empty() ? "" : "\n", escaped(s.name), frames,
                           short_text(reports[s.first].image, missing_text(s.missing)));
    }
    return out;
}

std::string text_of(const InfoArguments& arguments, const std::vector<FileReport>& reports) {
    if (!arguments.all && !arguments.ask_for_pixels()) return folded_text(reports);
    std::string out;
    for (const FileReport& r : reports) {
        if (!out.empty()) out += "\n";
        out += arguments.all ? long_text(r.file, r.image)
                             : fmt::format("{}: {}", escaped(r.file), short_text(r.image));
        out += findings_text(r);
    }
    return out;
}

std::string json_of(const std::vector<FileReport>& reports) {
    JsonWriter json(JsonWriter::Style::kIndented);
    json.begin_array();
    for (const FileReport& r : reports) write_report(json, r);
    return json.end_array().text() + "\n";
}

int run(const InfoArguments& arguments) {
    Diagnostics diagnostics;
    const std::vector<FileReport> reports = look_at_all(arguments, diagnostics);
    print_result(arguments.json ? json_of(reports) : text_of(arguments, reports));
    report(diagnostics);
    return exit_status(diagnostics);
}

}  // namespace

void add_info(const Command& program) {
    const Command command = program.add("info", "What image files hold");
    const auto arguments = std::make_shared<InfoArguments>();
    command.argument("FILE", arguments->files, "Image files; street.####.exr for all frames of a sequence");
    command.flag("--all", arguments->all, "Storage and attributes too, file by file");
    command.flag("--stats", arguments->statistics,
                 "The least, mean and largest sample of each channel, and how many are negative, "
                 "infinite or NaN");
    command.flag("--objects", arguments->objects,
                 "The objects of Cryptomattes: pixels, area and the window that holds them");
    command.option("--at", arguments->at, "X,Y", "Every channel of one pixel, and the objects that it shows");
    command.flag("--json", arguments->json, "As JSON: a list with an object a file");
    command.runs([arguments] { return run(*arguments); });
}

}  // namespace keyline::cli
