// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/farm/job_files.h"
#include "engine/json/json_writer.h"

#include <algorithm>
#include <fmt/format.h>

// A job type, which is a script that its manager runs, and a job of that type for its web interface.

namespace keyline::cli {

namespace {

// Lies in the folder `scripts` beside flamenco-manager, once for all jobs.
constexpr const char* kJobType = R"(// Renders a sequence with Keyline, then looks whether all of it is there.
const JOB_TYPE = {
    label: "Keyline",
    settings: [
        { key: "program", type: "string", default: "keyline", description: "Where Keyline lies on the workers" },
        { key: "graph", type: "string", subtype: "file_path", required: true, description: "The graph file" },
        { key: "frames", type: "string", required: true, description: "Frames, as 1-100" },
        { key: "chunk_size", type: "int32", default: 10, description: "Frames of a task" },
        { key: "options", type: "string", default: "[]", description: "Further options of both commands, a JSON list" },
    ],
};

function compileJob(job) {
    const settings = job.settings;
    const command = (name, more) => author.Command("exec", {
        exe: settings.program,
        args: [name, settings.graph].concat(JSON.parse(settings.options), more),
    });
    const verify = author.Task("verify", "misc");
    verify.addCommand(command("verify", ["--frames=" + settings.frames]));
    for (const frames of frameChunker(settings.frames, settings.chunk_size)) {
        const render = author.Task("render-" + frames, "misc");
        render.addCommand(command("render",
            ["--frames=" + frames, "--stale", "--keep-going", "--progress=flamenco"]));
        job.addTask(render);
        verify.addDependency(render);
    }
    job.addTask(verify);
}
)";

// Its ranges know no steps.
std::string frames_of(const Submission& job) {
    std::vector<int> frames = job.frames;
    std::ranges::sort(frames);
    std::string out;
    for (std::size_t i = 0; i < frames.size();) {
        std::size_t last = i;
        while (last + 1 < frames.size() && frames[last + 1] == frames[last] + 1) ++last;
        out += fmt::format("{}{}", out.empty() ? "" : ",", frames[i]);
        if (last > i) out += fmt::format("-{}", frames[last]);
        i = last + 1;
    }
    return out;
}

std::string job_of(const Submission& job) {
    // The program, the command and the graph stand apart.
    const std::vector<std::string> words = command_words(job, "render");
    JsonWriter options;
    options.list(std::vector<std::string>(words.begin() + 3, words.end()));
    JsonWriter json(JsonWriter::Style::kIndented);
    json.begin_object().field("name", job.name).field("type", "keyline").field("priority", 50);
    json.field("submitter_platform", "linux").key("settings").begin_object();
    json.field("program", words[0]).field("graph", words[2]).field("frames", frames_of(job));
    json.field("chunk_size", job.chunk).field("options", options.text()).end_object();
    json.key("metadata").begin_object().end_object().end_object();
    return json.text() + "\n";
}

}  // namespace

std::vector<JobFile> flamenco_files(const Submission& job) {
    return {{"keyline.js", kJobType}, {"flamenco.json", job_of(job)}};
}

void send_to_flamenco(const Submission& job, const std::filesystem::path& folder) {
    run_manager({"curl", "--fail", "--silent", "--show-error", "--header", "Content-Type: application/json",
                 "--data-binary", "@" + (folder / "flamenco.json").string(), job.url + "/api/v3/jobs"});
}

}  // namespace keyline::cli
