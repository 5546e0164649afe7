// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/params/validate.h"

#include "engine/json/json_reader.h"
#include "engine/params/colour_text.h"
#include "engine/params/file_name.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace keyline {

std::filesystem::path PathBase::of(const Place& place) const {
    const bool typed = place.line == 0;
    return typed && !is_root ? std::filesystem::path() : folder;
}

ParamReader::ParamReader(Diagnostics& diagnostics, std::string node, PathBase base)
    : diagnostics_(diagnostics), node_(std::move(node)), base_(std::move(base)) {}

void ParamReader::error(const Place& place, std::string what, std::string hint, Code code) {
    failed_ = true;
    diagnostics_.error(
        {ErrorKind::kGraph, place, node_, std::move(what), std::move(hint), Passing::kNever, code});
}

namespace {

using Kind = TypeInfo::Kind;

bool is_array_of(const Value& value, std::size_t count) {
    return value.is(Value::Kind::kArray) && value.items.size() == count;
}

bool accepts_each(const std::vector<TypeInfo>& types, const Value& value) {
    return is_array_of(value, types.size()) &&
           std::ranges::equal(types, value.items, [](const auto& t, const auto& v) { return accepts(t, v); });
}

// One value, called `name`; what is inside it is called by the same name, but for members.
class Validation {
public:
    Validation(std::string_view name, ParamReader& reader) : name_(name), reader_(reader) {}

    void check(const TypeInfo& type, const Value& value) const {
        if (type.optional && value.is(Value::Kind::kNull)) return;
        if (!accepts(type, value)) return wrong_kind(type, value);
        switch (type.kind) {
            case Kind::kBool:
            case Kind::kString: return;
            case Kind::kNumber: return range(type.range, value);
            case Kind::kInteger: return integer(type, value);
            case Kind::kFile: return file(value);
            case Kind::kWord: return word(type, value);
            case Kind::kPair: return pair(type, value);
            case Kind::kColor: return colour(type, value);
            case Kind::kInput: return input(value);
            case Kind::kNumbers:
            case Kind::kList: return items(type.items[0], value);
            case Kind::kMap:
                for (const Member& m : value.members) validate(type.items[0], m.value, m.key, reader_);
                return;
            case Kind::kObject: return validate(type.fields, value, reader_);
            case Kind::kTuple:
                for (std::size_t i = 0; i < type.items.size(); ++i) check(type.items[i], value.items[i]);
                return;
            case Kind::kAnyOf: return check(*choice(type, value), value);
        }
    }

private:
    void wrong_kind(const TypeInfo& type, const Value& value) const {
        const std::string kind =
            value.is(Value::Kind::kNull) ? "" : fmt::format(", {}", kind_name(value.kind));
        must_be(value, kind, type.text(), way_out(type, value));
    }

    // What people write who are used to other forms.
    static std::string way_out(const TypeInfo& type, const Value& value) {
        const bool may_move = type.kind == Kind::kNumber || type.kind == Kind::kInteger ||
                              type.kind == Kind::kPair || type.kind == Kind::kColor ||
                              type.kind == Kind::kNumbers;
        if (value.is(Value::Kind::kObject) && may_move)
            return "a value that moves is { \"keys\": [[FRAME, VALUE], …] }";
        const std::size_t comma = value.text.find(',');
        const bool is_number = value.is(Value::Kind::kString) && comma != std::string::npos &&
                               value.text.find_first_not_of("-0123456789,") == std::string::npos &&
                               value.text.find(',', comma + 1) == std::string::npos;
        if (in_needless_quotes(type, value)) return "leave out the quotes";
        if (!is_number || !may_move) return {};
        return fmt::format("a number has a point: {}.{}", value.text.substr(0, comma),
                           value.text.substr(comma + 1));
    }

    // Whether it is the text of a value that would do.
    static bool in_needless_quotes(const TypeInfo& type, const Value& value) {
        if (!value.is(Value::Kind::kString)) return false;
        try {
            const Value inner = parse_json(value.text, {});
            return !inner.is(Value::Kind::kString) && accepts(type, inner);
        } catch (const Failure&) {
            return false;
        }
    }

    void must_be(const Value& value, std::string_view kind, std::string_view what,
                 std::string hint = {}) const {
        reader_.error(value.place,
                      fmt::format("'{}' is {}{}; it must be {}", name_, value.shown(), kind, what),
                      std::move(hint));
    }

