// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/json/value.h"

#include <string>

namespace keyline::testing {

// Judges values by a JSON Schema, knowing the keywords that Keyline's schema uses and no other: written from
// the standard (draft 2020-12) and not from the loader, so that the two can be compared.
class JsonSchema {
public:
    explicit JsonSchema(const Value& root) : root_(root) {}

    // By the whole schema, and by one of its definitions.  Throws std::logic_error for a keyword that it does
    // not know.
    bool takes(const Value& value) const { return holds(root_, value); }
    bool takes(const std::string& definition, const Value& value) const;

    // How often the whole schema, where it is followed, asks for a member that is not there.
    int missing(const Value& value) const { return missing(root_, value); }

private:
    bool holds(const Value& schema, const Value& value) const;
    int missing(const Value& schema, const Value& value) const;
    bool keyword_holds(const Value& schema, const Member& keyword, const Value& value) const;
    bool number_holds(const Member& keyword, const Value& value) const;
    bool string_holds(const Member& keyword, const Value& value) const;
    bool array_holds(const Member& keyword, const Value& value) const;
    bool object_holds(const Value& schema, const Member& keyword, const Value& value) const;
    const Value& referred(const std::string& reference) const;

    const Value& root_;
};

}  // namespace keyline::testing
