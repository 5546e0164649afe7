// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/progress.h"

#include "cli/report.h"
#include "engine/json_writer.h"

#include <cstdio>
#include <fmt/format.h>
#include <unistd.h>

namespace keyline::cli {

namespace {

constexpr std::size_t kBarWidth = 30;

const char* outcome_name(FrameOutcome outcome) {
    switch (outcome) {
        case FrameOutcome::kDone: return "done";
        case FrameOutcome::kSkipped: return "skipped";
        case FrameOutcome::kFailed: break;
    }
    return "failed";
}

std::string seconds_text(double seconds) {
    if (seconds < 60) return fmt::format("{:.2f} s", seconds);
    const auto whole = static_cast<int>(seconds);
    if (whole < 3600) return fmt::format("{}:{:02}", whole / 60, whole % 60);
    return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

ProgressMode parse_progress(const std::string& word) {
    static const std::vector<std::string> words{"auto", "bar", "lines", "json", "none"};
    if (word == "auto") return isatty(STDERR_FILENO) ? ProgressMode::kBar : ProgressMode::kLines;
    if (word == "bar") return ProgressMode::kBar;
    if (word == "lines") return ProgressMode::kLines;
    if (word == "json") return ProgressMode::kJson;
    if (word == "none") return ProgressMode::kNone;
    fail(ErrorKind::kGraph, "it must be one of " + listed(words), did_you_mean(word, words));
}

void Progress::start(std::size_t frames) {
    frames_ = frames;
    start_ = Clock::now();
    if (mode_ == ProgressMode::kJson)
        print_message(
            JsonWriter().begin_object().field("event", "start").field("frames", frames).end_object().text());
}

void Progress::frame_started(int frame, const Plan& plan) {
    at_work_[frame] = Clock::now();
    if (mode_ == ProgressMode::kBar) draw_bar(fmt::format("frame {}", frame));
    if (mode_ != ProgressMode::kJson) return;
    JsonWriter json;
    json.begin_object().field("event", "frame_started").field("frame", frame).key("outputs").begin_array();
    for (const Sink& sink : plan.frame.sinks) json.value(sink.request.file.string());
    print_message(json.end_array().end_object().text());
}

void Progress::frame_ended(int frame, FrameOutcome outcome) {
    const auto begun = at_work_.find(frame);
    const double seconds = begun == at_work_.end() ? 0 : seconds_since(begun->second);
    at_work_.erase(frame);
    switch (outcome) {
        case FrameOutcome::kDone: ++done_; break;
        case FrameOutcome::kSkipped: ++skipped_; break;
        case FrameOutcome::kFailed: ++failed_; break;
    }
    if (mode_ == ProgressMode::kBar) draw_bar(fmt::format("frame {} {}", frame, outcome_name(outcome)));
    if (mode_ == ProgressMode::kLines)
        print_message(fmt::format("frame {}: {} in {} ({} of {})", frame, outcome_name(outcome),
                                  seconds_text(seconds), ended(), frames_));
    if (mode_ == ProgressMode::kJson)
        print_message(JsonWriter()
                          .begin_object()
                          .field("event", "frame_ended")
                          .field("frame", frame)
                          .field("outcome", outcome_name(outcome))
                          .field("seconds", seconds)
                          .field("ended", ended())
                          .field("frames", frames_)
                          .end_object()
                          .text());
}

void Progress::end() {
    clear_bar();
    const double seconds = seconds_since(start_);
    if (mode_ == ProgressMode::kJson)
        print_message(JsonWriter()
                          .begin_object()
                          .field("event", "end")
                          .field("done", done_)
                          .field("skipped", skipped_)
                          .field("failed", failed_)
                          .field("seconds", seconds)
                          .end_object()
                          .text());
    else if (mode_ != ProgressMode::kNone && ended() > 0 && frames_ > 1)
        print_message(fmt::format(
            "{} of {} frames done, {} skipped, {} failed, in {}{}", done_, frames_, skipped_, failed_,
            seconds_text(seconds),
            done_ > 0 ? fmt::format(", {} a frame", seconds_text(seconds / static_cast<double>(done_)))
                      : ""));
}

void Progress::stopped(const std::string& signal) {
    if (mode_ == ProgressMode::kJson)
        print_message(JsonWriter()
                          .begin_object()
                          .field("event", "stopped")
                          .field("signal", signal)
                          .end_object()
                          .text());
    else
        print_message(fmt::format("stopped by {}; no unfinished output is left", signal));
}

void Progress::warning(const Error& warning) { print("warning", warning.warning_text()); }
void Progress::error(const Error& error) { print("error", error.text()); }

void Progress::print(const char* event, const std::string& text) {
    clear_bar();
    if (mode_ == ProgressMode::kJson)
        print_message(
            JsonWriter().begin_object().field("event", event).field("text", text).end_object().text());
    else
        print_message(text);
}

std::string Progress::time_left() const {
    if (ended() == 0 || ended() == frames_) return "";
    const double a_frame = seconds_since(start_) / static_cast<double>(ended());
    return fmt::format(", {} left", seconds_text(a_frame * static_cast<double>(frames_ - ended())));
}

void Progress::draw_bar(const std::string& now) {
    const std::size_t full = frames_ == 0 ? 0 : kBarWidth * ended() / frames_;
    const std::string line = fmt::format("\r\x1b[K[{:=<{}}{: <{}}] {} of {}, {}{}", "", full, "",
                                         kBarWidth - full, ended(), frames_, now, time_left());
    std::fwrite(line.data(), 1, line.size(), stderr);
    bar_drawn_ = true;
}

void Progress::clear_bar() {
    if (bar_drawn_) std::fputs("\r\x1b[K", stderr);
    bar_drawn_ = false;
}

}  // namespace keyline::cli
