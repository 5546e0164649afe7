// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/json/json_writer.h"
#include "engine/params/param_types.h"

#include <string>
#include <vector>

namespace keyline {

// The definitions that schema_properties() refers to, as members of an object that is open.
void write_schema_definitions(JsonWriter& json);

// The keywords of an object with these fields: which are required, what each may be, and that there are no
// others.  `own` has the properties that it has beside them, as `"name": {…}, …`.
void write_schema_of_fields(JsonWriter& json, const std::vector<FieldInfo>& fields, const Value& own = {});

// One such field, as a member of an object that is open: "name": {…}.
void write_schema_of_property(JsonWriter& json, const FieldInfo& field);

// { "const": WORD, "description": HELP } for each: an editor that offers the word shows what it means.
void write_schema_of_words(JsonWriter& json, const std::vector<TypeInfo::WordInfo>& words);

}  // namespace keyline
