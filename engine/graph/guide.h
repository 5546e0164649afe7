// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/graph/animation.h"
#include "engine/params/param_types.h"

#include <cstddef>
#include <string_view>

namespace keyline {

// Says of a value and its parts, from the declared type, where an expression or keys may stand: where text is
// wanted, "= 5" is text.
class Guide {
public:
    static Guide text() { return {nullptr, false}; }
    static Guide of(const TypeInfo& type) { return {&type, false}; }
    static Guide everything() { return {nullptr, true}; }  // for a variable, whose type only its users know

    bool computes() const;  // an expression is evaluated
    bool animates() const;  // keys are
    bool is_whole() const;  // whole numbers are wanted
    Guide item(std::size_t i) const;
    Guide member(std::string_view name) const;

private:
    Guide(const TypeInfo* type, bool is_everything) : type_(type), is_everything_(is_everything) {}

    const TypeInfo* type_;  // null: text, or everything
    bool is_everything_;
};

// Visits the parts of a list or an object with what is declared for them; those of keys with what is declared
// for the whole.
template <class V, class F>
void for_each_part(V& value, const Guide& guide, const F& visit) {
    const bool moves = guide.animates() && is_animation(value);
    for (std::size_t i = 0; i < value.items.size(); ++i) visit(value.items[i], guide.item(i));
    for (auto& member : value.members) {
        if (!moves || member.key != "keys") {
            visit(member.value, moves ? Guide::everything() : guide.member(member.key));
            continue;
        }
        for (auto& key : member.value.items)
            for (std::size_t i = 0; i < key.items.size(); ++i)
                visit(key.items[i], i == 1 ? guide : Guide::everything());
    }
}

}  // namespace keyline
