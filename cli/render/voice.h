// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cli/render/ending.h"
#include "engine/run/render.h"

#include <chrono>
#include <map>
#include <memory>
#include <string>
#include <vector>

// How a render's progress is told: a voice for each kind of reader.

namespace keyline::cli {

// What is known of a render at a moment.
struct RunBooks {
    using Clock = std::chrono::steady_clock;
    struct AtWork {
        Clock::time_point begun;
        double part = 0;  // done, 0 to 1
    };

    std::size_t frames = 0, done = 0, skipped = 0, failed = 0;
    Clock::time_point start = Clock::now();
    std::map<int, AtWork> at_work;  // frames; they overlap
    FrameBooks list;
    std::map<int, std::string> waiting;  // frames, and the inputs that they wait for

    std::size_t ended() const { return done + skipped + failed; }
    double part() const;  // of all frames, 0 to 1
    double seconds() const;
};

double seconds_since(RunBooks::Clock::time_point start);
std::string seconds_text(double seconds);
std::string outcome_name(FrameOutcome outcome);

// Every call is for one thread at a time.
class Voice {
public:
    virtual ~Voice() = default;

    // How long a reader is left without a word.
    virtual std::chrono::seconds patience() const { return std::chrono::seconds(30); }

    virtual void start(const RunBooks&) {}
    virtual void frame_started(const RunBooks&, int /*frame*/, const Plan&) {}
    virtual void frame_ended(const RunBooks&, int /*frame*/, FrameOutcome, double /*seconds*/) {}
    virtual void frame_lost(int /*frame*/) {}
    // At its begin, where it waits for something else, and again while nothing else is said.
    virtual void frame_waits(int frame, const std::string& for_what);
    virtual void beat(const RunBooks&) {}  // nothing else was said for a while
    virtual void warning(const Error& warning);
    virtual void error(const Error& error);
    virtual void stopped(const std::string& signal);
    virtual void end(const RunBooks&, const Ending&, const std::vector<int>& untried);
};

// `auto`, which recognises a render farm's manager by its environment, or the name of a voice.  Throws
// Failure (kGraph) for another word.
std::unique_ptr<Voice> voice_named(const std::string& word);

// Of the managers that read what a program says: null for another name.
std::unique_ptr<Voice> manager_voice(const std::string& name);

}  // namespace keyline::cli
