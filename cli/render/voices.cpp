// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/common/report.h"
#include "cli/render/voice.h"
#include "engine/json/json_writer.h"
#include "engine/params/frames.h"

#include <array>
#include <cstdio>
#include <cstdlib>
#include <fmt/format.h>
#include <string_view>
#include <unistd.h>

namespace keyline::cli {

double seconds_since(RunBooks::Clock::time_point start) {
    return std::chrono::duration<double>(RunBooks::Clock::now() - start).count();
}

std::string seconds_text(double seconds) {
    if (seconds < 60) return fmt::format("{:.2f} s", seconds);
    const auto whole = static_cast<int>(seconds);
    if (whole < 3600) return fmt::format("{}:{:02}", whole / 60, whole % 60);
    return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

std::string outcome_name(FrameOutcome outcome) {
    switch (outcome) {
        case FrameOutcome::kDone: return "done";
        case FrameOutcome::kSkipped: return "skipped";
        case FrameOutcome::kFailed: break;
    }
    return "failed";
}

double RunBooks::seconds() const { return seconds_since(start); }

double RunBooks::part() const {
    if (frames == 0) return 0;
    double parts = static_cast<double>(ended());
    for (const auto& [frame, work] : at_work) parts += work.part;
    return parts / static_cast<double>(frames);
}

void Voice::warning(const Error& warning) { print_warning(warning); }
void Voice::error(const Error& error) { print_error(error); }

void Voice::frame_waits(int frame, const std::string& for_what) {
    print_message(fmt::format("frame {} waits: {}", frame, for_what));
}

void Voice::stopped(const std::string& signal) {
    print_message(fmt::format("stopped by {}; no unfinished output is left", signal));
}

void Voice::end(const RunBooks& books, const Ending& ending, const std::vector<int>&) {
    print_message(last_line(ending, ending.status == 0 ? books.list.all() : books.list.missing()));
}

namespace {

// Warnings, errors and the last line only.
class NoVoice final : public Voice {
    void frame_waits(int, const std::string&) override {}
};

// A line a frame.
class LinesVoice : public Voice {
public:
    void frame_ended(const RunBooks& books, int frame, FrameOutcome outcome, double seconds) override {
        print_message(fmt::format("frame {}: {} in {} ({} of {})", frame, outcome_name(outcome),
                                  seconds_text(seconds), books.ended(), books.frames));
    }
    void beat(const RunBooks& books) override {
        for (const auto& [frame, work] : books.at_work)
            print_message(fmt::format("frame {}: {:.0f} % after {}", frame, 100 * work.part,
                                      seconds_text(seconds_since(work.begun))));
    }
    void end(const RunBooks& books, const Ending& ending, const std::vector<int>& untried) override {
        if (books.ended() > 0 && books.frames > 1) print_summary(books, untried);
        Voice::end(books, ending, untried);
    }

private:
    static void print_summary(const RunBooks& books, const std::vector<int>& untried) {
        const double seconds = books.seconds(), done = static_cast<double>(books.done);
        print_message(
            fmt::format("{} of {} frames done, {} skipped, {} failed, in {}{}{}", books.done, books.frames,
                        books.skipped, books.failed, seconds_text(seconds),
                        books.done > 0 ? fmt::format(", {} a frame", seconds_text(seconds / done)) : "",
                        untried.empty() ? "" : "; not tried: " + format_frames(untried)));
    }
};

// One line that is drawn anew, for terminals.
class BarVoice final : public LinesVoice {
public:
    void frame_started(const RunBooks& books, int frame, const Plan&) override {
        draw(books, fmt::format("frame {}", frame));
    }
    void frame_ended(const RunBooks& books, int frame, FrameOutcome outcome, double) override {
        draw(books, fmt::format("frame {} {}", frame, outcome_name(outcome)));
    }
    void beat(const RunBooks&) override {}
    void frame_waits(int frame, const std::string& for_what) override {
        clear();
        Voice::frame_waits(frame, for_what);
    }
    void warning(const Error& warning) override {
        clear();
        Voice::warning(warning);
    }
    void error(const Error& error) override {
        clear();
        Voice::error(error);
    }
    void stopped(const std::string& signal) override {
        clear();
        Voice::stopped(signal);
    }
    void end(const RunBooks& books, const Ending& ending, const std::vector<int>& untried) override {
        clear();
        LinesVoice::end(books, ending, untried);
    }

private:
    static constexpr std::size_t kWidth = 30;

    static std::string time_left(const RunBooks& books) {
        const std::size_t ended = books.ended();
        if (ended == 0 || ended == books.frames) return "";
        const double a_frame = books.seconds() / static_cast<double>(ended);
        return fmt::format(", {} left", seconds_text(a_frame * static_cast<double>(books.frames - ended)));
    }

    void draw(const RunBooks& books, const std::string& now) {
        const std::size_t full = books.frames == 0 ? 0 : kWidth * books.ended() / books.frames;
        const std::string line =
            fmt::format("\r\x1b[K[{:=<{}}{: <{}}] {} of {}, {}{}", "", full, "", kWidth - full, books.ended(),
                        books.frames, now, time_left(books));
        std::fwrite(line.data(), 1, line.size(), stderr);
        is_drawn_ = true;
    }

    void clear() {
        if (is_drawn_) std::fputs("\r\x1b[K", stderr);
        is_drawn_ = false;
    }

    bool is_drawn_ = false;
};

// "error", with what its text is made of, or "warning": that one's text alone is free of the words that
// scripts look for.
std::string event_text(std::string_view event, const Error& error) {
    JsonWriter json;
    json.begin_object().field("event", event);
    if (event == "warning")
        return json.field("text", error.warning_text()).field("code", code_of(error)).end_object().text();
    json.field("text", error.text()).field("kind", kind_name(error.kind));
    json.field("retry", error.passing != Passing::kNever).field("reason", reason_of(error));
    json.field("code", code_of(error));
    if (!error.place.file.empty()) {
        json.key("place").begin_object().field("file", error.place.file);
        if (error.place.line > 0) json.field("line", error.place.line).field("column", error.place.column);
        json.end_object();
    }
    if (!error.node.empty()) json.field("node", error.node);
    json.field("what", error.what);
    if (!error.hint.empty()) json.field("hint", error.hint);
    return json.end_object().text();
}

// An object a line, warnings and errors too.
class JsonVoice final : public Voice {
public:
    JsonVoice() {
        print_library_warnings_with([](const Error& w) { print_message(event_text("warning", w)); });
    }

    void start(const RunBooks& books) override { say(event("start").field("frames", books.frames)); }
    void frame_started(const RunBooks&, int frame, const Plan& plan) override {
        JsonWriter json = event("frame_started");
        json.field("frame", frame).key("outputs").begin_array();
        for (const Sink& sink : plan.frame.sinks) json.value(sink.request.file.string());
        say(json.end_array());
    }
    void frame_ended(const RunBooks& books, int frame, FrameOutcome outcome, double seconds) override {
        say(event("frame_ended")
                .field("frame", frame)
                .field("outcome", outcome_name(outcome))
                .field("seconds", seconds)
                .field("ended", books.ended())
                .field("frames", books.frames));
    }
    void frame_lost(int frame) override { say(event("frame_lost").field("frame", frame)); }
    void frame_waits(int frame, const std::string& for_what) override {
        say(event("frame_waits").field("frame", frame).field("for", for_what));
    }
    void beat(const RunBooks& books) override {
        for (const auto& [frame, work] : books.at_work)
            say(event("progress").field("frame", frame).field("part", work.part));
    }
    void warning(const Error& warning) override { print_message(event_text("warning", warning)); }
    void error(const Error& error) override { print_message(event_text("error", error)); }
    void stopped(const std::string& signal) override { say(event("stopped").field("signal", signal)); }
    void end(const RunBooks& books, const Ending& ending, const std::vector<int>& untried) override {
        const std::vector<int> missing = books.list.missing();
        const std::vector<int>& frames = ending.status == 0 ? books.list.all() : missing;
        JsonWriter json = event("end");
        json.field("done", books.done).field("skipped", books.skipped).field("failed", books.failed);
        json.field("untried", format_frames(untried)).field("seconds", books.seconds());
        json.field("status", ending.status).field("retry", ending.retry).field("reason", ending.reason);
        say(json.field("frames", format_frames(frames)).field("text", last_line(ending, frames)));
    }

private:
    static JsonWriter event(std::string_view name) {
        JsonWriter json;
        json.begin_object().field("event", name);
        return json;
    }
    static void say(JsonWriter& json) { print_message(json.end_object().text()); }
};

// The manager that started this process, where it says so; else a bar on a terminal, and lines.
std::string recognised() {
    struct Sign {
        const char *variable, *voice;
    };
    constexpr std::array<Sign, 4> kSigns{{{"DEADLINE_SESSIONACTION_ID", "openjd"},
                                          {"AF_TASK_ID", "afanasy"},
                                          {"TR_ENV_TID", "tractor"},
                                          {"CUE_FRAME", "lines"}}};
    for (const Sign& sign : kSigns)
        if (std::getenv(sign.variable)) return sign.voice;
    return isatty(STDERR_FILENO) != 0 ? "bar" : "lines";
}

}  // namespace

std::unique_ptr<Voice> voice_named(const std::string& word) {
    static const std::vector<std::string> words{"auto",   "bar",     "lines",   "json",     "none",
                                                "openjd", "afanasy", "tractor", "deadline", "flamenco"};
    const std::string name = word == "auto" ? recognised() : word;
    if (name == "bar") return std::make_unique<BarVoice>();
    if (name == "lines" || name == "flamenco") return std::make_unique<LinesVoice>();
    if (name == "json") return std::make_unique<JsonVoice>();
    if (name == "none") return std::make_unique<NoVoice>();
    if (auto voice = manager_voice(name)) return voice;
    fail(ErrorKind::kGraph, "it must be one of " + listed(words), did_you_mean(word, words));
}

}  // namespace keyline::cli
