// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/lsp/mentions.h"

#include "cli/lsp/site.h"
#include "engine/params/computed.h"

#include <algorithm>
#include <set>
#include <string_view>

namespace keyline::lsp {

namespace {

using Of = Mention::Of;

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_part(char c) { return is_letter(c) || (c >= '0' && c <= '9'); }

class Finder {
public:
    explicit Finder(const Document& document) : document_(document) {}

    std::vector<Mention> run() {
        for (const char* section : {"nodes", "inputs"}) define(section, Of::kNode);
        for (const char* section : {"variables", "parameters"}) define(section, Of::kVariable);
        for (const JsonItem& item : document_.root().items) {
            const std::string key = document_.string_of(item.key);
            if (key == "nodes")
                for (const JsonItem& node : item.value.items) of_node(node);
            else if (key == "outputs")
                for (const JsonItem& output : item.value.items) link(output.value);
            else
                everything(item.value);
        }
        std::ranges::stable_sort(out_, {}, [](const Mention& m) { return m.span.begin; });
        return std::move(out_);
    }

private:
    void define(const char* section, Of of) {
        const JsonTree* tree = document_.section(section);
        if (!tree) return;
        for (const JsonItem& item : tree->items) {
            const std::string name = document_.string_of(item.key);
            if (of == Of::kVariable) variables_.insert(name);
            add(of, inside(item.key), true);
        }
    }

    void of_node(const JsonItem& node) {
        const NodeMeaning meaning = meaning_of_node(document_, node.value);
        for (const JsonItem& item : node.value.items) {
            const std::string key = document_.string_of(item.key);
            static const std::vector<FieldInfo> kNone;
            const std::vector<FieldInfo>& fields = meaning.type ? meaning.type->fields : kNone;
            const auto field = std::ranges::find(fields, key, &FieldInfo::name);
            field == fields.end() ? everything(item.value) : typed(item.value, field->type);
        }
    }

    void typed(const JsonTree& tree, const TypeInfo& type) {
        if (type.kind == TypeInfo::Kind::kInput) return link(tree);
        const bool holds = type.kind == TypeInfo::Kind::kList || type.kind == TypeInfo::Kind::kMap;
        if (!holds || type.items[0].kind != TypeInfo::Kind::kInput) {
            if (tree.is(JsonTree::Kind::kString) && !takes_expressions(type)) return references(tree.span);
            return everything(tree);
        }
        for (const JsonItem& item : tree.items) typed(item.value, type.items[0]);
    }

    // "id" or "id:NAME".
    void link(const JsonTree& tree) {
        if (!tree.is(JsonTree::Kind::kString)) return;
        references(tree.span);
        const Span text = inside(tree.span);
        const std::string_view id = document_.of(text).substr(0, document_.of(text).find(':'));
        if (!id.empty() && id.find('$') == std::string_view::npos)
            add(Of::kNode, {text.begin, text.begin + id.size()}, false);
    }

    void everything(const JsonTree& tree) {
        if (tree.is(JsonTree::Kind::kString)) strings(tree.span);
        for (const JsonItem& item : tree.items) everything(item.value);
    }

    void strings(Span string) {
        const Span text = inside(string);
        document_.of(text).starts_with('=') ? expression(text) : references(string);
    }

    void references(Span string) {
        const std::string_view all = document_.of(string);
        for (std::size_t at = all.find("${"); at != std::string_view::npos; at = all.find("${", at + 2)) {
            const std::size_t end = all.find_first_of("}\"", at + 2);
            const bool is_literal = at > 0 && all[at - 1] == '$';
            if (end == std::string_view::npos || is_literal) continue;
            variable({string.begin + at + 2, string.begin + end});
        }
    }

    void expression(Span text) {
        const std::string_view all = document_.of(text);
        for (std::size_t i = 0; i < all.size();) {
            if (all[i] == '\'') {
                i = std::min(all.find('\'', i + 1), all.size() - 1) + 1;
            } else if (all.substr(i).starts_with("${")) {
                const std::size_t end = std::min(all.find('}', i), all.size());
                variable({text.begin + i + 2, text.begin + end});
                i = end;
            } else if (is_letter(all[i])) {
                std::size_t end = i;
                while (end < all.size() && (is_part(all[end]) || all[end] == '.')) ++end;
                variable({text.begin + i, text.begin + end});
                i = end;
            } else {
                i += is_part(all[i]) ? number_length(all.substr(i)) : 1;
            }
        }
    }

    // A digit and what hangs together with it.
    static std::size_t number_length(std::string_view text) {
        const auto end = std::ranges::find_if_not(text, is_part);
        return static_cast<std::size_t>(end - text.begin());
    }

    void variable(Span name) {
        if (variables_.contains(std::string(document_.of(name)))) add(Of::kVariable, name, false);
    }

    void add(Of of, Span span, bool is_definition) {
        out_.push_back({of, std::string(document_.of(span)), span, is_definition});
    }

    // Without quotes.
    Span inside(Span string) const {
        const std::string_view raw = document_.of(string);
        if (!raw.starts_with('"')) return string;
        return {string.begin + 1, string.end - (raw.size() > 1 && raw.ends_with('"') ? 1 : 0)};
    }

    const Document& document_;
    std::set<std::string> variables_;
    std::vector<Mention> out_;
};

}  // namespace

std::vector<Mention> mentions_in(const Document& document) { return Finder(document).run(); }

const Mention* mention_at(const std::vector<Mention>& mentions, std::size_t byte) {
    const auto it = std::ranges::find_if(mentions, [&](const Mention& m) { return m.span.touches(byte); });
    return it == mentions.end() ? nullptr : &*it;
}

}  // namespace keyline::lsp
