// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/geometry.h"
#include "engine/json/json_writer.h"

namespace keyline::cli {

inline void write_window(JsonWriter& json, const char* name, const Rect& r) {
    json.key(name).begin_object().field("x", r.x0).field("y", r.y0);
    json.field("width", r.width()).field("height", r.height()).end_object();
}

}  // namespace keyline::cli
