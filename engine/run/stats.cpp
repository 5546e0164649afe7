// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/run/stats.h"

#include "engine/base/error.h"
#include "engine/json/json_writer.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <utility>
#include <vector>

namespace keyline {

namespace {

double seconds_between(Clock::time_point a, Clock::time_point b) {
    return std::chrono::duration<double>(b - a).count();
}

// The share of pixels that were computed more than once.
std::string again_text(int64_t pixels, int64_t wanted) {
    if (wanted == 0 || pixels <= wanted) return "";
    return fmt::format("{:.0f} %",
                       100.0 * static_cast<double>(pixels - wanted) / static_cast<double>(wanted));
}

std::string megabytes_text(int64_t bytes) {
    return bytes == 0 ? "" : fmt::format("{:.1f}", static_cast<double>(bytes) / (1 << 20));
}

constexpr std::string_view kTraceBegin = "{\"traceEvents\":";

// A graph or a picture given by mistake must not become a trace.
void refuse_other_files(const std::string& name) {
    if (!std::filesystem::is_regular_file(name)) return;
    std::ifstream file(name);
    std::string begin(kTraceBegin.size(), ' ');
    file.read(begin.data(), static_cast<std::streamsize>(begin.size()));
    if (file.gcount() > 0 && begin != kTraceBegin)
        fail(ErrorKind::kOutput, fmt::format("{} is there already, and is no profile", in_quotes(name)),
             "give --profile another file");
}

}  // namespace

const char* activity_name(Activity activity) {
    switch (activity) {
        case Activity::kRead: return "decode";
        case Activity::kLoad: return "convert";
        case Activity::kCompute: return "compute";
        case Activity::kMap: return "gather";
        case Activity::kKeep: return "store";
        case Activity::kEncode: return "encode";
        case Activity::kMakeData: return "make";
        case Activity::kFinish: break;
    }
    return "sync";
}

Recorder::Recorder(std::string trace) : name_(std::move(trace)) {
    refuse_other_files(name_);
    trace_.open(name_);
    trace_ << kTraceBegin << " [\n";
    if (!trace_) fail(ErrorKind::kOutput, "cannot write the profile " + in_quotes(name_));
}

void Recorder::add(const Event& e) {
    const double seconds = seconds_between(e.begin, e.end);
    const std::lock_guard lock(mutex_);
    Total& t = totals_[{e.sweep, e.activity, e.title}];
    ++t.calls;
    t.pixels += e.pixels;
    t.wanted += e.wanted;
    t.bytes += e.bytes;
    t.seconds += seconds;
    trace_ << fmt::format(
        "{{\"ph\": \"X\", \"pid\": {}, \"tid\": {}, \"ts\": {:.1f}, \"dur\": {:.1f}, \"cat\": \"{}\", "
        "\"name\": {}}},\n",
        e.frame, e.worker, 1e6 * seconds_between(start_, e.begin), 1e6 * seconds, activity_name(e.activity),
        JsonWriter().value(fmt::format("{} {}", activity_name(e.activity), e.title)).text());
}

void Recorder::finish() {
    const std::lock_guard lock(mutex_);
    // An entry of no length ends the list, as JSON allows no comma there.
    trace_ << fmt::format(R"({{"ph": "i", "pid": 0, "tid": 0, "ts": {:.1f}, "name": "end"}}
]}}
)",
                          1e6 * seconds_between(start_, Clock::now()))
           << std::flush;
    if (!trace_) fail(ErrorKind::kOutput, "cannot write the profile " + in_quotes(name_));
}

std::string Recorder::table() const {
    const std::lock_guard lock(mutex_);
    double all = 0;
    for (const auto& [key, t] : totals_) all += t.seconds;
    std::vector<std::pair<Key, Total>> rows(totals_.begin(), totals_.end());
    std::ranges::stable_sort(
        rows, [](const auto& a, const auto& b) { return a.second.seconds > b.second.seconds; });
    std::string out = fmt::format("{:>9}  {:>6}  {:>8}  {:>8}  {:>7}  {:>8}  {}\n", "ms", "share", "calls",
                                  "Mpixels", "again", "MiB", "what");
    for (const auto& [key, t] : rows)
        out +=
            fmt::format("{:9.1f}  {:4.1f} %  {:8}  {:8.1f}  {:>7}  {:>8}  {} {}, sweep {}\n",
                        1000 * t.seconds, 100 * t.seconds / all, t.calls, static_cast<double>(t.pixels) / 1e6,
                        again_text(t.pixels, t.wanted), megabytes_text(t.bytes),
                        activity_name(std::get<1>(key)), std::get<2>(key), std::get<0>(key) + 1);
    return out + fmt::format("{:9.1f}  in all, over all threads\n", 1000 * all);
}

Timed::Timed(Recorder* recorder, Activity activity, const std::string& title, int frame, int sweep,
             int worker)
    : recorder_(recorder) {
    if (!recorder_) return;
    event_ = {activity, title, frame, sweep, worker, Clock::now(), {}, 0, 0, 0};
}

Timed::~Timed() {
    if (!recorder_) return;
    event_.end = Clock::now();
    recorder_->add(event_);
}

}  // namespace keyline
