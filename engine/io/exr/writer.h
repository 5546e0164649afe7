// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/io/exr/layout.h"
#include "engine/io/image_sink.h"
#include "engine/io/sink_memory.h"

#include <filesystem>
#include <memory>

namespace keyline::exr {

// How `spec` is stored: windows, types by depth, channels in the file's order, compression.  An empty data
// window becomes one pixel at the display window's corner.  Throws Failure (kGraph) for what OpenEXR can't
// hold, naming what it can.
Layout layout_of(const SinkSpec& spec);

// What writing `spec` needs.  Throws as layout_of().
SinkMemory memory_of(const SinkSpec& spec);

// Rows that are encoded at once: one of the file's chunks, or several small ones.
int rows_at_once(const Layout& layout);

// Starts an OpenEXR file of one scanline part, increasing in y.  An empty data window is written as a zero
// pixel, whatever encode() is given.  Throws Failure: kGraph as above, kOutput where the file can't be made.
std::unique_ptr<ImageSink> create_exr(const std::filesystem::path& file, const SinkSpec& spec);

}  // namespace keyline::exr
