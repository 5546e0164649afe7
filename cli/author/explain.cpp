// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/author/commands.h"
#include "cli/common/explanations.h"
#include "cli/common/report.h"
#include "engine/base/error.h"

#include <algorithm>
#include <fmt/format.h>
#include <memory>
#include <string>
#include <vector>

namespace keyline::cli {

namespace {

// Broken into lines that a terminal shows whole.
std::string filled(std::string_view text) {
    constexpr std::size_t kWidth = 80;
    std::string out;
    std::size_t used = 0;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find(' '), text.size());
        const std::string_view word = text.substr(0, end);
        const bool fits = used + 1 + word.size() <= kWidth;
        if (used > 0) out += fits ? ' ' : '\n';
        used = used > 0 && fits ? used + 1 + word.size() : word.size();
        out += word;
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return out + "\n";
}

std::string command_of(const Explanation& e) {
    return fmt::format("keyline check graph.json{}{}", e.option.empty() ? "" : " ", e.option);
}

std::string text_of(const Explanation& e) {
    std::string out = fmt::format("{}: {}\n\n{}\n{}", e.code, e.title, filled(e.why), filled(e.remedy));
    if (!e.example.empty())
        out += fmt::format("\nWith this graph '{}' says so:\n\n{}\n", command_of(e), e.example);
    return out;
}

std::string list_text() {
    std::string out;
    for (const Explanation& e : explanations()) out += fmt::format("{:<20}{}\n", e.code, e.title);
    return out;
}

std::string markdown() {
    std::string out =
        "# Messages\n\nEach kind of message has a code: in brackets on a terminal, a field in `check "
        "--json`, the "
        "rule in\n`check --sarif`, the code in an editor. `keyline explain CODE` prints what stands here.\n\n"
        "Written by `keyline explain --markdown`; tests run each example.\n";
    for (const Explanation& e : explanations()) {
        out += fmt::format("\n## {}\n\n{}.\n\n{}\n{}", e.code, e.title, filled(e.why), filled(e.remedy));
        if (!e.example.empty()) out += fmt::format("\n```json\n{}\n```\n\n`{}`\n", e.example, command_of(e));
    }
    return out;
}

const Explanation& explanation_of(const std::string& code) {
    const auto all = explanations();
    const auto it = std::ranges::find(all, code, &Explanation::code);
    if (it != all.end()) return *it;
    std::vector<std::string> known;
    for (const Explanation& e : all) known.emplace_back(e.code);
    const std::string hint = did_you_mean(code, known);
    fail(ErrorKind::kGraph, "no message has the code " + in_quotes(code),
         hint.empty() ? "'keyline explain' lists them" : hint);
}

}  // namespace

void add_explain(const Command& program) {
    const Command command =
        program.add("explain", "Explain a message by its code, with an example: all codes, or one");
    const auto code = std::make_shared<std::string>();
    const auto as_markdown = std::make_shared<bool>(false);
    const Option argument =
        command.argument("CODE", *code, "As it stands in brackets behind a message: unknown-key").optional();
    command.flag("--markdown", *as_markdown, "All of them as Markdown").excludes(argument);
    command.runs([code, as_markdown] {
        print_result(*as_markdown    ? markdown()
                     : code->empty() ? list_text()
                                     : text_of(explanation_of(*code)));
        return 0;
    });
}

}  // namespace keyline::cli
