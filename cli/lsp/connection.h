// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace keyline::lsp {

// Messages with a header in front of each, over two descriptors.
class Connection {
public:
    Connection(int in, int out) : in_(in), out_(out) {}

    // Waits for the next; nothing where the other side has closed.  Throws Failure (kInput) for what is no
    // message.
    std::optional<std::string> read();

    // Whether read() would not have to wait for a message, or is under way to one.
    bool has_more();

    // Nothing happens where the other side is gone.
    void write(std::string_view message) const;

private:
    bool fill();

    int in_, out_;
    std::string buffer_;
};

}  // namespace keyline::lsp
