// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/io/helper/server/server.h"

#include "engine/base/sanitized.h"
#include "engine/io/helper/descriptors.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <fstream>
#include <map>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace keyline {

namespace {

// Bytes that this process may write to and shares with nobody; what RLIMIT_DATA bounds.
uint64_t own_data() {
    std::ifstream in("/proc/self/statm");
    uint64_t pages = 0, data = 0;
    for (int field = 0; field < 6 && in >> pages; ++field) data = pages;
    return data * static_cast<uint64_t>(sysconf(_SC_PAGESIZE));
}

// For what the library keeps from one picture to the next, and for the stacks of its threads.
constexpr uint64_t kSlack = uint64_t{256} << 20;

void set_soft_limit(decltype(RLIMIT_CPU) resource, uint64_t value) {
    rlimit limit = {};
    getrlimit(resource, &limit);
    limit.rlim_cur = std::min<rlim_t>(value, limit.rlim_max);
    setrlimit(resource, &limit);
}

// (A sanitizer's shadow memory is beyond any limit.)
void limit_resources(const HelperRequest& request) {
    rusage used = {};
    getrusage(RUSAGE_SELF, &used);
    set_soft_limit(RLIMIT_CPU,
                   static_cast<uint64_t>(used.ru_utime.tv_sec + used.ru_stime.tv_sec) + request.seconds + 1);
    // Not the address space: the allocator reserves much more of it for a thread than is ever used.
    if (!kIsSanitized) set_soft_limit(RLIMIT_DATA, own_data() + request.memory + request.bytes + kSlack);
}

class Session {
public:
    Session(int socket, int memory, HelperSession work)
        : socket_(socket), memory_(memory), work_(std::move(work)) {}

    // One request; false when there are no more.
    bool serve_one() {
        HelperRequest request = {};
        if (!receive_all(socket_, std::as_writable_bytes(std::span(&request, 1)))) return false;
        limit_resources(request);
        std::vector<std::byte> bytes(request.bytes);
        int descriptor = -1;
        if (request.has_descriptor != 0) descriptor = receive_descriptor(socket_);
        if (!receive_all(socket_, bytes)) return false;
        try {
            map(request.shared_bytes);
            return reply(HelperReply::Outcome::kDone, work_({request, bytes, descriptor, shared_}));
        } catch (const HelperFailure& failure) {
            return reply_failure(failure.outcome(), failure.what(), failure.hint(), failure.passing());
        } catch (const std::bad_alloc&) {
            return reply_failure(HelperReply::Outcome::kInputFailed,
                                 "it takes more memory than a file of its size should", {});
        } catch (const std::exception& error) {
            return reply_failure(HelperReply::Outcome::kInputFailed, error.what(), {});
        }
    }

    bool reply_failure(HelperReply::Outcome outcome, std::string what, const std::string& hint,
                       uint32_t passing = 0) const {
        what += '\0' + hint;
        const auto bytes = std::as_bytes(std::span(what));
        return reply(outcome, {bytes.begin(), bytes.end()}, passing);
    }

private:
    bool reply(HelperReply::Outcome outcome, const std::vector<std::byte>& bytes,
               uint32_t passing = 0) const {
        const HelperReply head{outcome, passing, bytes.size()};
        return send_all(socket_, std::as_bytes(std::span(&head, 1))) && send_all(socket_, bytes);
    }

    void map(std::size_t bytes) {
        if (bytes <= shared_.size()) return;
        if (!shared_.empty()) munmap(shared_.data(), shared_.size());
        shared_ = {};
        void* at = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, memory_, 0);
        if (at == MAP_FAILED) throw std::bad_alloc();
        shared_ = {static_cast<std::byte*>(at), bytes};
    }

    int socket_, memory_;
    HelperSession work_;
    std::span<std::byte> shared_;
};

// In the process of the session.
int run_session(int socket, int memory, const std::function<HelperSession()>& make_session) {
    try {
        Session session(socket, memory, make_session());
        while (session.serve_one()) {
        }
        return 0;
    } catch (const std::exception&) {  // no memory for the request: the other side sees the socket close
        return 1;
    }
}

class Sessions {
public:
    explicit Sessions(const std::function<HelperSession()>& make_session) : make_session_(make_session) {}

    // One order; false when there are no more.
    bool serve_one() {
        HelperOrder order = {};
        std::array<int, 2> descriptors = {-1, -1};
        if (!receive_packet(STDIN_FILENO, std::as_writable_bytes(std::span(&order, 1)), descriptors))
            return false;
        forget_those_that_ended();
        if (order.kind == HelperOrder::Kind::kStart)
            start(order.session, descriptors[0], descriptors[1]);
        else if (const auto found = processes_.find(order.session); found != processes_.end())
            kill(found->second, SIGKILL);
        return true;
    }

private:
    void start(uint64_t session, int socket, int memory) {
        const pid_t keeper = getpid(), process = fork();
        if (process == 0) {
            close(STDIN_FILENO);
            prctl(PR_SET_PDEATHSIG, SIGKILL);
            if (getppid() != keeper) _exit(1);
            _exit(run_session(socket, memory, make_session_));
        }
        if (process > 0)
            processes_[session] = process;
        else
            Session(socket, memory, {})
                .reply_failure(HelperReply::Outcome::kFailed,
                               "a helper process can't be started: " + std::generic_category().message(errno),
                               {});
        close(socket);
        close(memory);
    }

    // A process that ended keeps its number until it is asked about: what is killed is a session for sure.
    void forget_those_that_ended() {
        for (pid_t ended = waitpid(-1, nullptr, WNOHANG); ended > 0; ended = waitpid(-1, nullptr, WNOHANG))
            std::erase_if(processes_, [&](const auto& entry) { return entry.second == ended; });
    }

    const std::function<HelperSession()>& make_session_;
    std::map<uint64_t, pid_t> processes_;
};

}  // namespace

int serve(const std::function<HelperSession()>& make_session) {
    Sessions sessions(make_session);
    while (sessions.serve_one()) {
    }
    return 0;
}

}  // namespace keyline
