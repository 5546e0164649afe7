// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/graph/references.h"
#include "engine/graph/variables.h"

#include <map>

namespace keyline {

// Whether a name in an expression is that of a size of the node's leading input.
bool is_size(std::string_view name);

// Replaces what stands in one value, for one moment.
class Variables::Replacer {
public:
    Replacer(const Variables& variables, const Moment& moment, Diagnostics& diagnostics)
        : variables_(variables), moment_(moment), diagnostics_(diagnostics) {}

    // Finds out what the variables that `value` reaches stand for now; before it is replaced.
    void prepare(const Value& value, const Guide& guide);
    Value replace(const Value& value, const Guide& guide, std::size_t depth = 0);

    // Tells what is wrong at any moment.
    void check(const Value& value, const Guide& guide);

    bool failed() const { return failed_; }

private:
    class Names;

    std::optional<Value> fault(const Place& place, std::string what, std::string hint = {},
                               Code code = Code::kWrongValue);
    Value replace_string(const Value& string, std::size_t depth);
    Value evaluated(const Value& string);
    Value moved(const Value& animation, const Guide& guide);
    Value value_now(const Variable& variable);
    bool is_known_now(const Variable& variable) const;
    std::optional<Value> join(const std::vector<Piece>& pieces, const Place& use);
    std::optional<Value> value_of(const Piece& piece, const Place& use);
    std::optional<Value> variable(const std::string& name, const Place& use);
    std::optional<Value> environment(const std::string& name, const Place& use);
    void check_expression(const Value& string);
    void check_text(const Value& string);
    std::string hint(const std::string& name) const;

    const Variables& variables_;
    const Moment moment_;
    Diagnostics& diagnostics_;
    std::map<std::size_t, std::optional<Value>> now_;  // of variables that change; nothing: it failed
    std::size_t size_ = 0;                             // of what was put in so far
    bool failed_ = false;
};

}  // namespace keyline
