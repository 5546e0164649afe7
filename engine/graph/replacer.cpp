// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/graph/replacer.h"

#include "engine/expr/expression.h"
#include "engine/graph/animation.h"
#include "engine/graph/graph_error.h"
#include "engine/json/make_value.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <fmt/format.h>
#include <utility>

namespace keyline {

namespace {

// Bounds for what variables may unfold to: a few lines can ask for more than any memory holds.
constexpr std::size_t kLargest = 4'000'000;  // bytes
constexpr std::size_t kBytesPerValue = 100;  // beside its text, roughly
constexpr std::size_t kDeepest = 64;         // as in a graph file

constexpr const char* kLiteral = "a literal '${' is written as '$${'";

// A size of a node's leading input, as expressions call it.
struct Size {
    std::string_view name;
    double (*of)(const InputSizes&);
};

constexpr std::array kSizes{
    Size{"width", [](const InputSizes& s) -> double { return s.display.width(); }},
    Size{"height", [](const InputSizes& s) -> double { return s.display.height(); }},
    Size{"x", [](const InputSizes& s) -> double { return s.display.x0; }},
    Size{"y", [](const InputSizes& s) -> double { return s.display.y0; }},
    Size{"pixel_aspect", [](const InputSizes& s) { return s.pixel_aspect; }},
    Size{"data.width", [](const InputSizes& s) -> double { return s.data.width(); }},
    Size{"data.height", [](const InputSizes& s) -> double { return s.data.height(); }},
    Size{"data.x", [](const InputSizes& s) -> double { return s.data.x0; }},
    Size{"data.y", [](const InputSizes& s) -> double { return s.data.y0; }},
};

struct Extent {
    std::size_t size = 0, depth = 0;
};

Extent extent(const Value& value) {
    Extent out{kBytesPerValue + value.text.size(), 0};
    const auto add = [&out](const Extent& part) {
        out.size += part.size;
        out.depth = std::max(out.depth, part.depth);
    };
    for (const Value& item : value.items) add(extent(item));
    for (const Member& member : value.members) add(extent(member.value));
    if (value.is(Value::Kind::kArray) || value.is(Value::Kind::kObject)) ++out.depth;
    return out;
}

bool is_option(const Place& place) { return place.line == 0 && !place.file.empty(); }

void move_to(Value& value, const Place& use) {
    if (!is_option(value.place)) value.place = use;
    for (Value& item : value.items) move_to(item, use);
    for (Member& member : value.members) {
        if (!is_option(member.key_place)) member.key_place = use;
        move_to(member.value, use);
    }
}

Value frame_value(int frame, const Place& place) {
    Value value = number_value(frame, place);
    value.text = std::to_string(frame);
    return value;
}

void put_at(Value& value, const Place& place) {
    value.place = place;
    for (Value& item : value.items) put_at(item, place);
}

void round_off(Value& value) {
    value.number = std::floor(value.number + 0.5);
    for (Value& item : value.items) round_off(item);
}

// As it stands inside a longer text; nothing for what can't.
std::optional<std::string> as_text(const Value& value) {
    switch (value.kind) {
        case Value::Kind::kString: return value.text;
        case Value::Kind::kNumber: return value.text.empty() ? fmt::format("{}", value.number) : value.text;
        case Value::Kind::kBool: return value.boolean ? "true" : "false";
        default: return std::nullopt;
    }
}

}  // namespace

bool is_size(std::string_view name) { return std::ranges::find(kSizes, name, &Size::name) != kSizes.end(); }

// What the names in an expression stand for, where it is used.
class Variables::Replacer::Names final : public ExpressionScope {
public:
    Names(Replacer& replacer, const Place& use) : replacer_(replacer), use_(use) {}

    std::optional<Value> value(const std::string& name) const override {
        const Piece piece = piece_of_name(name);
        if (piece.kind == Piece::Kind::kName && !replacer_.variables_.find(name)) return named(name);
        std::optional<Value> value = replacer_.value_of({known_kind(piece.kind), piece.text}, use_);
        if (!value) throw AlreadyTold{};
        return value;
    }

    double first_frame() const override { return replacer_.variables_.shot_.first.value_or(1); }

    std::vector<std::string> names() const override {
        std::vector<std::string> out = replacer_.variables_.names();
        out.insert(out.end(), {"frame", "first", "last", "fps"});
        for (const Size& size : kSizes) out.emplace_back(size.name);
        return out;
    }

    // Thrown where a name has no value, which was told.
    struct AlreadyTold {};

private:
    static Piece::Kind known_kind(Piece::Kind kind) {
        return kind == Piece::Kind::kName ? Piece::Kind::kVariable : kind;
    }

