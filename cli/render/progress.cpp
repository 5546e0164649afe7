// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/render/progress.h"

#include <algorithm>
#include <system_error>

namespace keyline::cli {

std::unique_lock<std::mutex> Progress::speak() {
    std::unique_lock lock(mutex_);
    last_word_ = RunBooks::Clock::now();
    return lock;
}

void Progress::expect(std::vector<int> frames) {
    books_.frames = frames.size();
    books_.list = FrameBooks(std::move(frames));
}

void Progress::keep_talking(std::optional<std::chrono::milliseconds> patience) {
    try {
        talking_ = std::thread([this, p = patience.value_or(voice_->patience())] { beat(p); });
    } catch (const std::system_error&) {  // the render itself needs none
    }
}

void Progress::beat(std::chrono::milliseconds patience) {
    std::unique_lock lock(mutex_);
    while (!at_rest_.wait_until(lock, last_word_ + patience, [this] { return rests_; })) {
        if (RunBooks::Clock::now() < last_word_ + patience) continue;
        last_word_ = RunBooks::Clock::now();
        for (const auto& [frame, for_what] : books_.waiting) voice_->frame_waits(frame, for_what);
        voice_->beat(books_);
    }
}

void Progress::rest() {
    {
        const std::lock_guard lock(mutex_);
        rests_ = true;
    }
    at_rest_.notify_all();
    if (talking_.joinable()) talking_.join();
}

void Progress::start() {
    const auto lock = speak();
    books_.start = RunBooks::Clock::now();
    voice_->start(books_);
}

void Progress::frame_started(int frame, const Plan& plan) {
    const auto lock = speak();
    books_.waiting.erase(frame);
    books_.at_work[frame].begun = RunBooks::Clock::now();
    voice_->frame_started(books_, frame, plan);
}

void Progress::frame_ended(int frame, FrameOutcome outcome) {
    const auto lock = speak();
    const auto begun = books_.at_work.find(frame);
    const double seconds = begun == books_.at_work.end() ? 0 : seconds_since(begun->second.begun);
    books_.at_work.erase(frame);
    books_.waiting.erase(frame);
    books_.list.set(frame, outcome != FrameOutcome::kFailed);
    switch (outcome) {
        case FrameOutcome::kDone: ++books_.done; break;
        case FrameOutcome::kSkipped: ++books_.skipped; break;
        case FrameOutcome::kFailed: ++books_.failed; break;
    }
    voice_->frame_ended(books_, frame, outcome, seconds);
}

void Progress::frame_waits(int frame, const Error& for_what) {
    const auto lock = speak();
    // As a warning's: it is none, and nobody is to take it for an error.
    std::string what = Error{for_what.kind, {}, {}, for_what.what, {}}.warning_text();
    what.erase(0, std::string_view("warning: ").size());
    voice_->frame_waits(frame, books_.waiting[frame] = std::move(what));
}

void Progress::frame_lost(int frame, FrameOutcome was) {
    const auto lock = speak();
    --(was == FrameOutcome::kDone ? books_.done : books_.skipped);
    ++books_.failed;
    books_.list.set(frame, false);
    voice_->frame_lost(frame);
}

void Progress::frame_went_on(int frame, double part) {
    const std::lock_guard lock(mutex_);
    const auto work = books_.at_work.find(frame);
    if (work != books_.at_work.end()) work->second.part = std::max(work->second.part, part);
}

void Progress::end(const Ending& ending, const std::vector<int>& untried) {
    rest();
    voice_->end(books_, ending, untried);
}

void Progress::stopped(const std::string& signal) {
    const auto lock = speak();
    voice_->stopped(signal);
}

void Progress::warning(const Error& warning) {
    const auto lock = speak();
    voice_->warning(warning);
}

void Progress::error(const Error& error) {
    const auto lock = speak();
    voice_->error(error);
}

}  // namespace keyline::cli
