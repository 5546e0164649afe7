// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cli/render/ending.h"
#include "engine/run/verify.h"

#include <chrono>
#include <cstddef>
#include <map>
#include <string>
#include <thread>
#include <unordered_map>
#include <vector>

// What became of each frame of a render, for `--report`.

namespace keyline::cli {

struct FrameReport {
    int frame = 0;
    std::string outcome = "untried";
    double seconds = 0;
    std::size_t memory = 0;   // bytes that the process held at most while the frame was at work
    std::size_t planned = 0;  // bytes that its plan said
    std::vector<std::string> warnings, errors;
    std::vector<Verdict> outputs;  // as they lie there at the end; of frames that were done or skipped

    bool is_there() const { return outcome == "done" || outcome == "skipped"; }
};

struct RunReport {
    std::string graph;  // its file
    std::vector<FrameReport> frames;
    Ending ending;
    double seconds = 0;

    std::size_t memory() const;  // of all frames the most
};

// Hears of a render, keeps the report, and passes everything on.
class Reporter final : public RenderObserver {
public:
    Reporter(RenderObserver& listener, std::string graph, const std::vector<int>& frames);

    // Looks at the outputs once more, and ends the report; of a run that was stopped there is no time for
    // that.
    RunReport finish(const Graph& graph, const RenderOptions& options, const Ending& ending);

    void frame_started(int frame, const Plan& plan) override;
    void frame_ended(int frame, FrameOutcome outcome) override;
    void frame_lost(int frame, FrameOutcome was) override;
    void frame_went_on(int frame, double part) override { listener_.frame_went_on(frame, part); }
    void frame_waits(int frame, const Error& for_what) override { listener_.frame_waits(frame, for_what); }
    void warning(const Error& warning) override;
    void error(const Error& error) override;

private:
    using Clock = std::chrono::steady_clock;
    struct Told {
        std::vector<std::string> warnings, errors;
    };

    FrameReport& at(int frame) { return report_.frames[positions_.at(frame)]; }
    void take_memory();
    void take_told(FrameReport& frame);

    RenderObserver& listener_;
    RunReport report_;
    std::unordered_map<int, std::size_t> positions_;  // by frame
    std::map<int, Clock::time_point> at_work_;        // frames, and since when
    // What was told before the frame was named that it is about, which the same thread does next.
    std::map<std::thread::id, Told> told_;
    const Clock::time_point begun_ = Clock::now();
};

// As JSON, or as a page of HTML that stands by itself, as the file's extension says.  Throws Failure (kGraph)
// for another extension.
void check_report_name(const std::string& file);
void write_report(const RunReport& report, const std::string& file);

std::string report_json(const RunReport& report);
std::string report_page(const RunReport& report);

// JPEG, by frame: of an even choice of the frames, those of one output.
std::map<int, std::string> thumbnails_of(const RunReport& report, std::size_t most);

}  // namespace keyline::cli
