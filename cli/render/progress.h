// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cli/render/voice.h"

#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace keyline::cli {

// Keeps the books of a render and has a voice tell on standard error how it goes.
class Progress final : public RenderObserver {
public:
    explicit Progress(std::unique_ptr<Voice> voice) : voice_(std::move(voice)) {}
    ~Progress() override { rest(); }
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    void expect(std::vector<int> frames);  // those that are to be rendered

    // From now on nothing is silent for longer than this, or than the voice's patience: some managers kill
    // what is.  Without a thread for it, where the system lets start none, only what happens is told.
    void keep_talking(std::optional<std::chrono::milliseconds> patience);

    void start();
    void stopped(const std::string& signal);
    // The last thing that is told, whether or not a render was started.  `untried`: the frames that a failed
    // one kept from being rendered.
    void end(const Ending& ending, const std::vector<int>& untried = {});

    void frame_started(int frame, const Plan& plan) override;
    void frame_ended(int frame, FrameOutcome outcome) override;
    void frame_lost(int frame, FrameOutcome was) override;
    void frame_went_on(int frame, double part) override;
    void frame_waits(int frame, const Error& for_what) override;
    void warning(const Error& warning) override;
    void error(const Error& error) override;

private:
    std::unique_lock<std::mutex> speak();
    void beat(std::chrono::milliseconds patience);
    void rest();

    std::mutex mutex_;  // the render's threads and the one that keeps talking
    const std::unique_ptr<Voice> voice_;
    RunBooks books_;
    RunBooks::Clock::time_point last_word_ = RunBooks::Clock::now();
    std::condition_variable at_rest_;
    bool rests_ = false;
    std::thread talking_;
};

}  // namespace keyline::cli
