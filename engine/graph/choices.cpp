// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/graph/choices.h"

#include "engine/graph/graph_error.h"

#include <algorithm>
#include <fmt/format.h>

namespace keyline {

namespace {

using Kind = Value::Kind;

bool is_plain(const Value& v) { return v.is(Kind::kString) || v.is(Kind::kNumber) || v.is(Kind::kBool); }

bool is_same(const Value& a, const Value& b) {
    if (a.kind != b.kind) return false;
    return a.is(Kind::kString) ? a.text == b.text : a.number == b.number && a.boolean == b.boolean;
}

void check_keys(const Value& declared, Diagnostics& diagnostics) {
    static const std::vector<std::string> known{"default", "choices", "about"};
    for (const Member& m : declared.members) {
        if (std::ranges::find(known, m.key) == known.end()) {
            const std::string hint = did_you_mean(m.key, known);
            graph_error(diagnostics, m.key_place, "unknown key " + in_quotes(m.key),
                        hint.empty() ? "a variable with choices knows " + listed(known) : hint, {},
                        Code::kUnknownKey);
        }
        if (m.key == "about") check_text(m, diagnostics);
    }
}

std::vector<Value> read_choices(const Value& choices, Diagnostics& diagnostics) {
    if (!choices.is(Kind::kArray) || choices.items.empty() || !std::ranges::all_of(choices.items, is_plain)) {
        graph_error(
            diagnostics, choices.place,
            fmt::format("'choices' is {}; it must be a list of texts, numbers or truths", choices.shown()),
            {}, {}, Code::kWrongValue);
        return {};
    }
    return choices.items;
}

}  // namespace

Choice read_choice(const Value& declared, Diagnostics& diagnostics) {
    const Value* choices = declared.is(Kind::kObject) ? declared.find("choices") : nullptr;
    if (choices == nullptr) return {declared};
    check_keys(declared, diagnostics);
    const Value* value = declared.find("default");
    if (value == nullptr)
        graph_error(diagnostics, declared.place, "'default', which of the choices it is, is missing", {}, {},
                    Code::kMissingKey);
    Choice out{value ? *value : Value{}, read_choices(*choices, diagnostics)};
    if (value == nullptr) out = {out.choices.empty() ? Value{} : out.choices.front()};
    return out;
}

std::string choice_fault(const std::string& name, const Value& value, const std::vector<Value>& choices) {
    const auto is_it = [&](const Value& choice) { return is_same(choice, value); };
    if (choices.empty() || std::ranges::any_of(choices, is_it)) return {};
    return fmt::format("'{}' is {}; it must be one of {}", name, value.shown(),
                       listed(choice_texts(choices)));
}

std::vector<std::string> choice_texts(const std::vector<Value>& choices) {
    std::vector<std::string> out;
    for (const Value& c : choices) out.push_back(c.is(Kind::kBool) ? (c.boolean ? "true" : "false") : c.text);
    return out;
}

}  // namespace keyline
