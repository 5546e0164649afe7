// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/json/value.h"

#include <concepts>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace KEYLINE_API keyline {

// Writes JSON as it goes, one call a token; what does not make a whole value is the caller's fault and comes
// out as written.
//
//     JsonWriter json;
//     json.begin_object().key("frame").value(7).key("files").begin_array().value("a.exr").end_array();
//     puts(json.end_object().text().c_str());
class JsonWriter {
public:
    enum class Style { kOneLine, kIndented };
    explicit JsonWriter(Style style = Style::kOneLine) : style_(style) {}

    JsonWriter& begin_object() { return begin('{'); }
    JsonWriter& end_object() { return end('}'); }
    JsonWriter& begin_array() { return begin('['); }
    JsonWriter& end_array() { return end(']'); }
    JsonWriter& key(std::string_view name);

    // Bytes that are not UTF-8 become U+FFFD.
    JsonWriter& value(std::string_view text);
    JsonWriter& value(const char* text) { return value(std::string_view(text)); }
    JsonWriter& value(const std::string& text) { return value(std::string_view(text)); }
    JsonWriter& value(double number);  // null where it is not finite
    JsonWriter& value(float number);
    JsonWriter& value(std::same_as<bool> auto flag) { return token(flag ? "true" : "false"); }
    template <std::integral T>
    requires(!std::same_as<T, bool>) JsonWriter& value(T number) { return token(std::to_string(number)); }
    JsonWriter& value(const Value& v);

    // The same after key().
    template <class T>
    JsonWriter& field(std::string_view name, const T& v) {
        return key(name).value(v);
    }
    template <class T>
    JsonWriter& list(const std::vector<T>& items) {
        begin_array();
        for (const T& item : items) value(item);
        return end_array();
    }

    const std::string& text() const { return out_; }

private:
    JsonWriter& begin(char bracket);
    JsonWriter& end(char bracket);
    JsonWriter& token(std::string_view text);
    void separate();
    void new_line();

    Style style_;
    std::string out_;
    std::vector<bool> has_items_;  // by depth
    bool after_key_ = false;
};

}  // namespace keyline