    void range(const Range& range, const Value& value) const {
        if (value.number >= range.min && value.number <= range.max) return;
        must_be(value, "", TypeInfo::number(range).range_text());
    }

    void integer(const TypeInfo& type, const Value& value) const {
        const bool is_int =
            value.number == std::floor(value.number) && std::abs(value.number) <= 2147483647.0;
        is_int ? range(type.range, value) : wrong_kind(type, value);
    }

    void file(const Value& value) const {
        if (value.text.empty())
            return reader_.error(value.place, fmt::format("'{}' is empty; it must be a file name", name_));
        if (const auto fault = FileName::fault(value.text))
            reader_.error(value.place, fmt::format("'{}': {}", name_, *fault));
    }

    void word(const TypeInfo& type, const Value& value) const {
        std::vector<std::string> known;
        for (const TypeInfo::WordInfo& w : type.words) known.push_back(w.word);
        if (std::ranges::find(known, value.text) == known.end())
            must_be(value, "", "one of " + listed(known), did_you_mean(value.text, known));
    }

    void pair(const TypeInfo& type, const Value& value) const {
        if (value.is(Value::Kind::kArray))
            is_array_of(value, 2) ? items(TypeInfo::number(type.range), value) : wrong_kind(type, value);
        else
            range(type.range, value);
    }

    void colour(const TypeInfo& type, const Value& value) const {
        if (value.is(Value::Kind::kArray))
            items(TypeInfo::number(type.range), value);
        else if (!colour_of_text(value.text))
            wrong_kind(type, value);
    }

    void input(const Value& value) const {
        const auto colon = value.text.find(':');
        if (value.text.empty() || colon == 0 || colon == value.text.size() - 1)
            must_be(value, "", "\"NODE\" or \"NODE:LAYER\"");
    }

    void items(const TypeInfo& type, const Value& value) const {
        for (const Value& item : value.items) check(type, item);
    }

    static const TypeInfo* choice(const TypeInfo& type, const Value& value) {
        return &*std::ranges::find_if(type.items, [&](const TypeInfo& t) { return accepts(t, value); });
    }

    std::string_view name_;
    ParamReader& reader_;
};

void unknown_key(const Member& member, const std::vector<FieldInfo>& fields, ParamReader& reader) {
    std::vector<std::string> known;
    for (const FieldInfo& f : fields) known.push_back(f.name);
    std::string hint = did_you_mean(member.key, known);
    if (hint.empty()) hint = known.empty() ? "it takes none" : "known are " + listed(known);
    reader.error(member.key_place, "unknown key " + in_quotes(member.key), std::move(hint),
                 Code::kUnknownKey);
}

}  // namespace

void validate(const TypeInfo& type, const Value& value, std::string_view name, ParamReader& reader) {
    Validation(name, reader).check(type, value);
}

void validate(const std::vector<FieldInfo>& fields, const Value& object, ParamReader& reader) {
    for (const FieldInfo& f : fields)
        if (const Value* v = object.find(f.name))
            validate(f.type, *v, f.name, reader);
        else if (f.required)
            reader.error(object.place,
                         fmt::format("{} '{}' is missing",
                                     f.type.kind == Kind::kInput ? "input" : "parameter", f.name),
                         {}, Code::kMissingKey);
    for (const Member& m : object.members)
        if (std::ranges::find(fields, m.key, &FieldInfo::name) == fields.end())
            unknown_key(m, fields, reader);
}

bool accepts(const TypeInfo& type, const Value& value) {
    if (type.optional && value.is(Value::Kind::kNull)) return true;
    switch (type.kind) {
        case Kind::kNumber:
        case Kind::kInteger: return value.is(Value::Kind::kNumber);
        case Kind::kBool: return value.is(Value::Kind::kBool);
        case Kind::kString:
        case Kind::kFile:
        case Kind::kWord:
        case Kind::kInput: return value.is(Value::Kind::kString);
        case Kind::kPair: return value.is(Value::Kind::kNumber) || value.is(Value::Kind::kArray);
        case Kind::kColor: return value.is(Value::Kind::kString) || is_array_of(value, 3);
        case Kind::kNumbers: return is_array_of(value, type.count);
        case Kind::kList: return value.is(Value::Kind::kArray);
        case Kind::kMap:
        case Kind::kObject: return value.is(Value::Kind::kObject);
        case Kind::kTuple: return accepts_each(type.items, value);
        case Kind::kAnyOf: break;
    }
    return std::ranges::any_of(type.items, [&](const TypeInfo& t) { return accepts(t, value); });
}

}  // namespace keyline
