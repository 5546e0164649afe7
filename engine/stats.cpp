// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/stats.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <tuple>

namespace keyline {

namespace {

struct Total {
    int64_t calls = 0, pixels = 0, wanted = 0;
    double seconds = 0;
};

using Key = std::tuple<int, Activity, std::string>;  // sweep, activity, title

double seconds_between(Clock::time_point a, Clock::time_point b) {
    return std::chrono::duration<double>(b - a).count();
}

std::string again_text(const Total& t) {
    if (t.wanted == 0 || t.pixels <= t.wanted) return "";
    return fmt::format("{:.0f} %",
                       100.0 * static_cast<double>(t.pixels - t.wanted) / static_cast<double>(t.wanted));
}

// A JSON string: titles hold quotes of graphs' ids only, file names may hold anything.
std::string json_string(const std::string& text) {
    std::string out = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') out += '\\';
        if (static_cast<unsigned char>(c) >= 0x20) out += c;
    }
    return out + "\"";
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
        case Activity::kEndSweep: return "join";
        case Activity::kFinish: break;
    }
    return "sync";
}

void Recorder::add(Event event) {
    const std::lock_guard lock(mutex_);
    events_.push_back(std::move(event));
}

std::string Recorder::table() const {
    const std::lock_guard lock(mutex_);
    std::map<Key, Total> totals;
    double all = 0;
    for (const Event& e : events_) {
        Total& t = totals[{e.sweep, e.activity, e.title}];
        ++t.calls;
        t.pixels += e.pixels;
        t.wanted += e.wanted;
        t.seconds += seconds_between(e.begin, e.end);
        all += seconds_between(e.begin, e.end);
    }
    std::vector<std::pair<Key, Total>> rows(totals.begin(), totals.end());
    std::ranges::stable_sort(
        rows, [](const auto& a, const auto& b) { return a.second.seconds > b.second.seconds; });
    std::string out = fmt::format("{:>9}  {:>6}  {:>8}  {:>8}  {:>7}  {}\n", "ms", "share", "calls",
                                  "Mpixels", "again", "what");
    for (const auto& [key, t] : rows)
        out += fmt::format("{:9.1f}  {:4.1f} %  {:8}  {:8.1f}  {:>7}  {} {}, sweep {}\n", 1000 * t.seconds,
                           100 * t.seconds / all, t.calls, static_cast<double>(t.pixels) / 1e6, again_text(t),
                           activity_name(std::get<1>(key)), std::get<2>(key), std::get<0>(key) + 1);
    return out + fmt::format("{:9.1f}  in all, over all threads\n", 1000 * all);
}

std::string Recorder::chrome_trace() const {
    const std::lock_guard lock(mutex_);
    const auto micros = [&](Clock::time_point t) { return 1e6 * seconds_between(start_, t); };
    std::string out = "{\"traceEvents\": [\n";
    for (std::size_t i = 0; i < events_.size(); ++i) {
        const Event& e = events_[i];
        out += fmt::format(
            "{{\"ph\": \"X\", \"pid\": {}, \"tid\": {}, \"ts\": {:.1f}, \"dur\": {:.1f}, \"cat\": \"{}\", "
            "\"name\": {}}}{}\n",
            e.frame, e.worker, micros(e.begin), 1e6 * seconds_between(e.begin, e.end),
            activity_name(e.activity), json_string(fmt::format("{} {}", activity_name(e.activity), e.title)),
            i + 1 == events_.size() ? "" : ",");
    }
    return out + "]}\n";
}

Timed::Timed(Recorder* recorder, Activity activity, const std::string& title, int frame, int sweep,
             int worker)
    : recorder_(recorder) {
    if (!recorder_) return;
    event_ = {activity, title, frame, sweep, worker, Clock::now(), {}, 0, 0};
}

Timed::~Timed() {
    if (!recorder_) return;
    event_.end = Clock::now();
    recorder_->add(std::move(event_));
}

}  // namespace keyline
