// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/farm/job_files.h"

#include "cli/common/report.h"
#include "cli/common/run_program.h"
#include "cli/common/temporary_folder.h"

#include <array>
#include <cerrno>
#include <fmt/format.h>
#include <fstream>
#include <system_error>

namespace keyline::cli {

namespace fs = std::filesystem;

std::span<const FileManager> file_managers() {
    static const OwnOption kUser{"--user", &Submission::user, "NAME", "Whose job it is; yours when absent"};
    static const std::array<FileManager, 5> kAll{{
        {"opencue",
         "A job for OpenCue: a layer that renders, and one after it that verifies",
         {kUser,
          {"--show", &Submission::show, "NAME", "The show, which OpenCue must know; keyline when absent"},
          {"--shot", &Submission::shot, "NAME", "The shot; test when absent"},
          {"--service", &Submission::service, "NAME", "The service of the layers; shell when absent"}},
         opencue_files,
         send_to_opencue},
        {"afanasy",
         "A job for Afanasy: a block that renders, and one after it that verifies",
         {kUser,
          {"--service", &Submission::service, "NAME", "The service of the blocks; generic when absent"}},
         afanasy_files,
         send_to_afanasy},
        {"tractor",
         "A job for Tractor: tasks that render, and one after them that verifies",
         {{"--service", &Submission::service, "NAME", "The service key; PixarRender when absent"}},
         tractor_files,
         send_to_tractor},
        {"deadline",
         "Two jobs for Deadline 10: one renders, the other verifies after it",
         {{"--pool", &Submission::pool, "NAME", "The pool; Deadline's own choice when absent"},
          {"--group", &Submission::group, "NAME", "The group; Deadline's own choice when absent"}},
         deadline_files,
         send_to_deadline},
        {"flamenco",
         "A job and its type for Flamenco 3: tasks that render, and one after them that verifies",
         {{"--manager", &Submission::url, "URL", "Flamenco's manager; http://localhost:8080 when absent"}},
         flamenco_files,
         send_to_flamenco},
    }};
    return kAll;
}

void write_job_files(const FileManager& manager, const Submission& job, const fs::path& folder) {
    const std::vector<JobFile> files = manager.files(job);
    fs::create_directories(folder);
    for (const JobFile& file : files) {
        const fs::path path = folder / file.name;
        std::ofstream out(path, std::ios::binary);
        if (!(out << file.text).flush())
            fail(ErrorKind::kOutput, fmt::format("{}: can't be written: {}", path.string(),
                                                 std::generic_category().message(errno)));
    }
}

void send_job(const FileManager& manager, const Submission& job) {
    const TemporaryFolder folder;
    const fs::path path = folder / "job";
    write_job_files(manager, job, path);
    manager.send(job, path);
    print_message(fmt::format("{}: {} has {} tasks to render, and one that verifies", job.name, manager.name,
                              job.chunks.size()));
}

std::string run_manager(const std::vector<std::string>& command, const std::string& in) {
    const ProgramResult result = run_program(command, in);
    if (result.status != 0)
        fail(ErrorKind::kFailed, fmt::format("{} ended with status {}", command.front(), result.status),
             "--job DIR writes the job's files and sends nothing");
    return result.out;
}

void refuse_word(const char* manager, std::string_view word) {
    fail(ErrorKind::kGraph, fmt::format("{} can't pass {} on to a command", manager, in_quotes(word)),
         "put it into the graph, or into a file for --vars");
}

}  // namespace keyline::cli
