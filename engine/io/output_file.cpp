// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/io/output_file.h"

#include "engine/base/error.h"
#include "engine/io/system_call.h"
#include "engine/io/unfinished.h"

#include <chrono>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <thread>
#include <unistd.h>

namespace keyline {

namespace fs = std::filesystem;

namespace {

// Opened, as a file server is then asked anew.  Some give a file another number under another name: one of
// that size, last written at that instant, is taken for it too.
bool stands_under(const fs::path& name, const struct stat& own) {
    const int file = open(name.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
    struct stat there = {};
    const bool is_there = (file < 0 ? lstat(name.c_str(), &there) : fstat(file, &there)) == 0;
    if (file >= 0) close(file);
    const bool is_same = there.st_dev == own.st_dev && there.st_ino == own.st_ino;
    return is_there &&
           (is_same || (there.st_size == own.st_size && there.st_mtim.tv_sec == own.st_mtim.tv_sec &&
                        there.st_mtim.tv_nsec == own.st_mtim.tv_nsec));
}

constexpr mode_t kMode = 0666;              // less the umask
constexpr int kMostLinks = 40;              // as the kernel has it
constexpr uint64_t kSyncStep = 4ULL << 20;  // bytes
constexpr int kMostNames = 16;  // tried; two equal random ones in a row mean that something is wrong

// How often and how long a lost answer of a file server is waited for: systems remember names for a second.
constexpr int kMostLooks = 15;
constexpr std::chrono::milliseconds kBetweenLooks(100);

fs::path folder_of(const fs::path& target) {
    return target.has_parent_path() ? target.parent_path() : fs::path(".");
}

std::string in_proc(int descriptor) { return fmt::format("/proc/self/fd/{}", descriptor); }

[[noreturn]] void fail_with(const std::string& name, int error) {
    fail(ErrorKind::kOutput, fmt::format("{}: can't be written: {}", name, system_text(error)),
         system_hint(error), system_passing(error));
}

// The first of a path and the folders above it that is there.
fs::path nearest_there(fs::path folder) {
    std::error_code error;
    while (!fs::exists(fs::symlink_status(folder, error)) && folder.has_parent_path() &&
           folder != folder.parent_path())
        folder = folder.parent_path();
    return folder.empty() || !fs::exists(fs::symlink_status(folder, error)) ? fs::path(".") : folder;
}

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

void check_can_write(const fs::path& file) {
    const std::string name = file.string();
    const fs::path target = behind_links(file);
    if (!target.has_filename()) fail_with(name, EISDIR);
    struct stat status = {};
    if (again_if_stale([&] { return stat(target.c_str(), &status); }) == 0) {
        if (S_ISDIR(status.st_mode)) fail_with(name, EISDIR);
        if (!S_ISREG(status.st_mode))
            fail(ErrorKind::kOutput, fmt::format("{}: can't be written: not a regular file", name));
        if (access(target.c_str(), W_OK) != 0) fail_with(name, errno);
    } else if (errno != ENOENT) {
        fail_with(name, errno);
    }
    const fs::path folder = nearest_there(folder_of(target));
    if (access(folder.c_str(), W_OK | X_OK) != 0) fail_with(name, errno);
    const long longest = pathconf(folder.c_str(), _PC_NAME_MAX);
    if (longest > 0 && target.filename().string().size() > static_cast<std::size_t>(longest))
        fail_with(name, ENAMETOOLONG);
}

OutputFile::OutputFile(const fs::path& file, Unfinished unfinished)
    : name_(file.string()), target_(behind_links(file)) {
    check_can_write(file);
    std::error_code error;
    const auto make_folders = [&] {
        fs::create_directories(folder_of(target_), error);
        return errno = error.value(), error ? -1 : 0;
    };
    if (again_if_stale(make_folders) != 0) fail_with(name_, errno);
    if (unfinished == Unfinished::kUnnamedWherePossible) open_unnamed();
    if (descriptor_ < 0) open_named();
}

void OutputFile::open_unnamed() {
    descriptor_ = open(folder_of(target_).c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, kMode);
    if (descriptor_ < 0) return;
    // Without /proc it could never be given a name.
    if (access(in_proc(descriptor_).c_str(), F_OK) == 0 && claim(descriptor_)) return;
    close(descriptor_);
    descriptor_ = -1;
}

void OutputFile::open_named() {
    for (int i = 0; i < kMostNames; ++i) {
        unfinished_ = folder_of(target_) / unfinished_name(target_);
        descriptor_ = again_if_stale(
            [&] { return open(unfinished_.c_str(), O_CREAT | O_EXCL | O_RDWR | O_CLOEXEC, kMode); });
        if (descriptor_ < 0 && errno == EEXIST) continue;
        if (descriptor_ < 0) fail_with(name_, errno);
        has_name_ = true;
        // Another process may have found it in the moment before it was claimed.
        struct stat status = {};
        if (claim(descriptor_) && fstat(descriptor_, &status) == 0 && status.st_nlink > 0) return;
        discard();
    }
    fail_with(name_, EEXIST);
}

OutputFile::~OutputFile() { discard(); }

void OutputFile::discard() {
    // Closed first: what is open can't be removed from a server, but gets another name there until it is
    // closed.
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
        if (n < 0 && errno != EINTR) fail_with(name_, errno);
        if (n <= 0) continue;
        bytes = bytes.subspan(static_cast<std::size_t>(n));
        offset += static_cast<uint64_t>(n);
    }
}

void OutputFile::publish() {
    take_over_mode();
    if (fsync(descriptor_) != 0) fail_with(name_, errno);
    if (!has_name_) link_unnamed();
    rename_to_target();
    sync_folder();
    const int descriptor = descriptor_;
    descriptor_ = -1;
    if (close(descriptor) != 0) fail_with(name_, errno);
}

// Who shares the older file goes on sharing it.  A group that can't be given gets no more than everybody.
void OutputFile::take_over_mode() const {
    struct stat old = {}, own = {};
    if (stat(target_.c_str(), &old) != 0 || !S_ISREG(old.st_mode)) return;
    if (fchown(descriptor_, old.st_uid, old.st_gid) != 0 &&
        fchown(descriptor_, static_cast<uid_t>(-1), old.st_gid) != 0 && fstat(descriptor_, &own) == 0 &&
        own.st_gid != old.st_gid)
        old.st_mode &= ~mode_t{S_IRWXG} | ((old.st_mode & S_IRWXO) << 3U);
    // A file system without modes refuses; then there was none to keep.
    [[maybe_unused]] const int done = fchmod(descriptor_, old.st_mode & (S_IRWXU | S_IRWXG | S_IRWXO));
}

// A link can't replace a file, a rename can.
void OutputFile::link_unnamed() {
    for (int i = 0; i < kMostNames; ++i) {
        unfinished_ = folder_of(target_) / unfinished_name(target_);
        if (linkat(AT_FDCWD, in_proc(descriptor_).c_str(), AT_FDCWD, unfinished_.c_str(),
                   AT_SYMLINK_FOLLOW) == 0) {
            has_name_ = true;
            return;
        }
        if (errno != EEXIST) fail_with(name_, errno);
    }
    fail_with(name_, EEXIST);
}

// A file server whose answer was lost is asked again by the system, and finds nothing left to rename.
void OutputFile::rename_to_target() {
    struct stat own = {};
    if (fstat(descriptor_, &own) != 0) fail_with(name_, errno);
    if (again_if_stale([&] { return rename(unfinished_.c_str(), target_.c_str()); }) != 0) {
        const int error = errno;
        bool done = stands_under(target_, own);
        const bool is_moved = !done && error == ENOENT && unlink(unfinished_.c_str()) != 0 && errno == ENOENT;
        for (int i = 0; is_moved && !done && i < kMostLooks; ++i) {
            std::this_thread::sleep_for(kBetweenLooks);
            done = stands_under(target_, own);
        }
        if (!done) fail_with(name_, error);
    }
    has_name_ = false;
}

// So that not only the bytes outlive a loss of power, but their name too.
void OutputFile::sync_folder() const {
    const int folder = open(folder_of(target_).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (folder < 0) return;  // it may be written to and not read: nothing can be asked for
    const int error = fsync(folder) == 0 ? 0 : errno;
    close(folder);
    // Others mean that this file system has no such call.
    if (error == EIO || error == ENOSPC || error == EDQUOT) fail_with(name_, error);
}

}  // namespace keyline
