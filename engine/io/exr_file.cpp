// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/io/exr_file.h"

#include "engine/error.h"

#include <cerrno>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

namespace keyline::exr {

namespace {

[[noreturn]] void fail_to_read(const std::string& name, int error) {
    fail(ErrorKind::kInput, fmt::format("{}: {}", name, std::generic_category().message(error)));
}

}  // namespace

// Non-blocking, so that a pipe without a writer is refused below rather than waited for.
InputFile::InputFile(const std::filesystem::path& file)
    : name_(file.string()), descriptor_(open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {
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
            fail_to_read(name_, errno);
    }
    return done;
}

void InputFile::read(uint64_t offset, std::span<std::byte> bytes) const {
    const std::size_t n = read_some(offset, bytes);
    if (n == bytes.size()) return;
    fail(ErrorKind::kInput,
         fmt::format("{}: the file ends at byte {}; {} more were expected", name_, offset + n,
                     bytes.size() - n),
         "it is damaged or was not finished");
}

}  // namespace keyline::exr
