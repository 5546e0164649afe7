// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/params.h"

#include "engine/simd/elementary.h"

#include <charconv>
#include <cmath>
#include <fmt/format.h>

namespace keyline {

namespace detail {

void wrong_kind(const Value& value, std::string_view name, const TypeInfo& type, ParamReader& reader) {
    const std::string kind = value.is(Value::Kind::kNull) ? "" : fmt::format(", {}", kind_name(value.kind));
    reader.error(value.place,
                 fmt::format("'{}' is {}{}; it must be {}", name, value.shown(), kind, type.text()));
}

void check_range(const Value& value, std::string_view name, double number, const Constraint& c,
                 ParamReader& reader) {
    if (number >= c.range.min && number <= c.range.max) return;
    reader.error(value.place, fmt::format("'{}' is {}; it must be {}", name, value.shown(),
                                          TypeInfo::number(c.range).range_text()));
}

void unknown_key(const Member& member, const std::vector<std::string>& known, ParamReader& reader) {
    std::string hint = did_you_mean(member.key, known);
    if (hint.empty()) hint = known.empty() ? "it takes none" : "known are " + listed(known);
    reader.error(member.key_place, "unknown key " + in_quotes(member.key), std::move(hint));
}

void missing_key(const Place& place, const char* name, bool is_input, ParamReader& reader) {
    reader.error(place, fmt::format("{} '{}' is missing", is_input ? "input" : "parameter", name));
}

void unknown_word(const Value& value, std::string_view name, const std::vector<std::string>& words,
                  ParamReader& reader) {
    std::string hint = did_you_mean(value.text, words);
    reader.error(value.place,
                 fmt::format("'{}' is {}; it must be one of {}", name, value.shown(), listed(words)),
                 std::move(hint));
}

Value make_value(bool b) {
    Value v;
    v.kind = Value::Kind::kBool;
    v.boolean = b;
    return v;
}

Value make_value(double number) {
    Value v;
    v.kind = Value::Kind::kNumber;
    v.number = number;
    v.text = fmt::format("{}", number);
    return v;
}

Value make_value(std::string text) {
    Value v;
    v.kind = Value::Kind::kString;
    v.text = std::move(text);
    return v;
}

Value make_array(std::vector<Value> items) {
    Value v;
    v.kind = Value::Kind::kArray;
    v.items = std::move(items);
    return v;
}

Value make_object(std::vector<std::pair<std::string, Value>> members) {
    Value v;
    v.kind = Value::Kind::kObject;
    for (auto& [key, value] : members) v.members.push_back({key, {}, std::move(value)});
    return v;
}

}  // namespace detail

void Codec<int>::parse(const Value& v, std::string_view name, const Constraint& c, int& out, ParamReader& r) {
    const bool whole = accepts(v) && v.number == std::floor(v.number) && std::abs(v.number) <= 2147483647.0;
    if (!whole) return detail::wrong_kind(v, name, type(c), r);
    detail::check_range(v, name, v.number, c, r);
    out = static_cast<int>(v.number);
}

void Codec<FileName>::parse(const Value& v, std::string_view name, const Constraint& c, FileName& out,
                            ParamReader& r) {
    if (!accepts(v)) return detail::wrong_kind(v, name, type(c), r);
    if (v.text.empty()) return r.error(v.place, fmt::format("'{}' is empty; it must be a file name", name));
    try {
        out = FileName(v.text, r.base(v.place));
    } catch (const Failure& f) {
        r.error(v.place, fmt::format("'{}': {}", name, f.error().what), f.error().hint);
    }
}

Value Codec<Vec2>::to_value(const Vec2& v) {
    if (v.x == v.y) return detail::make_value(v.x);
    return detail::make_array({detail::make_value(v.x), detail::make_value(v.y)});
}

void Codec<Vec2>::parse(const Value& v, std::string_view name, const Constraint& c, Vec2& out,
                        ParamReader& r) {
    if (v.is(Value::Kind::kNumber)) {
        Codec<double>::parse(v, name, c, out.x, r);
        out.y = out.x;
    } else if (v.is(Value::Kind::kArray) && v.items.size() == 2) {
        Codec<double>::parse(v.items[0], name, c, out.x, r);
        Codec<double>::parse(v.items[1], name, c, out.y, r);
    } else {
        detail::wrong_kind(v, name, type(c), r);
    }
}

namespace {

// The sRGB transfer function's inverse, IEC 61966-2-1.
double srgb_to_linear(int byte) {
    const double s = byte / 255.0;
    return s <= 0.04045 ? s / 12.92 : elementary::pow((s + 0.055) / 1.055, 2.4);
}

std::optional<Color> parse_hex(const std::string& text) {
    if (text.size() != 7 || text[0] != '#') return {};
    std::array<int, 3> bytes{};
    for (std::size_t i = 0; i < 3; ++i) {
        const char* begin = text.data() + 1 + 2 * i;
        const auto [end, error] = std::from_chars(begin, begin + 2, bytes[i], 16);
        if (error != std::errc{} || end != begin + 2 || bytes[i] < 0) return {};
    }
    return Color{srgb_to_linear(bytes[0]), srgb_to_linear(bytes[1]), srgb_to_linear(bytes[2])};
}

}  // namespace

Value Codec<Color>::to_value(const Color& color) {
    return Codec<std::array<double, 3>>::to_value({color.r, color.g, color.b});
}

void Codec<Color>::parse(const Value& v, std::string_view name, const Constraint& c, Color& out,
                         ParamReader& r) {
    if (v.is(Value::Kind::kString)) {
        if (const auto color = parse_hex(v.text))
            out = *color;
        else
            detail::wrong_kind(v, name, type(c), r);
    } else if (v.is(Value::Kind::kArray) && v.items.size() == 3) {
        Codec<double>::parse(v.items[0], name, c, out.r, r);
        Codec<double>::parse(v.items[1], name, c, out.g, r);
        Codec<double>::parse(v.items[2], name, c, out.b, r);
    } else {
        detail::wrong_kind(v, name, type(c), r);
    }
}

void Codec<Input>::parse(const Value& v, std::string_view name, const Constraint& c, Input& out,
                         ParamReader& r) {
    if (!accepts(v)) return detail::wrong_kind(v, name, type(c), r);
    const auto colon = v.text.find(':');
    out.node = v.text.substr(0, colon);
    out.selector = colon == std::string::npos ? "" : v.text.substr(colon + 1);
    out.place = v.place;
    if (out.node.empty() || (colon != std::string::npos && out.selector.empty()))
        r.error(v.place, fmt::format("'{}' is {}; it must be \"NODE\" or \"NODE:LAYER\"", name, v.shown()));
}

}  // namespace keyline
