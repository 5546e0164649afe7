// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0

// Preloaded into the program, it makes the system answer as full disks and file servers do.  KEYLINE_FAULTS
// holds words, parted by blanks:
//
//   no_tmpfile    the file system has no files without a name
//   no_link       it has no hard links, by which a file without a name gets one
//   create=E      no file can be made
//   rename_lost   a rename is done, and its answer is ENOENT: it was lost, and the system asked again
//   rename=E      every rename fails with error number E
//   fsync=E       every fsync of a file that was opened to be written to
//   write=E       every pwrite
//   write_from=N  every pwrite from the Nth on is ENOSPC: the disk is full then
//   slow=MS       every pwrite takes so many milliseconds
//   read=E        every pread from byte 4096 on
//   read_every=N  of those every Nth is EIO
//   short=N       a pread gives N bytes at most
//   stale_once    the first opening of each name that ends in ".exr", to be read, is ESTALE
//
// KEYLINE_FAULTS_LOG names a file that gets a line for every folder that is listed.

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstdlib>
#include <cstring>
#include <dirent.h>
#include <dlfcn.h>
#include <fcntl.h>
#include <mutex>
#include <set>
#include <string>
#include <string_view>
#include <sys/types.h>
#include <unistd.h>

namespace {

// The value of `word=VALUE`, 0 for none; 1 for the bare word.
int fault(std::string_view word) {
    const char* all = std::getenv("KEYLINE_FAULTS");
    const std::string words = std::string(" ") + (all ? all : "") + " ";
    const std::size_t at = words.find(" " + std::string(word));
    if (at == std::string::npos) return 0;
    const std::size_t end = at + 1 + word.size();
    return words[end] == '=' ? std::atoi(words.c_str() + end + 1) : words[end] == ' ' ? 1 : 0;
}

bool fails(const char* word) {
    const int error = fault(word);
    if (error != 0) errno = error;
    return error != 0;
}

template <class Function>
Function* real(const char* name) {
    return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

bool is_stale(const char* name, int flags) {
    static std::mutex mutex;
    static std::set<std::string> seen;
    if ((flags & O_ACCMODE) != O_RDONLY || !std::string_view(name).ends_with(".exr") ||
        fault("stale_once") == 0)
        return false;
    const std::lock_guard lock(mutex);
    return seen.insert(name).second;
}

int opened(const char* name, int flags, mode_t mode) {
    if ((flags & O_TMPFILE) == O_TMPFILE && fault("no_tmpfile") != 0) return errno = EOPNOTSUPP, -1;
    if (is_stale(name, flags)) return errno = ESTALE, -1;
    if (((flags & O_CREAT) != 0 || (flags & O_TMPFILE) == O_TMPFILE) && fails("create")) return -1;
    return real<int(const char*, int, ...)>("open")(name, flags, mode);
}

// Whether one can write to it: that of a folder is not.
bool is_writable(int descriptor) { return (fcntl(descriptor, F_GETFL) & O_ACCMODE) != O_RDONLY; }

void log_listing(const char* what) {
    const char* name = std::getenv("KEYLINE_FAULTS_LOG");
    if (!name) return;
    const std::string line = std::string(what) + "\n";
    const int log = real<int(const char*, int, ...)>("open")(name, O_WRONLY | O_APPEND | O_CREAT, 0600);
    if (write(log, line.data(), line.size()) < 0) std::abort();
    close(log);
}

}  // namespace

// The C library's own parameters have names that nobody else may use.
// NOLINTBEGIN(readability-inconsistent-declaration-parameter-name)
extern "C" {

int open(const char* name, int flags, ...) {
    va_list more;
    va_start(more, flags);
    const mode_t mode = va_arg(more, mode_t);
    va_end(more);
    return opened(name, flags, mode);
}

int open64(const char* name, int flags, ...) {
    va_list more;
    va_start(more, flags);
    const mode_t mode = va_arg(more, mode_t);
    va_end(more);
    return opened(name, flags, mode);
}

int rename(const char* from, const char* to) noexcept {
    if (fails("rename")) return -1;
    const int done = real<int(const char*, const char*)>("rename")(from, to);
    return done == 0 && fault("rename_lost") != 0 ? (errno = ENOENT, -1) : done;
}

int linkat(int from_folder, const char* from, int to_folder, const char* to, int flags) noexcept {
    if (fault("no_link") != 0) return errno = EPERM, -1;
    return real<int(int, const char*, int, const char*, int)>("linkat")(from_folder, from, to_folder, to,
                                                                        flags);
}

int fsync(int descriptor) {
    return is_writable(descriptor) && fails("fsync") ? -1 : real<int(int)>("fsync")(descriptor);
}

ssize_t pwrite(int descriptor, const void* bytes, size_t n, off_t offset) {
    if (fails("write")) return -1;
    if (fault("slow") != 0) usleep(static_cast<useconds_t>(1000 * fault("slow")));
    static std::atomic<int> writes = 0;
    if (fault("write_from") != 0 && ++writes >= fault("write_from")) return errno = ENOSPC, -1;
    return real<ssize_t(int, const void*, size_t, off_t)>("pwrite")(descriptor, bytes, n, offset);
}

ssize_t pwrite64(int descriptor, const void* bytes, size_t n, off64_t offset) {
    return pwrite(descriptor, bytes, n, offset);
}

ssize_t pread(int descriptor, void* bytes, size_t n, off_t offset) {
    if (offset >= 4096 && fails("read")) return -1;
    static std::atomic<int> reads = 0;
    const int every = fault("read_every");
    if (offset >= 4096 && every != 0 && ++reads % every == 0) return errno = EIO, -1;
    if (fault("short") != 0) n = std::min(n, static_cast<size_t>(fault("short")));
    return real<ssize_t(int, void*, size_t, off_t)>("pread")(descriptor, bytes, n, offset);
}

ssize_t pread64(int descriptor, void* bytes, size_t n, off64_t offset) {
    return pread(descriptor, bytes, n, offset);
}

DIR* opendir(const char* name) {
    log_listing(name);
    return real<DIR*(const char*)>("opendir")(name);
}

DIR* fdopendir(int descriptor) {
    log_listing("a descriptor");
    return real<DIR*(int)>("fdopendir")(descriptor);
}
}
// NOLINTEND(readability-inconsistent-declaration-parameter-name)
