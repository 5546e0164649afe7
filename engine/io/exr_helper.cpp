// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/io/exr_helper.h"

#include "engine/error.h"
#include "engine/io/image_module.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <string>
#include <sys/socket.h>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>

namespace keyline::exr {

namespace {

// Far more than the work takes: its limit of processor time ends a helper that loops, this one that waits.
std::chrono::seconds patience(uint64_t sample_bytes) {
    return std::chrono::seconds(60 + static_cast<int64_t>(sample_bytes >> 20));
}

// What a started process inherits: the socket as standard input, silence, no blocked signals, and a process
// group of its own, so that an interrupt from the terminal is Keyline's to handle.
class SpawnSettings {
public:
    explicit SpawnSettings(int socket) {
        posix_spawn_file_actions_init(&actions_);
        posix_spawn_file_actions_adddup2(&actions_, socket, STDIN_FILENO);
        posix_spawn_file_actions_addopen(&actions_, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
        posix_spawn_file_actions_addopen(&actions_, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
        sigset_t none;
        sigemptyset(&none);
        posix_spawnattr_init(&attributes_);
        posix_spawnattr_setsigmask(&attributes_, &none);
        posix_spawnattr_setpgroup(&attributes_, 0);
        posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETPGROUP);
    }
    ~SpawnSettings() {
        posix_spawn_file_actions_destroy(&actions_);
        posix_spawnattr_destroy(&attributes_);
    }
    SpawnSettings(const SpawnSettings&) = delete;
    SpawnSettings& operator=(const SpawnSettings&) = delete;

    // Returns 0 or an error of the system.
    int spawn(const std::string& program, pid_t& process) const {
        std::string name = program;
        const std::array<char*, 2> arguments = {name.data(), nullptr};
        return posix_spawn(&process, program.c_str(), &actions_, &attributes_, arguments.data(), environ);
    }

private:
    posix_spawn_file_actions_t actions_ = {};
    posix_spawnattr_t attributes_ = {};
};

template <class T>
std::span<std::byte> bytes_of(T& value) {
    return std::as_writable_bytes(std::span(&value, 1));
}

}  // namespace

Helper::~Helper() { stop(); }

void Helper::start() {
    std::array<int, 2> sockets = {};
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, sockets.data()) != 0)
        fail(ErrorKind::kInternal,
             fmt::format("no socket for the helper process: {}", std::generic_category().message(errno)));
    socket_ = sockets[0];
    const std::string program = (module_folder() / "keyline-exr-helper").string();
    const int error = SpawnSettings(sockets[1]).spawn(program, process_);
    close(sockets[1]);
    if (error == 0) return;
    process_ = 0;
    stop();
    fail(ErrorKind::kInternal,
         fmt::format("{} can't be started: {}", program, std::generic_category().message(error)),
         "check the installation of Keyline");
}

void Helper::stop() {
    if (socket_ >= 0) close(socket_);
    if (process_ > 0) {
        kill(process_, SIGKILL);
        while (waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
        }
    }
    socket_ = -1;
    process_ = 0;
}

std::vector<std::byte> Helper::run(HelperRequest request, std::span<const std::byte> file) {
    if (socket_ < 0) start();
    const Deadline deadline = std::chrono::steady_clock::now() + patience(request.sample_bytes);
    request.file_bytes = file.size();
    send(bytes_of(request), deadline);
    send(file, deadline);
    HelperReply reply = {};
    receive(bytes_of(reply), deadline);
    if (reply.bytes > request.file_bytes + request.sample_bytes + 65536)
        give_up("its helper process went astray");
    std::vector<std::byte> bytes(reply.bytes);
    receive(bytes, deadline);
    if (reply.succeeded == 1) return bytes;
    fail(ErrorKind::kInput, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

void Helper::send(std::span<const std::byte> bytes, Deadline deadline) {
    while (!bytes.empty()) {
        wait_for(POLLOUT, deadline);
        const ssize_t n = ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
        if (n > 0)
            bytes = bytes.subspan(static_cast<std::size_t>(n));
        else if (errno != EINTR && errno != EAGAIN)
            give_up("OpenEXR's library could not cope with it");
    }
}

void Helper::receive(std::span<std::byte> bytes, Deadline deadline) {
    while (!bytes.empty()) {
        wait_for(POLLIN, deadline);
        const ssize_t n = recv(socket_, bytes.data(), bytes.size(), MSG_DONTWAIT);
        if (n > 0)
            bytes = bytes.subspan(static_cast<std::size_t>(n));
        else if (n == 0 || (errno != EINTR && errno != EAGAIN))
            give_up("OpenEXR's library could not cope with it");
    }
}

void Helper::wait_for(short events, Deadline deadline) {
    using std::chrono::milliseconds;
    const auto left = std::chrono::duration_cast<milliseconds>(deadline - std::chrono::steady_clock::now());
    pollfd socket{socket_, events, 0};
    if (left.count() <= 0 || poll(&socket, 1, static_cast<int>(left.count())) == 0)
        give_up("OpenEXR's library did not come to an end with it");
}

void Helper::give_up(const char* why) {
    stop();
    fail(ErrorKind::kInput, why);
}

}  // namespace keyline::exr
