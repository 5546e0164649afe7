// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstring>
#include <span>
#include <sys/socket.h>
#include <sys/types.h>
#include <unistd.h>

// Bytes and open files over a socket, for both sides of a helper.

namespace keyline {

// Sends one piece of `bytes`, and `descriptors` with its first one.  Returns what sendmsg() does.
inline ssize_t send_with(int socket, std::span<const std::byte> bytes, std::span<const int> descriptors,
                         int flags) {
    alignas(cmsghdr) std::byte control[CMSG_SPACE(2 * sizeof(int))] = {};
    // An iovec serves reading too.  NOLINTNEXTLINE(cppcoreguidelines-pro-type-const-cast)
    iovec piece{const_cast<std::byte*>(bytes.data()), bytes.size()};
    msghdr message = {};
    message.msg_iov = &piece;
    message.msg_iovlen = 1;
    if (!descriptors.empty()) {
        message.msg_control = control;
        message.msg_controllen = CMSG_SPACE(descriptors.size_bytes());
        cmsghdr* head = CMSG_FIRSTHDR(&message);
        head->cmsg_level = SOL_SOCKET;
        head->cmsg_type = SCM_RIGHTS;
        head->cmsg_len = CMSG_LEN(descriptors.size_bytes());
        std::memcpy(CMSG_DATA(head), descriptors.data(), descriptors.size_bytes());
    }
    return sendmsg(socket, &message, flags | MSG_NOSIGNAL);
}

// Receives one piece, and as many descriptors as there is room for; those that do not come stay as they are.
inline ssize_t receive_with(int socket, std::span<std::byte> bytes, std::span<int> descriptors) {
    alignas(cmsghdr) std::byte control[CMSG_SPACE(2 * sizeof(int))] = {};
    iovec piece{bytes.data(), bytes.size()};
    msghdr message = {};
    message.msg_iov = &piece;
    message.msg_iovlen = 1;
    message.msg_control = control;
    message.msg_controllen = sizeof control;
    ssize_t n = -1;
    do n = recvmsg(socket, &message, MSG_CMSG_CLOEXEC);
    while (n < 0 && errno == EINTR);
    const cmsghdr* head = n < 0 ? nullptr : CMSG_FIRSTHDR(&message);
    if (head != nullptr && head->cmsg_type == SCM_RIGHTS)
        std::memcpy(descriptors.data(), CMSG_DATA(head),
                    std::min(descriptors.size_bytes(), std::size_t{head->cmsg_len} - CMSG_LEN(0)));
    return n;
}

// A whole packet; false where there is none any more.
inline bool receive_packet(int socket, std::span<std::byte> bytes, std::span<int> descriptors) {
    return receive_with(socket, bytes, descriptors) == static_cast<ssize_t>(bytes.size());
}

// A descriptor comes with one byte of its own; -1 where none did.
inline int receive_descriptor(int socket) {
    std::byte byte = {};
    int descriptor = -1;
    receive_with(socket, std::span(&byte, 1), std::span(&descriptor, 1));
    return descriptor;
}

// Waits as long as it takes; false where the other side has gone.
inline bool receive_all(int socket, std::span<std::byte> bytes) {
    while (!bytes.empty()) {
        const ssize_t n = recv(socket, bytes.data(), bytes.size(), 0);
        if (n == 0 || (n < 0 && errno != EINTR)) return false;
        if (n > 0) bytes = bytes.subspan(static_cast<std::size_t>(n));
    }
    return true;
}

inline bool send_all(int socket, std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        const ssize_t n = send(socket, bytes.data(), bytes.size(), MSG_NOSIGNAL);
        if (n < 0 && errno != EINTR) return false;
        if (n > 0) bytes = bytes.subspan(static_cast<std::size_t>(n));
    }
    return true;
}

}  // namespace keyline
