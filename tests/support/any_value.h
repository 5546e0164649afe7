// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tests/support/draw.h"

#include <string>
#include <vector>

namespace keyline::testing {

// JSON of a type, or nearly: with wrong values in it where `one_in` is not 0, on average one in so many.
class AnyValue {
public:
    AnyValue(Draw& draw, int one_in) : draw_(draw), one_in_(one_in) {}

    std::string of(const TypeInfo& type);
    std::string object(const std::vector<FieldInfo>& fields);

    // From now on parts of what is right are computed, one in three: a variable, an expression or keys stands
    // for a value, wherever that may be.  Inputs stay as they are.
    void compute() { computes_ = true; }

    bool draws_wrong() const { return one_in_ > 0; }

    // What the variables are that were used so far, as JSON.
    std::string variables() const { return "{" + variables_ + "}"; }

    // Adds to what stands between the braces of an object.
    static void add(std::string& members, const std::string& name, const std::string& value);

private:
    std::string right(const TypeInfo& type);
    std::string plain(const TypeInfo& type);
    std::string wrong(const TypeInfo& type);
    std::string computed(const std::string& value);
    std::string number(const Range& range);
    std::string array(int count, const Range& range);
    std::string array(const TypeInfo& item, int count);
    std::string input(const Takes& takes);

    Draw& draw_;
    int one_in_;
    bool computes_ = false;
    int used_ = 0;  // variables
    std::string variables_;
};

}  // namespace keyline::testing
