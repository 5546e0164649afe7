// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/variables.h"

#include <algorithm>
#include <cstdlib>
#include <fmt/format.h>

namespace keyline {

namespace {

// Bounds for what variables may unfold to: a few lines can ask for more than any memory holds.
constexpr std::size_t kLargest = 4'000'000;  // bytes
constexpr std::size_t kBytesPerValue = 100;  // beside its text, roughly
constexpr std::size_t kDeepest = 64;         // as in a graph file

constexpr std::size_t kMostListed = 12;

struct Piece {
    enum class Kind { kText, kVariable, kFrame, kEnvironment };
    Kind kind;
    std::string text;  // the text itself, or the name
};

struct Template {
    std::vector<Piece> pieces;
    std::string fault;

    bool is_just_a_name() const { return pieces.size() == 1 && pieces[0].kind != Piece::Kind::kText; }
};

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }

bool is_name(std::string_view name) {
    return !name.empty() && is_letter(name[0]) && std::all_of(name.begin(), name.end(), [](char c) {
        return is_letter(c) || (c >= '0' && c <= '9') || c == '-';
    });
}

std::optional<Piece> parse_reference(std::string_view name) {
    constexpr std::string_view kEnv = "env:";
    if (name == "frame") return Piece{Piece::Kind::kFrame, {}};
    if (is_name(name)) return Piece{Piece::Kind::kVariable, std::string(name)};
    if (!name.starts_with(kEnv) || name.size() == kEnv.size()) return std::nullopt;
    return Piece{Piece::Kind::kEnvironment, std::string(name.substr(kEnv.size()))};
}

void append_text(Template& out, std::string_view text) {
    if (out.pieces.empty() || out.pieces.back().kind != Piece::Kind::kText)
        out.pieces.push_back({Piece::Kind::kText, {}});
    out.pieces.back().text += text;
}

Template parse_template(std::string_view text) {
    Template out;
    while (!text.empty()) {
        const std::size_t dollar = std::min(text.find('$'), text.size());
        if (dollar > 0) append_text(out, text.substr(0, dollar));
        text.remove_prefix(dollar);
        if (text.starts_with("$${")) {
            append_text(out, "${");
            text.remove_prefix(3);
        } else if (text.starts_with("${")) {
            const std::size_t close = text.find('}');
            if (close == std::string_view::npos) {
                out.fault = fmt::format("{} has no '}}'", in_quotes(text));
                return out;
            }
            auto reference = parse_reference(text.substr(2, close - 2));
            if (!reference) {
                out.fault = fmt::format("{} names no variable", in_quotes(text.substr(0, close + 1)));
                return out;
            }
            out.pieces.push_back(std::move(*reference));
            text.remove_prefix(close + 1);
        } else if (!text.empty()) {
            append_text(out, "$");
            text.remove_prefix(1);
        }
    }
    return out;
}

template <typename F>
void for_each_piece(const Value& value, const F& visit) {
    if (value.is(Value::Kind::kString))
        for (const Piece& piece : parse_template(value.text).pieces) visit(piece);
    for (const Value& item : value.items) for_each_piece(item, visit);
    for (const Member& member : value.members) for_each_piece(member.value, visit);
}

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

Value string_value(std::string text, const Place& place) {
    Value value;
    value.kind = Value::Kind::kString;
    value.text = std::move(text);
    value.place = place;
    return value;
}

Value frame_value(int frame, const Place& place) {
    Value value = string_value(std::to_string(frame), place);
    value.kind = Value::Kind::kNumber;
    value.number = frame;
    return value;
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

// The kind that a variable is declared with; "${other}" has the other's.
Value::Kind declared_kind(const Value& variables, const Value* value) {
    for (std::size_t hops = 0; hops < variables.members.size(); ++hops) {
        if (!value->is(Value::Kind::kString)) return value->kind;
        const Template parsed = parse_template(value->text);
        if (!parsed.is_just_a_name()) return Value::Kind::kString;
        if (parsed.pieces[0].kind == Piece::Kind::kFrame) return Value::Kind::kNumber;
        const Value* other = variables.find(parsed.pieces[0].text);
        if (parsed.pieces[0].kind != Piece::Kind::kVariable || other == nullptr) return Value::Kind::kString;
        value = other;
    }
    return value->kind;
}

std::string declared_names(const std::vector<std::string>& names) {
    if (names.empty()) return "the graph declares no variables";
    return names.size() <= kMostListed ? "the graph declares " + listed(names) : "";
}

}  // namespace

// Replaces what stands in one value, for one frame.
class Variables::Replacer {
public:
    // `at_frame` holds what the variables that use the frame stand for, beside `variables`.
    Replacer(const Variables& variables, std::optional<int> frame, const std::vector<Value>& at_frame,
             Diagnostics& diagnostics)
        : variables_(variables), frame_(frame), at_frame_(at_frame), diagnostics_(diagnostics) {}

