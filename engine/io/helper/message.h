// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

// Values as the bytes of a request or a reply, one after the other, and back.  Both sides are of one build.

namespace keyline {

class MessageWriter {
public:
    template <class T>
    requires std::is_trivially_copyable_v<T> MessageWriter& put(const T& value) {
        const auto bytes = std::as_bytes(std::span(&value, 1));
        bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
        return *this;
    }
    template <class T>
    requires std::is_trivially_copyable_v<T> MessageWriter& put(const std::vector<T>& values) {
        put(uint64_t{values.size()});
        const auto bytes = std::as_bytes(std::span(values));
        bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
        return *this;
    }
    MessageWriter& put_text(std::string_view text) {
        return put(std::vector<char>(text.begin(), text.end()));
    }

    const std::vector<std::byte>& bytes() const { return bytes_; }

private:
    std::vector<std::byte> bytes_;
};

// Throws std::runtime_error for bytes that no MessageWriter wrote.
class MessageReader {
public:
    explicit MessageReader(std::span<const std::byte> bytes) : left_(bytes) {}

    template <class T>
    requires std::is_trivially_copyable_v<T> T get() {
        T value{};
        std::memcpy(&value, take(sizeof(T)).data(), sizeof(T));
        return value;
    }
    template <class T>
    requires std::is_trivially_copyable_v<T> std::vector<T> get_all() {
        const auto count = get<uint64_t>();
        if (count > left_.size() / sizeof(T)) torn();
        std::vector<T> values(count);
        if (count > 0) std::memcpy(values.data(), take(count * sizeof(T)).data(), count * sizeof(T));
        return values;
    }
    std::string get_text() {
        const std::vector<char> text = get_all<char>();
        return {text.begin(), text.end()};
    }

private:
    [[noreturn]] static void torn() { throw std::runtime_error("a message that is not whole"); }

    std::span<const std::byte> take(std::size_t n) {
        if (n > left_.size()) torn();
        const auto taken = left_.first(n);
        left_ = left_.subspan(n);
        return taken;
    }

    std::span<const std::byte> left_;
};

}  // namespace keyline
