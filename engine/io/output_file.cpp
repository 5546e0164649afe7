// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/io/output_file.h"

#include "engine/error.h"

#include <array>
#include <cerrno>
#include <charconv>
#include <climits>
#include <csignal>
#include <cstdio>
#include <fcntl.h>
#include <fmt/format.h>
#include <string_view>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

namespace keyline {

namespace fs = std::filesystem;

namespace {

constexpr mode_t kMode = 0666;              // less the umask
constexpr int kMostLinks = 40;              // as the kernel has it
constexpr uint64_t kSyncStep = 4ULL << 20;  // bytes

std::string host_name() {
    std::array<char, HOST_NAME_MAX + 1> name = {};
    if (gethostname(name.data(), name.size() - 1) != 0) return "localhost";
    return name.data();
}

// ".STEM.HOST." and ".keyline.EXT": what stands before and after the process.  A stem that is too long for a
// file name with all that is cut.
struct UnfinishedName {
    std::string before, after;

    explicit UnfinishedName(const fs::path& target) : after(".keyline" + target.extension().string()) {
        const std::string host = host_name();
        const std::size_t others = host.size() + after.size() + std::string_view("...4294967295").size();
        const std::size_t room = others < NAME_MAX ? NAME_MAX - others : 0;
        before = fmt::format(".{}.{}.", target.stem().string().substr(0, room), host);
    }

    std::string of(pid_t process) const { return fmt::format("{}{}{}", before, process, after); }

    // The process of a name that is formed so; 0 for any other.
    pid_t process(std::string_view name) const {
        if (name.size() <= before.size() + after.size() || !name.starts_with(before) ||
            !name.ends_with(after))
            return 0;
        const std::string_view digits =
            name.substr(before.size(), name.size() - before.size() - after.size());
        pid_t process = 0;
        const auto parsed = std::from_chars(digits.data(), digits.data() + digits.size(), process);
        return parsed.ec == std::errc() && parsed.ptr == digits.data() + digits.size() ? process : 0;
    }
};

// This process has not begun with the file yet: what bears its number is of an earlier one.
bool is_gone(pid_t process) { return process == getpid() || (kill(process, 0) != 0 && errno == ESRCH); }

fs::path folder_of(const fs::path& target) {
    return target.has_parent_path() ? target.parent_path() : fs::path(".");
}

std::string in_proc(int descriptor) { return fmt::format("/proc/self/fd/{}", descriptor); }

}  // namespace

fs::path behind_links(const fs::path& file) {
    fs::path target = file;
    std::error_code error;
    for (int i = 0; i < kMostLinks && fs::is_symlink(fs::symlink_status(target, error)); ++i) {
        const fs::path next = fs::read_symlink(target, error);
        target = next.is_absolute() ? next : target.parent_path() / next;
    }
    return target;
}

void remove_unfinished(const fs::path& file) {
    const fs::path target = behind_links(file);
    const UnfinishedName name(target);
    std::error_code error;
    for (fs::directory_iterator entry(folder_of(target), error), end; !error && entry != end;
         entry.increment(error)) {
        const pid_t process = name.process(entry->path().filename().string());
        std::error_code ignored;  // another process may have removed it, or it is not ours to remove
        if (process > 0 && is_gone(process)) fs::remove(entry->path(), ignored);
    }
}

OutputFile::OutputFile(const fs::path& file, Unfinished unfinished)
    : name_(file.string()), target_(behind_links(file)) {
    if (!target_.has_filename()) fail_with(EISDIR);
    std::error_code error;
    fs::create_directories(folder_of(target_), error);
    if (error) fail_with(error.value());
    struct stat status = {};
    if (stat(target_.c_str(), &status) == 0) {
        if (S_ISDIR(status.st_mode)) fail_with(EISDIR);
        if (!S_ISREG(status.st_mode))
            fail(ErrorKind::kOutput, fmt::format("{}: can't be written: not a regular file", name_));
        if (access(target_.c_str(), W_OK) != 0) fail_with(errno);
    } else if (errno != ENOENT) {
        fail_with(errno);
    }
    unfinished_ = folder_of(target_) / UnfinishedName(target_).of(getpid());
    open_unfinished(unfinished);
}

void OutputFile::open_unfinished(Unfinished unfinished) {
    if (unfinished == Unfinished::kUnnamedWherePossible) {
        descriptor_ = open(folder_of(target_).c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, kMode);
        // Without /proc it could never be given a name.
        if (descriptor_ >= 0 && access(in_proc(descriptor_).c_str(), F_OK) == 0) return;
        if (descriptor_ >= 0) close(descriptor_);
    }
    unlink(unfinished_.c_str());  // of an earlier process of the same number
    descriptor_ = open(unfinished_.c_str(), O_CREAT | O_EXCL | O_RDWR | O_CLOEXEC, kMode);
    if (descriptor_ < 0) fail_with(errno);
    has_name_ = true;
}

OutputFile::~OutputFile() { discard(); }

void OutputFile::discard() {
    if (descriptor_ >= 0) close(descriptor_);
    if (has_name_) unlink(unfinished_.c_str());
    descriptor_ = -1;
    has_name_ = false;
}

void OutputFile::append(std::span<const std::byte> bytes) {
    write_at(size_, bytes);
    size_ += bytes.size();
    // Starts the disk early, so that the sync at the end has little left to wait for.  Only a hint.
    if (size_ - being_synced_ < kSyncStep) return;
    sync_file_range(descriptor_, static_cast<off_t>(being_synced_), static_cast<off_t>(size_ - being_synced_),
                    SYNC_FILE_RANGE_WRITE);
    being_synced_ = size_;
}

void OutputFile::overwrite(uint64_t offset, std::span<const std::byte> bytes) {
    if (offset + bytes.size() > size_)
        fail(ErrorKind::kInternal,
             fmt::format("{}: {} bytes at {} to be replaced, of {}", name_, bytes.size(), offset, size_));
    write_at(offset, bytes);
}

void OutputFile::write_at(uint64_t offset, std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        const ssize_t n = pwrite(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
        if (n < 0 && errno != EINTR) fail_with(errno);
        if (n <= 0) continue;
        bytes = bytes.subspan(static_cast<std::size_t>(n));
        offset += static_cast<uint64_t>(n);
    }
}

void OutputFile::publish() {
    if (fsync(descriptor_) != 0) fail_with(errno);
    if (!has_name_) {
        // A link can't replace a file, a rename can.
        unlink(unfinished_.c_str());
        if (linkat(AT_FDCWD, in_proc(descriptor_).c_str(), AT_FDCWD, unfinished_.c_str(),
                   AT_SYMLINK_FOLLOW) != 0)
            fail_with(errno);
        has_name_ = true;
    }
    if (rename(unfinished_.c_str(), target_.c_str()) != 0) fail_with(errno);
    has_name_ = false;
    const int descriptor = descriptor_;
    descriptor_ = -1;
    if (close(descriptor) != 0) fail_with(errno);
}

void OutputFile::fail_with(int error) const {
    fail(ErrorKind::kOutput,
         fmt::format("{}: can't be written: {}", name_, std::generic_category().message(error)));
}

}  // namespace keyline
