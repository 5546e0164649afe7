// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/expr/parse.h"

#include "engine/expr/functions.h"
#include "engine/expr/tokens.h"
#include "engine/json/make_value.h"

#include <array>
#include <fmt/format.h>
#include <utility>

namespace keyline {

namespace {

constexpr std::size_t kLongest = 2000;  // bytes of text
constexpr int kDeepest = 64;            // parts inside each other, as in a graph file

// Operators of two values, from weak to strong.
struct Level {
    std::array<std::string_view, 6> operators;
    bool repeats;  // a + b + c, but not a < b < c
};
constexpr std::array<Level, 5> kLevels{{{{"or"}, true},
                                        {{"and"}, true},
                                        {{"<", "<=", ">", ">=", "==", "!="}, false},
                                        {{"+", "-"}, true},
                                        {{"*", "/", "%"}, true}}};
constexpr std::size_t kComparisons = 2;  // `not` binds weaker than these

template <class... Terms>
Term term_of(Term::Kind kind, const Token& token, Terms... parts) {
    Term term{kind, token.at, token.text, {}, {}};
    (term.terms.push_back(std::move(parts)), ...);
    return term;
}

class Parser {
public:
    explicit Parser(std::string_view text) : tokens_(tokens_of(text, 1)) {}

    Term parse() {
        Term term = choice();
        if (now().kind != Token::Kind::kEnd)
            throw ExpressionFault(now().at, fmt::format("expected an operator, found {}", found()),
                                  way_out());
        return term;
    }

private:
    // What people write who are used to other languages.
    std::string way_out() const {
        if (now().is_sign(",")) return "a decimal point is written '.'";
        const bool is_if = now().is_word("if") || tokens_[0].is_word("if");
        return is_if ? "a choice is written CONDITION ? VALUE : OTHER" : "";
    }

    const Token& now() const { return tokens_[next_]; }
    std::string found() const {
        return now().kind == Token::Kind::kEnd ? "the end of the expression" : in_quotes(now().text);
    }
    bool take(std::string_view sign) {
        const bool is_it = now().is_sign(sign) || now().is_word(sign);
        next_ += is_it ? 1 : 0;
        return is_it;
    }
    void expect(std::string_view sign, std::string_view why) {
        if (!take(sign))
            throw ExpressionFault(now().at, fmt::format("expected '{}' {}, found {}", sign, why, found()));
    }

    // Counts how deep the parser is inside itself.
    class Deeper {
    public:
        explicit Deeper(Parser& parser) : parser_(parser) {
            if (++parser_.depth_ > kDeepest)
                throw ExpressionFault(parser_.now().at,
                                      fmt::format("the expression is nested deeper than {}", kDeepest));
        }
        ~Deeper() { --parser_.depth_; }
        Deeper(const Deeper&) = delete;
        Deeper& operator=(const Deeper&) = delete;

    private:
        Parser& parser_;
    };

    Term choice() {
        const Deeper deeper(*this);
        Term condition = binary(0);
        const Token mark = now();
        if (!take("?")) return condition;
        Term yes = choice();
        expect(":", "between the two values of '?'");
        Term no = choice();
        return term_of(Term::Kind::kChoice, mark, std::move(condition), std::move(yes), std::move(no));
    }

    Term binary(std::size_t level) {
        if (level == kLevels.size()) return sign();
        if (level == kComparisons && now().is_word("not")) return negation(level);
        Term left = binary(level + 1);
        for (bool is_first = true;; is_first = false) {
            const Token token = now();
            if (!take_operator(kLevels[level])) return left;
            if (!is_first && !kLevels[level].repeats)
                throw ExpressionFault(token.at, "comparisons do not follow each other",
                                      "write a < b and b < c");
            Term right = binary(level + 1);
            left = term_of(Term::Kind::kOperator, token, std::move(left), std::move(right));
        }
    }

    bool take_operator(const Level& level) {
        for (const std::string_view op : level.operators)
            if (!op.empty() && take(op)) return true;
        return false;
    }

    Term negation(std::size_t level) {
        const Deeper deeper(*this);
        const Token token = tokens_[next_++];
        return term_of(Term::Kind::kOperator, token, binary(level));
    }

    // −2^2 is −4.
    Term sign() { return now().is_sign("-") ? negation(kLevels.size()) : power(); }

    Term power() {
        Term base = primary();
        const Token token = now();
        if (!take("^")) return base;
        const Deeper deeper(*this);
        return term_of(Term::Kind::kOperator, token, std::move(base), sign());
    }

    Term primary() {
        const Token token = now();
        ++next_;
        switch (token.kind) {
            case Token::Kind::kNumber: return constant(token, number_value(token.number));
            case Token::Kind::kText: return constant(token, text_value(token.text));
            case Token::Kind::kName: return name(token);
            case Token::Kind::kSign:
                if (token.text == "(") return in_brackets();
                if (token.text == "[") return list(token);
                break;
            case Token::Kind::kEnd: break;
        }
        --next_;
        throw ExpressionFault(token.at, fmt::format("expected a value, found {}", found()));
    }

    Term in_brackets() {
        Term term = choice();
        expect(")", "at the end of what stands in '('");
        return term;
    }

    Term list(const Token& token) {
        Term term = term_of(Term::Kind::kList, token);
        term.terms = values_until("]");
        return term;
    }

    std::vector<Term> values_until(std::string_view close) {
        std::vector<Term> out;
        if (take(close)) return out;
        do out.push_back(choice());
        while (take(","));
        expect(close, "or ',' after a value");
        return out;
    }

    Term name(const Token& token) {
        if (now().is_sign("(")) return call(token);
        if (token.text == "true" || token.text == "false")
            return constant(token, truth_value(token.text == "true"));
        if (token.text == "pi") return constant(token, number_value(kPi));
        if (token.text == "and" || token.text == "or" || token.text == "not")
            throw ExpressionFault(token.at, fmt::format("expected a value, found '{}'", token.text));
        return term_of(Term::Kind::kName, token);
    }

    Term call(const Token& token) {
        check_function(token.text, token.at);
        take("(");
        Term term = term_of(Term::Kind::kCall, token);
        term.terms = values_until(")");
        check_arguments(token.text, term.terms.size(), token.at);
        return term;
    }

    static Term constant(const Token& token, Value value) {
        Term term = term_of(Term::Kind::kConstant, token);
        term.constant = std::move(value);
        return term;
    }

    std::vector<Token> tokens_;
    std::size_t next_ = 0;
    int depth_ = 0;
};

}  // namespace

Term parse_expression(std::string_view text) {
    if (text.size() > kLongest)
        throw ExpressionFault(kLongest, fmt::format("the expression is longer than {} characters", kLongest));
    return Parser(text).parse();
}

}  // namespace keyline
