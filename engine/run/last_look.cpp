// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/run/last_look.h"

#include "engine/base/index.h"
#include "engine/params/frames.h"

#include <fmt/format.h>
#include <map>
#include <sys/stat.h>

namespace keyline {

namespace {

constexpr uint64_t kAbsent = UINT64_MAX;

uint64_t size_of(const std::filesystem::path& file) {
    struct stat status = {};
    if (stat(file.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return kAbsent;
    return static_cast<uint64_t>(status.st_size);
}

// What became of the outputs of one sink.
struct Fate {
    std::vector<int> frames;
    std::filesystem::path file;  // of the first of them
    bool is_absent = false;
};

Error error_of(const GraphNode& node, const Fate& fate) {
    const std::string first = in_quotes(fate.file.string());
    std::string what = fate.is_absent ? first + " was written and is not there at the end of the run"
                                      : first + " was changed after it was written";
    if (fate.frames.size() > 1) what += fmt::format("; so it is with frames {}", format_frames(fate.frames));
    return {ErrorKind::kOutput, node.place, node.title(), std::move(what),
            "what is removed, renamed or changed meanwhile must be rendered again"};
}

}  // namespace

void LastLook::remember(int frame, FrameOutcome outcome) {
    const std::size_t before = sizes_.size();
    for (const OutputNames::Output& output : names_.at(frame)) sizes_.push_back(size_of(output.file));
    if (sizes_.size() > before) entries_.push_back({frame, outcome});
}

LastLook::Lost LastLook::lost() const {
    Lost out;
    std::map<int, Fate> fates;  // by sink
    std::size_t next = 0;
    for (const Entry& entry : entries_) {
        bool is_lost = false;
        for (const OutputNames::Output& output : names_.at(entry.frame)) {
            const uint64_t was = sizes_[next++], is = size_of(output.file);
            if (is == was && is != kAbsent) continue;
            Fate& fate = fates[output.sink];
            if (fate.frames.empty()) {
                fate.file = output.file;
                fate.is_absent = is == kAbsent;
            }
            fate.frames.push_back(entry.frame);
            is_lost = true;
        }
        if (is_lost) out.frames.emplace_back(entry.frame, entry.outcome);
    }
    for (const auto& [sink, fate] : fates) out.errors.push_back(error_of(graph_.nodes()[index(sink)], fate));
    return out;
}

}  // namespace keyline