    std::optional<Value> named(const std::string& name) const {
        const Shot& shot = replacer_.variables_.shot_;
        if (name == "first") return of_shot(name, shot.first, "\"frames\": \"1001-1100\"");
        if (name == "last") return of_shot(name, shot.last, "\"frames\": \"1001-1100\"");
        if (name == "fps") return of_shot(name, shot.fps, "\"fps\": 24");
        const auto size = std::ranges::find(kSizes, name, &Size::name);
        if (size == kSizes.end()) return std::nullopt;
        if (!replacer_.moment_.sizes)
            fail(ErrorKind::kGraph,
                 in_quotes(name) + " is that of a node's leading input, and not known here");
        return number_value(size->of(*replacer_.moment_.sizes));
    }

    template <class T>
    static std::optional<Value> of_shot(const std::string& name, const std::optional<T>& number,
                                        const char* way) {
        if (!number)
            fail(ErrorKind::kGraph, fmt::format("the graph does not say '{}'", name),
                 fmt::format("add {} to it", way));
        return number_value(*number);
    }

    Replacer& replacer_;
    const Place& use_;
};

void Variables::Replacer::prepare(const Value& value, const Guide& guide) {
    std::vector<bool> wanted(variables_.variables_.size(), false);
    const auto want = [&](const Value& user, const Guide& of_it) {
        for (const std::size_t i : variables_.used_by(user, of_it)) wanted[i] = true;
    };
    want(value, guide);
    for (std::size_t i = wanted.size(); i-- > 0;)
        if (wanted[i] && variables_.variables_[i].changes() && !variables_.variables_[i].giver)
            want(variables_.variables_[i].value, Guide::everything());
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        const Variable& v = variables_.variables_[i];
        if (!wanted[i] || !v.changes() || v.faulty || !is_known_now(v)) continue;
        const bool failed_before = std::exchange(failed_, false);
        Value now = value_now(v);
        const bool is_sound = !failed_ && variables_.is_choice(v, now, diagnostics_);
        now_[i] = is_sound ? std::optional(std::move(now)) : std::nullopt;
        failed_ = failed_ || failed_before;
    }
}

// What a variable that changes is now.
Value Variables::Replacer::value_now(const Variable& v) {
    if (!v.giver) return replace(v.value, Guide::everything());
    const std::size_t before = diagnostics_.errors().size();
    Value out = v.giver->replaced(v.value, Guide::everything(), moment_, diagnostics_);
    failed_ = failed_ || diagnostics_.errors().size() > before;
    return out;
}

bool Variables::Replacer::is_known_now(const Variable& v) const {
    return (!v.uses_frame || moment_.frame) && (!v.uses_sizes || moment_.sizes);
}

Value Variables::Replacer::replace(const Value& value, const Guide& guide, std::size_t depth) {
    if (value.is(Value::Kind::kString))
        return guide.computes() && is_expression(value.text) ? evaluated(value)
                                                             : replace_string(value, depth);
    Value out = value;
    for_each_part(out, guide,
                  [&](Value& part, const Guide& of_it) { part = replace(part, of_it, depth + 1); });
    return guide.animates() && is_animation(out) ? moved(out, guide) : out;
}

Value Variables::Replacer::evaluated(const Value& string) {
    try {
        Value out = Expression(string.text).evaluate(Names(*this, string.place));
        put_at(out, string.place);
        return out;
    } catch (const ExpressionFault& f) {
        fault(place_inside(string, f.at()), f.error().what, f.error().hint, Code::kExpression);
    } catch (const Names::AlreadyTold&) {
        failed_ = true;
    }
    return string;
}

Value Variables::Replacer::moved(const Value& animation, const Guide& guide) {
    if (!moment_.frame) return fault(animation.place, "keys have no value without a frame"), animation;
    std::optional<Value> now = animated(animation, *moment_.frame, diagnostics_);
    failed_ = failed_ || !now;
    if (now && guide.is_whole()) round_off(*now);
    return now.value_or(animation);
}

void Variables::Replacer::check(const Value& value, const Guide& guide) {
    if (value.is(Value::Kind::kString))
        return guide.computes() && is_expression(value.text) ? check_expression(value) : check_text(value);
    for_each_part(value, guide, [&](const Value& part, const Guide& of_it) { check(part, of_it); });
    if (guide.animates() && is_animation(value)) failed_ = !check_animation(value, diagnostics_) || failed_;
}

void Variables::Replacer::check_expression(const Value& string) {
    try {
        const Names known(*this, string.place);
        const std::vector<std::string> names = known.names();
        for (const NameInExpression& n : Expression(string.text).names())
            if (piece_of_name(n.name).kind == Piece::Kind::kName &&
                std::ranges::find(names, n.name) == names.end())
                throw ExpressionFault(n.at, "unknown name " + in_quotes(n.name), did_you_mean(n.name, names));
    } catch (const ExpressionFault& f) {
        fault(place_inside(string, f.at()), f.error().what, f.error().hint, Code::kExpression);
    }
}

