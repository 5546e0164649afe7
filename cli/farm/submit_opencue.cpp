// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/farm/job_files.h"

#include <algorithm>
#include <cctype>
#include <fmt/format.h>
#include <pwd.h>
#include <unistd.h>

// Its job specification, version 1.15: XML whose elements have a fixed order, which Cuebot validates.

namespace keyline::cli {

namespace {

constexpr int kSilentMinutes = 10;  // after which a frame is killed; a render speaks every 30 s

std::string xml_text(std::string_view text) {
    std::string out;
    for (const char c : text) {
        if (c == '&')
            out += "&amp;";
        else if (c == '<')
            out += "&lt;";
        else if (c == '>')
            out += "&gt;";
        else
            out += c;
    }
    return out;
}

// Of a show, a shot or a job.
std::string checked_name(const char* option, const std::string& name) {
    const auto is_fine = [](unsigned char c) {
        return std::isalnum(c) != 0 || c == '_' || c == '.' || c == '-';
    };
    if (name.size() < 3 || !std::ranges::all_of(name, is_fine))
        fail(ErrorKind::kGraph,
             fmt::format("{} {}: OpenCue's names are three or more letters, digits, '.', '_' and '-'", option,
                         in_quotes(name)));
    return name;
}

struct Account {
    std::string name;
    long number = -1;  // where it is known here
};

Account account_of(const Submission& job) {
    const passwd* entry = job.user.empty() ? getpwuid(getuid()) : getpwnam(job.user.c_str());
    const Account account{job.user.empty() && entry ? entry->pw_name : job.user,
                          entry ? static_cast<long>(entry->pw_uid) : -1L};
    if (account.name.empty() || account.number == 0)
        fail(ErrorKind::kGraph, "OpenCue runs nothing as root", "say whose job it is: --user NAME");
    return account;
}

std::string layer(const Submission& job, const char* name, const char* type, const std::string& command,
                  const std::string& range, int chunk) {
    return fmt::format(
        "      <layer name=\"{}\" type=\"{}\">\n"
        "        <cmd>{}</cmd>\n"
        "        <range>{}</range>\n"
        "        <chunk>{}</chunk>\n"
        "        <cores>{}.0</cores>\n"
        "        <threadable>True</threadable>\n"
        "        <memory>{}m</memory>\n"
        "        <timeout_llu>{}</timeout_llu>\n"
        "        <services><service>{}</service></services>\n"
        "      </layer>\n",
        name, type, xml_text(command), range, chunk, job.cpus, (job.memory >> 20) + 1, kSilentMinutes,
        xml_text(job.service.empty() ? "shell" : job.service));
}

}  // namespace

std::vector<JobFile> opencue_files(const Submission& job) {
    const Account account = account_of(job);
    const std::string name = checked_name("--name", job.name);
    const std::string render = shell_line(command_words(job, "render")) +
                               " --frames=#FRAMESPEC# --stale --keep-going --progress=lines";
    const std::string verify =
        shell_line(command_words(job, "verify")) + " --frames=" + shell_word(all_frames(job));
    std::string out =
        "<?xml version=\"1.0\"?>\n"
        "<!DOCTYPE spec SYSTEM \"http://localhost:8080/spcue/dtd/cjsl-1.15.dtd\">\n"
        "<spec>\n";
    out += fmt::format("  <show>{}</show>\n  <shot>{}</shot>\n  <user>{}</user>\n",
                       checked_name("--show", job.show), checked_name("--shot", job.shot),
                       xml_text(account.name));
    if (account.number > 0) out += fmt::format("  <uid>{}</uid>\n", account.number);
    out += fmt::format("  <job name=\"{}\">\n    <maxretries>1</maxretries>\n    <layers>\n", name);
    out += layer(job, "render", "Render", render, all_frames(job), job.chunk);
    out += layer(job, "verify", "Util", verify, "1", 1);
    out += fmt::format(
        "    </layers>\n  </job>\n  <depends>\n"
        "    <depend type=\"LAYER_ON_LAYER\" anyframe=\"False\"><depjob>{0}</depjob>"
        "<deplayer>verify</deplayer><onjob>{0}</onjob><onlayer>render</onlayer></depend>\n"
        "  </depends>\n</spec>\n",
        name);
    return {{"opencue.xml", out}};
}

void send_to_opencue(const Submission&, const std::filesystem::path& folder) {
    run_manager({"python3", "-c",
                 "import sys, opencue; opencue.api.launchSpecAndWait(open(sys.argv[1]).read())",
                 (folder / "opencue.xml").string()});
}

}  // namespace keyline::cli
