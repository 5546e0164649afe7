// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cli/farm/submit.h"

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

// Managers that take a job as files in a format of their own, by a command of their own.

namespace keyline::cli {

struct JobFile {
    std::string name, text;
};

// An option that only some managers have, and where its value goes.
struct OwnOption {
    const char* name;
    std::string Submission::*value;
    const char *value_name, *help;
};

struct FileManager {
    const char *name, *about;
    std::vector<OwnOption> options;
    std::vector<JobFile> (*files)(const Submission& job);
    // Gives the manager the files, which lie in the folder.
    void (*send)(const Submission& job, const std::filesystem::path& folder);
};

std::span<const FileManager> file_managers();

// Writes the job's files into the folder, made where it is not there; nothing is sent.
void write_job_files(const FileManager& manager, const Submission& job, const std::filesystem::path& folder);

// Writes them into a folder of their own, and sends them.
void send_job(const FileManager& manager, const Submission& job);

// Runs a manager's own command, and returns what it prints.  Throws Failure (kFailed) where it fails.
std::string run_manager(const std::vector<std::string>& command, const std::string& in = {});

// What a format can't hold is refused before it makes another command of it.
[[noreturn]] void refuse_word(const char* manager, std::string_view word);

std::vector<JobFile> opencue_files(const Submission& job);
void send_to_opencue(const Submission& job, const std::filesystem::path& folder);
std::vector<JobFile> afanasy_files(const Submission& job);
void send_to_afanasy(const Submission& job, const std::filesystem::path& folder);
std::vector<JobFile> tractor_files(const Submission& job);
void send_to_tractor(const Submission& job, const std::filesystem::path& folder);
std::vector<JobFile> deadline_files(const Submission& job);
void send_to_deadline(const Submission& job, const std::filesystem::path& folder);
std::vector<JobFile> flamenco_files(const Submission& job);
void send_to_flamenco(const Submission& job, const std::filesystem::path& folder);

}  // namespace keyline::cli
