// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/base/error.h"

namespace KEYLINE_API keyline {

// The Failure of a name that a graph gives and that is not there, thrown by who does not know which parameter
// gave it.  Whoever resolves the node finds the parameter by its value, and tells the fault at its place:
// authors of nodes need not.
class BadValue : public Failure {
public:
    BadValue(std::string value, std::string what, std::string hint, Code code = Code::kWrongValue)
        : Failure({ErrorKind::kGraph, {}, {}, std::move(what), std::move(hint), Passing::kNever, code}),
          value_(std::move(value)) {}
    const std::string& value() const { return value_; }

private:
    std::string value_;
};

}  // namespace keyline
