// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/params/param_types.h"

#include <cmath>
#include <fmt/format.h>

namespace keyline {

namespace {

TypeInfo of_kind(TypeInfo::Kind kind, Range range = {}) {
    TypeInfo t;
    t.kind = kind;
    t.range = range;
    return t;
}

std::string takes_text(const Takes& takes) {
    std::vector<std::string> names;
    switch (takes.kind) {
        case Takes::Kind::kAny: return "an input";
        case Takes::Kind::kColour: return "an input with R G B";
        case Takes::Kind::kMatte: return "an input with one channel, or an A";
        case Takes::Kind::kData: return fmt::format("an input of {}", takes.data ? takes.data : "any data");
        case Takes::Kind::kNamed: break;
    }
    std::string out = "an input with";
    for (const char* name : takes.names)
        if (name) out += fmt::format(" {}", name);
    return out;
}

std::string words_text(const std::vector<TypeInfo::WordInfo>& words) {
    std::string out = "one of ";
    for (std::size_t i = 0; i < words.size(); ++i)
        out += (i == 0 ? "" : i + 1 == words.size() ? " and " : ", ") + in_quotes(words[i].word);
    return out;
}

std::string tuple_text(const std::vector<TypeInfo>& items) {
    std::string out = "a list of ";
    for (std::size_t i = 0; i < items.size(); ++i) out += (i == 0 ? "" : " and ") + items[i].text();
    return out;
}

}  // namespace

TypeInfo TypeInfo::number(Range range) { return of_kind(Kind::kNumber, range); }
TypeInfo TypeInfo::integer(Range range) { return of_kind(Kind::kInteger, range); }
TypeInfo TypeInfo::boolean() { return of_kind(Kind::kBool); }
TypeInfo TypeInfo::string(Naming names) {
    TypeInfo t = of_kind(Kind::kString);
    t.names = names;
    return t;
}
TypeInfo TypeInfo::file() { return of_kind(Kind::kFile); }
TypeInfo TypeInfo::pair(Range range) { return of_kind(Kind::kPair, range); }
TypeInfo TypeInfo::color(Range range) { return of_kind(Kind::kColor, range); }

TypeInfo TypeInfo::one_of(std::vector<WordInfo> words) {
    TypeInfo t = of_kind(Kind::kWord);
    t.words = std::move(words);
    return t;
}

TypeInfo TypeInfo::numbers(std::size_t count, TypeInfo item) {
    TypeInfo t = of_kind(Kind::kNumbers, item.range);
    t.count = count;
    t.items.push_back(std::move(item));
    return t;
}

TypeInfo TypeInfo::input(Takes takes, bool leading) {
    TypeInfo t = of_kind(Kind::kInput);
    t.takes = takes;
    t.leading = leading;
    return t;
}

TypeInfo TypeInfo::list(TypeInfo item) {
    TypeInfo t = of_kind(Kind::kList);
    t.items.push_back(std::move(item));
    return t;
}

TypeInfo TypeInfo::map(TypeInfo item, Naming of_keys) {
    TypeInfo t = of_kind(Kind::kMap);
    t.names = of_keys;
    t.items.push_back(std::move(item));
    return t;
}

TypeInfo TypeInfo::object(std::vector<FieldInfo> fields) {
    TypeInfo t = of_kind(Kind::kObject);
    t.fields = std::move(fields);
    return t;
}

TypeInfo TypeInfo::tuple(std::vector<TypeInfo> items) {
    TypeInfo t = of_kind(Kind::kTuple);
    t.items = std::move(items);
    return t;
}

TypeInfo TypeInfo::any_of(std::vector<TypeInfo> choices) {
    TypeInfo t = of_kind(Kind::kAnyOf);
    t.items = std::move(choices);
    return t;
}

std::string TypeInfo::text() const {
    switch (kind) {
        case Kind::kNumber: return "a number";
        case Kind::kInteger: return "a whole number";
        case Kind::kBool: return "true or false";
        case Kind::kString: return "a string";
        case Kind::kFile: return "a file name";
        case Kind::kWord: return words_text(words);
        case Kind::kPair: return "a number or [x, y]";
        case Kind::kColor: return "a colour, [r, g, b] or \"#rrggbb\"";
        case Kind::kNumbers: return fmt::format("a list of {} numbers", count);
        case Kind::kInput: return takes_text(takes);
        case Kind::kList: return "a list, each item " + items[0].text();
        case Kind::kMap: return "an object, each value " + items[0].text();
        case Kind::kObject: return "an object";
        case Kind::kTuple: return tuple_text(items);
        case Kind::kAnyOf: break;
    }
    std::string out;
    for (const TypeInfo& choice : items) out += (out.empty() ? "" : ", or ") + choice.text();
    return out;
}

std::string TypeInfo::range_text() const {
    const std::string unit = *range.unit ? fmt::format(" {}", range.unit) : "";
    const bool low = std::isfinite(range.min), high = std::isfinite(range.max);
    if (low && high) return fmt::format("from {} to {}{}", range.min, range.max, unit);
    if (low) return fmt::format("at least {}{}", range.min, unit);
    if (high) return fmt::format("at most {}{}", range.max, unit);
    return "";
}

}  // namespace keyline
