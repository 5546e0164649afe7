// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/lsp/site.h"

#include "engine/graph/group_search.h"
#include "engine/node/registry.h"

#include <algorithm>

namespace keyline::lsp {

namespace {

bool is_container(const JsonTree& tree) {
    return tree.is(JsonTree::Kind::kObject) || tree.is(JsonTree::Kind::kArray);
}

bool is_inside(const JsonTree& tree, std::size_t byte) {
    return is_container(tree) && tree.span.begin < byte &&
           (byte < tree.span.end || (!tree.is_closed && byte == tree.span.end));
}

void find(const JsonTree& container, std::size_t byte, Site& site) {
    site.container = &container;
    for (const JsonItem& item : container.items) {
        const bool in_key = !item.key.is_empty() && item.key.touches(byte);
        if (!in_key && !is_inside(item.value, byte) &&
            !(item.value.span.touches(byte) && !is_container(item.value)))
            continue;
        site.path.push_back(&item);
        if (!in_key && is_container(item.value)) return find(item.value, byte, site);
        site.item = &item;
        site.part = in_key ? Site::Part::kKey : Site::Part::kValue;
        site.token = in_key ? item.key : item.value.span;
        if (!in_key && item.value.is(JsonTree::Kind::kMissing)) site.token = {byte, byte};
        return;
    }
    site.part = container.is(JsonTree::Kind::kObject) ? Site::Part::kKey : Site::Part::kValue;
    site.token = {byte, byte};
}

const FieldInfo* field_called(const std::vector<FieldInfo>& fields, const std::string& name) {
    const auto it = std::ranges::find(fields, name, &FieldInfo::name);
    return it == fields.end() ? nullptr : &*it;
}

const TypeInfo* item_type(const TypeInfo& type, std::size_t i) {
    static const TypeInfo kNumber = TypeInfo::number({});
    switch (type.kind) {
        case TypeInfo::Kind::kPair:
        case TypeInfo::Kind::kColor: return &kNumber;
        case TypeInfo::Kind::kNumbers:
        case TypeInfo::Kind::kList: return type.items.data();
        case TypeInfo::Kind::kTuple: return i < type.items.size() ? &type.items[i] : nullptr;
        case TypeInfo::Kind::kAnyOf:
            for (const TypeInfo& choice : type.items)
                if (const TypeInfo* item = item_type(choice, i)) return item;
            return nullptr;
        default: return nullptr;
    }
}

const TypeInfo* member_type(const TypeInfo& type, const std::string& key) {
    if (type.kind == TypeInfo::Kind::kMap) return type.items.data();
    const FieldInfo* field = field_called(type.fields, key);
    return field ? &field->type : nullptr;
}

// Of what is inside of a value of a declared type.
const TypeInfo* part_type(const Document& document, const TypeInfo& type, const JsonTree& of,
                          const JsonItem& part) {
    if (!part.key.is_empty()) return member_type(type, document.string_of(part.key));
    return item_type(type, static_cast<std::size_t>(&part - of.items.data()));
}

}  // namespace

Site site_at(const Document& document, std::size_t byte) {
    Site out;
    if (is_inside(document.root(), byte)) find(document.root(), byte, out);
    return out;
}

NodeMeaning meaning_of_node(const Document& document, const JsonTree& node) {
    const JsonItem* type = document.member(node, "type");
    if (!type) return {};
    const std::string name = document.string_of(type->value.span);
    const std::filesystem::path file = group_file(name, document.folder());
    if (file.empty()) return {registry().find(name), nullptr};
    Diagnostics ignored;  // check tells them
    auto group = read_group(file, {}, ignored);
    const NodeType* declared = group ? &group->type : nullptr;
    return {declared, std::move(group)};
}

Meaning meaning_of(const Document& document, const std::vector<const JsonItem*>& path) {
    Meaning out;
    if (path.size() < 2 || document.string_of(path[0]->key) != "nodes") return out;
    out.node = path[1];
    out.of_node = meaning_of_node(document, path[1]->value);
    if (path.size() < 3 || !out.of_node.type) return out;
    out.field = field_called(out.of_node.type->fields, document.string_of(path[2]->key));
    out.type = out.field ? &out.field->type : nullptr;
    for (std::size_t i = 3; i < path.size() && out.type; ++i) {
        const bool are_keys = document.string_of(path[i]->key) == "keys" && !member_type(*out.type, "keys");
        if (!are_keys)
            out.type = part_type(document, *out.type, path[i - 1]->value, *path[i]);
        else if (i + 2 < path.size())  // [FRAME, VALUE, …]: the value is of the whole's type
            i += path[i + 2] == path[i + 1]->value.items.data() + 1 ? 2 : path.size();
    }
    return out;
}

}  // namespace keyline::lsp
