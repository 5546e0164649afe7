// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/json/json_writer.h"
#include "engine/run/render.h"

#include <string>

namespace keyline::cli {

// What leaves each node of a frame, as it was resolved: windows, channels, how they are kept, digests.

// For people, a row a node.
std::string streams_text(const Graph& graph, const ResolvedFrame& frame);

// An object.
void write_streams(JsonWriter& json, const Graph& graph, const ResolvedFrame& frame);

}  // namespace keyline::cli
