// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/farm/job_files.h"

#include <algorithm>
#include <cerrno>
#include <fmt/format.h>
#include <fstream>
#include <system_error>

// Its manual submission: a file of the job and one of the plug-in, KEY=VALUE a line.  The plug-in CommandLine
// is part of every Deadline.

namespace keyline::cli {

namespace {

// The executable apart.
std::string arguments_of(const std::vector<std::string>& words) {
    std::string out;
    for (std::size_t i = 1; i < words.size(); ++i) {
        const std::string& word = words[i];
        if (word.find_first_of("\"\\\n<>") != std::string::npos) refuse_word("Deadline", word);
        out += i > 1 ? " " : "";
        out += shell_word(word) == word ? word : "<QUOTE>" + word + "<QUOTE>";
    }
    return out;
}

// A task is told its first and its last frame only.
bool is_one_range(const std::vector<int>& frames) {
    const auto [first, last] = std::ranges::minmax(frames);
    return static_cast<std::size_t>(last - first) + 1 == frames.size();
}

std::string job_info(const Submission& job, const std::string& name, const std::string& frames, int chunk) {
    std::string out =
        fmt::format("Plugin=CommandLine\nName={}\nFrames={}\nChunkSize={}\n", name, frames, chunk);
    if (!job.pool.empty()) out += fmt::format("Pool={}\n", job.pool);
    if (!job.group.empty()) out += fmt::format("Group={}\n", job.group);
    for (std::size_t i = 0; i < job.output_folders.size(); ++i)
        out += fmt::format("OutputDirectory{}={}\n", i, job.output_folders[i]);
    return out;
}

std::string plugin_info(const std::vector<std::string>& words, const std::string& more) {
    return fmt::format(
        "Executable={}\nArguments={}{}\nStartupDirectory={}\nShellExecute=False\nSingleFramesOnly=False\n",
        words.front(), arguments_of(words), more, std::filesystem::current_path().string());
}

// Returns the job's number, which it is told on a line of its own.
std::string submitted(const std::filesystem::path& folder, const std::string& name) {
    const std::string told = run_manager(
        {"deadlinecommand", (folder / (name + ".job")).string(), (folder / (name + ".plugin")).string()});
    const std::size_t at = told.find("JobID=");
    if (at == std::string::npos)
        fail(ErrorKind::kFailed, "deadlinecommand told no JobID: " + in_quotes(told));
    return told.substr(at + 6, told.find_first_of("\r\n", at) - at - 6);
}

}  // namespace

std::vector<JobFile> deadline_files(const Submission& job) {
    const std::string frames = all_frames(job);
    const int chunk = is_one_range(job.frames) ? job.chunk : 1;
    return {{"render.job", job_info(job, job.name, frames, chunk)},
            {"render.plugin",
             plugin_info(command_words(job, "render"),
                         " --frames=<STARTFRAME>-<ENDFRAME> --stale --keep-going --progress=deadline")},
            {"verify.job", job_info(job, job.name + "-verify", "1", 1)},
            {"verify.plugin", plugin_info(command_words(job, "verify"), " --frames=" + frames)}};
}

void send_to_deadline(const Submission&, const std::filesystem::path& folder) {
    const std::string first = submitted(folder, "render");
    std::ofstream verify(folder / "verify.job", std::ios::app);
    if (!(verify << "JobDependencies=" << first << '\n').flush())
        fail(ErrorKind::kOutput, fmt::format("{}: can't be written: {}", (folder / "verify.job").string(),
                                             std::generic_category().message(errno)));
    submitted(folder, "verify");
}

}  // namespace keyline::cli
