// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/plan/size_check.h"

#include <fmt/format.h>

namespace keyline {

namespace {

// A terabyte of samples in one picture is a slip of the keyboard.
constexpr double kMostBytes = 0x1p40;

// Overscan and lens distortion want a multiple of the displayed area, not this one; below so many pixels it
// does not matter.
constexpr double kManyTimes = 16, kManyPixels = 0x1p26;

double pixels(const Rect& window) { return static_cast<double>(window.area()); }

}  // namespace

double stored_bytes(const SinkSpec& spec) {
    double pixel = 0;
    for (const ChannelInfo& c : spec.channels) pixel += static_cast<double>(sample_size(c.type));
    return pixel * pixels(spec.data_window);
}

void check_sizes(const ResolvedFrame& frame, Diagnostics& diagnostics) {
    for (const Sink& sink : frame.sinks) {
        const SinkSpec& spec = sink.request.spec;
        const std::string size =
            fmt::format("{} × {} pixels", spec.data_window.width(), spec.data_window.height());
        const std::string displayed =
            fmt::format("{} × {}", spec.display_window.width(), spec.display_window.height());
        if (stored_bytes(spec) > kMostBytes)
            diagnostics.error({ErrorKind::kGraph, sink.place, sink.title,
                               fmt::format("{} are {:.0f} TiB of samples, of which {} pixels are displayed",
                                           size, stored_bytes(spec) / kMostBytes, displayed),
                               "crop the picture, or scale it less"});
        else if (pixels(spec.data_window) > kManyPixels &&
                 pixels(spec.data_window) > kManyTimes * pixels(spec.display_window))
            diagnostics.warning(
                {ErrorKind::kFailed, sink.place, sink.title,
                 fmt::format("{} are computed and written, of which {} are displayed", size, displayed),
                 "a crop before it leaves out what is not seen"});
    }
}

}  // namespace keyline
