// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

namespace keyline {

// A file that appears under its name only when it is whole.  Until publish() an older file of that name stays
// as it is; destroyed before, nothing remains.  Where the file system can (O_TMPFILE), the unfinished file
// has no name at all, so that a killed process leaves nothing either; elsewhere it is
// `.STEM.HOST.PID.keyline.EXT` beside the final place.
//
// Everything that fails throws Failure (kOutput) with the system's reason.
class OutputFile {
public:
    enum class Unfinished { kUnnamedWherePossible, kNamed };

    // Missing folders are made.  A symbolic link is written through.  Anything but a regular file in the
    // place, or one without permission to write, is refused.  The mode follows the umask.
    explicit OutputFile(const std::filesystem::path& file,
                        Unfinished unfinished = Unfinished::kUnnamedWherePossible);
    ~OutputFile();
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;

    void append(std::span<const std::byte> bytes);
    uint64_t size() const { return size_; }  // of what was appended

    // Replaces bytes that were appended before.
    void overwrite(uint64_t offset, std::span<const std::byte> bytes);

    // Syncs the file and gives it its name.  Nothing may be written afterwards.
    void publish();

    // For writers that want a path: the name of the unfinished file; only with Unfinished::kNamed.
    const std::filesystem::path& unfinished_path() const { return unfinished_; }

private:
    void open_unfinished(Unfinished unfinished);
    void write_at(uint64_t offset, std::span<const std::byte> bytes);
    void discard();
    [[noreturn]] void fail_with(int error) const;

    std::string name_;                  // as given, for messages
    std::filesystem::path target_;      // behind symbolic links
    std::filesystem::path unfinished_;  // the name for the time until the rename
    bool has_name_ = false;             // whether something stands under unfinished_
    int descriptor_ = -1;
    uint64_t size_ = 0, being_synced_ = 0;
};

// The final target of `file`: itself, or what it points to where it is a symbolic link, there or not.
std::filesystem::path behind_links(const std::filesystem::path& file);

// Removes unfinished files for `file` whose process, on this host, no longer lives.
void remove_unfinished(const std::filesystem::path& file);

}  // namespace keyline