    Value replace(const Value& value, std::size_t depth = 0);
    bool failed() const { return failed_; }

private:
    std::optional<Value> fault(const Place& place, std::string what, std::string hint = {});
    Value replace_string(const Value& string, std::size_t depth);
    std::optional<Value> join(const std::vector<Piece>& pieces, const Place& use);
    std::optional<Value> value_of(const Piece& piece, const Place& use);
    std::optional<Value> variable(const std::string& name, const Place& use);
    std::optional<Value> environment(const std::string& name, const Place& use);
    std::string hint(const std::string& name) const;

    const Variables& variables_;
    std::optional<int> frame_;
    const std::vector<Value>& at_frame_;
    Diagnostics& diagnostics_;
    std::size_t size_ = 0;  // of what was put in so far
    bool failed_ = false;
};

Value Variables::Replacer::replace(const Value& value, std::size_t depth) {
    if (value.is(Value::Kind::kString)) return replace_string(value, depth);
    Value out = value;
    for (Value& item : out.items) item = replace(item, depth + 1);
    for (Member& member : out.members) member.value = replace(member.value, depth + 1);
    return out;
}

std::optional<Value> Variables::Replacer::fault(const Place& place, std::string what, std::string hint) {
    diagnostics_.error({ErrorKind::kGraph, place, {}, std::move(what), std::move(hint)});
    failed_ = true;
    return std::nullopt;
}

Value Variables::Replacer::replace_string(const Value& string, std::size_t depth) {
    const Template parsed = parse_template(string.text);
    if (!parsed.fault.empty()) {
        fault(string.place, parsed.fault, "a literal '${' is written as '$${'");
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
    std::optional<Value> out = string_value({}, use);
    for (const Piece& piece : pieces) {
        if (size_ > kLargest) break;
        const std::optional<Value> part =
            piece.kind == Piece::Kind::kText ? string_value(piece.text, use) : value_of(piece, use);
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
    if (!frame_) return fault(use, "'${frame}' stands for no frame here", "say which with --frames");
    return frame_value(*frame_, use);
}

std::optional<Value> Variables::Replacer::variable(const std::string& name, const Place& use) {
    const Variable* found = variables_.find(name);
    if (found == nullptr) return fault(use, fmt::format("unknown variable {}", in_quotes(name)), hint(name));
    if (found->faulty) {
        failed_ = true;
        return std::nullopt;
    }
    if (found->uses_frame && !frame_)
        return fault(
            use,
            fmt::format("the variable {} uses '${{frame}}', which stands for no frame here", in_quotes(name)),
            "say which with --frames");
    const auto i = static_cast<std::size_t>(found - variables_.variables_.data());
    Value value = found->uses_frame && !at_frame_.empty() ? at_frame_[i] : found->resolved;
    move_to(value, use);
    return value;
}

std::optional<Value> Variables::Replacer::environment(const std::string& name, const Place& use) {
    const char* value = std::getenv(name.c_str());
    if (value == nullptr)
        return fault(use, fmt::format("the environment has no variable {}", in_quotes(name)));
    return string_value(value, use);
}

std::string Variables::Replacer::hint(const std::string& name) const {
    std::vector<std::string> known = variables_.names();
    known.emplace_back("frame");
    if (std::string near = did_you_mean(name, known); !near.empty()) return near;
    if (std::getenv(name.c_str()) != nullptr)
        return fmt::format("the environment's is written as '${{env:{}}}'", name);
    return declared_names(variables_.names());
}

Variables::Variables(const Value* declared, const std::vector<std::pair<std::string, Value>>& overrides,
                     Diagnostics& diagnostics) {
    if (declared != nullptr) declare(*declared, diagnostics);
    for (const auto& [name, value] : overrides) override_one(name, value, declared, diagnostics);
    sort_by_use(diagnostics);
    for (Variable& variable : variables_) resolve(variable, diagnostics);
}

Value Variables::substitute(const Value& value, std::optional<int> frame, Diagnostics& diagnostics) const {
    std::vector<Value> at_frame;
    if (frame && uses_frame(value)) {
        at_frame.resize(variables_.size());
        for (std::size_t i = 0; i < variables_.size(); ++i)
            if (variables_[i].uses_frame && !variables_[i].faulty)
                at_frame[i] = Replacer(*this, frame, at_frame, diagnostics).replace(variables_[i].value);
    }
    return Replacer(*this, frame, at_frame, diagnostics).replace(value);
}

bool Variables::uses_frame(const Value& value) const {
    bool out = false;
    for_each_piece(value, [&](const Piece& piece) {
        const Variable* variable = piece.kind == Piece::Kind::kVariable ? find(piece.text) : nullptr;
        out = out || piece.kind == Piece::Kind::kFrame || (variable != nullptr && variable->uses_frame);
    });
    return out;
}

bool Variables::uses_faulty(const Value& value) const {
    bool out = false;
    for_each_piece(value, [&](const Piece& piece) {
        const Variable* variable = piece.kind == Piece::Kind::kVariable ? find(piece.text) : nullptr;
        out = out || (variable != nullptr && variable->faulty);
    });
    return out;
}

void Variables::declare(const Value& declared, Diagnostics& diagnostics) {
    const auto refuse = [&diagnostics](const Place& place, std::string what) {
        diagnostics.error({ErrorKind::kGraph, place, {}, std::move(what), {}});
    };
    if (!declared.is(Value::Kind::kObject))
        refuse(declared.place,
               fmt::format("'variables' must be an object, not {}", kind_name(declared.kind)));
    for (const Member& member : declared.members) {
        const std::string name = in_quotes(member.key);
        if (member.key == "frame")
            refuse(member.key_place, "a variable can't be named 'frame', which is the frame's number");
        else if (!is_name(member.key))
            refuse(member.key_place,
                   fmt::format(
                       "a variable can't be named {}: a letter or '_', then letters, digits, '_' and '-'",
                       name));
        else {
            index_.emplace(member.key, variables_.size());
            variables_.push_back({member.key, member.value});
        }
    }
}

void Variables::override_one(const std::string& name, const Value& value, const Value* declared,
                             Diagnostics& diagnostics) {
    const auto at = index_.find(name);
    if (at == index_.end()) {
        std::string hint = did_you_mean(name, names());
        if (hint.empty()) hint = declared_names(names());
        diagnostics.error({ErrorKind::kGraph, value.place, {}, "unknown variable " + in_quotes(name), hint});
        return;
    }
    const bool is_text = declared_kind(*declared, declared->find(name)) == Value::Kind::kString;
    variables_[at->second].value = is_text ? string_value(value.text, value.place) : value;
}

// Kahn's algorithm, in the order of declaration; what it leaves over is in a loop or leads to one.
void Variables::sort_by_use(Diagnostics& diagnostics) {
    const std::size_t n = variables_.size();
    std::vector<std::vector<std::size_t>> uses(n), users(n);
    std::vector<std::size_t> waiting(n), order;
    for (std::size_t i = 0; i < n; ++i) {
        for_each_piece(variables_[i].value, [&](const Piece& piece) {
            const auto used = index_.find(piece.text);
            if (piece.kind != Piece::Kind::kVariable || used == index_.end()) return;
            uses[i].push_back(used->second);
            users[used->second].push_back(i);
        });
        waiting[i] = uses[i].size();
        if (waiting[i] == 0) order.push_back(i);
    }
    for (std::size_t next = 0; next < order.size(); ++next)
        for (const std::size_t user : users[order[next]])
            if (--waiting[user] == 0) order.push_back(user);
    for (std::size_t i = 0; i < n; ++i) {
        variables_[i].faulty = waiting[i] > 0;
        if (waiting[i] > 0) order.push_back(i);
    }
    report_loops(uses, diagnostics);
    std::vector<Variable> sorted;
    for (const std::size_t i : order) {
        index_[variables_[i].name] = sorted.size();
        sorted.push_back(std::move(variables_[i]));
    }
    variables_ = std::move(sorted);
}

// Every faulty variable uses a faulty one: whoever walks from one to the next ends in a loop.
void Variables::report_loops(const std::vector<std::vector<std::size_t>>& uses,
                             Diagnostics& diagnostics) const {
    std::vector<std::size_t> walked_from(variables_.size(), variables_.size());
    for (std::size_t start = 0; start < variables_.size(); ++start) {
        if (!variables_[start].faulty) continue;
        std::vector<std::size_t> path;
        std::size_t i = start;
        while (walked_from[i] == variables_.size()) {
            walked_from[i] = start;
            path.push_back(i);
            i = *std::find_if(uses[i].begin(), uses[i].end(),
                              [this](std::size_t u) { return variables_[u].faulty; });
        }
        if (walked_from[i] != start) continue;
        path.erase(path.begin(), std::find(path.begin(), path.end(), i));
        std::string chain;
        for (std::size_t k = 0; k < std::min(path.size(), kMostListed); ++k)
            chain += in_quotes(variables_[path[k]].name) + " → ";
        if (path.size() > kMostListed) chain += "… → ";
        diagnostics.error(
            {ErrorKind::kGraph,
             variables_[i].value.place,
             {},
             fmt::format("variables use each other in a loop: {}{}", chain, in_quotes(variables_[i].name)),
             {}});
    }
}

void Variables::resolve(Variable& variable, Diagnostics& diagnostics) const {
    const std::vector<Value> no_frame;
    Replacer replacer(*this, 0, no_frame, diagnostics);
    variable.uses_frame = uses_frame(variable.value);
    variable.resolved = replacer.replace(variable.value);
    variable.faulty = variable.faulty || replacer.failed();
}

const Variables::Variable* Variables::find(std::string_view name) const {
    const auto at = index_.find(name);
    return at == index_.end() ? nullptr : &variables_[at->second];
}

std::vector<std::string> Variables::names() const {
    std::vector<std::string> out;
    for (const auto& [name, at] : index_) out.push_back(name);
    return out;
}

}  // namespace keyline
