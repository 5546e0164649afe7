// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/file_name.h"
#include "engine/param_types.h"
#include "engine/value.h"

#include <algorithm>
#include <concepts>
#include <tuple>

// The one declaration of a node's inputs and parameters.
//
//     struct Params {
//         Input in;
//         Vec2 sigma = 1;
//         static constexpr auto fields = declare(
//             input(&Params::in, "in", "The image to blur."),
//             field(&Params::sigma, "sigma", "Standard deviation.", px(0, 500)));
//     };
//
// Strict parsing, range errors with their places, the reference and the JSON Schema all derive from it;
// the struct's initialisers are the defaults and stated nowhere else.

namespace keyline {

// What relative paths are relative to: the graph's folder for what stands in the graph, the working directory
// for what was typed on the command line, unless a root was given for both.
struct PathBase {
    std::filesystem::path folder;
    bool is_root = false;
};

// Collects what is wrong with one node's object.
class ParamReader {
public:
    ParamReader(Diagnostics& diagnostics, std::string node, PathBase base)
        : diagnostics_(diagnostics), node_(std::move(node)), base_(std::move(base)) {}

    void error(const Place& place, std::string what, std::string hint = {}) {
        failed_ = true;
        diagnostics_.error({ErrorKind::kGraph, place, node_, std::move(what), std::move(hint)});
    }
    bool failed() const { return failed_; }
    std::filesystem::path base(const Place& place) const {
        const bool typed = place.line == 0;
        return typed && !base_.is_root ? std::filesystem::path() : base_.folder;
    }

private:
    Diagnostics& diagnostics_;
    std::string node_;
    PathBase base_;
    bool failed_ = false;
};

template <class Owner, class T>
struct Field {
    T Owner::*member;
    const char* name;
    const char* help;
    Constraint constraint;
    bool is_required = false;

