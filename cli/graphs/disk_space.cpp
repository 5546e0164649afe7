// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/graphs/disk_space.h"

#include "engine/plan/size_check.h"

#include <algorithm>
#include <fmt/format.h>
#include <sys/stat.h>

namespace keyline::cli {

namespace {

namespace fs = std::filesystem;

// The nearest folder that is there.
fs::path folder_of(const fs::path& file) {
    std::error_code error;
    fs::path folder = fs::absolute(file, error).parent_path();
    while (!fs::is_directory(folder, error) && folder.has_relative_path()) folder = folder.parent_path();
    return folder;
}

std::string gibibytes(double bytes) { return fmt::format("{:.1f} GiB", bytes / 0x1p30); }

}  // namespace

void DiskSpace::look(const ResolvedFrame& frame) {
    for (const Sink& sink : frame.sinks) {
        if (sink.request.stream.is_data()) continue;
        const fs::path folder = folder_of(sink.request.file);
        struct stat status {};
        if (stat(folder.c_str(), &status) != 0) continue;
        std::error_code error;
        const std::uintmax_t replaced = fs::file_size(sink.request.file, error);
        Disk& disk = disks_.try_emplace(status.st_dev, Disk{folder}).first->second;
        // Uncompressed: how well pictures pack is known when they are there.
        const double more = stored_bytes(sink.request.spec) - (error ? 0 : static_cast<double>(replaced));
        disk.bytes += std::max(0.0, more);
        ++disk.files;
    }
}

void DiskSpace::tell(Diagnostics& diagnostics) const {
    for (const auto& [device, disk] : disks_) {
        std::error_code error;
        const fs::space_info space = fs::space(disk.folder, error);
        if (error || disk.bytes <= static_cast<double>(space.available)) continue;
        diagnostics.warning(
            {ErrorKind::kOutput,
             {},
             {},
             fmt::format("{} output{} take up to {} uncompressed, and {} has {} free", disk.files,
                         disk.files == 1 ? "" : "s", gibibytes(disk.bytes), in_quotes(disk.folder.string()),
                         gibibytes(static_cast<double>(space.available))),
             "make room, or write elsewhere",
             Passing::kNever,
             Code::kLittleSpace});
    }
}

}  // namespace keyline::cli
