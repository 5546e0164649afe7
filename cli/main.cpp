// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/author/commands.h"
#include "cli/common/command_line.h"
#include "cli/common/machine.h"
#include "cli/common/report.h"
#include "cli/farm/commands.h"
#include "cli/graphs/commands.h"
#include "cli/look/commands.h"
#include "cli/lsp/commands.h"
#include "cli/manual.h"
#include "cli/render/commands.h"
#include "engine/color/color.h"
#include "engine/color/opencolorio_log.h"
#include "engine/io/versions.h"

#include <csignal>
#include <exception>
#include <fmt/format.h>
#include <string>

namespace {

using namespace keyline;
using namespace keyline::cli;

std::string version_text() {
    std::string out = fmt::format("keyline {}\n", keyline_version());
    for (const LibraryVersion& v : library_versions()) out += fmt::format("  {:<14} {}\n", v.name, v.version);
    out.pop_back();  // the command line's own end of line
    return out;
}

void add_commands(const Command& program) {
    add_new(program);
    add_render(program);
    add_check(program);
    add_plan(program);
    add_fmt(program);
    add_lsp(program);
    add_nodes(program);
    add_schema(program);
    add_info(program);
    add_diff(program);
    add_view(program);
    add_draw(program);
    add_measure(program);
    add_verify(program);
    add_provenance(program);
    add_submit(program);
    add_test(program);
    add_explain(program);
    add_completion(program);
}

int run(int argc, char** argv) {
    clear_ocio_environment();
    hear_opencolorio([](const std::string& message) { print_library_warning("OpenColorIO", message); });
    std::signal(SIGPIPE, SIG_IGN);  // a reader that goes away is a write that fails
    std::signal(SIGXFSZ, SIG_IGN);  // and so is a file that grows beyond what the system allows
    CommandLine line({"keyline", "Keyline renders node graphs for toon looks.",
                      "Examples:\n"
                      "  keyline check toon.json\n"
                      "  keyline render toon.json --frames 1-24\n"
                      "  keyline render toon.json --frames 12 --output blur=look.exr --set blur.sigma=3\n"
                      "  keyline help render\n"
                      "  keyline help graphs       the language of graph files\n"
                      "  keyline help commands     all commands and their options",
                      version_text});
    line.add_topic("graphs", [] { return print_result(manual_of_graphs()), 0; });
    line.add_topic("commands", [&line] { return print_result(line.pages()), 0; });
    add_commands(line.program());
    const int status = line.run(argc, argv);
    finish_results();
    return status;
}

}  // namespace

int main(int argc, char** argv) {
    fill_closed_streams();
    give_large_blocks_back();
    try {
        return run(argc, argv);
    } catch (...) {
        const Error error = error_of(std::current_exception());
        print_error(error);
        return exit_status(error);
    }
}