    // Must be given; it has no default.
    constexpr Field required() const {
        Field f = *this;
        f.is_required = true;
        return f;
    }
    // The input whose display window, data window and metadata the result takes; else it is the first.
    constexpr Field leading() const {
        Field f = *this;
        f.constraint.leading = true;
        return f;
    }
};

template <class Owner, class T>
constexpr Field<Owner, T> field(T Owner::*member, const char* name, const char* help,
                                Constraint constraint = {}) {
    return {member, name, help, constraint};
}

template <class Owner, class T>
constexpr Field<Owner, T> input(T Owner::*member, const char* name, const char* help,
                                Takes takes = any_channels()) {
    Constraint constraint;
    constraint.takes = takes;
    return {member, name, help, constraint, std::same_as<T, Input>};
}

template <class... Fields>
constexpr std::tuple<Fields...> declare(Fields... f) {
    return {f...};
}

// A struct that declares its fields: a node's Params, or a struct in a list of them (a light).
template <class T>
concept Declared = requires {
    T::fields;
};

// How a type is read from JSON, written back, and described.  Specialised for each kind of parameter.
template <class T>
struct Codec;

template <class Params, class Fields>
void parse_fields(const Value& object, const Fields& declaration, Params& out, ParamReader& reader);

template <class Params, class Fields>
std::vector<FieldInfo> describe_fields(const Fields& declaration, const Params& defaults);

template <class Params, class Fields>
Value fields_to_value(const Fields& declaration, const Params& params);

namespace detail {

void wrong_kind(const Value& value, std::string_view name, const TypeInfo& type, ParamReader& reader);
void check_range(const Value& value, std::string_view name, double number, const Constraint& c,
                 ParamReader& reader);
void unknown_key(const Member& member, const std::vector<std::string>& known, ParamReader& reader);
void missing_key(const Place& place, const char* name, bool is_input, ParamReader& reader);
void unknown_word(const Value& value, std::string_view name, const std::vector<std::string>& words,
                  ParamReader& reader);
Value make_value(bool b);
Value make_value(double number);
Value make_value(std::string text);
Value make_array(std::vector<Value> items);
Value make_object(std::vector<std::pair<std::string, Value>> members);

}  // namespace detail

template <>
struct Codec<double> {
    static bool accepts(const Value& v) { return v.is(Value::Kind::kNumber); }
    static TypeInfo type(const Constraint& c) { return TypeInfo::number(c.range); }
    static Value to_value(double d) { return detail::make_value(d); }
    static void parse(const Value& v, std::string_view name, const Constraint& c, double& out,
                      ParamReader& r) {
        if (!accepts(v)) return detail::wrong_kind(v, name, type(c), r);
        detail::check_range(v, name, v.number, c, r);
        out = v.number;
    }
};

template <>
struct Codec<int> {
    static bool accepts(const Value& v) { return v.is(Value::Kind::kNumber); }
    static TypeInfo type(const Constraint& c) { return TypeInfo::integer(c.range); }
    static Value to_value(int i) { return detail::make_value(static_cast<double>(i)); }
    static void parse(const Value& v, std::string_view name, const Constraint& c, int& out, ParamReader& r);
};

template <>
struct Codec<bool> {
    static bool accepts(const Value& v) { return v.is(Value::Kind::kBool); }
    static TypeInfo type(const Constraint&) { return TypeInfo::boolean(); }
    static Value to_value(bool b) { return detail::make_value(b); }
    static void parse(const Value& v, std::string_view name, const Constraint& c, bool& out, ParamReader& r) {
        if (!accepts(v)) return detail::wrong_kind(v, name, type(c), r);
        out = v.boolean;
    }
};

template <>
struct Codec<std::string> {
    static bool accepts(const Value& v) { return v.is(Value::Kind::kString); }
    static TypeInfo type(const Constraint&) { return TypeInfo::string(); }
    static Value to_value(const std::string& s) { return detail::make_value(s); }
    static void parse(const Value& v, std::string_view name, const Constraint& c, std::string& out,
                      ParamReader& r) {
        if (!accepts(v)) return detail::wrong_kind(v, name, type(c), r);
        out = v.text;
    }
};

template <>
struct Codec<FileName> {
    static bool accepts(const Value& v) { return v.is(Value::Kind::kString); }
    static TypeInfo type(const Constraint&) { return TypeInfo::file(); }
    static Value to_value(const FileName& f) { return detail::make_value(f.text()); }
    static void parse(const Value& v, std::string_view name, const Constraint& c, FileName& out,
                      ParamReader& r);
};

// One number for both axes, or [x, y].
template <>
struct Codec<Vec2> {
    static bool accepts(const Value& v) { return v.is(Value::Kind::kNumber) || v.is(Value::Kind::kArray); }
    static TypeInfo type(const Constraint& c) { return TypeInfo::pair(c.range); }
    static Value to_value(const Vec2& v);
    static void parse(const Value& v, std::string_view name, const Constraint& c, Vec2& out, ParamReader& r);
};

template <>
struct Codec<Color> {
    static bool accepts(const Value& v) {
        return v.is(Value::Kind::kString) || (v.is(Value::Kind::kArray) && v.items.size() == 3);
    }
    static TypeInfo type(const Constraint& c) { return TypeInfo::color(c.range); }
    static Value to_value(const Color& color);
    static void parse(const Value& v, std::string_view name, const Constraint& c, Color& out, ParamReader& r);
};

template <>
struct Codec<Input> {
    static bool accepts(const Value& v) { return v.is(Value::Kind::kString); }
    static TypeInfo type(const Constraint& c) { return TypeInfo::input(c.takes, c.leading); }
    static Value to_value(const Input& i) { return detail::make_value(i.text()); }
    static void parse(const Value& v, std::string_view name, const Constraint& c, Input& out, ParamReader& r);
};

// An enum whose words stand beside it: `constexpr auto words(Shape) { return std::array{Word{"disk",
// Shape::kDisk, "a round brush"}, …}; }`.
template <class E>
requires std::is_enum_v<E>
struct Codec<E> {
    static bool accepts(const Value& v) { return v.is(Value::Kind::kString); }
    static TypeInfo type(const Constraint&) {
        TypeInfo t;
        t.kind = TypeInfo::Kind::kWord;
        for (const auto& w : words(E{})) t.words.push_back({w.word, w.help});
        return t;
    }
    static Value to_value(E e) {
        for (const auto& w : words(E{}))
            if (w.value == e) return detail::make_value(std::string(w.word));
        return {};
    }
    static void parse(const Value& v, std::string_view name, const Constraint& c, E& out, ParamReader& r) {
        if (!accepts(v)) return detail::wrong_kind(v, name, type(c), r);
        std::vector<std::string> known;
        for (const auto& w : words(E{})) {
            if (v.text == w.word) {
                out = w.value;
                return;
            }
            known.emplace_back(w.word);
        }
        detail::unknown_word(v, name, known, r);
    }
};

// Absent or null: none.
template <class T>
struct Codec<std::optional<T>> {
    static bool accepts(const Value& v) { return v.is(Value::Kind::kNull) || Codec<T>::accepts(v); }
    static TypeInfo type(const Constraint& c) {
        TypeInfo t = Codec<T>::type(c);
        t.optional = true;
        return t;
    }
    static Value to_value(const std::optional<T>& o) { return o ? Codec<T>::to_value(*o) : Value{}; }
    static void parse(const Value& v, std::string_view name, const Constraint& c, std::optional<T>& out,
                      ParamReader& r) {
        if (v.is(Value::Kind::kNull)) {
            out.reset();
            return;
        }
        out.emplace();
        Codec<T>::parse(v, name, c, *out, r);
    }
};

// A fixed number of numbers.
template <class N, std::size_t Count>
requires std::is_arithmetic_v<N>
struct Codec<std::array<N, Count>> {
    using T = std::array<N, Count>;
    static bool accepts(const Value& v) { return v.is(Value::Kind::kArray) && v.items.size() == Count; }
    static TypeInfo type(const Constraint& c) { return TypeInfo::numbers(Count, c.range); }
    static Value to_value(const T& a) {
        std::vector<Value> items;
        for (const N n : a) items.push_back(Codec<N>::to_value(n));
        return detail::make_array(std::move(items));
    }
    static void parse(const Value& v, std::string_view name, const Constraint& c, T& out, ParamReader& r) {
        if (!accepts(v)) return detail::wrong_kind(v, name, type(c), r);
        for (std::size_t i = 0; i < Count; ++i) Codec<N>::parse(v.items[i], name, c, out[i], r);
    }
};

template <class T>
struct Codec<std::vector<T>> {
    static bool accepts(const Value& v) { return v.is(Value::Kind::kArray); }
    static TypeInfo type(const Constraint& c) { return TypeInfo::list(Codec<T>::type(c)); }
    static Value to_value(const std::vector<T>& list) {
        std::vector<Value> items;
        for (const T& t : list) items.push_back(Codec<T>::to_value(t));
        return detail::make_array(std::move(items));
    }
    static void parse(const Value& v, std::string_view name, const Constraint& c, std::vector<T>& out,
                      ParamReader& r) {
        if (!accepts(v)) return detail::wrong_kind(v, name, type(c), r);
        out.assign(v.items.size(), T{});
        for (std::size_t i = 0; i < out.size(); ++i) Codec<T>::parse(v.items[i], name, c, out[i], r);
    }
};

// A list of two things.
template <class A, class B>
struct Codec<std::pair<A, B>> {
    using T = std::pair<A, B>;
    static bool accepts(const Value& v) {
        return v.is(Value::Kind::kArray) && v.items.size() == 2 && Codec<A>::accepts(v.items[0]) &&
               Codec<B>::accepts(v.items[1]);
    }
    static TypeInfo type(const Constraint& c) {
        return TypeInfo::tuple({Codec<A>::type(c), Codec<B>::type(c)});
    }
    static Value to_value(const T& pair) {
        return detail::make_array({Codec<A>::to_value(pair.first), Codec<B>::to_value(pair.second)});
    }
    static void parse(const Value& v, std::string_view name, const Constraint& c, T& out, ParamReader& r) {
        if (!accepts(v)) return detail::wrong_kind(v, name, type(c), r);
        Codec<A>::parse(v.items[0], name, c, out.first, r);
        Codec<B>::parse(v.items[1], name, c, out.second, r);
    }
};

// An object with keys of the user's own: name → T.
template <class T>
struct Codec<Map<T>> {
    static bool accepts(const Value& v) { return v.is(Value::Kind::kObject); }
    static TypeInfo type(const Constraint& c) { return TypeInfo::map(Codec<T>::type(c)); }
    static Value to_value(const Map<T>& map) {
        std::vector<std::pair<std::string, Value>> members;
        for (const auto& [key, t] : map.entries) members.emplace_back(key, Codec<T>::to_value(t));
        return detail::make_object(std::move(members));
    }
    static void parse(const Value& v, std::string_view name, const Constraint& c, Map<T>& out,
                      ParamReader& r) {
        if (!accepts(v)) return detail::wrong_kind(v, name, type(c), r);
        out.entries.clear();
        for (const Member& m : v.members) {
            out.entries.emplace_back(m.key, T{});
            Codec<T>::parse(m.value, m.key, c, out.entries.back().second, r);
        }
    }
};

// One of several types, told apart by the kind of JSON value.
template <class... Ts>
struct Codec<std::variant<Ts...>> {
    using V = std::variant<Ts...>;
    static bool accepts(const Value& v) { return (Codec<Ts>::accepts(v) || ...); }
    static TypeInfo type(const Constraint& c) { return TypeInfo::any_of({Codec<Ts>::type(c)...}); }
    static Value to_value(const V& variant) {
        return std::visit([]<class T>(const T& t) { return Codec<T>::to_value(t); }, variant);
    }
    static void parse(const Value& v, std::string_view name, const Constraint& c, V& out, ParamReader& r) {
        if (!accepts(v)) return detail::wrong_kind(v, name, type(c), r);
        static_cast<void>((try_parse<Ts>(v, name, c, out, r) || ...));
    }

private:
    template <class T>
    static bool try_parse(const Value& v, std::string_view name, const Constraint& c, V& out,
                          ParamReader& r) {
        if (!Codec<T>::accepts(v)) return false;
        Codec<T>::parse(v, name, c, out.template emplace<T>(), r);
        return true;
    }
};

template <Declared T>
struct Codec<T> {
    static bool accepts(const Value& v) { return v.is(Value::Kind::kObject); }
    static TypeInfo type(const Constraint&) { return TypeInfo::object(describe_fields(T::fields, T{})); }
    static Value to_value(const T& t) { return fields_to_value(T::fields, t); }
    static void parse(const Value& v, std::string_view name, const Constraint& c, T& out, ParamReader& r) {
        if (!accepts(v)) return detail::wrong_kind(v, name, type(c), r);
        parse_fields(v, T::fields, out, r);
    }
};

template <class Params, class Fields>
void parse_fields(const Value& object, const Fields& declaration, Params& out, ParamReader& reader) {
    std::vector<std::string> known;
    const auto parse_one = [&]<class Owner, class T>(const Field<Owner, T>& f) {
        known.emplace_back(f.name);
        if (const Value* v = object.find(f.name))
            Codec<T>::parse(*v, f.name, f.constraint, out.*f.member, reader);
        else if (f.is_required)
            detail::missing_key(object.place, f.name, std::same_as<T, Input>, reader);
    };
    std::apply([&](const auto&... f) { (parse_one(f), ...); }, declaration);
    for (const Member& m : object.members)
        if (std::ranges::find(known, m.key) == known.end()) detail::unknown_key(m, known, reader);
}

template <class Params, class Fields>
std::vector<FieldInfo> describe_fields(const Fields& declaration, const Params& defaults) {
    std::vector<FieldInfo> out;
    const auto describe_one = [&]<class Owner, class T>(const Field<Owner, T>& f) {
        out.push_back({f.name, f.help, Codec<T>::type(f.constraint), Codec<T>::to_value(defaults.*f.member),
                       f.is_required});
    };
    std::apply([&](const auto&... f) { (describe_one(f), ...); }, declaration);
    return out;
}

template <class Params, class Fields>
Value fields_to_value(const Fields& declaration, const Params& params) {
    const Params defaults{};
    std::vector<std::pair<std::string, Value>> members;
    const auto add = [&]<class Owner, class T>(const Field<Owner, T>& f) {
        const auto is_null = [](const Value& v) { return v.is(Value::Kind::kNull); };
        Value v = Codec<T>::to_value(params.*f.member);
        // Absent says none only where none is the default.
        if (is_null(v) && is_null(Codec<T>::to_value(defaults.*f.member))) return;
        members.emplace_back(f.name, std::move(v));
    };
    std::apply([&](const auto&... f) { (add(f), ...); }, declaration);
    return detail::make_object(std::move(members));
}

// Calls visit(T&, field name, constraint) for every T (Input, FileName) in the parameters, in declared order:
// members, optional ones, and those inside maps, lists and lists of structs.
template <class Wanted, class Params, class Visit>
void for_each(Params& params, Visit&& visit);

namespace detail {

template <class Wanted, class T, class Visit>
void visit_all(T& value, const char* name, const Constraint& c, Visit&& visit) {
    if constexpr (std::same_as<std::remove_const_t<T>, Wanted>) {
        visit(value, name, c);
    } else if constexpr (Declared<std::remove_const_t<T>>) {
        for_each<Wanted>(value, visit);
    } else if constexpr (requires { value.entries; }) {
        for (auto& [key, item] : value.entries) visit_all<Wanted>(item, name, c, visit);
    } else if constexpr (requires {
                             value.has_value();
                             *value;
                         }) {
        if (value) visit_all<Wanted>(*value, name, c, visit);
    } else if constexpr (!std::same_as<std::remove_const_t<T>, std::string> && requires {
                             value.begin();
                             value.end();
                         }) {
        for (auto& item : value) visit_all<Wanted>(item, name, c, visit);
    }
}

}  // namespace detail

template <class Wanted, class Params, class Visit>
void for_each(Params& params, Visit&& visit) {
    std::apply(
        [&](const auto&... f) {
            (detail::visit_all<Wanted>(params.*f.member, f.name, f.constraint, visit), ...);
        },
        Params::fields);
}

}  // namespace keyline
