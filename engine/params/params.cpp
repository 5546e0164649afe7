// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/params/params.h"

#include "engine/params/colour_text.h"

#include <fmt/format.h>

namespace keyline {

namespace detail {

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

Value make_object(std::vector<Member> members) {
    Value v;
    v.kind = Value::Kind::kObject;
    v.members = std::move(members);
    return v;
}

}  // namespace detail

Value Codec<Vec2>::to_value(const Vec2& v) {
    if (v.x == v.y) return detail::make_value(v.x);
    return detail::make_array({detail::make_value(v.x), detail::make_value(v.y)});
}

Vec2 Codec<Vec2>::from_value(const Value& v, const TypeInfo&, const PathBase&) {
    if (v.is(Value::Kind::kNumber)) return v.number;
    return {v.items[0].number, v.items[1].number};
}

Value Codec<Color>::to_value(const Color& color) {
    return Codec<std::array<double, 3>>::to_value({color.r, color.g, color.b});
}

Color Codec<Color>::from_value(const Value& v, const TypeInfo&, const PathBase&) {
    if (v.is(Value::Kind::kString)) return colour_of_text(v.text).value();
    return {v.items[0].number, v.items[1].number, v.items[2].number};
}

Input Codec<Input>::from_value(const Value& v, const TypeInfo&, const PathBase&) {
    const auto colon = v.text.find(':');
    Input out;
    out.node = v.text.substr(0, colon);
    out.selector = colon == std::string::npos ? "" : v.text.substr(colon + 1);
    out.place = v.place;
    return out;
}

}  // namespace keyline
