// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/render/run_report.h"

#include "cli/common/machine.h"
#include "engine/json/json_writer.h"
#include "engine/params/frames.h"

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <iterator>
#include <system_error>

namespace keyline::cli {

namespace {

void append(std::vector<std::string>& to, std::vector<std::string>& from) {
    std::ranges::move(from, std::back_inserter(to));
    from.clear();
}

double seconds_between(std::chrono::steady_clock::time_point begin) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

void write_output(JsonWriter& json, const Verdict& output) {
    json.begin_object().field("node", output.node).field("file", output.file.string());
    json.field("state", output_state_name(output.state)).key("hashes").begin_object();
    for (const ChannelHash& h : output.hashes) json.field(h.channel, to_string(h.samples));
    json.end_object().end_object();
}

void write_frame(JsonWriter& json, const FrameReport& frame) {
    json.begin_object().field("frame", frame.frame).field("outcome", frame.outcome);
    json.field("seconds", frame.seconds).field("memory", frame.memory).field("planned", frame.planned);
    json.key("warnings").list(frame.warnings).key("errors").list(frame.errors);
    json.key("outputs").begin_array();
    for (const Verdict& output : frame.outputs) write_output(json, output);
    json.end_array().end_object();
}

}  // namespace

std::size_t RunReport::memory() const {
    std::size_t most = 0;
    for (const FrameReport& f : frames) most = std::max(most, f.memory);
    return most;
}

Reporter::Reporter(RenderObserver& listener, std::string graph, const std::vector<int>& frames)
    : listener_(listener) {
    report_.graph = std::move(graph);
    for (const int frame : frames) {
        positions_[frame] = report_.frames.size();
        report_.frames.emplace_back().frame = frame;
    }
    peak_memory_since_last();
}

// Frames overlap: what the process held counts for each that is at work.
void Reporter::take_memory() {
    const std::size_t peak = peak_memory_since_last();
    for (const auto& [frame, since] : at_work_) at(frame).memory = std::max(at(frame).memory, peak);
}

void Reporter::take_told(FrameReport& frame) {
    Told& told = told_[std::this_thread::get_id()];
    append(frame.warnings, told.warnings);
    append(frame.errors, told.errors);
}

void Reporter::frame_started(int frame, const Plan& plan) {
    take_memory();
    at_work_[frame] = Clock::now();
    at(frame).planned = plan.memory_bytes;
    take_told(at(frame));
    listener_.frame_started(frame, plan);
}

void Reporter::frame_ended(int frame, FrameOutcome outcome) {
    take_memory();
    FrameReport& report = at(frame);
    report.outcome = outcome == FrameOutcome::kDone      ? "done"
                     : outcome == FrameOutcome::kSkipped ? "skipped"
                                                         : "failed";
    if (const auto since = at_work_.find(frame); since != at_work_.end())
        report.seconds = seconds_between(since->second);
    at_work_.erase(frame);
    take_told(report);
    listener_.frame_ended(frame, outcome);
}

void Reporter::frame_lost(int frame, FrameOutcome was) {
    at(frame).outcome = "lost";
    listener_.frame_lost(frame, was);
}

void Reporter::warning(const Error& warning) {
    told_[std::this_thread::get_id()].warnings.push_back(warning.warning_text());
    listener_.warning(warning);
}

void Reporter::error(const Error& error) {
    told_[std::this_thread::get_id()].errors.push_back(error.text());
    listener_.error(error);
}

RunReport Reporter::finish(const Graph& graph, const RenderOptions& options, const Ending& ending) {
    report_.ending = ending;
    report_.seconds = seconds_between(begun_);
    RenderOptions there = options;
    std::erase_if(there.frames, [&](int frame) { return !at(frame).is_there(); });
    if (there.frames.empty() || ending.reason == "stopped") return report_;
    Diagnostics diagnostics;  // what a render has told already
    verify(graph, there, true, diagnostics, [&](const Verdict& v) { at(v.frame).outputs.push_back(v); });
    return report_;
}

std::string report_json(const RunReport& report) {
    JsonWriter json(JsonWriter::Style::kIndented);
    json.begin_object().field("graph", report.graph).field("status", report.ending.status);
    json.field("retry", report.ending.retry).field("reason", report.ending.reason);
    json.field("seconds", report.seconds).field("memory", report.memory());
    json.key("frames").begin_array();
    for (const FrameReport& frame : report.frames) write_frame(json, frame);
    return json.end_array().end_object().text() + "\n";
}

void check_report_name(const std::string& file) {
    const std::string extension = std::filesystem::path(file).extension().string();
    if (extension != ".json" && extension != ".html")
        fail(ErrorKind::kGraph, "a report is a file .json or .html");
}

void write_report(const RunReport& report, const std::string& file) {
    const std::string text = file.ends_with(".json") ? report_json(report) : report_page(report);
    std::ofstream out(file, std::ios::binary);
    if (!(out << text).flush())
        fail(ErrorKind::kOutput,
             fmt::format("{}: can't be written: {}", file, std::generic_category().message(errno)));
}

}  // namespace keyline::cli
