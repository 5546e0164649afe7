// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/json/json_reader.h"

#include "engine/json/json_text.h"

#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unordered_map>

namespace keyline {

namespace {

constexpr std::size_t kDeepest = 64;

// Text that is not JSON at all, as against JSON that can't be taken.
class NotJson : public Failure {
public:
    using Failure::Failure;
};

// Builds values from the parser's events.  The events come in the text's order, so a cursor that follows
// them from token to token knows where each one stands; the parser itself does not tell.
class Builder {
public:
    Builder(std::string_view text, std::string source, bool option)
        : source_(std::move(source)), option_(option), token_(text), cursor_(text) {}

    Value take() { return std::move(root_); }

    // The events, with the signatures that nlohmann's parser asks for.
    bool null() { return literal(Value::Kind::kNull, false, "null"); }
    bool boolean(bool b) { return literal(Value::Kind::kBool, b, b ? "true" : "false"); }
    bool number_integer(nlohmann::json::number_integer_t n) { return number(static_cast<double>(n)); }
    bool number_unsigned(nlohmann::json::number_unsigned_t n) { return number(static_cast<double>(n)); }
    bool number_float(double n, const std::string&) { return number(n); }
    bool string(std::string& text);
    bool binary(nlohmann::json::binary_t&) { return false; }  // no part of JSON text
    bool start_object(std::size_t) { return open(Value::Kind::kObject, JsonNext::kKeyOrEnd); }
    bool key(std::string& name);
    bool end_object() { return close(); }
    bool start_array(std::size_t) { return open(Value::Kind::kArray, JsonNext::kValue); }
    bool end_array() { return close(); }
    bool parse_error(std::size_t position, const std::string& token, const nlohmann::json::exception& error);

private:
    struct Open {
        Value value;
        std::string key;  // of the member to come
        Place key_place;
        std::unordered_map<std::string, int> lines;  // of the keys so far
    };

    Place place(const TextCursor& at) const {
        return option_ ? Place{source_, 0, 0} : Place{source_, at.line(), at.column()};
    }
    [[noreturn]] void refuse(std::string what, Code code = Code::kSyntax) const {
        throw Failure({ErrorKind::kGraph, place(token_), {}, std::move(what), {}, Passing::kNever, code});
    }
    void to_token();
    void take_string();
    Value begin(Value::Kind kind);
    bool add(Value value);
    bool literal(Value::Kind kind, bool b, std::string_view word);
    bool number(double n);
    bool open(Value::Kind kind, JsonNext next);
    bool close();

