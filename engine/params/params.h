// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/json/value.h"
#include "engine/params/file_name.h"
#include "engine/params/param_types.h"
#include "engine/params/validate.h"

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
// It becomes data (describe_fields), from which validate() tells what is wrong with a value, and from which
// the reference and the JSON Schema derive.  The struct's initialisers are the defaults and stated nowhere
// else.

namespace KEYLINE_API keyline {

template <class Owner, class T>
struct Field {
    using Type = T;
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
    // The text names something that a config or a file holds; of a map, its keys do.
    constexpr Field naming(Naming names) const {
        Field f = *this;
        f.constraint.names = names;
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

// How a type is described, made from a value that validate() has passed for that description, and written
// back.  Specialised for each kind of parameter.
template <class T>
struct Codec;

// Makes what stands in the object; the rest of `out` keeps its defaults.  `fields` describes the declaration.
template <class Params>
void read_fields(const Value& object, const std::vector<FieldInfo>& fields, const PathBase& base,
                 Params& out);

template <class Params>
std::vector<FieldInfo> describe_fields();

template <class Params>
Value fields_to_value(const Params& params);

namespace detail {

Value make_value(bool b);
Value make_value(double number);
Value make_value(std::string text);
Value make_array(std::vector<Value> items);
Value make_object(std::vector<Member> members);

}  // namespace detail

template <>
struct Codec<double> {
    static TypeInfo type(const Constraint& c) { return TypeInfo::number(c.range); }
    static Value to_value(double d) { return detail::make_value(d); }
    static double from_value(const Value& v, const TypeInfo&, const PathBase&) { return v.number; }
};

template <>
struct Codec<int> {
    static TypeInfo type(const Constraint& c) { return TypeInfo::integer(c.range); }
    static Value to_value(int i) { return detail::make_value(static_cast<double>(i)); }
    static int from_value(const Value& v, const TypeInfo&, const PathBase&) {
        return static_cast<int>(v.number);
    }
};

template <>
struct Codec<bool> {
    static TypeInfo type(const Constraint&) { return TypeInfo::boolean(); }
    static Value to_value(bool b) { return detail::make_value(b); }
    static bool from_value(const Value& v, const TypeInfo&, const PathBase&) { return v.boolean; }
};

template <>
struct Codec<std::string> {
    static TypeInfo type(const Constraint& c) { return TypeInfo::string(c.names); }
    static Value to_value(const std::string& s) { return detail::make_value(s); }
    static std::string from_value(const Value& v, const TypeInfo&, const PathBase&) { return v.text; }
};

template <>
struct Codec<FileName> {
    static TypeInfo type(const Constraint&) { return TypeInfo::file(); }
    static Value to_value(const FileName& f) { return detail::make_value(f.text()); }
    static FileName from_value(const Value& v, const TypeInfo&, const PathBase& base) {
        return FileName(v.text, base.of(v.place));
    }
};

// One number for both axes, or [x, y].
template <>
struct Codec<Vec2> {
    static TypeInfo type(const Constraint& c) { return TypeInfo::pair(c.range); }
    static Value to_value(const Vec2& v);
    static Vec2 from_value(const Value& v, const TypeInfo&, const PathBase&);
};

template <>
struct Codec<Color> {
    static TypeInfo type(const Constraint& c) { return TypeInfo::color(c.range); }
    static Value to_value(const Color& color);
    static Color from_value(const Value& v, const TypeInfo&, const PathBase&);
};

template <>
struct Codec<Input> {
    static TypeInfo type(const Constraint& c) { return TypeInfo::input(c.takes, c.leading); }
    static Value to_value(const Input& i) { return detail::make_value(i.text()); }
    static Input from_value(const Value& v, const TypeInfo&, const PathBase&);
};

// An enum whose words stand beside it: `constexpr auto words(Shape) { return std::array{Word{"disk",
// Shape::kDisk, "a round brush"}, …}; }`.
template <class E>
requires std::is_enum_v<E>
struct Codec<E> {
    static TypeInfo type(const Constraint&) {
        std::vector<TypeInfo::WordInfo> known;
        for (const auto& w : words(E{})) known.push_back({w.word, w.help});
        return TypeInfo::one_of(std::move(known));
    }
    static Value to_value(E e) {
        for (const auto& w : words(E{}))
            if (w.value == e) return detail::make_value(std::string(w.word));
        return {};
    }
    static E from_value(const Value& v, const TypeInfo&, const PathBase&) {
        E out{};
        for (const auto& w : words(E{}))
            if (v.text == w.word) out = w.value;
        return out;
    }
};

// Absent or null: none.
template <class T>
struct Codec<std::optional<T>> {
    static TypeInfo type(const Constraint& c) {
        TypeInfo t = Codec<T>::type(c);
        t.optional = true;
        return t;
    }
    static Value to_value(const std::optional<T>& o) { return o ? Codec<T>::to_value(*o) : Value{}; }
    static std::optional<T> from_value(const Value& v, const TypeInfo& type, const PathBase& base) {
        if (v.is(Value::Kind::kNull)) return std::nullopt;
        return Codec<T>::from_value(v, type, base);
    }
};

// A fixed number of numbers.
template <class N, std::size_t Count>
requires std::is_arithmetic_v<N>
struct Codec<std::array<N, Count>> {
    using T = std::array<N, Count>;
    static TypeInfo type(const Constraint& c) { return TypeInfo::numbers(Count, Codec<N>::type(c)); }
    static Value to_value(const T& a) {
        std::vector<Value> items;
        for (const N n : a) items.push_back(Codec<N>::to_value(n));
        return detail::make_array(std::move(items));
    }
    static T from_value(const Value& v, const TypeInfo&, const PathBase&) {
        T out{};
        for (std::size_t i = 0; i < Count; ++i) out[i] = static_cast<N>(v.items[i].number);
        return out;
    }
};

template <class T>
struct Codec<std::vector<T>> {
    static TypeInfo type(const Constraint& c) { return TypeInfo::list(Codec<T>::type(c)); }
    static Value to_value(const std::vector<T>& list) {
        std::vector<Value> items;
        for (const T& t : list) items.push_back(Codec<T>::to_value(t));
        return detail::make_array(std::move(items));
    }
    static std::vector<T> from_value(const Value& v, const TypeInfo& type, const PathBase& base) {
        std::vector<T> out;
        for (const Value& item : v.items) out.push_back(Codec<T>::from_value(item, type.items[0], base));
        return out;
    }
};

// An object with keys of the user's own: name → T.
template <class T>
struct Codec<Map<T>> {
    static TypeInfo type(const Constraint& c) { return TypeInfo::map(Codec<T>::type(c), c.names); }
    static Value to_value(const Map<T>& map) {
        std::vector<Member> members;
        for (const auto& [key, t] : map.entries) members.push_back({key, {}, Codec<T>::to_value(t)});
        return detail::make_object(std::move(members));
    }
    static Map<T> from_value(const Value& v, const TypeInfo& type, const PathBase& base) {
        Map<T> out;
        for (const Member& m : v.members)
            out.entries.emplace_back(m.key, Codec<T>::from_value(m.value, type.items[0], base));
        return out;
    }
};

namespace detail {

// for_each() looks into neither pairs nor variants; an input or a file in one would go unseen.
template <class T>
inline constexpr bool kMustBeFound = std::same_as<T, Input> || std::same_as<T, FileName> || Declared<T>;
template <class T>
inline constexpr bool kMustBeFound<std::optional<T>> = kMustBeFound<T>;
template <class T>
inline constexpr bool kMustBeFound<std::vector<T>> = kMustBeFound<T>;
template <class T>
inline constexpr bool kMustBeFound<Map<T>> = kMustBeFound<T>;

}  // namespace detail

// A list of two things.
template <class A, class B>
struct Codec<std::pair<A, B>> {
    static_assert(!detail::kMustBeFound<A> && !detail::kMustBeFound<B>,
                  "a std::pair can't hold an Input, a FileName or a struct of fields; list structs instead");
    using T = std::pair<A, B>;
    static TypeInfo type(const Constraint& c) {
        return TypeInfo::tuple({Codec<A>::type(c), Codec<B>::type(c)});
    }
    static Value to_value(const T& pair) {
        return detail::make_array({Codec<A>::to_value(pair.first), Codec<B>::to_value(pair.second)});
    }
    static T from_value(const Value& v, const TypeInfo& type, const PathBase& base) {
        return {Codec<A>::from_value(v.items[0], type.items[0], base),
                Codec<B>::from_value(v.items[1], type.items[1], base)};
    }
};

// One of several types, told apart by the kind of JSON value.
template <class... Ts>
struct Codec<std::variant<Ts...>> {
    static_assert((!detail::kMustBeFound<Ts> && ...),
                  "a std::variant can't hold an Input, a FileName or a struct of fields");
    using V = std::variant<Ts...>;
    static TypeInfo type(const Constraint& c) { return TypeInfo::any_of({Codec<Ts>::type(c)...}); }
    static Value to_value(const V& variant) {
        return std::visit([]<class T>(const T& t) { return Codec<T>::to_value(t); }, variant);
    }
    static V from_value(const Value& v, const TypeInfo& type, const PathBase& base) {
        V out;
        auto choice = type.items.begin();
        static_cast<void>((take<Ts>(v, *choice++, base, out) || ...));
        return out;
    }

private:
    template <class T>
    static bool take(const Value& v, const TypeInfo& type, const PathBase& base, V& out) {
        if (!accepts(type, v)) return false;
        out.template emplace<T>(Codec<T>::from_value(v, type, base));
        return true;
    }
};

template <Declared T>
struct Codec<T> {
    static TypeInfo type(const Constraint&) { return TypeInfo::object(describe_fields<T>()); }
    static Value to_value(const T& t) { return fields_to_value(t); }
    static T from_value(const Value& v, const TypeInfo& type, const PathBase& base) {
        T out;
        read_fields(v, type.fields, base, out);
        return out;
    }
};

template <class Params>
void read_fields(const Value& object, const std::vector<FieldInfo>& fields, const PathBase& base,
                 Params& out) {
    auto info = fields.begin();
    const auto read_one = [&]<class Owner, class T>(const Field<Owner, T>& f) {
        const TypeInfo& type = info++->type;
        if (const Value* v = object.find(f.name)) out.*f.member = Codec<T>::from_value(*v, type, base);
    };
    std::apply([&](const auto&... f) { (read_one(f), ...); }, Params::fields);
}

template <class Params>
std::vector<FieldInfo> describe_fields() {
    const Params defaults{};
    std::vector<FieldInfo> out;
    const auto describe_one = [&]<class Owner, class T>(const Field<Owner, T>& f) {
        out.push_back({f.name, f.help, Codec<T>::type(f.constraint), Codec<T>::to_value(defaults.*f.member),
                       f.is_required});
    };
    std::apply([&](const auto&... f) { (describe_one(f), ...); }, Params::fields);
    return out;
}

template <class Params>
Value fields_to_value(const Params& params) {
    const Params defaults{};
    std::vector<Member> members;
    const auto add = [&]<class Owner, class T>(const Field<Owner, T>& f) {
        const auto is_null = [](const Value& v) { return v.is(Value::Kind::kNull); };
        Value v = Codec<T>::to_value(params.*f.member);
        // Absent says none only where none is the default.
        if (is_null(v) && is_null(Codec<T>::to_value(defaults.*f.member))) return;
        members.push_back({f.name, {}, std::move(v)});
    };
    std::apply([&](const auto&... f) { (add(f), ...); }, Params::fields);
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
