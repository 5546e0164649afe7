// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/graph/guide.h"
#include "engine/json/value.h"

#include <string>
#include <string_view>
#include <vector>

namespace keyline {

// A piece of a text: the text itself, or what a ${…} in it refers to.
struct Piece {
    enum class Kind { kText, kVariable, kFrame, kEnvironment, kName };  // kName: of an expression
    Kind kind;
    std::string text;  // the text itself, or the name
};

struct Template {
    std::vector<Piece> pieces;
    std::string fault;  // where the text is none; empty: it is

    bool is_just_a_name() const { return pieces.size() == 1 && pieces[0].kind != Piece::Kind::kText; }
};

Template parse_template(std::string_view text);

// What a name in an expression stands for: the frame, a variable of the environment, or something that has a
// name.
Piece piece_of_name(const std::string& name);

// What a string refers to: ${…}, or the names in an expression where it is one.
std::vector<Piece> references_in(const Value& string, bool computes);

// Visits all that a value refers to; keys refer to the frame.
template <typename F>
void for_each_reference(const Value& value, const Guide& guide, const F& visit) {
    if (value.is(Value::Kind::kString))
        for (const Piece& piece : references_in(value, guide.computes())) visit(piece);
    if (guide.animates() && is_animation(value)) visit(Piece{Piece::Kind::kFrame, {}});
    for_each_part(value, guide,
                  [&](const Value& part, const Guide& of_it) { for_each_reference(part, of_it, visit); });
}

// Whether there is an expression in it, or keys.
bool is_computed(const Value& value, const Guide& guide);

template <typename F>
bool any_reference(const Value& value, const Guide& guide, const F& is_it) {
    bool out = false;
    for_each_reference(value, guide, [&](const Piece& piece) { out = out || is_it(piece); });
    return out;
}

}  // namespace keyline
