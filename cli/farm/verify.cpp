// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/run/verify.h"

#include "cli/common/frames.h"
#include "cli/common/options.h"
#include "cli/common/report.h"
#include "cli/farm/commands.h"
#include "engine/base/text.h"
#include "engine/json/json_writer.h"
#include "engine/params/frames.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace keyline::cli {

namespace {

constexpr std::array kStates{OutputState::kCurrent, OutputState::kStale, OutputState::kDamaged,
                             OutputState::kMissing, OutputState::kForeign};

// Of outputs that are not all current, which is no fault of the program's.
constexpr int kNotCurrent = 1;

struct VerifyArguments {
    GraphArguments graph;
    std::string list;  // which frames to name; empty: the outputs are told one by one
    bool json = false, hashes = false;
};

// The states of --list.
std::set<OutputState> parse_list(const std::string& text) {
    std::set<OutputState> out;
    std::vector<std::string> words;
    for (const OutputState s : kStates) words.emplace_back(output_state_name(s));
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find(',', begin), text.size());
        const std::string word = text.substr(begin, end - begin);
        const auto found = std::ranges::find(words, word);
        if (found == words.end())
            fail(ErrorKind::kGraph,
                 fmt::format("{} must be some of {}, joined by commas", in_quotes(word), listed(words)),
                 did_you_mean(word, words));
        out.insert(kStates[static_cast<std::size_t>(found - words.begin())]);
        begin = end + 1;
    }
    return out;
}

// Tells of outputs, one by one.
class Teller {
public:
    explicit Teller(const VerifyArguments& arguments) : arguments_(arguments) {
        if (!arguments.list.empty()) listed_ = parse_list(arguments.list);
        if (arguments.json) json_.begin_object().key("outputs").begin_array();
    }

    void tell(const Verdict& v) {
        ++counts_[v.state];
        if (listed_.contains(v.state) && (frames_.empty() || frames_.back() != v.frame))
            frames_.push_back(v.frame);
        if (arguments_.json)
            write(v);
        else if (arguments_.list.empty())
            print_result(text_of(v));
    }

    void end() {
        if (!arguments_.json)
            return print_result(arguments_.list.empty() ? summary() + "\n"
                                : frames_.empty()       ? ""
                                                        : format_frames(frames_) + "\n");
        json_.end_array();
        for (const OutputState s : kStates) json_.field(output_state_name(s), counts_[s]);
        print_result(json_.end_object().text() + "\n");
    }

    bool all_current() {
        return std::ranges::all_of(
            counts_, [](const auto& c) { return c.first == OutputState::kCurrent || c.second == 0; });
    }

private:
    static std::string text_of(const Verdict& v) {
        std::string out = fmt::format("{}: {}", escaped(v.file.string()), output_state_name(v.state));
        for (std::size_t i = 0; i < v.reasons.size(); ++i)
            out += (i == 0 ? ": " : "; ") + escaped(v.reasons[i]);
        out += '\n';
        for (const ChannelHash& h : v.hashes)
            out += fmt::format("  {} {}\n", to_string(h.samples), escaped(h.channel));
        return out;
    }

    void write(const Verdict& v) {
        json_.begin_object().field("frame", v.frame).field("node", v.node).field("file", v.file.string());
        json_.field("state", output_state_name(v.state)).key("reasons").list(v.reasons);
        if (!v.hashes.empty()) {
            json_.key("hashes").begin_object();
            for (const ChannelHash& h : v.hashes) json_.field(h.channel, to_string(h.samples));
            json_.end_object();
        }
        json_.end_object();
    }

    std::string summary() {
        int all = 0;
        std::string parts;
        for (const OutputState s : kStates) {
            all += counts_[s];
            if (counts_[s] > 0)
                parts += fmt::format("{} {} {}", parts.empty() ? "" : ",", counts_[s], output_state_name(s));
        }
        return fmt::format("{} output{}:{}", all, all == 1 ? "" : "s", parts.empty() ? " none" : parts);
    }

    const VerifyArguments& arguments_;
    std::set<OutputState> listed_;
    std::vector<int> frames_;  // those that --list asks for
    std::map<OutputState, int> counts_;
    JsonWriter json_{JsonWriter::Style::kIndented};
};

int run(const VerifyArguments& arguments) {
    Diagnostics diagnostics;
    LoadedGraph loaded = load_graph(arguments.graph, diagnostics);
    if (loaded.graph && !loaded.no_frames)
        loaded.options.frames = frames_to_render(*loaded.graph, loaded.options.frames, diagnostics);
    bool all_current = true;
    if (diagnostics.ok()) {
        Teller teller(arguments);
        verify(*loaded.graph, loaded.options, arguments.hashes, diagnostics,
               [&](const Verdict& v) { teller.tell(v); });
        teller.end();
        all_current = teller.all_current();
    }
    report(diagnostics);
    return !diagnostics.ok() ? exit_status(diagnostics) : all_current ? 0 : kNotCurrent;
}

}  // namespace

void add_verify(const Command& program) {
    const Command command = program.add(
        "verify",
        "Tell which outputs are whole and made by this graph from these inputs; status 1 where some are not");
    const auto arguments = std::make_shared<VerifyArguments>();
    add_graph_options(command, arguments->graph);
    command.option("--threads", arguments->graph.threads, "N",
                   "Worker threads; all cores that the task may use when absent");
    command.option("--list", arguments->list, "STATES",
                   "Print just the frames of these outputs, as --frames takes them: some of current, stale, "
                   "damaged, missing, foreign, joined by commas");
    command.flag("--json", arguments->json, "As JSON: an object with a list of the outputs");
    command.flag("--hashes", arguments->hashes, "Show the samples' hash of every channel too");
    command.runs([arguments] { return run(*arguments); });
}

}  // namespace keyline::cli
