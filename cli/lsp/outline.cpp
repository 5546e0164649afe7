// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/lsp/answers.h"
#include "engine/json/json_layout.h"

namespace keyline::lsp {

namespace {

// By the protocol's numbers.
constexpr int kVariable = 13, kFunction = 12, kField = 8;

class Outline {
public:
    explicit Outline(const Document& document) : document_(document) {}

    std::string run() {
        json_.begin_array();
        section("variables", kVariable);
        section("inputs", kField);
        section("parameters", kVariable);
        section("outputs", kField);
        section("nodes", kFunction);
        return json_.end_array().text();
    }

private:
    void section(const char* name, int kind) {
        const JsonTree* tree = document_.section(name);
        if (!tree) return;
        for (const JsonItem& item : tree->items) {
            if (document_.of(item.key).size() < 3) continue;  // a symbol must have a name
            json_.begin_object()
                .field("name", document_.string_of(item.key))
                .field("detail", detail(name, item));
            json_.field("kind", kind).key("range");
            document_.text().write_range(json_,
                                         {item.key.begin, std::max(item.key.end, item.value.span.end)});
            json_.key("selectionRange");
            document_.text().write_range(json_, item.key);
            json_.end_object();
        }
    }

    std::string detail(const std::string& section, const JsonItem& item) const {
        const JsonItem* type = document_.member(item.value, "type");
        return section == "nodes" && type ? document_.string_of(type->value.span) : section;
    }

    const Document& document_;
    JsonWriter json_;
};

}  // namespace

std::string symbols(const Known& known) { return Outline(known.document).run(); }

std::string formatted(const Known& known) {
    const std::string& text = known.document.text().all();
    if (known.document.fault()) return "null";
    JsonWriter json;
    json.begin_array();
    if (const std::string laid_out = json_layout(text, known.document.file().string()); laid_out != text) {
        json.begin_object().key("range");
        known.document.text().write_range(json, {0, text.size()});
        json.field("newText", laid_out).end_object();
    }
    return json.end_array().text();
}

}  // namespace keyline::lsp
