// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/base/error.h"

#include <string>
#include <string_view>
#include <vector>

namespace KEYLINE_API keyline {

struct Member;

// A JSON value that remembers where it stood, so that whoever finds fault with it can say where.
struct Value {
    enum class Kind { kNull, kBool, kNumber, kString, kArray, kObject };

    Kind kind = Kind::kNull;
    bool boolean = false;
    double number = 0;
    std::string text;             // a string's text; a number's as written; an option's value as typed
    std::vector<Value> items;     // an array's
    std::vector<Member> members;  // an object's, in the file's order; keys are unique
    Place place;

    bool is(Kind k) const { return kind == k; }
    const Value* find(std::string_view key) const;  // of an object; null where there is none

    // For messages: compact JSON, cut to 60 characters.
    std::string shown() const;
};

struct Member {
    std::string key;
    Place key_place;
    Value value;
};

// "a number", "a string", "an array", …
std::string_view kind_name(Value::Kind kind);

}  // namespace keyline
