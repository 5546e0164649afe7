// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/json/value.h"

#include <string>
#include <utility>

namespace keyline {

// Values that stand in no file, or at a place that is not their own.

inline Value text_value(std::string text, const Place& place = {}) {
    Value value;
    value.kind = Value::Kind::kString;
    value.text = std::move(text);
    value.place = place;
    return value;
}

inline Value number_value(double number, const Place& place = {}) {
    Value value;
    value.kind = Value::Kind::kNumber;
    value.number = number;
    value.place = place;
    return value;
}

inline Value truth_value(bool truth, const Place& place = {}) {
    Value value;
    value.kind = Value::Kind::kBool;
    value.boolean = truth;
    value.place = place;
    return value;
}

}  // namespace keyline
