// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/error.h"
#include "engine/json/value.h"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace keyline {

// What is wrong with an expression, and the byte of its text where that stands.
class ExpressionFault final : public Failure {
public:
    ExpressionFault(std::size_t at, std::string what, std::string hint = {})
        : Failure({ErrorKind::kGraph, {}, {}, std::move(what), std::move(hint)}), at_(at) {}
    std::size_t at() const { return at_; }

private:
    std::size_t at_;
};

// What the names in an expression stand for.
class ExpressionScope {
public:
    virtual ~ExpressionScope() = default;
    // Nothing where there is no such name.  Throws Failure where it has no value now.
    virtual std::optional<Value> value(const std::string& name) const = 0;
    // Where frames that are held begin.
    virtual double first_frame() const = 0;
    // Every name there is, for hints.
    virtual std::vector<std::string> names() const = 0;
};

// A part of an expression: what is computed, from what.
struct Term {
    enum class Kind { kConstant, kName, kList, kChoice, kOperator, kCall };
    Kind kind = Kind::kConstant;
    std::size_t at = 0;       // its byte in the text; of an operator, where that stands
    std::string text;         // the name, the operator, the function
    Value constant;           // a number, a text, true or false
    std::vector<Term> terms;  // what it is computed from
};

struct NameInExpression {
    std::string name;
    std::size_t at;
};

// Whether a text is meant as an expression.
inline bool is_expression(std::string_view text) { return text.starts_with('='); }

// An expression as read.  Bounded: texts are short, nesting is shallow, and there is nothing that repeats.
class Expression {
public:
    // `text` begins with '='.  Throws ExpressionFault.
    explicit Expression(std::string_view text);

    // A number, true or false, a text, or a list of them.  Throws ExpressionFault.
    Value evaluate(const ExpressionScope& scope) const;

    // Those that it asks the scope for, some perhaps more than once.
    std::vector<NameInExpression> names() const;

private:
    Term root_;
};

// The place of a byte of a string's text, as far as JSON's escapes let one count.
Place place_inside(const Value& string, std::size_t byte);

}  // namespace keyline
