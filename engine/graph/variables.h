// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/base/error.h"
#include "engine/base/geometry.h"
#include "engine/json/value.h"
#include "engine/params/param_types.h"

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace KEYLINE_API keyline {

class Guide;
class Variables;
struct Piece;

// What a graph says of the shot that it is for.
struct Shot {
    std::optional<int> first = {}, last = {};
    std::optional<double> fps = {};
};

// What an expression may know of the node's leading input.
struct InputSizes {
    Rect display, data;
    double pixel_aspect = 1;
};

// When a value is wanted, and for what.
struct Moment {
    std::optional<int> frame = {};
    const InputSizes* sizes = nullptr;  // null: not known
};

// Where variables have their values from, each over those before it.
struct VariableSources {
    const Value* declared = nullptr;  // the graph's own `variables`; null where it has none
    std::vector<Value> files = {};    // of `include`, then of --vars
    std::vector<std::pair<std::string, Value>> options = {};  // of --var, as parse_option_value makes them
    Shot shot = {};
    // Of a group's parameters: with values of the graph that uses it, which mean what they mean there.
    const Value* given = nullptr;
    std::shared_ptr<const Variables> giver = {};
};

// The graph's variables as overridden by files and from the command line, and what ${name}, ${frame} and
// ${env:NAME} in a string, expressions and keys stand for.  $${ is a literal ${.  A variable may be an
// expression or keys; it has its value where it is used.  Immutable once made.
class Variables {
public:
    // Of several values of a name the last counts.  What is declared as a string stays one in an option: its
    // text as typed.  Faults are reported here, once, whether or not the variable is used: names, loops,
    // unknown names and missing environment in the values, values that are none of their choices, undeclared
    // options.
    Variables(const VariableSources& sources, Diagnostics& diagnostics);

    // Replaces every ${…} in the strings of `value`; keys are left alone.  A string that is just ${name}
    // becomes the variable's JSON value; ${frame} becomes a number.  Inside longer text a number stands as it
    // was written.  What comes from a variable has the place of the string that uses it, or of the --var
    // option that set it.  Faults are reported with the place of the string, which stays as it is; errors
    // carry no node.
    Value substitute(const Value& value, std::optional<int> frame, Diagnostics& diagnostics) const;

    // The same of a value of a declared type: where that allows it, expressions and keys are replaced too.
    Value evaluate(const Value& value, const TypeInfo& type, const Moment& moment,
                   Diagnostics& diagnostics) const;

    // Tells what is wrong with a value whatever the moment: the form of expressions and keys, unknown names.
    // False where something is.
    bool check(const Value& value, const TypeInfo& type, Diagnostics& diagnostics) const;

    // Whether `value` depends on the frame, through variables too; without a type it is text.
    bool uses_frame(const Value& value, const TypeInfo* type = nullptr) const;

    // Whether a value of a declared type depends on the sizes of an input.
    bool uses_sizes(const Value& value, const TypeInfo& type) const;

    // Whether `value` uses a variable whose fault the constructor reported; substitute() is silent about it
    // and leaves the string as it is.
    bool uses_faulty(const Value& value, const TypeInfo* type = nullptr) const;

    // Every variable in the order of their names, with its value as given, whose place says by whom.
    std::vector<std::pair<std::string, Value>> given() const;

    // A variable that has choices: these, and which of them it is.
    struct Chosen {
        std::string name;
        std::vector<std::string> choices;
        std::string now;
    };
    std::vector<Chosen> chosen() const;

    // Those of the graph's own that neither these values use nor a variable that they use; as declared.
    std::vector<Member> unused_by(const std::vector<const Value*>& values) const;

    const Shot& shot() const { return shot_; }

    // Whether one of the choices of some variable is `id`, or a layer of it.
    bool is_a_choice(std::string_view id) const;

private:
    struct Variable {
        std::string name;
        Value value;                      // as given last
        Value declared;                   // as given first
        std::vector<Value> choices = {};  // none: any value will do
        Place own_place = {};             // of its name in the graph itself; none: in a file of variables
        std::shared_ptr<const Variables> giver = {};  // whose the names in its value are; null: these
        bool uses_frame = false;
        bool uses_sizes = false;
        bool is_late = false;  // it is computed from one of them: known only where it is used
        bool faulty = false;
        Value resolved = {};  // for frame 0 where it uses the frame

        bool changes() const { return uses_frame || uses_sizes; }
    };
    class Replacer;

    void declare(const Value& declared, bool is_own, Diagnostics& diagnostics);
    void declare_one(const Member& member, bool is_own, Diagnostics& diagnostics);
    void override_one(const std::string& name, const Value& value, Diagnostics& diagnostics);
    Value::Kind declared_kind(const Variable& variable) const;
    bool is_choice(const Variable& variable, const Value& value, Diagnostics& diagnostics) const;
    std::vector<std::size_t> used_by(const Value& value, const Guide& guide) const;
    bool reaches_frame(const Value& value, const Guide& guide) const;
    bool reaches_sizes(const Value& value, const Guide& guide) const;
    bool reaches_faulty(const Value& value, const Guide& guide) const;
    const Variable* find(const Piece& piece) const;
    Value replaced(const Value& value, const Guide& guide, const Moment& moment,
                   Diagnostics& diagnostics) const;
    void sort_by_use(Diagnostics& diagnostics);
    void report_loops(const std::vector<std::vector<std::size_t>>& uses, Diagnostics& diagnostics) const;
    void resolve(Variable& variable, Diagnostics& diagnostics) const;
    const Variable* find(std::string_view name) const;
    std::vector<std::string> names() const;
    std::string declared_names() const;

    std::vector<Variable> variables_;  // each after those that it uses; those in loops last
    std::map<std::string, std::size_t, std::less<>> index_;
    Shot shot_;
};

}  // namespace keyline
