// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/lsp/connection.h"

#include "engine/base/error.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <cstddef>
#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

namespace keyline::lsp {

namespace {

constexpr std::size_t kLongest = std::size_t{256} << 20;

std::size_t length_in(std::string_view header) {
    std::string lower(header);
    std::ranges::transform(lower, lower.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    constexpr std::string_view kName = "content-length:";
    std::size_t at = lower.find(kName);
    if (at != std::string::npos) at = lower.find_first_not_of(" \t", at + kName.size());
    std::size_t length = 0;
    const bool is_number =
        at != std::string::npos &&
        std::from_chars(lower.data() + at, lower.data() + lower.size(), length).ec == std::errc{};
    if (!is_number || length > kLongest)
        fail(ErrorKind::kInput, "what came on standard input is no message of the language server protocol",
             "'keyline lsp' is started by an editor");
    return length;
}

}  // namespace

bool Connection::fill() {
    std::array<char, 1 << 16> part;
    ssize_t n = 0;
    do n = ::read(in_, part.data(), part.size());
    while (n < 0 && errno == EINTR);
    if (n > 0) buffer_.append(part.data(), static_cast<std::size_t>(n));
    return n > 0;
}

std::optional<std::string> Connection::read() {
    constexpr std::string_view kEnd = "\r\n\r\n";
    constexpr std::size_t kLongestHeader = 4096;
    std::size_t header = 0;
    while ((header = buffer_.find(kEnd)) == std::string::npos) {
        if (buffer_.size() > kLongestHeader) length_in("");
        if (!fill()) return std::nullopt;
    }
    const std::size_t begin = header + kEnd.size(),
                      length = length_in(std::string_view(buffer_).substr(0, header));
    while (buffer_.size() < begin + length)
        if (!fill()) return std::nullopt;
    std::string out = buffer_.substr(begin, length);
    buffer_.erase(0, begin + length);
    return out;
}

bool Connection::has_more() {
    pollfd one{in_, POLLIN, 0};
    return !buffer_.empty() || (poll(&one, 1, 0) > 0 && fill());
}

void Connection::write(std::string_view message) const {
    const std::string all = fmt::format("Content-Length: {}\r\n\r\n{}", message.size(), message);
    for (std::string_view rest = all; !rest.empty();) {
        const ssize_t n = ::write(out_, rest.data(), rest.size());
        if (n < 0 && errno == EINTR) continue;
        if (n <= 0) return;
        rest.remove_prefix(static_cast<std::size_t>(n));
    }
}

}  // namespace keyline::lsp
