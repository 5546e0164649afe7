// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"

#include <compare>
#include <concepts>
#include <cstdint>
#include <string>
#include <string_view>

namespace KEYLINE_API keyline {

// What a thing is, in 128 bits: the same for equal things, on every machine and in every run.
struct Digest {
    uint64_t high = 0, low = 0;

    // Not so for a thing that can't be told from others of its kind, such as an image in memory.  It is equal
    // to nothing, and so is whatever is made of it.
    bool known() const { return high != 0 || low != 0; }
    friend auto operator<=>(const Digest&, const Digest&) = default;
};

// 32 hexadecimal digits, or "unknown".
std::string to_string(const Digest& digest);

// Makes a digest of parts.  Each part says where it ends, so that "ab", "c" differs from "a", "bc".
class Digester {
public:
    explicit Digester(std::string_view what) { add(what); }

    Digester& add(std::string_view text);
    Digester& add(double number);
    Digester& add(const Digest& digest);
    template <std::integral T>
    Digester& add(T number) {
        return add_number(static_cast<uint64_t>(static_cast<int64_t>(number)));
    }

    Digest digest() const;

private:
    Digester& add_number(uint64_t number);

    std::string bytes_;
    bool known_ = true;
};

}  // namespace keyline
