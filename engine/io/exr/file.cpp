// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/io/exr/file.h"

#include "engine/base/error.h"
#include "engine/io/system_call.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

namespace keyline::exr {

namespace {

[[noreturn]] void fail_to_read(const std::string& name, int error) {
    if (error == ENOENT)
        fail(Code::kFileMissing, ErrorKind::kInput, fmt::format("{}: {}", name, system_text(error)));
    fail(ErrorKind::kInput, fmt::format("{}: {}", name, system_text(error)), system_hint(error),
         system_passing(error));
}

// Non-blocking, so that a pipe without a writer is refused rather than waited for.
int open_to_read(const std::filesystem::path& file) {
    return again_if_stale([&] { return open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK); });
}

}  // namespace

InputFile::InputFile(const std::filesystem::path& file)
    : name_(file.string()), descriptor_(open_to_read(file)) {
    if (descriptor_ < 0) fail_to_read(name_, errno);
    struct stat status = {};
    const int error = fstat(descriptor_, &status) != 0 ? errno : S_ISDIR(status.st_mode) ? EISDIR : 0;
    if (error != 0 || !S_ISREG(status.st_mode)) {
        close(descriptor_);
        if (error != 0) fail_to_read(name_, error);
        fail(ErrorKind::kInput, fmt::format("{}: not a regular file", name_));
    }
    size_ = static_cast<uint64_t>(status.st_size);
}

InputFile::~InputFile() { close(descriptor_); }

std::size_t InputFile::read_some(uint64_t offset, std::span<std::byte> bytes) const {
    std::size_t done = 0;
    while (done < bytes.size()) {
        const ssize_t n =
            pread(descriptor_, bytes.data() + done, bytes.size() - done, static_cast<off_t>(offset + done));
        if (n == 0) break;
        if (n > 0)
            done += static_cast<std::size_t>(n);
        else if (errno != EINTR)
            fail_to_read(name_, error_ = errno);
    }
    return done;
}

void InputFile::fail_where_the_system_did() const {
    if (error_ != 0) fail_to_read(name_, error_);
}

void InputFile::read(uint64_t offset, std::span<std::byte> bytes) const {
    const std::size_t n = read_some(offset, bytes);
    if (n == bytes.size()) return;
    fail(ErrorKind::kInput,
         fmt::format("{}: the file ends at byte {}; {} more were expected", name_, offset + n,
                     bytes.size() - n),
         kUnfinishedHint, Passing::kUnfinished);
}

}  // namespace keyline::exr
