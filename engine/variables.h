// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/error.h"
#include "engine/value.h"

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace keyline {

// The graph's variables as overridden from the command line, and what ${name}, ${frame} and ${env:NAME} in a
// string stand for.  $${ is a literal ${.  Immutable once made.
class Variables {
public:
    // `declared` is the graph's `variables`, null where it has none.  `overrides` are the --var options, with
    // values as parse_option_value makes them; the last one of a name counts.  What the graph declares as a
    // string stays one: the option's text as typed.  Faults are reported here, once, whether or not the
    // variable is used: names, loops, unknown names and missing environment in the values, undeclared
    // overrides.
    Variables(const Value* declared, const std::vector<std::pair<std::string, Value>>& overrides,
              Diagnostics& diagnostics);

    // Replaces every ${…} in the strings of `value`; keys are left alone.  A string that is just ${name}
    // becomes the variable's JSON value; ${frame} becomes a number.  Inside longer text a number stands as it
    // was written.  What comes from a variable has the place of the string that uses it, or of the --var
    // option that set it.  Faults are reported with the place of the string, which stays as it is; errors
    // carry no node.
    Value substitute(const Value& value, std::optional<int> frame, Diagnostics& diagnostics) const;

    // Whether a string of `value` reaches ${frame}, through variables too.
    bool uses_frame(const Value& value) const;

    // Whether `value` uses a variable whose fault the constructor reported; substitute() is silent about it
    // and leaves the string as it is.
    bool uses_faulty(const Value& value) const;

private:
    struct Variable {
        std::string name;
        Value value;  // as declared or overridden
        bool uses_frame = false;
        bool faulty = false;
        Value resolved = {};  // for frame 0 where it uses the frame
    };
    class Replacer;

    void declare(const Value& declared, Diagnostics& diagnostics);
    void override_one(const std::string& name, const Value& value, const Value* declared,
                      Diagnostics& diagnostics);
    void sort_by_use(Diagnostics& diagnostics);
    void report_loops(const std::vector<std::vector<std::size_t>>& uses, Diagnostics& diagnostics) const;
    void resolve(Variable& variable, Diagnostics& diagnostics) const;
    const Variable* find(std::string_view name) const;
    std::vector<std::string> names() const;

    std::vector<Variable> variables_;  // each after those that it uses; those in loops last
    std::map<std::string, std::size_t, std::less<>> index_;
};

}  // namespace keyline
