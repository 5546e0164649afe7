// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/json/json_writer.h"

#include "engine/base/text.h"

#include <cmath>
#include <fmt/format.h>

namespace keyline {

namespace {

std::string quoted(std::string_view text) { return '"' + escaped(text, Escapes::kJson) + '"'; }

}  // namespace

void JsonWriter::new_line() {
    if (style_ == Style::kIndented) out_.append(1, '\n').append(2 * has_items_.size(), ' ');
}

// Whatever belongs between the last token and the next one of the same array or object.
void JsonWriter::separate() {
    if (after_key_ || has_items_.empty()) {
        after_key_ = false;
        return;
    }
    if (has_items_.back()) out_ += style_ == Style::kIndented ? "," : ", ";
    has_items_.back() = true;
    new_line();
}

JsonWriter& JsonWriter::begin(char bracket) {
    separate();
    out_ += bracket;
    has_items_.push_back(false);
    return *this;
}

JsonWriter& JsonWriter::end(char bracket) {
    const bool had_items = has_items_.back();
    has_items_.pop_back();
    if (had_items) new_line();
    out_ += bracket;
    return *this;
}

JsonWriter& JsonWriter::token(std::string_view text) {
    separate();
    out_ += text;
    return *this;
}

JsonWriter& JsonWriter::key(std::string_view name) {
    token(quoted(name) + ": ");
    after_key_ = true;
    return *this;
}

JsonWriter& JsonWriter::value(std::string_view text) { return token(quoted(text)); }

JsonWriter& JsonWriter::value(double number) {
    return token(std::isfinite(number) ? fmt::format("{}", number) : "null");
}

JsonWriter& JsonWriter::value(float number) {
    return token(std::isfinite(number) ? fmt::format("{}", number) : "null");
}

JsonWriter& JsonWriter::value(const Value& v) {
    switch (v.kind) {
        case Value::Kind::kNull: return token("null");
        case Value::Kind::kBool: return value(v.boolean);
        case Value::Kind::kNumber: return value(v.number);
        case Value::Kind::kString: return value(v.text);
        case Value::Kind::kArray: return list(v.items);
        case Value::Kind::kObject: break;
    }
    begin_object();
    for (const Member& m : v.members) field(m.key, m.value);
    return end_object();
}

}  // namespace keyline
