// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/graph/variables.h"

#include "engine/base/identifier.h"
#include "engine/graph/choices.h"
#include "engine/graph/graph_error.h"
#include "engine/graph/replacer.h"
#include "engine/json/make_value.h"

#include <algorithm>
#include <fmt/format.h>

namespace keyline {

namespace {

Guide guide_of(const TypeInfo* type) { return type ? Guide::of(*type) : Guide::text(); }

}  // namespace

Variables::Variables(const VariableSources& sources, Diagnostics& diagnostics) {
    if (sources.declared != nullptr) declare(*sources.declared, true, diagnostics);
    for (const Value& file : sources.files) declare(file, false, diagnostics);
    for (const auto& [name, value] : sources.options) override_one(name, value, diagnostics);
    shot_ = sources.shot;
    if (sources.given)
        for (const Member& m : sources.given->members)
            if (const auto at = index_.find(m.key); at != index_.end()) {
                variables_[at->second].value = m.value;
                variables_[at->second].giver = sources.giver;
            }
    sort_by_use(diagnostics);
    for (Variable& variable : variables_) resolve(variable, diagnostics);
}

Value Variables::substitute(const Value& value, std::optional<int> frame, Diagnostics& diagnostics) const {
    return replaced(value, Guide::text(), {frame}, diagnostics);
}

Value Variables::evaluate(const Value& value, const TypeInfo& type, const Moment& moment,
                          Diagnostics& diagnostics) const {
    return replaced(value, Guide::of(type), moment, diagnostics);
}

Value Variables::replaced(const Value& value, const Guide& guide, const Moment& moment,
                          Diagnostics& diagnostics) const {
    Replacer replacer(*this, moment, diagnostics);
    replacer.prepare(value, guide);
    return replacer.replace(value, guide);
}

bool Variables::check(const Value& value, const TypeInfo& type, Diagnostics& diagnostics) const {
    Replacer replacer(*this, {}, diagnostics);
    replacer.check(value, Guide::of(type));
    return !replacer.failed();
}

bool Variables::uses_frame(const Value& value, const TypeInfo* type) const {
    return reaches_frame(value, guide_of(type));
}

bool Variables::reaches_frame(const Value& value, const Guide& guide) const {
    return any_reference(value, guide, [&](const Piece& piece) {
        const Variable* variable = find(piece);
        return piece.kind == Piece::Kind::kFrame || (variable && variable->uses_frame);
    });
}

bool Variables::uses_sizes(const Value& value, const TypeInfo& type) const {
    return reaches_sizes(value, Guide::of(type));
}

bool Variables::reaches_sizes(const Value& value, const Guide& guide) const {
    return any_reference(value, guide, [&](const Piece& piece) {
        const Variable* variable = find(piece);
        return variable ? variable->uses_sizes : piece.kind == Piece::Kind::kName && is_size(piece.text);
    });
}

bool Variables::uses_faulty(const Value& value, const TypeInfo* type) const {
    return reaches_faulty(value, guide_of(type));
}

bool Variables::reaches_faulty(const Value& value, const Guide& guide) const {
    return any_reference(value, guide, [&](const Piece& piece) {
        const Variable* variable = find(piece);
        return variable && variable->faulty;
    });
}

std::vector<std::pair<std::string, Value>> Variables::given() const {
    std::vector<std::pair<std::string, Value>> out;
    for (const auto& [name, at] : index_) out.emplace_back(name, variables_[at].value);
    return out;
}

std::vector<Variables::Chosen> Variables::chosen() const {
    std::vector<Chosen> out;
    for (const Variable& v : variables_)
        if (!v.choices.empty())
            out.push_back({v.name, choice_texts(v.choices), choice_texts({v.resolved}).front()});
    return out;
}

std::vector<Member> Variables::unused_by(const std::vector<const Value*>& values) const {
    std::vector<bool> used(variables_.size(), false);
    const auto mark = [&](const Value& value) {
        for (const std::size_t i : used_by(value, Guide::everything())) used[i] = true;
    };
    for (const Value* value : values) mark(*value);
    for (std::size_t i = variables_.size(); i-- > 0;)  // each before those that it uses
        if (used[i] && !variables_[i].giver) mark(variables_[i].value);
    std::vector<Member> out;
    for (std::size_t i = 0; i < variables_.size(); ++i)
        if (!used[i] && variables_[i].own_place.line > 0)
            out.push_back({variables_[i].name, variables_[i].own_place, variables_[i].value});
    return out;
}

bool Variables::is_a_choice(std::string_view id) const {
    return std::ranges::any_of(variables_, [&](const Variable& v) {
        return std::ranges::any_of(v.choices,
                                   [&](const Value& c) { return c.text.substr(0, c.text.find(':')) == id; });
    });
}

void Variables::declare(const Value& declared, bool is_own, Diagnostics& diagnostics) {
    if (!declared.is(Value::Kind::kObject))
        graph_error(diagnostics, declared.place,
                    fmt::format("{} must be an object, not {}",
                                is_own ? "'variables'" : "a file of variables", kind_name(declared.kind)),
                    {}, {}, Code::kWrongValue);
    for (const Member& member : declared.members) declare_one(member, is_own, diagnostics);
}

void Variables::declare_one(const Member& member, bool is_own, Diagnostics& diagnostics) {
    if (member.key == "frame")
        return graph_error(diagnostics, member.key_place,
                           "a variable can't be named 'frame', which is the frame's number");
    if (!is_identifier(member.key))
        return graph_error(diagnostics, member.key_place,
                           fmt::format("a variable can't be named {}: a name is {}", in_quotes(member.key),
                                       kIdentifierForm));
    Choice choice = read_choice(member.value, diagnostics);
    const auto [at, is_new] = index_.emplace(member.key, variables_.size());
    if (is_new) variables_.push_back({member.key, choice.value, choice.value});
    Variable& variable = variables_[at->second];
    variable.value = std::move(choice.value);
    if (!choice.choices.empty()) variable.choices = std::move(choice.choices);
    if (is_own) variable.own_place = member.key_place;
}

void Variables::override_one(const std::string& name, const Value& value, Diagnostics& diagnostics) {
    const auto at = index_.find(name);
    if (at == index_.end()) {
        const std::string hint = did_you_mean(name, names());
        return graph_error(diagnostics, value.place, "unknown variable " + in_quotes(name),
                           hint.empty() ? declared_names() : hint, {}, Code::kUnknownVariable);
    }
    Variable& variable = variables_[at->second];
    const bool is_text = declared_kind(variable) == Value::Kind::kString;
    variable.value = is_text ? text_value(value.text, value.place) : value;
}

// "${other}" has the other's.
Value::Kind Variables::declared_kind(const Variable& variable) const {
    const Value* value = &variable.declared;
    for (std::size_t hops = 0; hops < variables_.size(); ++hops) {
        if (!value->is(Value::Kind::kString)) break;
        const Template parsed = parse_template(value->text);
        if (!parsed.is_just_a_name()) break;
        if (parsed.pieces[0].kind == Piece::Kind::kFrame) return Value::Kind::kNumber;
        const Variable* other =
            parsed.pieces[0].kind == Piece::Kind::kVariable ? find(parsed.pieces[0].text) : nullptr;
        if (other == nullptr) break;
        value = &other->declared;
    }
    return value->kind;
}

std::vector<std::size_t> Variables::used_by(const Value& value, const Guide& guide) const {
    std::vector<std::size_t> out;
    for_each_reference(value, guide, [&](const Piece& piece) {
        if (const Variable* used = find(piece))
            out.push_back(static_cast<std::size_t>(used - variables_.data()));
    });
    return out;
}

// Kahn's algorithm, in the order of declaration; what it leaves over is in a loop or leads to one.
void Variables::sort_by_use(Diagnostics& diagnostics) {
    const std::size_t n = variables_.size();
    std::vector<std::vector<std::size_t>> uses(n), users(n);
    std::vector<std::size_t> waiting(n), order;
    for (std::size_t i = 0; i < n; ++i) {
        if (!variables_[i].giver) uses[i] = used_by(variables_[i].value, Guide::everything());
        for (const std::size_t used : uses[i]) users[used].push_back(i);
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
        graph_error(
            diagnostics, variables_[i].value.place,
            fmt::format("variables use each other in a loop: {}{}", chain, in_quotes(variables_[i].name)), {},
            {}, Code::kCycle);
    }
}

void Variables::resolve(Variable& variable, Diagnostics& diagnostics) const {
    if (variable.giver) {
        const Variables& giver = *variable.giver;
        variable.uses_frame = giver.reaches_frame(variable.value, Guide::everything());
        variable.uses_sizes = giver.reaches_sizes(variable.value, Guide::everything());
        variable.is_late = variable.changes();
        Diagnostics told;  // where the group is used
        if (!variable.is_late)
            variable.resolved = giver.replaced(variable.value, Guide::everything(), {}, told);
        variable.faulty = !told.ok() || giver.reaches_faulty(variable.value, Guide::everything());
        return;
    }
    const Guide guide = Guide::everything();
    const std::vector<std::size_t> used = used_by(variable.value, guide);
    variable.uses_frame = reaches_frame(variable.value, guide);
    variable.uses_sizes = reaches_sizes(variable.value, guide);
    variable.is_late = variable.uses_sizes || (variable.uses_frame && is_computed(variable.value, guide)) ||
                       std::ranges::any_of(used, [&](std::size_t i) { return variables_[i].is_late; });
    Replacer replacer(*this, Moment{0}, diagnostics);
    if (variable.is_late)
        replacer.check(variable.value, guide);
    else
        variable.resolved = replacer.replace(variable.value, guide);
    variable.faulty = variable.faulty || replacer.failed() ||
                      (!variable.changes() && !is_choice(variable, variable.resolved, diagnostics));
}

bool Variables::is_choice(const Variable& variable, const Value& value, Diagnostics& diagnostics) const {
    const std::string fault = choice_fault(variable.name, value, variable.choices);
    if (!fault.empty())
        graph_error(diagnostics, variable.value.place, fault,
                    did_you_mean(value.text, choice_texts(variable.choices)), {}, Code::kWrongValue);
    return fault.empty();
}

const Variables::Variable* Variables::find(const Piece& piece) const {
    const bool is_name = piece.kind == Piece::Kind::kVariable || piece.kind == Piece::Kind::kName;
    return is_name ? find(piece.text) : nullptr;
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

std::string Variables::declared_names() const {
    if (index_.empty()) return "the graph declares no variables";
    return index_.size() <= kMostListed ? "the graph declares " + listed(names()) : "";
}

}  // namespace keyline
