// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/run/ahead.h"

#include "engine/base/error.h"

#include <algorithm>
#include <utility>

namespace keyline {

namespace {

// So many in any case, where frames of the run have something in common; and on, as long as one still has
// something in common with the frame that is planned.
constexpr std::size_t kLeast = 4, kMost = 24;

}  // namespace

Ahead::Ahead(const Graph& graph, const std::vector<int>& frames, ResolveOptions resolving,
             std::function<void(ResolvedFrame&)> drop_finished)
    : graph_(graph),
      frames_(frames),
      resolving_(std::move(resolving)),
      drop_finished_(std::move(drop_finished)) {}

std::span<const ComingFrame> Ahead::after(const ResolvedFrame& now, std::size_t next) {
    answer_.clear();
    if (!have_something_in_common_.value_or(true)) return {};
    while (!seen_.empty() && seen_.front().first < next) seen_.pop_front();
    next_ = std::max(next_, next);
    const ComingFrame self(now, demand(now));
    const auto shares = [&](const auto& seen) { return seen.second.shares_with(self); };
    look(std::min(frames_.size(), next + kLeast));
    if (!have_something_in_common_ && !seen_.empty()) {
        have_something_in_common_ = std::ranges::any_of(seen_, shares);
        if (!*have_something_in_common_) return seen_.clear(), std::span<const ComingFrame>{};
    }
    while (next_ < std::min(frames_.size(), next + kMost) && !seen_.empty() && shares(seen_.back()))
        look(next_ + 1);
    for (const auto& [position, coming] : seen_) answer_.push_back(coming);
    return answer_;
}

void Ahead::look(std::size_t end) {
    for (; next_ < end; ++next_)
        if (auto coming = resolved(frames_[next_])) seen_.emplace_back(next_, std::move(*coming));
}

// Nothing for a frame that can't be resolved now: what is wrong with it is told when its turn comes.
std::optional<ComingFrame> Ahead::resolved(int frame) const {
    try {
        Diagnostics unheard;
        auto found = resolve(graph_, frame, resolving_, unheard);
        if (!found) return std::nullopt;
        if (drop_finished_) drop_finished_(*found);
        return ComingFrame(*found, demand(*found));
    } catch (const Failure&) {
        return std::nullopt;
    }
}

}  // namespace keyline
