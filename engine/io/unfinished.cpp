// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/io/unfinished.h"

#include <cerrno>
#include <cstdint>
#include <ctime>
#include <fcntl.h>
#include <fmt/format.h>
#include <fstream>
#include <string_view>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

namespace keyline {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view kBegin = ".keyline-";
constexpr std::size_t kMachine = 8;           // digits
constexpr std::size_t kLongestExtension = 8;  // with its dot
constexpr time_t kForgotten = 24 * 60 * 60;   // seconds

uint64_t random_bits() {
    uint64_t bits = 0;
    while (getrandom(&bits, sizeof bits, 0) != sizeof bits) {
    }
    return bits;
}

// The same for all processes that one kernel runs: its locks are what they see of each other.  A container
// has a name and process numbers of its own and may share both with others.
const std::string& machine() {
    static const std::string name = [] {
        std::string boot;
        std::ifstream("/proc/sys/kernel/random/boot_id") >> boot;
        return boot.size() < kMachine ? fmt::format("{:08x}", random_bits() >> 32U)
                                      : boot.substr(0, kMachine);
    }();
    return name;
}

int lock(int descriptor) {
    struct flock whole = {};
    whole.l_type = F_WRLCK;
    whole.l_whence = SEEK_SET;
    return fcntl(descriptor, F_OFD_SETLK, &whole);
}

bool is_taken(int error) { return error == EAGAIN || error == EACCES; }

// Of a file that is open; where it can be locked, it is.
bool is_left_over(int descriptor, bool of_this_machine) {
    struct stat status = {};
    if (fstat(descriptor, &status) != 0 || !S_ISREG(status.st_mode)) return false;
    const bool locked = lock(descriptor) == 0;
    if (!locked && is_taken(errno)) return false;
    return (locked && of_this_machine) || std::time(nullptr) - status.st_mtime > kForgotten;
}

}  // namespace

std::string unfinished_name(const fs::path& output) {
    const std::string extension = output.extension().string();
    return fmt::format("{}{}-{:016x}{}", kBegin, machine(), random_bits(),
                       extension.size() <= kLongestExtension ? extension : "");
}

bool claim(int descriptor) { return lock(descriptor) == 0 || !is_taken(errno); }

void remove_unfinished(const fs::path& folder) {
    const std::string ours = std::string(kBegin) + machine() + "-";
    std::error_code error;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
        const std::string name = entry->path().filename().string();
        if (!name.starts_with(kBegin)) continue;
        // What is not ours to write to is not ours to remove.
        const int file = open(entry->path().c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
        if (file < 0) continue;
        // Locked meanwhile, so that who made it and has not claimed it yet sees that it is taken.
        if (is_left_over(file, name.starts_with(ours))) unlink(entry->path().c_str());
        close(file);
    }
}

}  // namespace keyline
