// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/expr/expression.h"

#include "engine/expr/functions.h"
#include "engine/json/make_value.h"

#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <map>

namespace keyline {
namespace {

class Names final : public ExpressionScope {
public:
    std::optional<Value> value(const std::string& name) const override {
        if (name == "nowhere") fail(ErrorKind::kGraph, "'nowhere' has no value now", "try later");
        const auto it = values_.find(name);
        return it == values_.end() ? std::nullopt : std::optional(it->second);
    }
    double first_frame() const override { return 1001; }
    std::vector<std::string> names() const override {
        std::vector<std::string> out;
        for (const auto& [name, value] : values_) out.push_back(name);
        return out;
    }

private:
    const std::map<std::string, Value> values_{
        {"frame", number_value(1007)},      {"first", number_value(1001)},  {"height", number_value(2160)},
        {"data.width", number_value(1920)}, {"look", text_value("ink")},    {"on", truth_value(true)},
        {"two-part", number_value(5)},      {"env:SHOW", text_value("ab")}, {"k", number_value(2)}};
};

std::string evaluated(const std::string& text) { return Expression(text).evaluate(Names()).shown(); }
double number(const std::string& text) { return Expression(text).evaluate(Names()).number; }

// "at BYTE: what; hint"
std::string fault(const std::string& text) {
    try {
        return "no fault but " + evaluated(text);
    } catch (const ExpressionFault& f) {
        const Error& e = f.error();
        return fmt::format("at {}: {}{}", f.at(), e.what, e.hint.empty() ? "" : "; " + e.hint);
    }
}

TEST(Expression, ComputesFromStrongToWeak) {
    EXPECT_EQ(evaluated("= 1 + 2 * 3"), "7");
    EXPECT_EQ(evaluated("= (1 + 2) * 3"), "9");
    EXPECT_EQ(evaluated("= 10 - 4 - 3"), "3");
    EXPECT_EQ(evaluated("= 24 / 4 / 2"), "3");
    EXPECT_EQ(evaluated("= 2^3^2"), "512");
    EXPECT_EQ(evaluated("= -2^2"), "-4");
    EXPECT_EQ(evaluated("= 2^-1"), "0.5");
    EXPECT_EQ(evaluated("= 2 * -3"), "-6");
    EXPECT_EQ(evaluated("=.5+1e-1"), "0.6");
    EXPECT_EQ(evaluated("= 7 % 3"), "1");
    EXPECT_EQ(evaluated("= -1 % 24"), "23");
}

TEST(Expression, DecidesAndCompares) {
    EXPECT_EQ(evaluated("= 1 < 2 and 2 <= 2 and 3 > 2 and 2 >= 2 and 1 != 2"), "true");
    EXPECT_EQ(evaluated("= not 1 < 2 or look == 'ink'"), "true");
    EXPECT_EQ(evaluated("= false or false and true"), "false");
    EXPECT_EQ(evaluated("= k > 1 ? 'a' : 'b'"), "\"a\"");
    EXPECT_EQ(evaluated("= k < 1 ? 1 : k < 3 ? 2 : 3"), "2");
    EXPECT_EQ(evaluated("= on ? [k, 'x', true] : []"), "[2,\"x\",true]");
}

TEST(Expression, LooksAtNothingThatDoesNotMatter) {
    EXPECT_EQ(evaluated("= k == 2 ? 1 : 1 / 0"), "1");
    EXPECT_EQ(evaluated("= on or 1 / 0 > 1"), "true");
    EXPECT_EQ(evaluated("= not on and 1 / 0 > 1"), "false");
}

TEST(Expression, KnowsNames) {
    EXPECT_EQ(evaluated("= 1.5 * height / 1080"), "3");
    EXPECT_EQ(evaluated("= data.width / 2"), "960");
    EXPECT_EQ(evaluated("= ${two-part} - ${k}"), "3");
    EXPECT_EQ(evaluated("= ${env:SHOW}"), "\"ab\"");
    std::vector<std::string> names;
    for (const auto& n : Expression("= a + ${b} * min(c, pi) ? d.e : hold(2)").names())
        names.push_back(n.name);
    EXPECT_EQ(names, (std::vector<std::string>{"a", "b", "c", "d.e", "frame"}));
}

TEST(Expression, HasFunctions) {
    EXPECT_EQ(evaluated("= min(3, 1, 2) + max(3, 1, 2)"), "4");
    EXPECT_EQ(evaluated("= abs(-2) + floor(-0.5) + ceil(0.5)"), "2");
    EXPECT_EQ(evaluated("= [round(0.5), round(-0.5), round(2.4)]"), "[1,0,2]");
    EXPECT_EQ(evaluated("= clamp(5, 0, 1) + clamp(-5, 0, 1)"), "1");
    EXPECT_EQ(evaluated("= mix(10, 20, 0.25)"), "12.5");
    EXPECT_EQ(evaluated("= [step(2, 1), step(2, 2)]"), "[0,1]");
    EXPECT_EQ(evaluated("= [smoothstep(0, 2, 1), smoothstep(0, 2, 5), smoothstep(1, 1, 0)]"), "[0.5,1,0]");
    EXPECT_EQ(evaluated("= sqrt(9)"), "3");
    EXPECT_NEAR(number("= exp(1)"), std::exp(1.0), 1e-14);
    EXPECT_NEAR(number("= log(10)"), std::log(10.0), 1e-14);
    EXPECT_NEAR(number("= sin(pi / 6)"), 0.5, 1e-14);
    EXPECT_NEAR(number("= cos(pi / 3)"), 0.5, 1e-14);
    EXPECT_NEAR(number("= 2^0.5"), std::sqrt(2.0), 1e-14);
}

TEST(Expression, HoldsFrames) {
    for (const double first : {1.0, 1001.0, -3.0})
        for (int i = 0; i < 9; ++i) EXPECT_EQ(held_frame(first + i, first, 3), first + i / 3 * 3);
    EXPECT_EQ(held_frame(-2, 1, 2), -3);
    EXPECT_EQ(evaluated("= hold(4)"), "1005");
}

TEST(Expression, NoiseIsSmoothAndDiffersBySeed) {
    double sum = 0, largest = 0;
    for (int i = 0; i < 1000; ++i) {
        const double here = number(fmt::format("= noise({}, 1)", i));
        sum += here;
        largest = std::max(largest, std::abs(here));
        EXPECT_NEAR(number(fmt::format("= noise({}.001, 1)", i)), here, 1e-4);
    }
    EXPECT_NEAR(sum / 1000, 0, 0.1);
    EXPECT_LE(largest, 1);
    EXPECT_GT(largest, 0.9);
    EXPECT_NE(evaluated("= noise(7, 1)"), evaluated("= noise(7, 2)"));
    EXPECT_EQ(evaluated("= noise(7)"), evaluated("= noise(7, 0)"));
}

TEST(Expression, FaultsAreToldWhereTheyStand) {
    EXPECT_EQ(fault("= 2 * hieght"), "at 6: unknown name 'hieght'; did you mean 'height'?");
    EXPECT_EQ(fault("= pow(2, 3)"), "at 2: there is no function 'pow'; a power is written x ^ y");
    EXPECT_EQ(fault("= mx(1, 2)"), "at 2: there is no function 'mx'; did you mean 'max'?");
    EXPECT_EQ(fault("= clamp(1, 2)"), "at 2: 'clamp' takes (x, low, high); it is given 2 values");
    EXPECT_EQ(fault("= 1 +"), "at 5: expected a value, found the end of the expression");
    EXPECT_EQ(fault("="), "at 1: expected a value, found the end of the expression");
    EXPECT_EQ(fault("= (1 + 2"),
              "at 8: expected ')' at the end of what stands in '(', found the end of the expression");
    EXPECT_EQ(fault("= 1 2"), "at 4: expected an operator, found '2'");
    EXPECT_EQ(fault("= 1,5"), "at 3: expected an operator, found ','; a decimal point is written '.'");
    EXPECT_EQ(fault("= 5px"), "at 2: '5px' is no number");
    EXPECT_EQ(fault("= 1e999"), "at 2: '1e999' is no number");
    EXPECT_EQ(fault("= 'ink"), "at 2: ''ink' has no \"'\" at its end");
    EXPECT_EQ(fault("= k ? 1"),
              "at 7: expected ':' between the two values of '?', found the end of the expression");
    EXPECT_EQ(fault("= and 1"), "at 2: expected a value, found 'and'");
    EXPECT_EQ(fault("= 1 < 2 < 3"), "at 8: comparisons do not follow each other; write a < b and b < c");
}

TEST(Expression, WhatOtherLanguagesWriteIsToldHow) {
    EXPECT_EQ(fault("= on && on"), "at 5: '&&' has no meaning in an expression; and is written 'and'");
    EXPECT_EQ(fault("= !on"), "at 2: '!' has no meaning in an expression; not is written 'not'");
    EXPECT_EQ(fault("= k = 2"),
              "at 4: '=' has no meaning in an expression; two values are compared with '=='");
    EXPECT_EQ(fault("= k ** 2"), "at 4: '**' has no meaning in an expression; a power is written '^'");
    EXPECT_EQ(fault("= k × 2"), "at 4: '×' has no meaning in an expression; it is written '*'");
    EXPECT_EQ(fault("= k; 2"), "at 3: ';' has no meaning in an expression");
}

TEST(Expression, ValuesOfTheWrongKindAreTold) {
    EXPECT_EQ(fault("= look + 1"), "at 2: '+' takes numbers, and this is \"ink\", a string");
    EXPECT_EQ(fault("= k ? 1 : 2"), "at 2: '?' takes what is true or false, and this is 2, a number");
    EXPECT_EQ(fault("= look == 1"),
              "at 7: '==' compares numbers with numbers and texts with texts, not \"ink\" with 1");
    EXPECT_EQ(fault("= max(1, on)"), "at 9: 'max' takes numbers, and this is true, a boolean");
}

TEST(Expression, WhatHasNoResultIsTold) {
    EXPECT_EQ(fault("= 1 / (k - 2)"), "at 4: 1 is divided by 0");
    EXPECT_EQ(fault("= 1 % 0"), "at 4: 1 is divided by 0");
    EXPECT_EQ(fault("= sqrt(-1)"), "at 2: the result of 'sqrt' is no finite number");
    EXPECT_EQ(fault("= (-8)^0.5"), "at 6: the result of '^' is no finite number");
    EXPECT_EQ(fault("= 1e300 * 1e300"), "at 8: the result of '*' is no finite number");
    EXPECT_EQ(fault("= hold(0)"), "at 2: 'hold' takes at least one frame");
    EXPECT_EQ(fault("= nowhere"), "at 2: 'nowhere' has no value now; try later");
}

TEST(Expression, IsBounded) {
    const auto repeated = [](std::string_view part, int n) {
        std::string out;
        for (int i = 0; i < n; ++i) out += part;
        return out;
    };
    EXPECT_EQ(fault("=" + repeated("(", 65)), "at 65: the expression is nested deeper than 64");
    EXPECT_EQ(fault("=" + repeated("-", 70) + "1"), "at 64: the expression is nested deeper than 64");
    EXPECT_EQ(fault("=" + repeated(" ", 2000)), "at 2000: the expression is longer than 2000 characters");
    EXPECT_EQ(evaluated("= 0" + repeated("+1", 900)), "900");
    EXPECT_EQ(fault("= 1" + repeated("^1", 70)), "at 130: the expression is nested deeper than 64");
}

TEST(Expression, PlacesCountCharactersAndEscapes) {
    Value string = text_value("= \"ü\" + x", {"g.json", 3, 10});
    EXPECT_EQ(place_inside(string, 9), (Place{"g.json", 3, 21}));
    string.place = {"--set a.b=…", 0, 0};
    EXPECT_EQ(place_inside(string, 9), string.place);
}

}  // namespace
}  // namespace keyline
