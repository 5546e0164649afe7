// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/error.h"

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

// How a render ended, for the programs that run it: every log's last line says it in one form.

namespace keyline::cli {

struct Ending {
    int status = 0;
    bool retry = false;           // the same command may do better
    std::string reason = "none";  // a word: reason_of() an error, or "stopped" by a signal
};

// Of a render that an error decided; of a good one where there is none.
Ending ending_of(const std::optional<Error>& cause);

// "keyline: failed frames=3,7-9 retry=yes reason=space": the frames that are not there.  Of a good render,
// "keyline: done frames=1-12 retry=no reason=none": all of them.  A "-" stands for frames that nobody named.
std::string last_line(const Ending& ending, const std::vector<int>& frames);

// Which frames of a run are there.
class FrameBooks {
public:
    explicit FrameBooks(std::vector<int> frames = {})
        : frames_(std::move(frames)), is_there_(frames_.size()) {}

    void set(int frame, bool is_there);
    std::vector<int> missing() const;
    const std::vector<int>& all() const { return frames_; }

private:
    std::vector<int> frames_;
    std::vector<bool> is_there_;
    std::size_t next_ = 0;  // where the next one is likely to stand: they end about in order
};

}  // namespace keyline::cli
