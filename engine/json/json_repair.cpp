// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/json/json_repair.h"

#include "engine/json/json_reader.h"
#include "engine/json/json_text.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace keyline {

namespace {

bool is_closed(std::string_view raw) { return raw.size() > 1 && raw.ends_with('"'); }

class Repair {
public:
    Repair(std::string_view text, const std::string& file) : text_(text), file_(file), cursor_(text) {}

    std::optional<Value> value(const JsonTree& tree) {
        const Place place = place_of(tree.span.begin);
        if (tree.is(JsonTree::Kind::kMissing)) return std::nullopt;
        if (tree.is(JsonTree::Kind::kWord) || tree.is(JsonTree::Kind::kString)) return leaf(tree, place);
        Value out;
        out.place = place;
        out.kind = tree.is(JsonTree::Kind::kObject) ? Value::Kind::kObject : Value::Kind::kArray;
        for (const JsonItem& item : tree.items) add(item, out);
        return out;
    }

private:
    // In the order of the text.
    Place place_of(std::size_t offset) {
        if (offset > cursor_.offset()) cursor_.advance(offset - cursor_.offset());
        return {file_, cursor_.line(), cursor_.column()};
    }

    std::optional<Value> leaf(const JsonTree& tree, const Place& place) const {
        const std::string_view raw = tree.span.of(text_);
        Value out;
        try {
            out = parse_json(
                tree.is(JsonTree::Kind::kString) && !is_closed(raw) ? std::string(raw) + '"' : raw, file_);
        } catch (const Failure&) {
            if (tree.is(JsonTree::Kind::kWord)) return std::nullopt;
            out.kind = Value::Kind::kString;
            out.text = json_string(raw);
        }
        out.place = place;
        return out;
    }

    void add(const JsonItem& item, Value& to) {
        const Place key_place = place_of(item.key.is_empty() ? item.value.span.begin : item.key.begin);
        std::optional<Value> value = this->value(item.value);
        if (!value) return;
        if (to.is(Value::Kind::kArray)) return to.items.push_back(std::move(*value));
        std::string key = json_string(item.key.of(text_));
        if (!to.find(key)) to.members.push_back({std::move(key), key_place, std::move(*value)});
    }

    std::string_view text_;
    const std::string& file_;
    TextCursor cursor_;
};

}  // namespace

Value read_what_is_whole(const JsonDocument& document, std::string_view text, const std::string& file) {
    return Repair(text, file).value(document.root).value_or(Value{});
}

bool is_torn(const JsonTree& tree, std::string_view text) {
    if (tree.is(JsonTree::Kind::kString)) return !is_closed(tree.span.of(text));
    return tree.is(JsonTree::Kind::kMissing) || !tree.is_closed ||
           std::ranges::any_of(tree.items, [&](const JsonItem& i) { return is_torn(i.value, text); });
}

std::string json_string(std::string_view raw) {
    const bool closed = is_closed(raw);
    try {
        return parse_json(closed ? std::string(raw) : std::string(raw) + '"', {}).text;
    } catch (const Failure&) {  // a word, or an escape that is none
    }
    if (raw.starts_with('"')) raw.remove_prefix(1);
    if (closed) raw.remove_suffix(1);
    return std::string(raw);
}

}  // namespace keyline
