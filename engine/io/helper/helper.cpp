// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/io/helper/helper.h"

#include "engine/base/error.h"
#include "engine/base/library_place.h"
#include "engine/io/helper/descriptors.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <fmt/format.h>
#include <map>
#include <mutex>
#include <poll.h>
#include <spawn.h>
#include <string>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace keyline {

namespace {

std::string system_message(int error) { return std::generic_category().message(error); }

// Far more than the work takes: its limit of processor time ends a helper that loops, this one that waits.
std::chrono::seconds patience(uint64_t seconds) {
    return std::chrono::seconds(60 + 4 * static_cast<int64_t>(seconds));
}

// What a started program inherits: the socket as standard input, silence, no blocked signals, and a process
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

// The running program, which starts the sessions.
class Keeper {
public:
    explicit Keeper(std::string_view name) : program_((helper_folder() / name).string()) {}

    uint64_t start_session(int socket, int memory) {
        const std::scoped_lock lock(mutex_);
        const HelperOrder order{HelperOrder::Kind::kStart, ++last_session_};
        // Once more, where it has ended since it was last asked.
        if (!send(order, {{socket, memory}}) && !send(order, {{socket, memory}}))
            fail(ErrorKind::kInternal, fmt::format("{} does not run", program_), kHint);
        return order.session;
    }

    void kill_session(uint64_t session) {
        const std::scoped_lock lock(mutex_);
        if (socket_ >= 0) send_order({HelperOrder::Kind::kKill, session}, {});
    }

    // "" while it runs; else how it ended.  The next session starts it again.
    std::string end() {
        const std::scoped_lock lock(mutex_);
        pollfd socket{socket_, 0, 0};
        if (process_ == 0 || poll(&socket, 1, 0) <= 0 || (socket.revents & POLLHUP) == 0) return {};
        int status = 0;
        while (waitpid(process_, &status, 0) < 0 && errno == EINTR) {
        }
        process_ = 0;
        stop();
        return WIFSIGNALED(status) ? fmt::format("{} was ended by signal {}", program_, WTERMSIG(status))
                                   : fmt::format("{} ended with status {}", program_, WEXITSTATUS(status));
    }

    bool is_running() const { return running_; }

    void stop_for_good() {
        const std::scoped_lock lock(mutex_);
        stop();
    }

    static constexpr const char* kHint = "check the installation of Keyline";

private:
    bool send(const HelperOrder& order, const std::array<int, 2>& descriptors) {
        if (socket_ < 0) start();
        if (send_order(order, descriptors)) return true;
        stop();
        return false;
    }

    bool send_order(const HelperOrder& order, std::span<const int> descriptors) const {
        const auto bytes = std::as_bytes(std::span(&order, 1));
        ssize_t n = -1;
        do n = send_with(socket_, bytes, descriptors, 0);
        while (n < 0 && errno == EINTR);
        return n == static_cast<ssize_t>(bytes.size());
    }

    void start() {
        std::array<int, 2> sockets = {};
        if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, sockets.data()) != 0)
            fail(ErrorKind::kInternal, fmt::format("no socket for {}: {}", program_, system_message(errno)));
        socket_ = sockets[0];
        const int error = SpawnSettings(sockets[1]).spawn(program_, process_);
        close(sockets[1]);
        running_ = error == 0;
        if (error == 0) return;
        process_ = 0;
        stop();
        fail(ErrorKind::kInternal, fmt::format("{} can't be started: {}", program_, system_message(error)),
             kHint);
    }

    void stop() {
        if (socket_ >= 0) close(socket_);
        if (process_ > 0) {
            kill(process_, SIGKILL);
            while (waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
            }
        }
        socket_ = -1;
        process_ = 0;
        running_ = false;
    }

    const std::string program_;
    std::mutex mutex_;
    int socket_ = -1;
    pid_t process_ = 0;
    uint64_t last_session_ = 0;
    std::atomic<bool> running_ = false;
};

// One a program for as long as this process lives, whatever else is destroyed when it ends.
struct Keepers {
    std::mutex mutex;
    std::map<std::string_view, std::unique_ptr<Keeper>> by_name;
};

Keepers& all_keepers() {
    static auto* const keepers = new Keepers;
    return *keepers;
}

void stop_all_keepers() {
    const std::scoped_lock lock(all_keepers().mutex);
    for (const auto& [name, keeper] : all_keepers().by_name) keeper->stop_for_good();
}

Keeper& keeper_of(const HelperProgram& program) {
    const std::scoped_lock lock(all_keepers().mutex);
    static const int stopped_at_exit = std::atexit(stop_all_keepers);
    static_cast<void>(stopped_at_exit);
    std::unique_ptr<Keeper>& keeper = all_keepers().by_name[program.name];
    if (!keeper) keeper = std::make_unique<Keeper>(program.name);
    return *keeper;
}

ErrorKind kind_of(HelperReply::Outcome outcome) {
    switch (outcome) {
        case HelperReply::Outcome::kOutputFailed: return ErrorKind::kOutput;
        case HelperReply::Outcome::kFailed: return ErrorKind::kFailed;
        default: return ErrorKind::kInput;
    }
}

}  // namespace

Helper::Helper(const HelperProgram& program) : program_(program) {}

Helper::~Helper() { stop(); }

