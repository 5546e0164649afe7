// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

namespace keyline::exr {

// A regular file to read from at any place, from any number of threads.  It is read, not mapped: mapped pages
// count as memory, and a file cut short while mapped is a signal instead of an error.
class InputFile {
public:
    // Throws Failure (kInput) with the system's reason.
    explicit InputFile(const std::filesystem::path& file);
    ~InputFile();
    InputFile(const InputFile&) = delete;
    InputFile& operator=(const InputFile&) = delete;

    const std::string& name() const { return name_; }
    uint64_t size() const { return size_; }

    // As many bytes as there are, up to bytes.size().
    std::size_t read_some(uint64_t offset, std::span<std::byte> bytes) const;

    // All of `bytes`.  Throws Failure (kInput) where the file ends before.
    void read(uint64_t offset, std::span<std::byte> bytes) const;

    // Throws Failure (kInput) with the system's reason where a read failed before: a library that was told
    // only that it did takes the file for damaged.
    void fail_where_the_system_did() const;

private:
    mutable std::atomic<int> error_ = 0;  // the first of a read
    std::string name_;
    int descriptor_;
    uint64_t size_ = 0;
};

}  // namespace keyline::exr