    std::string source_;
    bool option_;
    TextCursor token_;   // where the last token starts
    TextCursor cursor_;  // where it ends
    JsonNext next_ = JsonNext::kValue;
    std::vector<Open> stack_;
    Value root_;
};

// The parser has checked the grammar: what lies between two tokens can be skipped blindly.
void Builder::to_token() {
    cursor_.skip_blanks();
    while (cursor_.peek() == ',' || cursor_.peek() == ':') {
        cursor_.advance();
        cursor_.skip_blanks();
    }
    token_ = cursor_;
}

void Builder::take_string() {
    cursor_.advance();
    while (cursor_.peek() != '"') cursor_.advance(cursor_.peek() == '\\' ? 2 : 1);
    cursor_.advance();
}

Value Builder::begin(Value::Kind kind) {
    to_token();
    Value value;
    value.kind = kind;
    value.place = place(token_);
    return value;
}

bool Builder::add(Value value) {
    if (stack_.empty()) {
        root_ = std::move(value);
        next_ = JsonNext::kNothing;
        return true;
    }
    Open& parent = stack_.back();
    if (parent.value.is(Value::Kind::kArray)) {
        parent.value.items.push_back(std::move(value));
        next_ = JsonNext::kCommaOrBracket;
    } else {
        parent.value.members.push_back(
            {std::move(parent.key), std::move(parent.key_place), std::move(value)});
        next_ = JsonNext::kCommaOrBrace;
    }
    return true;
}

bool Builder::literal(Value::Kind kind, bool b, std::string_view word) {
    Value value = begin(kind);
    cursor_.advance(word.size());
    value.boolean = b;
    return add(std::move(value));
}

bool Builder::number(double n) {
    Value value = begin(Value::Kind::kNumber);
    value.text = cursor_.rest().substr(0, number_length(cursor_.rest()));
    cursor_.advance(value.text.size());
    // The parser reads -0 as the integer 0.
    value.number = value.text.front() == '-' ? -std::abs(n) : n;
    return add(std::move(value));
}

bool Builder::string(std::string& text) {
    Value value = begin(Value::Kind::kString);
    take_string();
    value.text = std::move(text);
    return add(std::move(value));
}

bool Builder::open(Value::Kind kind, JsonNext next) {
    Value value = begin(kind);
    if (stack_.size() == kDeepest) refuse(fmt::format("this is nested deeper than {} levels", kDeepest));
    cursor_.advance();
    stack_.push_back({std::move(value), {}, {}, {}});
    next_ = next;
    return true;
}

bool Builder::close() {
    to_token();
    cursor_.advance();
    Value value = std::move(stack_.back().value);
    stack_.pop_back();
    return add(std::move(value));
}

bool Builder::key(std::string& name) {
    to_token();
    Open& parent = stack_.back();
    const auto [first, fresh] = parent.lines.try_emplace(name, token_.line());
    if (!fresh) {
        const std::string line = option_ ? "" : fmt::format("; it was first given at line {}", first->second);
        refuse(fmt::format("key {} is given twice{}", in_quotes(name), line), Code::kDuplicateKey);
    }
    take_string();
    parent.key = std::move(name);
    parent.key_place = place(token_);
    next_ = JsonNext::kColon;
    return true;
}

bool Builder::parse_error(std::size_t, const std::string& token, const nlohmann::json::exception& error) {
    if (dynamic_cast<const nlohmann::json::out_of_range*>(&error) != nullptr) {
        to_token();
        refuse(fmt::format("{} is beyond the range of numbers", in_quotes(token)));
    }
    JsonFault fault = explain_json_fault(token_, cursor_, next_);
    if (fault.at.at_end() && fault.hint.empty() && !stack_.empty()) {
        const Value& open = stack_.back().value;
        fault.hint = fmt::format("the '{}' at line {} is not closed",
                                 open.is(Value::Kind::kArray) ? '[' : '{', open.place.line);
    }
    throw NotJson({ErrorKind::kGraph,
                   place(fault.at),
                   {},
                   std::move(fault.what),
                   std::move(fault.hint),
                   Passing::kNever,
                   Code::kSyntax});
}

Value parse(std::string_view text, const std::string& source, bool option) {
    Builder builder(text, source, option);
    if (auto fault = find_encoding_fault(text))
        throw NotJson({ErrorKind::kGraph,
                       {source, fault->at.line(), fault->at.column()},
                       {},
                       std::move(fault->what),
                       std::move(fault->hint),
                       Passing::kNever,
                       Code::kSyntax});
    nlohmann::json::sax_parse(text.begin(), text.end(), &builder, nlohmann::json::input_format_t::json,
                              /*strict=*/true, /*ignore_comments=*/!option);
    return builder.take();
}

}  // namespace

Value parse_json(std::string_view text, const std::string& file) { return parse(text, file, false); }

Value parse_option_value(std::string_view text, const std::string& option) {
    try {
        Value value = parse(text, option, true);
        if (!value.is(Value::Kind::kString)) value.text = text;
        return value;
    } catch (const NotJson&) {
        Value value;
        value.kind = Value::Kind::kString;
        value.text = text;
        value.place = {option, 0, 0};
        return value;
    }
}

}  // namespace keyline
