// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

namespace keyline {

// What a piece of work was.
enum class Activity { kRead, kLoad, kCompute, kMap, kKeep, kEncode, kEndSweep, kFinish };
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
};

// Collects the events of a render: where the time went.  Safe from any thread.
class Recorder {
public:
    void add(Event event);

    // A line a node and activity of each sweep, the costliest first: time over all threads, share, pixels,
    // and the share of pixels computed more than once.
    std::string table() const;

    // The events as a trace that chrome://tracing and Perfetto show: JSON.
    std::string chrome_trace() const;

private:
    mutable std::mutex mutex_;
    std::vector<Event> events_;
    Clock::time_point start_ = Clock::now();
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

private:
    Recorder* recorder_;
    Event event_;
};

}  // namespace keyline
