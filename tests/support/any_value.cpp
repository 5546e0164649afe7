// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/support/any_value.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace keyline::testing {

using Kind = TypeInfo::Kind;

std::string AnyValue::of(const TypeInfo& type) {
    if (one_in_ > 0 && draw_.one_in(one_in_)) return wrong(type);
    if (type.optional && draw_.one_in(4)) return "null";
    return right(type);
}

std::string AnyValue::object(const std::vector<FieldInfo>& fields) {
    std::string out;
    for (const FieldInfo& f : fields)
        if (one_in_ > 0 ? !draw_.one_in(one_in_) : f.required || (computes_ && draw_.one_in(2)))
            add(out, f.name, of(f.type));
    if (one_in_ > 0 && draw_.one_in(2 * one_in_)) add(out, "no_such_key", "1");
    return "{" + out + "}";
}

void AnyValue::add(std::string& members, const std::string& name, const std::string& value) {
    members += fmt::format("{}\"{}\": {}", members.empty() ? "" : ", ", name, value);
}

std::string AnyValue::right(const TypeInfo& type) {
    const std::string value = plain(type);
    return computes_ && type.kind != Kind::kInput && draw_.one_in(3) ? computed(value) : value;
}

// An expression may stand where none is allowed: what comes of it is for both to judge.  Keys hold what is
// not computed: a schema lets any value be in them.
std::string AnyValue::computed(const std::string& value) {
    const auto holds = [&](const char* part) { return value.find(part) != std::string::npos; };
    const bool is_text = value.front() == '"', is_plain = !holds("[") && !holds("{") && !holds("=");
    switch (draw_.whole(0, 2)) {
        case 0: {
            const std::string name = fmt::format("v{}", ++used_);
            add(variables_, name, value);
            return fmt::format("\"${{{}}}\"", name);
        }
        case 1:
            return holds("\"=") || holds("\"keys\"")
                       ? value
                       : fmt::format(R"({{"keys": [[1, {}]], "after": "loop"}})", value);
        default: break;
    }
    if (!is_plain || value == "null") return value;
    return is_text ? fmt::format("\"= '{}'\"", value.substr(1, value.size() - 2))
                   : fmt::format("\"= {}\"", value);
}

std::string AnyValue::plain(const TypeInfo& type) {
    switch (type.kind) {
        case Kind::kNumber: return number(type.range);
        case Kind::kInteger: return fmt::format("{}", std::round(draw_.number(type.range)));
        case Kind::kBool: return draw_.one_in(2) ? "true" : "false";
        case Kind::kString: return draw_.of(std::vector<std::string>{"\"\"", "\"ü\"", "\"R\""});
        case Kind::kFile: return draw_.of(std::vector<std::string>{"\"a.exr\"", "\"b/a.####.exr\""});
        case Kind::kWord: return fmt::format("\"{}\"", draw_.of(type.words).word);
        case Kind::kPair: return draw_.one_in(2) ? number(type.range) : array(2, type.range);
        case Kind::kColor: return draw_.one_in(2) ? "\"#12abEF\"" : array(3, type.range);
        case Kind::kInput: return input(type.takes);
        case Kind::kNumbers: return array(type.items[0], static_cast<int>(type.count));
        case Kind::kList: return array(type.items[0], draw_.whole(0, 3));
        case Kind::kTuple: {
            std::string out;
            for (const TypeInfo& item : type.items) out += (out.empty() ? "" : ", ") + of(item);
            return "[" + out + "]";
        }
        case Kind::kMap: {
            std::string out;
            for (int i = draw_.whole(0, 2); i > 0; --i) add(out, fmt::format("k{}", i), of(type.items[0]));
            return "{" + out + "}";
        }
        case Kind::kObject: return object(type.fields);
        case Kind::kAnyOf: break;
    }
    return of(draw_.of(type.items));
}

// Of some other kind, out of the range, too long, or no such word.
std::string AnyValue::wrong(const TypeInfo& type) {
    const std::vector<std::string> others{
        "null",       "true",       "1",        "0.5",    "-1e9",       "1e9",
        "3000000000", "[]",         "[0]",      "[0, 0]", "[0, 0, 0]",  "[0, 0, 0, 0]",
        "[0.5, 0.5]", "[0, \"a\"]", "[[0, 0]]", "{}",     "{\"a\": 0}", "{\"a\": \"node\"}"};
    const std::vector<std::string> texts{"\"\"", "\"nonsense\"", "\"#12abE\"", "\"#12abEG\""};
    const std::vector<std::string> inputs{"\"\"", "\"node:\"", "\":R\"", "\":\""};
    if (draw_.one_in(2)) return draw_.of(others);
    if (type.kind == Kind::kInput) return draw_.of(inputs);
    if (type.kind == Kind::kFile) return "\"\"";
    const double step = draw_.one_in(2) ? 1 : 0.25;
    if (std::isfinite(type.range.min) && draw_.one_in(2)) return fmt::format("{}", type.range.min - step);
    if (std::isfinite(type.range.max) && draw_.one_in(2)) return fmt::format("{}", type.range.max + step);
    return draw_.of(texts);
}

std::string AnyValue::number(const Range& range) { return fmt::format("{}", draw_.number(range)); }

std::string AnyValue::array(int count, const Range& range) { return array(TypeInfo::number(range), count); }

std::string AnyValue::array(const TypeInfo& item, int count) {
    std::string out;
    for (int i = 0; i < count; ++i) out += (i == 0 ? "" : ", ") + of(item);
    return "[" + out + "]";
}

std::string AnyValue::input(const Takes& takes) {
    if (takes.kind == Takes::Kind::kData || draw_.one_in(2)) return "\"node\"";
    return draw_.of(std::vector<std::string>{"\"_a-1:R\"", "\"node:depth.Z\"", "\"n:a:b\""});
}

}  // namespace keyline::testing
