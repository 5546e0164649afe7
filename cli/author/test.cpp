// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/author/commands.h"
#include "cli/author/graph_test.h"
#include "cli/author/test_report.h"
#include "cli/common/machine.h"
#include "cli/common/options.h"
#include "cli/common/report.h"
#include "engine/io/text_file.h"
#include "engine/kit/wildcard.h"

#include <algorithm>
#include <atomic>
#include <fmt/format.h>
#include <memory>
#include <thread>

namespace keyline::cli {

namespace {

struct TestArguments {
    std::vector<std::string> files;
    std::string filter, junit, threads;
    bool bless = false, tap = false, untouched = false;
};

// Each test on one thread, as many at once as there are threads.
std::vector<TestResult> run_all(const std::vector<GraphTest>& tests, bool bless, std::size_t threads) {
    std::vector<TestResult> out(tests.size());
    std::atomic<std::size_t> next = 0;
    const auto work = [&] {
        for (std::size_t i = next++; i < tests.size(); i = next++) out[i] = run_graph_test(tests[i], bless);
    };
    std::vector<std::jthread> others;
    for (std::size_t i = 1; i < std::min(threads, tests.size()); ++i) others.emplace_back(work);
    work();
    return out;
}

int run(const TestArguments& arguments) {
    Diagnostics diagnostics;
    std::vector<GraphTest> tests;
    for (const std::string& file : arguments.files)
        for (GraphTest& t : read_graph_tests(file, diagnostics))
            if (arguments.filter.empty() || matches(t.name, arguments.filter)) tests.push_back(std::move(t));
    report(diagnostics);
    const std::size_t threads = arguments.threads.empty()
                                    ? usable_threads().amount
                                    : static_cast<std::size_t>(parse_count(arguments.threads, 1, 1024));
    const std::vector<TestResult> results = run_all(tests, arguments.bless, threads);
    print_result(arguments.tap ? results_as_tap(tests, results) : results_as_text(tests, results));
    if (arguments.untouched) print_result(untouched_text(tests, results));
    if (!arguments.junit.empty()) write_text_file(arguments.junit, results_as_junit(tests, results));
    const bool all_pass = std::ranges::all_of(results, [](const TestResult& r) { return r.faults.empty(); });
    return diagnostics.ok() ? (all_pass ? 0 : 1) : exit_status(diagnostics);
}

}  // namespace

void add_test(const Command& program) {
    const Command command =
        program.add("test", "Run tests of graphs and nodes; the status is 1 where one fails");
    const auto arguments = std::make_shared<TestArguments>();
    command.argument("FILE", arguments->files, "Files of tests");
    command.option("--filter", arguments->filter, "PATTERN",
                   "Only tests of such names; * stands for anything");
    command.flag("--bless", arguments->bless,
                 "Where an expected file differs or is not there, make it what came out");
    command.flag("--untouched", arguments->untouched,
                 "Tell which nodes of the graphs no test reaches, which of their branches none takes, and "
                 "which parameters none gives");
    command.flag("--tap", arguments->tap, "As the Test Anything Protocol, version 14");
    command.option("--junit", arguments->junit, "FILE", "Write the results as JUnit's XML too");
    command.option("--threads", arguments->threads, "N", "Tests at once; all cores when absent");
    command.runs([arguments] { return run(*arguments); });
}

}  // namespace keyline::cli
