// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/base/code.h"
#include "engine/graph/variables.h"

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace KEYLINE_API keyline {

struct Scope;

// What stands for a group where nodes link to it.
struct GroupUse {
    struct Output {
        std::string name;
        Value link;  // to a node of the group, as written
    };
    std::shared_ptr<const Scope> inside;
    std::vector<Output> outputs;  // the first is what the id alone means
    std::string passes = {};      // its input that stands for all of them, where the group is not enabled
};

// What the names in a node mean: in the graph itself, or in one use of a group.
struct Scope {
    std::string prefix;            // of the ids of its nodes: "" in the graph itself, "outer/"
    std::filesystem::path file;    // that says it
    std::filesystem::path folder;  // what relative paths in it are relative to
    std::shared_ptr<const Variables> variables;
    const Scope* outer = nullptr;  // where the group is used, which holds this; null: the graph itself
    bool is_enabled = true;        // false: nobody sees what the group gives
    std::map<std::string, std::optional<Value>> inputs =
        {};                                       // of the group: links as written there; none: not connected
    std::map<std::string, GroupUse> groups = {};  // those used in it, by the ids that they have in it
    std::vector<Code> meant = {};                 // mistakes that are none in the group
    std::string use = {};                         // for messages: ", used at shot.json:7:5"
};

// Puts ids of the whole graph into the links of a node's object, whose variables have been replaced; links to
// what is not connected are taken out.
void make_links_whole(const Scope& scope, const std::vector<FieldInfo>& fields, int frame, Value& object);

// What a link written in a scope leads to, in ids of the whole graph; nothing: an input of the group that is
// not connected.
std::optional<std::string> whole_link(const Scope& scope, const std::string& link, int frame);

}  // namespace keyline
