// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/render/ending.h"

#include "engine/params/frames.h"

#include <algorithm>
#include <fmt/format.h>

namespace keyline::cli {

Ending ending_of(const std::optional<Error>& cause) {
    if (!cause) return {};
    return {exit_status(*cause), cause->passing != Passing::kNever, std::string(reason_of(*cause))};
}

std::string last_line(const Ending& ending, const std::vector<int>& frames) {
    std::string list = frames.empty() ? "-" : format_frames(frames);
    std::erase(list, ' ');
    return fmt::format("keyline: {} frames={} retry={} reason={}", ending.status == 0 ? "done" : "failed",
                       list, ending.retry ? "yes" : "no", ending.reason);
}

void FrameBooks::set(int frame, bool is_there) {
    for (std::size_t tried = 0; tried < frames_.size(); ++tried, ++next_) {
        if (next_ >= frames_.size()) next_ = 0;
        if (frames_[next_] != frame) continue;
        is_there_[next_] = is_there;
        return;
    }
}

std::vector<int> FrameBooks::missing() const {
    std::vector<int> out;
    for (std::size_t i = 0; i < frames_.size(); ++i)
        if (!is_there_[i]) out.push_back(frames_[i]);
    return out;
}

}  // namespace keyline::cli
