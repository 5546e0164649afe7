// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/farm/submit.h"
#include "engine/json/json_writer.h"
#include "engine/params/frames.h"

#include <cerrno>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <system_error>

namespace keyline::cli {

namespace {

namespace fs = std::filesystem;

// Of the specification, version 2023-09.
constexpr std::size_t kMostTasks = 1024;  // values in the list of a task parameter
constexpr std::size_t kLongestName = 64;  // of a job
constexpr int kNotifyPeriod = 60;         // seconds from SIGTERM to SIGKILL

void write_file(const fs::path& file, const JsonWriter& json) {
    std::ofstream out(file, std::ios::binary);
    if (!(out << json.text() << '\n').flush())
        fail(ErrorKind::kOutput,
             fmt::format("{}: can't be written: {}", file.string(), std::generic_category().message(errno)));
}

// What every command is given: the graph, and where the folders of the one who submitted lie on the worker.
void write_arguments(JsonWriter& json, const Submission& job, const char* command,
                     const std::vector<std::string>& more) {
    json.key("args").begin_array().value(command).value("{{Param.Graph}}");
    json.value("--path-map={{Session.PathMappingRulesFile}}");
    for (const std::string& s : job.graph.set) json.value("--set=" + s);
    for (const std::string& s : job.graph.vars) json.value("--vars=" + fs::absolute(s).string());
    for (const std::string& s : job.graph.var) json.value("--var=" + s);
    for (const std::string& s : job.graph.only) json.value("--only=" + s);
    for (const std::string& s : job.graph.output) json.value("--output=" + s);
    if (!job.graph.ocio.empty()) json.value("--ocio=" + fs::absolute(job.graph.ocio).string());
    if (!job.graph.root.empty()) json.value("--root=" + fs::absolute(job.graph.root).string());
    for (const std::string& s : more) json.value(s);
    json.end_array();
}

void write_script(JsonWriter& json, const Submission& job, const char* command,
                  const std::vector<std::string>& more) {
    json.key("script").begin_object().key("actions").begin_object().key("onRun").begin_object();
    json.field("command", "keyline");
    write_arguments(json, job, command, more);
    json.key("cancelation").begin_object().field("mode", "NOTIFY_THEN_TERMINATE");
    json.field("notifyPeriodInSeconds", kNotifyPeriod).end_object();
    json.end_object().end_object().end_object();
}

void write_requirements(JsonWriter& json, const Submission& job) {
    const auto amount = [&](const char* name, std::size_t least) {
        json.begin_object().field("name", name).field("min", least).end_object();
    };
    json.key("hostRequirements").begin_object().key("amounts").begin_array();
    amount("amount.worker.vcpu", static_cast<std::size_t>(job.cpus));
    amount("amount.worker.memory", (job.memory >> 20) + 1);
    json.end_array().end_object();
}

void write_render_step(JsonWriter& json, const Submission& job) {
    json.begin_object().field("name", "Render");
    write_requirements(json, job);
    json.key("parameterSpace").begin_object().key("taskParameterDefinitions").begin_array();
    json.begin_object().field("name", "Frames").field("type", "STRING").key("range").list(job.chunks);
    json.end_object().end_array().end_object();
    write_script(json, job, "render",
                 {"--frames={{Task.Param.Frames}}", "--stale", "--keep-going", "--progress=openjd"});
    json.end_object();
}

void write_verify_step(JsonWriter& json, const Submission& job) {
    std::string frames = format_frames(job.frames);
    std::erase(frames, ' ');
    json.begin_object().field("name", "Verify").key("dependencies").begin_array();
    json.begin_object().field("dependsOn", "Render").end_object().end_array();
    write_requirements(json, job);
    write_script(json, job, "verify", {"--frames=" + frames});
    json.end_object();
}

JsonWriter job_template(const Submission& job) {
    JsonWriter json(JsonWriter::Style::kIndented);
    json.begin_object().field("specificationVersion", "jobtemplate-2023-09");
    json.field("name", job.name.substr(0, kLongestName)).key("parameterDefinitions").begin_array();
    json.begin_object().field("name", "Graph").field("type", "PATH");
    json.field("objectType", "FILE").field("dataFlow", "IN").end_object().end_array();
    json.key("steps").begin_array();
    write_render_step(json, job);
    write_verify_step(json, job);
    json.end_array().end_object();
    return json;
}

}  // namespace

void write_openjd_bundle(const Submission& job, const std::string& folder) {
    if (job.chunks.size() > kMostTasks)
        fail(ErrorKind::kGraph,
             fmt::format("{} tasks are more than the {} that a step can have", job.chunks.size(), kMostTasks),
             fmt::format("give --chunk {}", (job.frames.size() + kMostTasks - 1) / kMostTasks));
    const std::string graph = fs::absolute(job.graph.graph).string();
    fs::create_directories(folder);
    write_file(fs::path(folder) / "template.json", job_template(job));
    JsonWriter values(JsonWriter::Style::kIndented);
    values.begin_object().key("parameterValues").begin_array();
    values.begin_object().field("name", "Graph").field("value", graph).end_object();
    write_file(fs::path(folder) / "parameter_values.json", values.end_array().end_object());
    JsonWriter assets(JsonWriter::Style::kIndented);
    assets.begin_object().key("assetReferences").begin_object();
    assets.key("inputs").begin_object().key("filenames").list(std::vector{graph});
    assets.key("directories").list(job.input_folders).end_object();
    assets.key("outputs").begin_object().key("directories").list(job.output_folders).end_object();
    assets.key("referencedPaths").list(std::vector<std::string>{});
    write_file(fs::path(folder) / "asset_references.json", assets.end_object().end_object());
}

}  // namespace keyline::cli
