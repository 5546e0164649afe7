// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/io/image_sink.h"

#include <cstddef>

namespace KEYLINE_API keyline {

// Bytes that an output needs beside the rows that wait for being encoded, told before it is made.  Helper
// processes count: a limit of memory is one for the whole family.
struct SinkMemory {
    std::size_t encode = 0;  // each thread that calls encode(), and keeps until the output is done
    std::size_t held = 0;    // once, however many threads there are: headers, tables, a library's whole frame
};
SinkMemory sink_memory(const std::filesystem::path& file, const SinkSpec& spec);

}  // namespace keyline
