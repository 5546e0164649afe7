// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"

#include <chrono>
#include <cstdint>
#include <fstream>
#include <map>
#include <mutex>
#include <string>
#include <tuple>

namespace KEYLINE_API keyline {

// What a piece of work was.
enum class Activity { kRead, kLoad, kCompute, kMap, kKeep, kEncode, kMakeData, kFinish };
const char* activity_name(Activity activity);

using Clock = std::chrono::steady_clock;

// One piece of work of one thread.
struct Event {
    Activity activity = Activity::kCompute;
    std::string title;  // "node 'a' (gaussian)"
    int frame = 0, sweep = 0, worker = 0;
    Clock::time_point begin, end;
    int64_t pixels = 0;  // that it computed, decoded or encoded
    int64_t wanted = 0;  // of those, inside the tile: the others are its neighbours' too
    int64_t bytes = 0;   // of samples that it decoded or encoded
};

// Where the time of a render went: every event goes into a file as it comes, which is then a trace that
// chrome://tracing and Perfetto show; their sums are kept.  Safe from any thread.
class Recorder {
public:
    // Throws Failure (kOutput) where the file can't be made.
    explicit Recorder(std::string trace);

    void add(const Event& event);

    // Ends the trace.  Throws Failure (kOutput) where it could not be written whole.
    void finish();

    // A line a node and activity of each sweep, the costliest first: time over all threads, share, pixels,
    // the share of pixels computed more than once, and the samples' bytes.
    std::string table() const;

private:
    struct Total {
        int64_t calls = 0, pixels = 0, wanted = 0, bytes = 0;
        double seconds = 0;
    };
    using Key = std::tuple<int, Activity, std::string>;  // sweep, activity, title

    mutable std::mutex mutex_;
    std::map<Key, Total> totals_;
    const std::string name_;
    std::ofstream trace_;
    const Clock::time_point start_ = Clock::now();
};

// Records the time from here to the end of the scope; does nothing without a recorder.
class Timed {
public:
    Timed(Recorder* recorder, Activity activity, const std::string& title, int frame, int sweep, int worker);
    ~Timed();
    Timed(const Timed&) = delete;
    Timed& operator=(const Timed&) = delete;

    void pixels(int64_t computed, int64_t wanted) {
        event_.pixels = computed;
        event_.wanted = wanted;
    }
    void bytes(int64_t samples) { event_.bytes = samples; }

private:
    Recorder* recorder_;
    Event event_;
};

}  // namespace keyline
