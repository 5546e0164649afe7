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
// has no name at all, so that a killed process leaves nothing either; elsewhere it has one of its own beside
// the final place (unfinished.h).
//
// A new file's mode follows the umask.  One that replaces another takes over its mode, and its owner and
// group as far as this process may give them.
//
// Everything that fails throws Failure (kOutput) with the system's reason.
class OutputFile {
public:
    enum class Unfinished { kUnnamedWherePossible, kNamed };

    // Missing folders are made.  A symbolic link is written through.  What check_can_write() tells is
    // refused.
    explicit OutputFile(const std::filesystem::path& file,
                        Unfinished unfinished = Unfinished::kUnnamedWherePossible);
    ~OutputFile();
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;

    void append(std::span<const std::byte> bytes);
    uint64_t size() const { return size_; }  // of what was appended

    // Replaces bytes that were appended before.
    void overwrite(uint64_t offset, std::span<const std::byte> bytes);

    // Syncs the file, gives it its name, and syncs that.  Nothing may be written afterwards.
    void publish();

    // The open file, for a writer in another process: it writes where it likes, and append() is not used.
    int descriptor() const { return descriptor_; }

    // For writers that want a path: the name of the unfinished file; only with Unfinished::kNamed.
    const std::filesystem::path& unfinished_path() const { return unfinished_; }

private:
    void open_unnamed();
    void open_named();
    void link_unnamed();
    void rename_to_target();
    void take_over_mode() const;
    void sync_folder() const;
    void write_at(uint64_t offset, std::span<const std::byte> bytes);
    void discard();

    std::string name_;                  // as given, for messages
    std::filesystem::path target_;      // behind symbolic links
    std::filesystem::path unfinished_;  // the name for the time until the rename
    bool has_name_ = false;             // whether something stands under unfinished_
    int descriptor_ = -1;
    uint64_t size_ = 0, being_synced_ = 0;
};

// The final target of `file`: itself, or what it points to where it is a symbolic link, there or not.
std::filesystem::path behind_links(const std::filesystem::path& file);

// Throws what is known beforehand to keep a file from being written, and makes nothing: something else than a
// regular file in its place, or no permission.
void check_can_write(const std::filesystem::path& file);

}  // namespace keyline
