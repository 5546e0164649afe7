// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/json/value.h"

#include "engine/base/text.h"

#include <algorithm>
#include <fmt/format.h>

namespace keyline {

namespace {

constexpr std::size_t kLongestShown = 60;  // characters

// Enough bytes for the longest text shown, whatever its characters: writing may stop here.
constexpr std::size_t kEnough = 4 * (kLongestShown + 1);

void append_string(std::string& out, std::string_view text) {
    out += '"' + escaped(text.substr(0, kEnough), Escapes::kJson) + '"';
}

void append(std::string& out, const Value& value);

void append_array(std::string& out, const Value& value) {
    out += '[';
    for (const Value& item : value.items) {
        if (out.size() > kEnough) return;
        if (&item != &value.items.front()) out += ',';
        append(out, item);
    }
    out += ']';
}

void append_object(std::string& out, const Value& value) {
    out += '{';
    for (const Member& member : value.members) {
        if (out.size() > kEnough) return;
        if (&member != &value.members.front()) out += ',';
        append_string(out, member.key);
        out += ':';
        append(out, member.value);
    }
    out += '}';
}

void append(std::string& out, const Value& value) {
    switch (value.kind) {
        case Value::Kind::kNull: out += "null"; break;
        case Value::Kind::kBool: out += value.boolean ? "true" : "false"; break;
        case Value::Kind::kNumber:
            out += value.text.empty() ? fmt::format("{}", value.number) : value.text;
            break;
        case Value::Kind::kString: append_string(out, value.text); break;
        case Value::Kind::kArray: append_array(out, value); break;
        case Value::Kind::kObject: append_object(out, value); break;
    }
}

}  // namespace

const Value* Value::find(std::string_view key) const {
    const auto found =
        std::find_if(members.begin(), members.end(), [&](const Member& m) { return m.key == key; });
    return found == members.end() ? nullptr : &found->value;
}

std::string Value::shown() const {
    std::string out;
    append(out, *this);
    std::size_t characters = 0;
    for (std::size_t i = 0; i < out.size(); ++i) {
        const bool continuation = (static_cast<unsigned char>(out[i]) & 0xC0U) == 0x80U;
        if (!continuation && ++characters > kLongestShown) return out.substr(0, i) + "…";
    }
    return out;
}

std::string_view kind_name(Value::Kind kind) {
    switch (kind) {
        case Value::Kind::kNull: return "null";
        case Value::Kind::kBool: return "a boolean";
        case Value::Kind::kNumber: return "a number";
        case Value::Kind::kString: return "a string";
        case Value::Kind::kArray: return "an array";
        case Value::Kind::kObject: return "an object";
    }
    return "";
}

}  // namespace keyline