// The memory can't be made smaller by the helper: reading it would end this process.
void Helper::start() {
    memory_ = memfd_create("keyline", MFD_CLOEXEC | MFD_ALLOW_SEALING);
    std::array<int, 2> sockets = {};
    if (memory_ < 0 || fcntl(memory_, F_ADD_SEALS, F_SEAL_SHRINK) != 0 ||
        socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, sockets.data()) != 0) {
        const int error = errno;
        stop();
        fail(ErrorKind::kInternal,
             fmt::format("no socket and memory for a helper process: {}", system_message(error)));
    }
    socket_ = sockets[0];
    try {
        session_ = keeper_of(program_).start_session(sockets[1], memory_);
    } catch (...) {
        close(sockets[1]);
        stop();
        throw;
    }
    close(sockets[1]);
}

void Helper::stop() {
    if (is_asked_) keeper_of(program_).kill_session(session_);
    if (socket_ >= 0) close(socket_);
    if (memory_ >= 0) close(memory_);
    if (!shared_.empty()) munmap(shared_.data(), shared_.size());
    socket_ = memory_ = -1;
    shared_ = {};
    is_asked_ = false;
}

std::span<std::byte> Helper::shared(std::size_t bytes) {
    if (socket_ < 0) start();
    if (bytes <= shared_.size()) return shared_;
    // The limit of a file's size is that of this memory too.
    if (ftruncate(memory_, static_cast<off_t>(bytes)) != 0) return {};
    if (!shared_.empty()) munmap(shared_.data(), shared_.size());
    shared_ = {};
    void* at = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, memory_, 0);
    if (at != MAP_FAILED) shared_ = {static_cast<std::byte*>(at), bytes};
    return shared_;
}

std::vector<std::byte> Helper::run(HelperRequest request, const HelperBounds& bounds,
                                   std::span<const std::byte> bytes, int descriptor) {
    begin(request, bounds, bytes, descriptor);
    return end();
}

void Helper::begin(HelperRequest request, const HelperBounds& bounds, std::span<const std::byte> bytes,
                   int descriptor) {
    if (is_asked_) end();
    if (socket_ < 0) start();
    request.has_descriptor = descriptor >= 0 ? 1 : 0;
    request.bytes = bytes.size();
    request.shared_bytes = shared_.size();
    request.memory = bounds.memory;
    request.seconds = bounds.seconds;
    most_reply_ = bounds.reply_bytes;
    deadline_ = std::chrono::steady_clock::now() + patience(bounds.seconds);
    is_asked_ = true;
    send(std::as_bytes(std::span(&request, 1)));
    const std::byte carrier = {};
    if (descriptor >= 0) send(std::span(&carrier, 1), descriptor);
    send(bytes);
}

std::vector<std::byte> Helper::end() {
    HelperReply reply = {};
    receive(std::as_writable_bytes(std::span(&reply, 1)));
    if (reply.bytes > most_reply_ + 65536) give_up("went astray with it");
    std::vector<std::byte> bytes(reply.bytes);
    receive(bytes);
    is_asked_ = false;
    if (reply.outcome == HelperReply::Outcome::kDone) return bytes;
    stop();
    const std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const std::size_t zero = std::min(text.find('\0'), text.size());
    fail(kind_of(reply.outcome), text.substr(0, zero), text.substr(std::min(zero + 1, text.size())),
         static_cast<Passing>(reply.passing));
}

void Helper::send(std::span<const std::byte> bytes, int descriptor) {
    const std::span<const int> descriptors(&descriptor, descriptor >= 0 ? 1 : 0);
    while (!bytes.empty()) {
        wait_for(POLLOUT);
        const ssize_t n = send_with(socket_, bytes, descriptors, MSG_DONTWAIT);
        if (n > 0)
            bytes = bytes.subspan(static_cast<std::size_t>(n));
        else if (errno != EINTR && errno != EAGAIN)
            give_up("could not cope with it");
    }
}

void Helper::receive(std::span<std::byte> bytes) {
    while (!bytes.empty()) {
        wait_for(POLLIN);
        const ssize_t n = recv(socket_, bytes.data(), bytes.size(), MSG_DONTWAIT);
        if (n > 0)
            bytes = bytes.subspan(static_cast<std::size_t>(n));
        else if (n == 0 || (errno != EINTR && errno != EAGAIN))
            give_up("could not cope with it");
    }
}

void Helper::wait_for(short events) {
    using std::chrono::milliseconds;
    const auto left = std::chrono::duration_cast<milliseconds>(deadline_ - std::chrono::steady_clock::now());
    pollfd socket{socket_, events, 0};
    if (left.count() <= 0 || poll(&socket, 1, static_cast<int>(left.count())) == 0)
        give_up("did not come to an end with it");
}

void Helper::give_up(std::string_view what_the_library_did) {
    stop();
    if (const std::string end = keeper_of(program_).end(); !end.empty())
        fail(ErrorKind::kInternal, end, Keeper::kHint);
    fail(ErrorKind::kInput, fmt::format("{} {}", program_.library, what_the_library_did));
}

bool helper_is_running(const HelperProgram& program) { return keeper_of(program).is_running(); }

std::filesystem::path helper_folder() {
    const std::filesystem::path folder = library_folder();
    // A program that holds the engine itself, as the tests do, lies beside the library's folder and not in
    // it.
    std::error_code none;
    const bool beside = std::filesystem::is_directory(folder / "keyline", none);
    return beside ? folder / "keyline" : folder.parent_path() / "lib" / "keyline";
}

}  // namespace keyline
