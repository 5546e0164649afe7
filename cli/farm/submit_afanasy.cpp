// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/farm/job_files.h"
#include "engine/json/json_writer.h"

#include <array>
#include <fmt/format.h>
#include <pwd.h>
#include <unistd.h>

// Its JSON protocol: a block with a task for each part of the sequence, whose command is what the tasks share
// with
// @#@ for what they don't.

namespace keyline::cli {

namespace {

constexpr int kRetries = 3;

std::string user_name(const Submission& job) {
    if (!job.user.empty()) return job.user;
    const passwd* entry = getpwuid(getuid());
    return entry ? entry->pw_name : std::to_string(getuid());
}

std::string host_name() {
    std::array<char, 256> name = {};
    return gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "unknown";
}

void write_needs(JsonWriter& json, const Submission& job) {
    json.field("service", job.service.empty() ? "generic" : job.service).field("parser", "generic");
    json.field("working_directory", std::filesystem::current_path().string());
    json.field("errors_retries", kRetries);
    json.field("need_memory", (job.memory >> 20) + 1).field("need_cpu_cores", job.cpus);
}

void write_render_block(JsonWriter& json, const Submission& job) {
    json.begin_object().field("name", "render");
    write_needs(json, job);
    json.field("frames_per_task", job.chunk);
    json.field("command", shell_line(command_words(job, "render")) +
                              " --frames=@#@ --stale --keep-going --progress=afanasy");
    json.key("tasks").begin_array();
    for (const std::string& frames : job.chunks)
        json.begin_object().field("name", frames).field("command", frames).end_object();
    json.end_array().end_object();
}

void write_verify_block(JsonWriter& json, const Submission& job) {
    json.begin_object().field("name", "verify").field("depend_mask", "render");
    write_needs(json, job);
    json.field("command", "@#@").key("tasks").begin_array().begin_object().field("name", "verify");
    json.field("command",
               shell_line(command_words(job, "verify")) + " --frames=" + shell_word(all_frames(job)));
    json.end_object().end_array().end_object();
}

}  // namespace

std::vector<JobFile> afanasy_files(const Submission& job) {
    for (const std::string& word : command_words(job, "render"))
        if (word.find("@#") != std::string::npos) refuse_word("Afanasy", word);
    JsonWriter json(JsonWriter::Style::kIndented);
    json.begin_object().key("job").begin_object().field("name", job.name);
    json.field("user_name", user_name(job)).field("host_name", host_name()).key("blocks").begin_array();
    write_render_block(json, job);
    write_verify_block(json, job);
    json.end_array().end_object().end_object();
    return {{"afanasy.json", json.text() + "\n"}};
}

void send_to_afanasy(const Submission&, const std::filesystem::path& folder) {
    run_manager({"afcmd", "json", "send", (folder / "afanasy.json").string()});
}

}  // namespace keyline::cli
