// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/farm/job_files.h"
#include "engine/base/error.h"

#include <fmt/format.h>

// Its job scripts, which are Tcl: braces quote, and nothing inside them is read but braces.

namespace keyline::cli {

namespace {

// Braces inside must be in pairs; a backslash and a per cent sign would be Tractor's own.
bool can_be_braced(std::string_view text) {
    int depth = 0;
    for (const char c : text) {
        depth += c == '{' ? 1 : c == '}' ? -1 : 0;
        if (depth < 0 || c == '\\' || c == '%' || c == '\n') return false;
    }
    return depth == 0;
}

std::string braced(std::string_view text) {
    if (!can_be_braced(text)) refuse_word("Tractor", text);
    return fmt::format("{{{}}}", text);
}

std::string launched(const std::vector<std::string>& words) {
    std::string out;
    for (const std::string& word : words) {
        const bool is_plain = shell_word(word) == word && can_be_braced(word);
        out += (out.empty() ? "" : " ") + (is_plain ? word : braced(word));
    }
    return braced(out);
}

std::string task(const Submission& job, const std::string& title, const std::vector<std::string>& words) {
    return fmt::format(
        "Task -title {} -cmds {{\n      RemoteCmd {} -service {} -atleast {} -retryrc {{{}}}\n    }}\n",
        braced(title), launched(words), braced(job.service.empty() ? "PixarRender" : job.service), job.cpus,
        kTryAgain);
}

}  // namespace

std::vector<JobFile> tractor_files(const Submission& job) {
    std::string out =
        fmt::format("Job -title {} -serialsubtasks 1 -subtasks {{\n  Task -title {{render}} -subtasks {{\n",
                    braced(job.name));
    for (const std::string& frames : job.chunks) {
        std::vector<std::string> words = command_words(job, "render");
        words.insert(words.end(), {"--frames=" + frames, "--stale", "--keep-going", "--progress=tractor"});
        out += "    " + task(job, frames, words);
    }
    std::vector<std::string> verify = command_words(job, "verify");
    verify.push_back("--frames=" + all_frames(job));
    out += "  }\n  " + task(job, "verify", verify) + "}\n";
    return {{"tractor.alf", out}};
}

void send_to_tractor(const Submission&, const std::filesystem::path& folder) {
    run_manager({"tractor-spool", (folder / "tractor.alf").string()});
}

}  // namespace keyline::cli
