// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/author/test_report.h"

#include "engine/base/text.h"
#include "engine/graph/graph.h"
#include "engine/node/registry.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <map>

namespace keyline::cli {

namespace {

std::string counted(std::size_t n, const char* what) {
    return fmt::format("{} {}{}", n, what, n == 1 ? "" : "s");
}

std::size_t failed(const std::vector<TestResult>& results) {
    return static_cast<std::size_t>(
        std::ranges::count_if(results, [](const TestResult& r) { return !r.faults.empty(); }));
}

// The nodes of each graph, and those that some test reaches; its branches, and those that some test takes.
struct Reach {
    std::set<std::string> nodes, reached, branches, taken;
};

std::vector<std::string> left_of(const std::set<std::string>& all, const std::set<std::string>& touched) {
    std::vector<std::string> out;
    std::ranges::set_difference(all, touched, std::back_inserter(out));
    return out;
}

// "a, b and c"
std::string joined(const std::vector<std::string>& words) {
    std::string out;
    for (std::size_t i = 0; i < words.size(); ++i)
        out += (i == 0 ? "" : i + 1 == words.size() ? " and " : ", ") + words[i];
    return out;
}

std::map<std::string, Reach> reach_of(const std::vector<GraphTest>& tests,
                                      const std::vector<TestResult>& results) {
    std::map<std::string, Reach> out;
    for (std::size_t i = 0; i < tests.size(); ++i) {
        if (tests[i].graph.empty()) continue;
        const std::string file =
            (std::filesystem::path(tests[i].folder) / tests[i].graph).lexically_normal().string();
        const auto [it, is_new] = out.try_emplace(file);
        it->second.reached.insert(results[i].reached.begin(), results[i].reached.end());
        it->second.taken.insert(results[i].branches.begin(), results[i].branches.end());
        if (!is_new) continue;
        Diagnostics unheard;
        const auto graph = Graph::load_what_is_sound(file, {}, unheard);
        if (!graph) continue;
        it->second.branches = branches_of(*graph, 1).all;
        for (const GraphNode& node : graph->nodes())
            if (node.type->kind != NodeKind::kSink) it->second.nodes.insert(node.id);
    }
    return out;
}

// By type, of those that tests of nodes have, the parameters that none gives.
std::map<std::string, std::vector<std::string>> parameters_not_given(const std::vector<TestResult>& results) {
    std::set<std::string> given, types;
    for (const TestResult& r : results) given.insert(r.parameters.begin(), r.parameters.end());
    for (const std::string& g : given) types.insert(g.substr(0, g.find('.')));
    std::map<std::string, std::vector<std::string>> out;
    for (const std::string& name : types)
        if (const NodeType* type = registry().find(name))
            for (const FieldInfo& f : type->fields)
                if (!given.contains(fmt::format("{}.{}", name, f.name))) out[name].emplace_back(f.name);
    return out;
}

}  // namespace

std::string results_as_text(const std::vector<GraphTest>& tests, const std::vector<TestResult>& results) {
    std::string out;
    for (std::size_t i = 0; i < tests.size(); ++i) {
        const std::string title =
            fmt::format("{}: {}", escaped(tests[i].place.text()), in_quotes(tests[i].name));
        if (results[i].blessed) out += title + ": blessed\n";
        for (const std::string& fault : results[i].faults)
            out += fmt::format("{}: failed: {}\n", title, escaped(fault));
    }
    const std::size_t bad = failed(results);
    return out + fmt::format("{}, {} failed\n", counted(tests.size(), "test"),
                             bad == 0 ? "none" : std::to_string(bad));
}

std::string results_as_tap(const std::vector<GraphTest>& tests, const std::vector<TestResult>& results) {
    std::string out = fmt::format("TAP version 14\n1..{}\n", tests.size());
    for (std::size_t i = 0; i < tests.size(); ++i) {
        std::string name = escaped(tests[i].name);
        std::ranges::replace(name, '#', '_');  // which would begin a directive
        out += fmt::format("{}ok {} - {}\n", results[i].faults.empty() ? "" : "not ", i + 1, name);
        if (results[i].faults.empty()) continue;
        out += "  ---\n  faults:\n";
        for (const std::string& fault : results[i].faults)
            out += fmt::format("    - \"{}\"\n", escaped(fault, Escapes::kJson));
        out += "  ...\n";
    }
    return out;
}

std::string results_as_junit(const std::vector<GraphTest>& tests, const std::vector<TestResult>& results) {
    std::string out = fmt::format(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n"
        "  <testsuite name=\"keyline\" tests=\"{}\" failures=\"{}\">\n",
        tests.size(), failed(results));
    for (std::size_t i = 0; i < tests.size(); ++i) {
        out += fmt::format("    <testcase classname=\"{}\" name=\"{}\" time=\"{:.3f}\"",
                           for_xml(tests[i].file), for_xml(tests[i].name), results[i].seconds);
        if (results[i].faults.empty()) {
            out += "/>\n";
            continue;
        }
        out += ">\n";
        for (const std::string& fault : results[i].faults)
            out += fmt::format("      <failure message=\"{}\"/>\n", for_xml(fault));
        out += "    </testcase>\n";
    }
    return out + "  </testsuite>\n</testsuites>\n";
}

std::string untouched_text(const std::vector<GraphTest>& tests, const std::vector<TestResult>& results) {
    std::string out;
    for (const auto& [file, reach] : reach_of(tests, results)) {
        if (const auto left = left_of(reach.nodes, reach.reached); !left.empty())
            out += fmt::format("{}: no test reaches {}\n", escaped(file), listed(left));
        if (const auto left = left_of(reach.branches, reach.taken); !left.empty())
            out += fmt::format("{}: no test has {}\n", escaped(file), joined(left));
    }
    for (const auto& [type, names] : parameters_not_given(results))
        out += fmt::format("{}: no test gives {}\n", type, listed(names));
    return out;
}

}  // namespace keyline::cli
