// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/expr/expression.h"

#include "engine/expr/functions.h"
#include "engine/expr/parse.h"
#include "engine/json/make_value.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace keyline {

namespace {

using Kind = Value::Kind;

class Evaluation {
public:
    explicit Evaluation(const ExpressionScope& scope) : scope_(scope) {}

    Value of(const Term& term) const {
        switch (term.kind) {
            case Term::Kind::kConstant: return term.constant;
            case Term::Kind::kName: return named(term.text, term.at);
            case Term::Kind::kList: return list(term);
            case Term::Kind::kChoice: return of(truth(term.terms[0], "'?'") ? term.terms[1] : term.terms[2]);
            case Term::Kind::kOperator: return operation(term);
            case Term::Kind::kCall: break;
        }
        return finite(term, call(term));
    }

private:
    Value named(const std::string& name, std::size_t at) const {
        try {
            if (std::optional<Value> value = scope_.value(name)) return *value;
        } catch (const ExpressionFault&) {
            throw;
        } catch (const Failure& f) {
            throw ExpressionFault(at, f.error().what, f.error().hint);
        }
        throw ExpressionFault(at, "unknown name " + in_quotes(name), did_you_mean(name, scope_.names()));
    }

    Value list(const Term& term) const {
        Value out;
        out.kind = Kind::kArray;
        for (const Term& t : term.terms) out.items.push_back(of(t));
        return out;
    }

    // What `asks` takes, a number or a truth; told at the part that is something else.
    Value wanted(const Term& term, Kind kind, const std::string& asks) const {
        Value value = of(term);
        if (value.is(kind)) return value;
        throw ExpressionFault(term.at, fmt::format("{} takes {}, and this is {}, {}", asks,
                                                   kind == Kind::kBool ? "what is true or false" : "numbers",
                                                   value.shown(), kind_name(value.kind)));
    }
    double number(const Term& term, const std::string& asks) const {
        return wanted(term, Kind::kNumber, asks).number;
    }
    bool truth(const Term& term, const std::string& asks) const {
        return wanted(term, Kind::kBool, asks).boolean;
    }

    Value operation(const Term& term) const {
        const std::string asks = in_quotes(term.text);
        if (term.text == "not") return truth_value(!truth(term.terms[0], asks));
        if (term.text == "and" || term.text == "or") {
            const bool left = truth(term.terms[0], asks);
            return truth_value(left == (term.text == "or") ? left : truth(term.terms[1], asks));
        }
        if (term.text == "==" || term.text == "!=")
            return truth_value(equal(term, of(term.terms[0]), of(term.terms[1])) == (term.text == "=="));
        const double a = number(term.terms[0], asks);
        if (term.terms.size() == 1) return number_value(-a);
        const double b = number(term.terms[1], asks);
        if (term.text.starts_with('<') || term.text.starts_with('>')) return comparison(term.text, a, b);
        return finite(term, arithmetic(term, a, b));
    }

    static bool equal(const Term& term, const Value& a, const Value& b) {
        if (a.kind != b.kind || a.is(Kind::kArray))
            throw ExpressionFault(
                term.at, fmt::format("{} compares numbers with numbers and texts with texts, not {} with {}",
                                     in_quotes(term.text), a.shown(), b.shown()));
        if (a.is(Kind::kString)) return a.text == b.text;
        return a.number == b.number && a.boolean == b.boolean;
    }

    static Value comparison(const std::string& sign, double a, double b) {
        const bool or_equal = sign.size() == 2 && a == b;
        return truth_value(or_equal || (sign[0] == '<' ? a < b : a > b));
    }

    static double arithmetic(const Term& term, double a, double b) {
        if (b == 0 && (term.text == "/" || term.text == "%"))
            throw ExpressionFault(term.at, fmt::format("{} is divided by 0", a));
        switch (term.text[0]) {
            case '+': return a + b;
            case '-': return a - b;
            case '*': return a * b;
            case '/': return a / b;
            case '%': return modulo(a, b);
            default: return power(a, b);
        }
    }

    double call(const Term& term) const {
        std::vector<double> values;
        for (const Term& t : term.terms) values.push_back(number(t, in_quotes(term.text)));
        if (term.text == "hold") return hold(term, values[0]);
        return call_function(term.text, values);
    }

    double hold(const Term& term, double length) const {
        if (length < 1) throw ExpressionFault(term.at, "'hold' takes at least one frame");
        return held_frame(named("frame", term.at).number, scope_.first_frame(), length);
    }

    static Value finite(const Term& term, double number) {
        if (!std::isfinite(number))
            throw ExpressionFault(term.at,
                                  fmt::format("the result of {} is no finite number", in_quotes(term.text)));
        return number_value(number);
    }

    const ExpressionScope& scope_;
};

void add_names(const Term& term, std::vector<NameInExpression>& out) {
    if (term.kind == Term::Kind::kName) out.push_back({term.text, term.at});
    if (term.kind == Term::Kind::kCall && term.text == "hold") out.push_back({"frame", term.at});
    for (const Term& t : term.terms) add_names(t, out);
}

// Columns that a character of a string took in the file.
int columns_of(char c) {
    const bool continues = (static_cast<unsigned char>(c) & 0xC0U) == 0x80U;
    const bool is_escaped = c == '"' || c == '\\' || c == '\n' || c == '\t';
    return continues ? 0 : is_escaped ? 2 : 1;
}

}  // namespace

Expression::Expression(std::string_view text) : root_(parse_expression(text)) {}

Value Expression::evaluate(const ExpressionScope& scope) const { return Evaluation(scope).of(root_); }

std::vector<NameInExpression> Expression::names() const {
    std::vector<NameInExpression> out;
    add_names(root_, out);
    return out;
}

Place place_inside(const Value& string, std::size_t byte) {
    Place place = string.place;
    if (place.line == 0) return place;
    ++place.column;  // the quote
    for (const char c : std::string_view(string.text).substr(0, byte)) place.column += columns_of(c);
    return place;
}

}  // namespace keyline
