// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/graph/variables.h"

#include "engine/json/json_reader.h"

#include <cstdlib>
#include <fmt/format.h>
#include <gtest/gtest.h>

namespace keyline {
namespace {

using Overrides = std::vector<std::pair<std::string, Value>>;

Overrides overrides(const std::vector<std::pair<std::string, std::string>>& options) {
    Overrides out;
    for (const auto& [name, text] : options)
        out.emplace_back(name, parse_option_value(text, "--var " + name + "=" + text));
    return out;
}

std::vector<std::string> texts(const Diagnostics& diagnostics) {
    std::vector<std::string> out;
    for (const Error& error : diagnostics.errors()) out.push_back(error.text());
    return out;
}

Variables variables(std::string_view json, const Overrides& options = {}) {
    const Value declared = parse_json(json, "g.json");
    Diagnostics diagnostics;
    Variables out({&declared, {}, options}, diagnostics);
    EXPECT_EQ(texts(diagnostics), std::vector<std::string>{});
    return out;
}

std::vector<std::string> faults(std::string_view json, const Overrides& options = {}) {
    const Value declared = parse_json(json, "g.json");
    Diagnostics diagnostics;
    const Variables made({&declared, {}, options}, diagnostics);
    return texts(diagnostics);
}

std::string replaced(const Variables& v, std::string_view json, std::optional<int> frame = {}) {
    Diagnostics diagnostics;
    const std::string out = v.substitute(parse_json(json, "g.json"), frame, diagnostics).shown();
    EXPECT_EQ(texts(diagnostics), std::vector<std::string>{});
    return out;
}

std::string fault(const Variables& v, std::string_view json, std::optional<int> frame = {}) {
    Diagnostics diagnostics;
    const Value value = parse_json(json, "g.json");
    EXPECT_EQ(v.substitute(value, frame, diagnostics).shown(), value.shown());
    return diagnostics.errors().size() == 1 ? diagnostics.errors()[0].text() : "not one error";
}

using Texts = std::vector<std::string>;

TEST(Variables, ReplaceInsideText) {
    const Variables v = variables(R"({"shot": "street", "n": 1.50, "on": true, "dir": "a/${shot}"})");
    EXPECT_EQ(replaced(v, R"("${shot}.####.exr")"), R"("street.####.exr")");
    EXPECT_EQ(replaced(v, R"("${shot}${shot}-${n}-${on}")"), R"("streetstreet-1.50-true")");
    EXPECT_EQ(replaced(v, R"("x/${dir}/y")"), R"("x/a/street/y")");
    EXPECT_EQ(replaced(v, R"({"${shot}": ["${shot} ", {"b": "${shot}!"}]})"),
              R"({"${shot}":["street ",{"b":"street!"}]})");
    EXPECT_EQ(replaced(v, R"(["", "$", "$shot", "a$$b", "{shot}", 5, null])"),
              R"(["","$","$shot","a$$b","{shot}",5,null])");
}

TEST(Variables, DollarDollarBraceIsLiteral) {
    const Variables v = variables(R"({"a": "$${b}", "b": "x"})");
    EXPECT_EQ(replaced(v, R"("$${b}")"), R"("${b}")");
    EXPECT_EQ(replaced(v, R"("$$${b}")"), R"("$${b}")");
    EXPECT_EQ(replaced(v, R"("$${")"), R"("${")");
    // What a variable's text says is not read again.
    EXPECT_EQ(replaced(v, R"("${a}")"), R"("${b}")");
    EXPECT_EQ(replaced(v, R"("-${a}")"), R"("-${b}")");
}

TEST(Variables, AloneTakeTheirJsonType) {
    const Variables v =
        variables(R"({"n": 1.50, "on": false, "none": null, "list": [1, "${n}"], "o": {"a": "${list}"}})");
    EXPECT_EQ(replaced(v, R"(["${n}", "${on}", "${none}", "${list}", "${o}"])"),
              R"([1.50,false,null,[1,1.50],{"a":[1,1.50]}])");
}

TEST(Variables, FrameIsANumberOrText) {
    const Variables v = variables(R"({"a": "${frame}", "b": "f${a}", "c": ["${b}"]})");
    EXPECT_EQ(replaced(v, R"(["${frame}", "${a}", "x${frame}", "${b}", "${c}"])", -7),
              R"([-7,-7,"x-7","f-7",["f-7"]])");
    EXPECT_EQ(replaced(v, R"("${c}")", 8), R"(["f8"])");
    EXPECT_EQ(fault(v, R"("${frame}")"),
              "g.json:1:1: error: '${frame}' stands for no frame here; say which with --frames");
    EXPECT_EQ(fault(v, R"("x${b}")"),
              "g.json:1:1: error: the variable 'b' uses '${frame}', which stands for no "
              "frame here; say which with --frames");
}

TEST(Variables, KnowWhatUsesTheFrame) {
    const Variables v = variables(R"({"a": "${frame}", "b": ["f${a}"], "c": "$${frame}"})");
    const auto uses = [&v](std::string_view json) { return v.uses_frame(parse_json(json, "g.json")); };
    EXPECT_TRUE(uses(R"({"x": ["${frame}"]})"));
    EXPECT_TRUE(uses(R"("x${b}")"));
    EXPECT_FALSE(uses(R"(["${c}", "$${frame}", {"${frame}": 1}])"));
}

TEST(Variables, ReadTheEnvironment) {
    ::setenv("KEYLINE_TEST_SHOT", "sh${n}", 1);
    ::unsetenv("KEYLINE_TEST_NONE");
    const Variables v = variables(R"({"n": 1, "a": "${env:KEYLINE_TEST_SHOT}"})");
    EXPECT_EQ(replaced(v, R"(["${env:KEYLINE_TEST_SHOT}", "${a}", "x${a}"])"),
              R"(["sh${n}","sh${n}","xsh${n}"])");
    EXPECT_EQ(fault(v, R"("${env:KEYLINE_TEST_NONE}")"),
              "g.json:1:1: error: the environment has no variable 'KEYLINE_TEST_NONE'");
    EXPECT_EQ(fault(v, R"("${KEYLINE_TEST_SHOT}")"),
              "g.json:1:1: error: unknown variable 'KEYLINE_TEST_SHOT'; the environment's is written as "
              "'${env:KEYLINE_TEST_SHOT}'");
}

TEST(Variables, FaultsInStringsAreTold) {
    const Variables v = variables(R"({"sigma": 1, "list": [1], "none": null, "o": {}})");
    EXPECT_EQ(fault(v, R"({"a": ["x${sgma}"]})"),
              "g.json:1:8: error: unknown variable 'sgma'; did you mean 'sigma'?");
    EXPECT_EQ(fault(v, R"("${Frame}")"),
              "g.json:1:1: error: unknown variable 'Frame'; did you mean 'frame'?");
    EXPECT_EQ(
        fault(v, R"("${shot}")"),
        "g.json:1:1: error: unknown variable 'shot'; the graph declares 'list', 'none', 'o' and 'sigma'");
    EXPECT_EQ(fault(v, R"("${KEYLINE_NOWHERE}")"),
              "g.json:1:1: error: unknown variable 'KEYLINE_NOWHERE'; the environment's is written as "
              "'${env:KEYLINE_NOWHERE}'");
    EXPECT_EQ(fault(variables("{}"), R"("${shot}")"),
              "g.json:1:1: error: unknown variable 'shot'; the graph declares no variables");
    EXPECT_EQ(fault(v, R"("a${sigma")"),
              "g.json:1:1: error: '${sigma' has no '}'; a literal '${' is written as '$${'");
    for (const std::string bad : {"${}", "${a b}", "${env:}", "${1}", "${sigma:-2}"})
        EXPECT_EQ(
            fault(v, fmt::format("\"{}\"", bad)),
            fmt::format("g.json:1:1: error: '{}' names no variable; a literal '${{' is written as '$${{'",
                        bad));
    EXPECT_EQ(fault(v, R"("x${list}")"),
              "g.json:1:1: error: the variable 'list' is an array, which can't stand inside a text");
    EXPECT_EQ(fault(v, R"("x${o}")"),
              "g.json:1:1: error: the variable 'o' is an object, which can't stand inside a text");
    EXPECT_EQ(fault(v, R"("x${none}")"),
              "g.json:1:1: error: the variable 'none' is null, which can't stand inside a text");
}

TEST(Variables, AFaultSparesTheOtherStrings) {
    Diagnostics diagnostics;
    const Variables v = variables(R"({"a": 1})");
    const Value out = v.substitute(parse_json(R"(["${x}", "${a}", "${y}"])", "g.json"), {}, diagnostics);
    EXPECT_EQ(out.shown(), R"(["${x}",1,"${y}"])");
    EXPECT_EQ(diagnostics.errors().size(), 2U);
}

TEST(Variables, FaultsInDeclarationsAreToldOnce) {
    EXPECT_EQ(faults("[1]"), Texts{"g.json:1:1: error: 'variables' must be an object, not an array"});
    EXPECT_EQ(faults(R"({"a b": 1})"),
              Texts{"g.json:1:2: error: a variable can't be named 'a b': a name is a letter or _, then "
                    "letters, digits, _ and -"});
    EXPECT_EQ(faults(R"({"frame": 1})"),
              Texts{"g.json:1:2: error: a variable can't be named 'frame', which is the frame's number"});
    EXPECT_EQ(faults(R"({"abc": "${abd}", "b": "x${abc}"})"),
              Texts{"g.json:1:9: error: unknown variable 'abd'; did you mean 'abc'?"});
}

TEST(Variables, WhatUsesAFaultyOneIsKnown) {
    const Value declared = parse_json(R"({"a": "${zzz}", "b": "x${a}", "c": 1})", "g.json");
    Diagnostics diagnostics;
    const Variables v({&declared}, diagnostics);
    EXPECT_EQ(diagnostics.errors().size(), 1U);
    EXPECT_TRUE(v.uses_faulty(parse_json(R"(["${b}"])", "g.json")));
    EXPECT_FALSE(v.uses_faulty(parse_json(R"(["${c}", "${unknown}"])", "g.json")));
    EXPECT_EQ(replaced(v, R"(["${b}", "${c}"])"), R"(["${b}",1])");
}

TEST(Variables, LoopsAreToldOnceAndNamed) {
    EXPECT_EQ(faults(R"({"a": "x${a}"})"),
              Texts{"g.json:1:7: error: variables use each other in a loop: 'a' → 'a'"});
    EXPECT_EQ(faults(R"({"z": "${b}", "a": "${b}", "b": ["${c}"], "c": {"x": "${b} ${frame}"}})"),
              Texts{"g.json:1:33: error: variables use each other in a loop: 'b' → 'c' → 'b'"});
    EXPECT_EQ(faults(R"({"a": "${a}", "b": "${b}${x}"})"),
              (Texts{"g.json:1:7: error: variables use each other in a loop: 'a' → 'a'",
                     "g.json:1:20: error: variables use each other in a loop: 'b' → 'b'",
                     "g.json:1:20: error: unknown variable 'x'; the graph declares 'a' and 'b'"}));
    EXPECT_EQ(faults(R"({"a": 1})", overrides({{"a", "${a}"}})),
              Texts{"--var a=${a}: error: variables use each other in a loop: 'a' → 'a'"});
}

TEST(Variables, OptionsOverride) {
    const Variables v = variables(R"({"a": 1, "b": ["${a}"], "shot": "x", "same": "${a}"})",
                                  overrides({{"a", "5"}, {"a", "2.50"}, {"shot", "007"}}));
    EXPECT_EQ(replaced(v, R"(["${a}", "${b}", "${shot}", "${same}"])"), R"([2.50,[2.50],"007",2.50])");
    EXPECT_EQ(replaced(variables(R"({"a": 1})", overrides({{"a", "[1, true]"}})), R"("${a}")"), "[1,true]");
    EXPECT_EQ(replaced(variables(R"({"a": 1, "b": "y"})", overrides({{"a", "x${b}"}})), R"("${a}")"),
              R"("xy")");
}

TEST(Variables, WhatIsDeclaredAsAStringStaysOne) {
    for (const std::string text : {"007", "7", "1.50", "true", "null", "[1, 2]", "abc"})
        EXPECT_EQ(replaced(variables(R"({"shot": "x"})", overrides({{"shot", text}})), R"("${shot}")"),
                  '"' + text + '"');
    EXPECT_EQ(replaced(variables(R"({"shot": "x"})", overrides({{"shot", "\"7\""}})), R"("${shot}")"),
              R"("7")");
    // "${other}" alone has the other's type.
    const std::string_view json =
        R"({"n": 1, "a": "${n}", "b": "${c}", "c": "${s}", "s": "x", "f": "${frame}"})";
    EXPECT_EQ(replaced(variables(json, overrides({{"a", "2"}, {"b", "3"}, {"f", "4"}})),
                       R"(["${a}", "${b}", "${f}"])"),
              R"([2,"3",4])");
}

TEST(Variables, UndeclaredOptionsAreFaults) {
    EXPECT_EQ(faults(R"({"shot": 1})", overrides({{"sho", "2"}})),
              Texts{"--var sho=2: error: unknown variable 'sho'; did you mean 'shot'?"});
    EXPECT_EQ(faults(R"({"shot": 1})", overrides({{"x", "2"}})),
              Texts{"--var x=2: error: unknown variable 'x'; the graph declares 'shot'"});
    Diagnostics diagnostics;
    const Variables v({nullptr, {}, overrides({{"x", "2"}})}, diagnostics);
    EXPECT_EQ(texts(diagnostics),
              Texts{"--var x=2: error: unknown variable 'x'; the graph declares no variables"});
}

TEST(Variables, PlacesAreTheUseOrTheOption) {
    const Variables v = variables(R"({"a": [1, {"k": "${n}"}], "n": 2, "o": 3})", overrides({{"n", "5"}}));
    Diagnostics diagnostics;
    const Value out =
        v.substitute(parse_json("[\n\"${a}\",\n\"x${o}\",\n\"${o}\"]", "g.json"), {}, diagnostics);
    EXPECT_EQ(out.place.text(), "g.json:1:1");
    EXPECT_EQ(out.items[0].place.text(), "g.json:2:1");
    EXPECT_EQ(out.items[0].items[0].place.text(), "g.json:2:1");
    EXPECT_EQ(out.items[0].items[1].members[0].key_place.text(), "g.json:2:1");
    EXPECT_EQ(out.items[0].items[1].members[0].value.place.text(), "--var n=5");
    EXPECT_EQ(out.items[1].place.text(), "g.json:3:1");
    EXPECT_EQ(out.items[2].place.text(), "g.json:4:1");
}

TEST(Variables, FilesStandOverTheGraphAndOptionsOverFiles) {
    const Value declared = parse_json(R"({"a": 1, "b": 1, "c": 1, "s": "x"})", "g.json");
    const std::vector<Value> files{parse_json(R"({"b": 2, "c": 2, "new": "${c}", "s": "007"})", "show.json"),
                                   parse_json(R"({"c": 3})", "shot.json")};
    Diagnostics diagnostics;
    const Variables v({&declared, files, overrides({{"s", "8"}})}, diagnostics);
    EXPECT_EQ(texts(diagnostics), Texts{});
    EXPECT_EQ(replaced(v, R"(["${a}", "${b}", "${c}", "${new}", "${s}"])"), R"([1,2,3,3,"8"])");
    Texts given;
    for (const auto& [name, value] : v.given())
        given.push_back(name + " " + value.shown() + " " + value.place.text());
    EXPECT_EQ(given, (Texts{"a 1 g.json:1:7", "b 2 show.json:1:7", "c 3 shot.json:1:7",
                            "new \"${c}\" show.json:1:25", "s \"8\" --var s=8"}));
}

TEST(Variables, HaveTheValueOfAChoice) {
    const std::string_view json = R"({"look": {"default": "ink", "choices": ["ink", "pencil:R"]},
                                      "n": {"default": 1, "choices": [1, 2.0], "about": "how many"},
                                      "other": {"default": "${look}", "choices": ["ink", "x"]}})";
    EXPECT_EQ(replaced(variables(json), R"(["${look}", "${n}", "${other}"])"), R"(["ink",1,"ink"])");
    EXPECT_EQ(replaced(variables(json, overrides({{"n", "2"}})), R"("${n}")"), "2");
    EXPECT_EQ(faults(json, overrides({{"n", "3"}})),
              Texts{"--var n=3: error: 'n' is 3; it must be one of '1' and '2.0'"});
    EXPECT_EQ(faults(json, overrides({{"look", "pencil:R"}})),
              Texts{"g.json:3:60: error: 'other' is \"pencil:R\"; it must be one of 'ink' and 'x'"});
    EXPECT_TRUE(variables(json).is_a_choice("ink"));
    EXPECT_TRUE(variables(json).is_a_choice("pencil"));
    EXPECT_FALSE(variables(json).is_a_choice("pencil:R"));
}

TEST(Variables, FaultsInChoicesAreTold) {
    EXPECT_EQ(faults(R"({"a": {"choices": [1]}})"),
              Texts{"g.json:1:7: error: 'default', which of the choices it is, is missing"});
    EXPECT_EQ(faults(R"({"a": {"default": 1, "choices": []}})"),
              Texts{"g.json:1:33: error: 'choices' is []; it must be a list of texts, numbers or truths"});
    EXPECT_EQ(faults(R"({"a": {"default": 1, "choices": [1], "abut": 1}})"),
              Texts{"g.json:1:38: error: unknown key 'abut'; did you mean 'about'?"});
}

TEST(Variables, KnowWhichNobodyUses) {
    const Variables v = variables(R"({"a": 1, "b": "${a}", "c": 2, "d": "${c}", "e": "${d}"})");
    const Value value = parse_json(R"({"x": ["${b}"]})", "g.json");
    Texts unused;
    for (const Member& m : v.unused_by({&value})) unused.push_back(m.key + " " + m.key_place.text());
    EXPECT_EQ(unused, (Texts{"c g.json:1:23", "d g.json:1:31", "e g.json:1:44"}));
}

// "v0": first, "v1": each with {0} standing for ${v0}, and so on.
std::string chain(const std::string& first, const std::string& each, int length) {
    std::string json = fmt::format("{{\"v0\": {}", first);
    for (int i = 1; i <= length; ++i)
        json += fmt::format(", \"v{}\": {}", i,
                            fmt::vformat(each, fmt::make_format_args(fmt::format("${{v{}}}", i - 1))));
    return json + "}";
}

TEST(Variables, DoNotGrowWithoutBound) {
    const std::vector<std::string> strings = faults(chain("\"xxxx\"", "\"{0}{0}\"", 64));
    ASSERT_EQ(strings.size(), 1U);
    EXPECT_TRUE(strings[0].ends_with("error: variables make this larger than 4 MB")) << strings[0];
    const std::vector<std::string> lists = faults(chain("[1]", "[\"{0}\", \"{0}\"]", 64));
    ASSERT_EQ(lists.size(), 1U);
    EXPECT_TRUE(lists[0].ends_with("error: variables make this larger than 4 MB")) << lists[0];
    const std::vector<std::string> deep = faults(chain("[1]", "[\"{0}\"]", 64));
    ASSERT_EQ(deep.size(), 1U);
    EXPECT_TRUE(deep[0].ends_with("error: variables nest this deeper than 64 levels")) << deep[0];
}

TEST(Variables, LongChainsAreFine) {
    EXPECT_EQ(replaced(variables(chain("1", "\"{0}\"", 20000)), "\"${v20000}\""), "1");
}

}  // namespace
}  // namespace keyline
