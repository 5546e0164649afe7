// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/render.h"

#include <chrono>
#include <map>
#include <string>

namespace keyline::cli {

enum class ProgressMode {
    kBar,    // one line that is drawn anew, for terminals
    kLines,  // a line a frame
    kJson,   // an object a line, warnings and errors too
    kNone,   // warnings and errors only
};

// `auto`, `bar`, `lines`, `json` or `none`.  Throws Failure (kGraph) for another word.
ProgressMode parse_progress(const std::string& word);

// Tells on standard error how a render goes.
class Progress final : public RenderObserver {
public:
    explicit Progress(ProgressMode mode) : mode_(mode) {}

    void start(std::size_t frames);
    void end();
    void stopped(const std::string& signal);  // after end(), where it came before the last frame's

    void frame_started(int frame, const Plan& plan) override;
    void frame_ended(int frame, FrameOutcome outcome) override;
    void warning(const Error& warning) override;
    void error(const Error& error) override;

private:
    using Clock = std::chrono::steady_clock;

    void draw_bar(const std::string& now);
    void clear_bar();
    void print(const char* event, const std::string& text);
    std::size_t ended() const { return done_ + skipped_ + failed_; }
    std::string time_left() const;

    ProgressMode mode_;
    std::size_t frames_ = 0, done_ = 0, skipped_ = 0, failed_ = 0;
    Clock::time_point start_;
    std::map<int, Clock::time_point> at_work_;  // frames, and when each was begun; they overlap
    bool bar_drawn_ = false;
};

}  // namespace keyline::cli
