// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

// The command lines of what is compared.

namespace keyline::bench {

using Command = std::vector<std::string>;
Command operator+(Command a, const Command& b);

struct Plate {
    std::filesystem::path file;
    int width = 0, height = 0;
    double pixels() const { return static_cast<double>(width) * height; }
};

// The folder that this program and Keyline's stand in.
std::filesystem::path programs();

// `keyline render` of bench/lines.json, the job that all others are compared with.
Command keyline_job(const std::filesystem::path& plate, const std::filesystem::path& out, int threads,
                    const Command& more = {});

// The same of bench/toon.json: tones under strokes.
Command keyline_toon(const std::filesystem::path& plate, const std::filesystem::path& out, int threads);

// OpenEXR's own library: reads the beauty pass, writes it, computes nothing.
Command openexr_copy(const std::filesystem::path& plate, const std::filesystem::path& out, int threads);

// The same, and reads the other channels that toon.json does.
Command openexr_copy_of_toon(const std::filesystem::path& plate, const std::filesystem::path& out,
                             int threads);

// N × N copies of a plate.
Command mosaic(const std::filesystem::path& plate, int n, const std::filesystem::path& out);

struct Peer {
    std::string name;
    std::string program;  // left out where it is not installed
    Command command;
    Command prepare;  // what it reads, made once; empty: nothing
};

// Jobs of other programs, as near to lines.json as they come.  Files go to `folder`, where "copy.exr" is what
// openexr_copy() makes of the plate.
std::vector<Peer> peers(const Plate& plate, const std::filesystem::path& folder, int threads);

bool is_installed(const std::string& program);

}  // namespace keyline::bench
