// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/base/error.h"
#include "engine/json/value.h"

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

// What parameters are made of: their types, what is allowed, and the description that messages, reference and
// schema are written from.

namespace KEYLINE_API keyline {

// A pair of numbers for x and y; a single number sets both.
struct Vec2 {
    double x = 0, y = 0;
    constexpr Vec2() = default;
    constexpr Vec2(double both) : x(both), y(both) {}  // NOLINT(google-explicit-constructor)
    constexpr Vec2(double px, double py) : x(px), y(py) {}
    friend bool operator==(const Vec2&, const Vec2&) = default;
};

// Scene-linear; in JSON three numbers or an sRGB "#rrggbb".
struct Color {
    double r = 0, g = 0, b = 0;
    friend bool operator==(const Color&, const Color&) = default;
};

// What a port accepts, and which channels of its stream reach compute(), in which order.
struct Takes {
    enum class Kind {
        kAny,     // every channel, in the stream's order
        kColour,  // R G B, and A where there is one and it is wanted
        kMatte,   // the only channel, or else A
        kNamed,   // exactly `names`
        kData,    // no pixels: a datum of the kind `data`
    };
    Kind kind = Kind::kAny;
    std::array<const char*, 8> names{};
    const char* preferred = nullptr;  // kMatte: this channel, where the stream has it
    bool alpha = true;                // kColour: the A too
    const char* data = nullptr;       // kData; null: of any kind
};

constexpr Takes any_channels() { return {}; }
constexpr Takes colour() { return {Takes::Kind::kColour, {}, nullptr}; }
constexpr Takes colour_without_alpha() { return {Takes::Kind::kColour, {}, nullptr, false}; }
constexpr Takes matte(const char* preferred = nullptr) { return {Takes::Kind::kMatte, {}, preferred}; }
template <class... Names>
constexpr Takes named(Names... names) {
    return {Takes::Kind::kNamed, {names...}, nullptr};
}
// A datum of the kind that T is; see engine/node/datum.h.
template <class T>
constexpr Takes data() {
    return {Takes::Kind::kData, {}, nullptr, true, T::kind};
}
constexpr Takes any_data() { return {Takes::Kind::kData, {}, nullptr, true, nullptr}; }

// "id" or "id:NAME" in a graph.  `slot` numbers the inputs of one node in declared order; compute() finds its
// pixels by it.
struct Input {
    std::string node, selector;
    Place place;
    int slot = -1;

    std::string text() const { return selector.empty() ? node : node + ":" + selector; }
    friend bool operator==(const Input& a, const Input& b) {
        return a.node == b.node && a.selector == b.selector;
    }
};

// Keys of the user's own, in the order written.
template <class T>
struct Map {
    std::vector<std::pair<std::string, T>> entries;
    friend bool operator==(const Map&, const Map&) = default;
};

template <class E>
struct Word {
    const char* word;
    E value;
    const char* help;
};

struct Range {
    double min = -std::numeric_limits<double>::infinity();
    double max = std::numeric_limits<double>::infinity();
    const char* unit = "";
    double test_max =
        std::numeric_limits<double>::infinity();  // tests draw no larger values; cost grows with them
};

// What a text names, or a map's keys do, that only a config or a file knows: for editors, which offer it.
enum class Naming { kNothing, kColorSpace, kDisplay, kView, kCryptomatte, kObject };

struct Constraint {
    Range range{};
    Takes takes{};
    Naming names = Naming::kNothing;
    bool leading = false;

    // Tests draw values up to this.
    constexpr Constraint tested_to(double max) const {
        Constraint c = *this;
        c.range.test_max = max;
        return c;
    }
};

constexpr Constraint between(double min, double max, const char* unit = "") { return {{min, max, unit}}; }
constexpr Constraint at_least(double min, const char* unit = "") {
    return {{min, std::numeric_limits<double>::infinity(), unit}};
}
constexpr Constraint px(double min, double max) { return between(min, max, "pixels"); }

struct FieldInfo;

// A type as messages, the reference and the schema tell it.
struct TypeInfo {
    enum class Kind {
        kNumber,
        kInteger,
        kBool,
        kString,
        kFile,
        kWord,
        kPair,
        kColor,
        kNumbers,
        kInput,
        kList,
        kMap,
        kObject,
        kTuple,
        kAnyOf
    };
    struct WordInfo {
        std::string word, help;
    };

    Kind kind = Kind::kNumber;
    bool optional = false;
    Range range{};
    Naming names = Naming::kNothing;  // kString: itself; kMap: its keys
    std::vector<WordInfo> words;      // kWord
    std::size_t count = 0;            // kNumbers
    Takes takes{};                    // kInput
    bool leading = false;             // kInput
    std::vector<TypeInfo> items;      // kNumbers, kList, kMap: one; kTuple: each; kAnyOf: the choices
    std::vector<FieldInfo> fields;    // kObject

    static TypeInfo number(Range range);
    static TypeInfo integer(Range range);
    static TypeInfo boolean();
    static TypeInfo string(Naming names = Naming::kNothing);
    static TypeInfo file();
    static TypeInfo pair(Range range);
    static TypeInfo color(Range range);
    static TypeInfo one_of(std::vector<WordInfo> words);
    static TypeInfo numbers(std::size_t count, TypeInfo item);
    static TypeInfo input(Takes takes, bool leading);
    static TypeInfo list(TypeInfo item);
    static TypeInfo map(TypeInfo item, Naming of_keys = Naming::kNothing);
    static TypeInfo object(std::vector<FieldInfo> fields);
    static TypeInfo tuple(std::vector<TypeInfo> items);
    static TypeInfo any_of(std::vector<TypeInfo> choices);

    std::string text() const;        // "a number", "one of 'disk', 'square' and 'diamond'"
    std::string range_text() const;  // "from 0 to 500 pixels"; "" where all are allowed
};

struct FieldInfo {
    std::string name, help;
    TypeInfo type;
    Value default_value;  // null: none
    bool required = false;
};

}  // namespace keyline
