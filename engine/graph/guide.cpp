// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/graph/guide.h"

#include "engine/params/computed.h"

#include <algorithm>

namespace keyline {

namespace {

using Kind = TypeInfo::Kind;

// Of the items of a list; null: it is none.
const TypeInfo* item_type(const TypeInfo& type, std::size_t i) {
    static const TypeInfo kNumber = TypeInfo::number({});
    switch (type.kind) {
        case Kind::kPair:
        case Kind::kColor: return &kNumber;
        case Kind::kNumbers:
        case Kind::kList: return type.items.data();
        case Kind::kTuple: return i < type.items.size() ? &type.items[i] : nullptr;
        case Kind::kAnyOf:
            for (const TypeInfo& choice : type.items)
                if (const TypeInfo* item = item_type(choice, i)) return item;
            return nullptr;
        default: return nullptr;
    }
}

const TypeInfo* member_type(const TypeInfo& type, std::string_view name) {
    if (type.kind == Kind::kMap) return type.items.data();
    const auto field = std::ranges::find(type.fields, name, &FieldInfo::name);
    return type.kind == Kind::kObject && field != type.fields.end() ? &field->type : nullptr;
}

}  // namespace

bool Guide::computes() const { return is_everything_ || (type_ && takes_expressions(*type_)); }

bool Guide::animates() const { return is_everything_ || (type_ && takes_keys(*type_)); }

bool Guide::is_whole() const {
    if (!type_) return false;
    const bool is_list = type_->kind == Kind::kNumbers || type_->kind == Kind::kList;
    return type_->kind == Kind::kInteger || (is_list && type_->items[0].kind == Kind::kInteger);
}

Guide Guide::item(std::size_t i) const { return {type_ ? item_type(*type_, i) : nullptr, is_everything_}; }

Guide Guide::member(std::string_view name) const {
    return {type_ ? member_type(*type_, name) : nullptr, is_everything_};
}

}  // namespace keyline
