// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/params/computed.h"

#include <algorithm>

namespace keyline {

bool takes_expressions(const TypeInfo& type) {
    switch (type.kind) {
        case TypeInfo::Kind::kNumber:
        case TypeInfo::Kind::kInteger:
        case TypeInfo::Kind::kBool:
        case TypeInfo::Kind::kWord:
        case TypeInfo::Kind::kPair:
        case TypeInfo::Kind::kColor:
        case TypeInfo::Kind::kNumbers:
        case TypeInfo::Kind::kList:
        case TypeInfo::Kind::kTuple: return true;
        case TypeInfo::Kind::kAnyOf: return std::ranges::any_of(type.items, takes_expressions);
        case TypeInfo::Kind::kString:
        case TypeInfo::Kind::kFile:
        case TypeInfo::Kind::kInput:
        case TypeInfo::Kind::kMap:
        case TypeInfo::Kind::kObject: break;
    }
    return false;
}

bool takes_keys(const TypeInfo& type) {
    return takes_expressions(type) || type.kind == TypeInfo::Kind::kString ||
           type.kind == TypeInfo::Kind::kFile;
}

}  // namespace keyline
