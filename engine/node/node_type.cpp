// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/node/node_type.h"

#include <algorithm>

namespace keyline {

namespace {

bool is_elsewhere(const TypeInfo& type) {
    return type.kind == TypeInfo::Kind::kInput || type.kind == TypeInfo::Kind::kFile;
}

void add(Digester& digester, const Value& value, const std::vector<FieldInfo>& fields);

// How a value reads does not matter, 1 or 1.0; what it is does.
void add(Digester& digester, const Value& value, const TypeInfo& type) {
    digester.add(static_cast<int>(value.kind));
    if (is_elsewhere(type)) return;
    static const TypeInfo plain;
    const auto item_type = [&](std::size_t i) -> const TypeInfo& {
        const bool has_items = type.kind != TypeInfo::Kind::kAnyOf && !type.items.empty();
        return has_items ? type.items[std::min(i, type.items.size() - 1)] : plain;
    };
    switch (value.kind) {
        case Value::Kind::kNull: break;
        case Value::Kind::kBool: digester.add(value.boolean); break;
        case Value::Kind::kNumber: digester.add(value.number); break;
        case Value::Kind::kString: digester.add(value.text); break;
        case Value::Kind::kArray:
            digester.add(value.items.size());
            for (std::size_t i = 0; i < value.items.size(); ++i) add(digester, value.items[i], item_type(i));
            break;
        case Value::Kind::kObject:
            if (!type.fields.empty()) return add(digester, value, type.fields);
            digester.add(value.members.size());
            for (const Member& m : value.members) {
                digester.add(m.key);
                add(digester, m.value, item_type(0));
            }
            break;
    }
}

void add(Digester& digester, const Value& value, const std::vector<FieldInfo>& fields) {
    for (const FieldInfo& f : fields) {
        const Value* v = value.find(f.name);
        digester.add(f.name);
        add(digester, v ? *v : Value{}, f.type);
    }
}

}  // namespace

std::unique_ptr<const Node> NodeType::parse(const Value& object, ParamReader& reader) const {
    validate(fields, object, reader);
    return reader.failed() ? nullptr : make(fields, object, reader);
}

Digest digest_of(const NodeType& type, const Node& node) {
    Digester digester("node");
    digester.add(type.name).add(type.version);
    add(digester, node.to_value(), type.fields);
    return digester.digest();
}

const char* node_kind_name(NodeKind kind) {
    switch (kind) {
        case NodeKind::kPoint: return "point operation";
        case NodeKind::kStencil: return "stencil";
        case NodeKind::kGather: return "gather";
        case NodeKind::kDerive: return "derivation";
        case NodeKind::kSource: return "source";
        case NodeKind::kSink: return "sink";
        case NodeKind::kGroup: return "group";
        case NodeKind::kCompound: break;
    }
    return "compound";
}

}  // namespace keyline