void Variables::Replacer::check_text(const Value& string) {
    const Template parsed = parse_template(string.text);
    if (!parsed.fault.empty()) fault(string.place, parsed.fault, kLiteral);
    for (const Piece& piece : parsed.pieces) {
        if (piece.kind == Piece::Kind::kEnvironment) environment(piece.text, string.place);
        if (piece.kind == Piece::Kind::kVariable && !variables_.find(piece.text))
            fault(string.place, "unknown variable " + in_quotes(piece.text), hint(piece.text),
                  Code::kUnknownVariable);
    }
}

std::optional<Value> Variables::Replacer::fault(const Place& place, std::string what, std::string hint,
                                                Code code) {
    graph_error(diagnostics_, place, std::move(what), std::move(hint), {}, code);
    failed_ = true;
    return std::nullopt;
}

Value Variables::Replacer::replace_string(const Value& string, std::size_t depth) {
    const Template parsed = parse_template(string.text);
    if (!parsed.fault.empty()) {
        fault(string.place, parsed.fault, kLiteral);
        return string;
    }
    if (size_ > kLargest) return string;
    std::optional<Value> out = parsed.is_just_a_name() ? value_of(parsed.pieces[0], string.place)
                                                       : join(parsed.pieces, string.place);
    if (!out) return string;
    const Extent added = extent(*out);
    size_ += parsed.is_just_a_name() ? added.size : 0;
    if (size_ > kLargest)
        out = fault(string.place, fmt::format("variables make this larger than {} MB", kLargest / 1'000'000));
    else if (depth + added.depth > kDeepest)
        out = fault(string.place, fmt::format("variables nest this deeper than {} levels", kDeepest));
    return out.value_or(string);
}

std::optional<Value> Variables::Replacer::join(const std::vector<Piece>& pieces, const Place& use) {
    std::optional<Value> out = text_value({}, use);
    for (const Piece& piece : pieces) {
        if (size_ > kLargest) break;
        const std::optional<Value> part =
            piece.kind == Piece::Kind::kText ? text_value(piece.text, use) : value_of(piece, use);
        const std::optional<std::string> text = part ? as_text(*part) : std::nullopt;
        if (part && !text)
            fault(use, fmt::format("the variable {} is {}, which can't stand inside a text",
                                   in_quotes(piece.text), kind_name(part->kind)));
        if (!text) out.reset();
        if (!text || !out) continue;  // the other pieces may be at fault too
        out->text += *text;
        if (piece.kind != Piece::Kind::kText) size_ += text->size();
    }
    return out;
}

std::optional<Value> Variables::Replacer::value_of(const Piece& piece, const Place& use) {
    if (piece.kind == Piece::Kind::kVariable) return variable(piece.text, use);
    if (piece.kind == Piece::Kind::kEnvironment) return environment(piece.text, use);
    if (!moment_.frame) return fault(use, "'${frame}' stands for no frame here", "say which with --frames");
    return frame_value(*moment_.frame, use);
}

std::optional<Value> Variables::Replacer::variable(const std::string& name, const Place& use) {
    const Variable* found = variables_.find(name);
    if (found == nullptr)
        return fault(use, fmt::format("unknown variable {}", in_quotes(name)), hint(name),
                     Code::kUnknownVariable);
    if (found->faulty) {
        failed_ = true;
        return std::nullopt;
    }
    if (found->uses_frame && !moment_.frame)
        return fault(
            use,
            fmt::format("the variable {} uses '${{frame}}', which stands for no frame here", in_quotes(name)),
            "say which with --frames");
    if (found->uses_sizes && !moment_.sizes)
        return fault(use, fmt::format("the variable {} needs the size of an input, which is not known here",
                                      in_quotes(name)));
    const auto i = static_cast<std::size_t>(found - variables_.variables_.data());
    const auto now = now_.find(i);
    std::optional<Value> value = now == now_.end() ? found->resolved : now->second;
    if (value)
        move_to(*value, use);
    else
        failed_ = true;
    return value;
}

std::optional<Value> Variables::Replacer::environment(const std::string& name, const Place& use) {
    const char* value = std::getenv(name.c_str());
    if (value == nullptr)
        return fault(use, fmt::format("the environment has no variable {}", in_quotes(name)));
    return text_value(value, use);
}

std::string Variables::Replacer::hint(const std::string& name) const {
    std::vector<std::string> known = variables_.names();
    known.emplace_back("frame");
    if (std::string near = did_you_mean(name, known); !near.empty()) return near;
    const bool is_loud = std::ranges::none_of(name, [](char c) { return c >= 'a' && c <= 'z'; });
    if (is_loud || std::getenv(name.c_str()) != nullptr)
        return fmt::format("the environment's is written as '${{env:{}}}'", name);
    return variables_.declared_names();
}

}  // namespace keyline
