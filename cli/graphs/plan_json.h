// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/json/json_writer.h"
#include "engine/plan/plan.h"

namespace keyline::cli {

// What the text of a plan says, as fields: an object.  Bytes are whole numbers; regions lie between others,
// so they are told as `info --json` tells windows.
void write_plan(JsonWriter& json, const Plan& plan);

}  // namespace keyline::cli
