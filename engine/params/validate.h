// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/params/param_types.h"

#include <filesystem>

namespace KEYLINE_API keyline {

// What relative paths are relative to: the graph's folder for what stands in the graph, the working directory
// for what was typed on the command line, unless a root was given for both.
struct PathBase {
    std::filesystem::path folder;
    bool is_root = false;

    // For what stands at `place`.
    std::filesystem::path of(const Place& place) const;
};

// Collects what is wrong with one node's object.
class ParamReader {
public:
    ParamReader(Diagnostics& diagnostics, std::string node, PathBase base);

    void error(const Place& place, std::string what, std::string hint = {}, Code code = Code::kWrongValue);
    bool failed() const { return failed_; }
    const PathBase& base() const { return base_; }

private:
    Diagnostics& diagnostics_;
    std::string node_;
    PathBase base_;
    bool failed_ = false;
};

// Tells the reader everything that is wrong with a value of the declared type; `name` is what messages call
// it.  Whoever reads a value that has passed need check nothing more.
void validate(const TypeInfo& type, const Value& value, std::string_view name, ParamReader& reader);

// The same of an object's members: each by its declaration, those that are missing, those that nobody knows.
void validate(const std::vector<FieldInfo>& fields, const Value& object, ParamReader& reader);

// Whether a value is of the right kind of JSON, and as long as it must be: which of several types is meant.
bool accepts(const TypeInfo& type, const Value& value);

}  // namespace keyline
