// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/error.h"
#include "engine/json/value.h"

#include <string>
#include <vector>

namespace keyline {

// A variable's value, and those that it may have; none: any.
struct Choice {
    Value value;
    std::vector<Value> choices = {};
};

// { "default": VALUE, "choices": [VALUE, …], "about": "…" }, or just a value.  What is wrong with the form is
// told.
Choice read_choice(const Value& declared, Diagnostics& diagnostics);

// What is wrong with a value that is none of the choices; "" where it is one, or any will do.
std::string choice_fault(const std::string& name, const Value& value, const std::vector<Value>& choices);

// As they are typed on a command line.
std::vector<std::string> choice_texts(const std::vector<Value>& choices);

}  // namespace keyline
