// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"

#include <cstddef>
#include <string_view>
#include <vector>

// JSON as it is written: every value, key and comment with the bytes where it stands.  For what changes text
// or looks at it while it is typed; what only reads it wants a Value.

namespace KEYLINE_API keyline {

// Bytes of a text, from `begin` to before `end`.
struct Span {
    std::size_t begin = 0, end = 0;

    std::string_view of(std::string_view text) const { return text.substr(begin, end - begin); }
    bool is_empty() const { return begin == end; }
    // Whether a cursor stands in it or at one of its ends.
    bool touches(std::size_t at) const { return begin <= at && at <= end; }
};

struct JsonComment {
    Span span;
    int lines_before = 0;  // ends of lines between it and what is before it
};

struct JsonItem;

struct JsonTree {
    enum class Kind {
        kMissing,  // where a value should stand
        kWord,     // a number, true, false or null; or something that is none
        kString,
        kArray,
        kObject
    };

    Kind kind = Kind::kMissing;
    Span span = {};
    std::vector<JsonItem> items;               // of an array or an object
    std::vector<JsonComment> before_end = {};  // comments on lines of their own in front of the bracket
    bool is_closed = true;                     // else its end is missing

    bool is(Kind k) const { return kind == k; }
};

// A value of an array, or a member of an object.
struct JsonItem {
    std::vector<JsonComment> before = {};
    int lines_before = 0;  // ends of lines between it and what is before it, its own comments too
    Span key = {};         // with its quotes; empty in an array
    JsonTree value = {};
    std::vector<JsonComment> after = {};  // on its last line
};

struct JsonDocument {
    JsonTree root;
    std::vector<JsonComment> before, after;  // outside of it
    int lines_before = 0;                    // ends of lines between it and what is before it
};

// Reads any text.  Of what is not JSON, or not yet, as much is made as can be: a value that is not there is
// kMissing, a bracket that is not closed ends where the text or what is around it does.
JsonDocument read_json_tree(std::string_view text);

}  // namespace keyline
