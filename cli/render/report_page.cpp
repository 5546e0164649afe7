// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/common/base64.h"
#include "cli/render/run_report.h"
#include "engine/params/frames.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <functional>

// The report as one page: what failed first, where the time and the memory went, and what the frames look
// like.

namespace keyline::cli {

namespace {

constexpr std::size_t kMostThumbnails = 240;  // some 4 KB each
constexpr std::size_t kMostColumns = 440;     // of a plot

constexpr const char* kHead = R"(<!doctype html>
<html lang="en">
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>{0}</title>
<style>
:root {{ color-scheme: light; font: 15px/1.45 system-ui, sans-serif; color: #1c1d21; background: #f6f6f4 }}
body {{ max-width: 1000px; margin: 2rem auto; padding: 0 1rem }}
h1 {{ font-size: 1.5rem; margin: 0 }}
h2 {{ font-size: 1.05rem; margin: 2rem 0 .6rem }}
.sum {{ color: #5b5d66; margin: .2rem 0 0 }}
.done, .failed {{ font-weight: 600 }}
.done {{ color: #1b6e3c }}
.failed {{ color: #b3261e }}
.fault {{ background: #fff; border-left: 4px solid #b3261e; padding: .5rem .8rem; margin: .4rem 0 }}
.fault p {{ margin: .15rem 0; font-family: ui-monospace, monospace; font-size: .82rem; overflow-wrap: anywhere }}
svg {{ display: block; width: 100%; height: auto; background: #fff; margin: .4rem 0 }}
svg text {{ font: 11px system-ui, sans-serif; fill: #5b5d66 }}
.sheet {{ display: grid; grid-template-columns: repeat(auto-fill, minmax(160px, 1fr)); gap: 10px }}
figure {{ margin: 0; background: #fff; padding: 5px }}
figure img, figure div {{ display: block; width: 100%; aspect-ratio: 16 / 9; object-fit: contain; background: #24252b }}
figure div {{ display: grid; place-items: center; background: #f4d9d7; color: #b3261e; font-weight: 600 }}
figcaption {{ font-size: .78rem; color: #5b5d66; padding-top: 3px }}
</style>
)";

std::string html(std::string_view text) {
    std::string out;
    for (const char c : text) {
        switch (c) {
            case '&': out += "&amp;"; break;
            case '<': out += "&lt;"; break;
            case '>': out += "&gt;"; break;
            case '"': out += "&quot;"; break;
            default: out += c;
        }
    }
    return out;
}

double megabytes(std::size_t bytes) { return static_cast<double>(bytes) / (1 << 20); }

bool has_failed(const FrameReport& f) { return f.outcome == "failed" || f.outcome == "lost"; }

std::string head(const RunReport& report) {
    const std::string name = std::filesystem::path(report.graph).filename().string();
    const auto count = [&](const std::function<bool(const FrameReport&)>& is) {
        return std::ranges::count_if(report.frames, is);
    };
    const bool good = report.ending.status == 0;
    std::string out = fmt::format(kHead, html(name));
    out += fmt::format("<h1>{} <span class=\"{}\">{}</span></h1>\n", html(name), good ? "done" : "failed",
                       good ? "done" : "failed: " + html(report.ending.reason));
    out += fmt::format(
        "<p class=\"sum\">{} frames: {} done, {} skipped, {} failed, {} not tried, in {:.1f} s and {:.0f} MB "
        "at most{}</p>\n",
        report.frames.size(), count([](const auto& f) { return f.outcome == "done"; }),
        count([](const auto& f) { return f.outcome == "skipped"; }), count(has_failed),
        count([](const auto& f) { return f.outcome == "untried"; }), report.seconds,
        megabytes(report.memory()), report.ending.retry ? "; another try may help" : "");
    return out;
}

std::string faults(const RunReport& report, const char* title, bool (*is)(const FrameReport&),
                   std::vector<std::string> FrameReport::*texts) {
    std::string out;
    for (const FrameReport& f : report.frames) {
        if (!is(f)) continue;
        out += fmt::format("<div class=\"fault\"><b>Frame {}</b>", f.frame);
        for (const std::string& text : f.*texts) out += fmt::format("<p>{}</p>", html(text));
        out += "</div>\n";
    }
    return out.empty() ? "" : fmt::format("<h2>{}</h2>\n{}", title, out);
}

// Columns over the frames in their order; of many frames, the highest of those that share a column.
class Plot {
public:
    Plot(const RunReport& report, const std::function<double(const FrameReport&)>& value) : report_(report) {
        const std::size_t frames = report.frames.size(), columns = std::min(frames, kMostColumns);
        values_.resize(columns);
        failed_.resize(columns);
        for (std::size_t i = 0; i < frames; ++i) {
            const std::size_t column = i * columns / frames;
            values_[column] = std::max(values_[column], value(report.frames[i]));
            failed_[column] = failed_[column] || has_failed(report.frames[i]);
        }
        if (!values_.empty()) most_ = std::max(1e-9, *std::ranges::max_element(values_));
    }

    std::string svg(const char* title, const char* unit, const char* color) const {
        std::string good, bad;
        for (std::size_t i = 0; i < values_.size(); ++i)
            (failed_[i] ? bad : good) += fmt::format("M{:.1f} {}V{:.1f}", x(i), kBottom, y(i));
        const double width = std::max(1.0, 0.75 * (kRight - kLeft) / static_cast<double>(values_.size()));
        return fmt::format(
            "<svg viewBox=\"0 0 960 170\" role=\"img\"><title>{0}</title>"
            "<text x=\"{1}\" y=\"16\">{0}</text>"
            "<path d=\"M{1} {2:.1f}H{3}M{1} {4:.1f}H{3}M{1} {5}H{3}\" stroke=\"#e3e3df\" fill=\"none\"/>"
            "<text x=\"{6}\" y=\"{7:.1f}\" text-anchor=\"end\">{8:.3g} {9}</text>"
            "<text x=\"{6}\" y=\"{10}\" text-anchor=\"end\">0</text>"
            "<path d=\"{11}\" stroke=\"{12}\" stroke-width=\"{13:.2f}\" fill=\"none\"/>"
            "<path d=\"{14}\" stroke=\"#b3261e\" stroke-width=\"{13:.2f}\" fill=\"none\"/>"
            "<text x=\"{1}\" y=\"164\">frame {15}</text>"
            "<text x=\"{3}\" y=\"164\" text-anchor=\"end\">{16}</text></svg>\n",
            title, kLeft, level(1), kRight, level(0.5), kBottom, kLeft - 6, level(1) + 4, most_, unit,
            kBottom + 4, good, color, width, bad, report_.frames.front().frame, report_.frames.back().frame);
    }

private:
    static constexpr int kLeft = 70, kRight = 950, kTop = 30, kBottom = 146;

    static double level(double part) { return kBottom - part * (kBottom - kTop); }
    double x(std::size_t i) const {
        return kLeft +
               (static_cast<double>(i) + 0.5) * (kRight - kLeft) / static_cast<double>(values_.size());
    }
    // What failed at once is seen too.
    double y(std::size_t i) const {
        return std::min(level(values_[i] / most_), failed_[i] ? kBottom - 4.0 : kBottom);
    }

    const RunReport& report_;
    std::vector<double> values_;
    std::vector<bool> failed_;
    double most_ = 1;
};

std::string plots(const RunReport& report) {
    if (report.frames.empty()) return "";
    return "<h2>Time and memory</h2>\n" +
           Plot(report, [](const FrameReport& f) { return f.seconds; })
               .svg("Seconds a frame", "s", "#2f6db3") +
           Plot(report, [](const FrameReport& f) {
               return megabytes(f.memory);
           }).svg("Memory of the process while the frame was at work", "MB", "#7a5aa6");
}

std::string figure(const FrameReport& f, const std::string& picture) {
    const std::string shown = has_failed(f)
                                  ? "<div>" + html(f.outcome) + "</div>"
                                  : fmt::format("<img alt=\"frame {}\" src=\"data:image/jpeg;base64,{}\">",
                                                f.frame, base64(picture));
    return fmt::format("<figure>{}<figcaption>frame {} · {:.2f} s</figcaption></figure>\n", shown, f.frame,
                       f.seconds);
}

std::string sheet(const RunReport& report) {
    const std::map<int, std::string> pictures = thumbnails_of(report, kMostThumbnails);
    std::string failed, good;
    std::size_t failures = 0;
    for (const FrameReport& f : report.frames) {
        if (has_failed(f) && failures++ < kMostThumbnails) failed += figure(f, "");
        if (const auto picture = pictures.find(f.frame); picture != pictures.end() && f.is_there())
            good += figure(f, picture->second);
    }
    const bool all = pictures.size() + failures >= report.frames.size();
    return fmt::format("<h2>Frames{}</h2>\n<div class=\"sheet\">\n{}{}</div>\n",
                       all ? "" : fmt::format(", {} of {}", pictures.size(), report.frames.size()), failed,
                       good);
}

}  // namespace

std::string report_page(const RunReport& report) {
    return head(report) + faults(report, "Failed", has_failed, &FrameReport::errors) + plots(report) +
           sheet(report) +
           faults(
               report, "Warnings", [](const FrameReport& f) { return !f.warnings.empty(); },
               &FrameReport::warnings) +
           "</html>\n";
}

}  // namespace keyline::cli
