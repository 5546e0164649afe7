// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"

#include <string>
#include <string_view>
#include <vector>

namespace KEYLINE_API keyline {

// Where folders of another machine lie on this one: rules in the form of Open Job Description's path mapping
// ("pathmapping-1.0").  The rule with the longest source that a path lies in counts, of equal ones the first.
class PathMap {
public:
    PathMap() = default;  // changes nothing

    // The text of a rules file; `{}` holds none.  `name` stands for the file in messages.  Throws Failure
    // (kGraph) with the place for what is not in that form.
    static PathMap parse(std::string_view text, const std::string& name);

    // A path as written, with tokens for the frame or without, moved where a rule says; one that no rule is
    // about stays as it is.
    std::string map(const std::string& path) const;

private:
    struct Rule {
        bool is_windows = false;         // '\' parts names too, and capitals are like small letters
        std::vector<std::string> names;  // of the source
        std::string destination;
    };
    std::vector<Rule> rules_;  // the longest first
};

}  // namespace keyline
