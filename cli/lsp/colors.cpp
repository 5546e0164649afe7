// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/lsp/answers.h"
#include "cli/lsp/site.h"
#include "engine/json/json_reader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <optional>

// Colours in a graph are scene-linear, or sRGB as "#rrggbb"; a swatch shows sRGB.

namespace keyline::lsp {

namespace {

using Rgb = std::array<double, 3>;

double to_srgb(double v) {
    const double c = std::clamp(v, 0.0, 1.0);
    return c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055;
}

double to_linear(double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); }

std::optional<Rgb> of_text(const std::string& text) {
    if (text.size() != 7 || text[0] != '#' ||
        text.find_first_not_of("0123456789abcdefABCDEF", 1) != std::string::npos)
        return std::nullopt;
    Rgb out;
    for (std::size_t i = 0; i < 3; ++i) out[i] = std::stoi(text.substr(1 + 2 * i, 2), nullptr, 16) / 255.0;
    return out;
}

// As a swatch shows it; nothing for what is no colour as it stands.
std::optional<Rgb> color_of(const Document& document, const JsonTree& tree) {
    if (tree.is(JsonTree::Kind::kString)) return of_text(document.string_of(tree.span));
    if (!tree.is(JsonTree::Kind::kArray) || tree.items.size() != 3) return std::nullopt;
    Rgb out;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::string word(document.of(tree.items[i].value.span));
        char* end = nullptr;
        out[i] = to_srgb(std::strtod(word.c_str(), &end));
        if (!tree.items[i].value.is(JsonTree::Kind::kWord) || *end != '\0') return std::nullopt;
    }
    return out;
}

class Swatches {
public:
    explicit Swatches(const Document& document) : document_(document) {}

    std::string run() {
        json_.begin_array();
        if (const JsonTree* nodes = document_.section("nodes"))
            for (const JsonItem& node : nodes->items) {
                const NodeMeaning meaning = meaning_of_node(document_, node.value);
                if (meaning.type) fields(meaning.type->fields, node.value);
            }
        return json_.end_array().text();
    }

private:
    void fields(const std::vector<FieldInfo>& fields, const JsonTree& object) {
        for (const FieldInfo& f : fields)
            if (const JsonItem* item = document_.member(object, f.name)) value(f.type, item->value);
    }

    void value(const TypeInfo& type, const JsonTree& tree) {
        if (type.kind == TypeInfo::Kind::kObject) return fields(type.fields, tree);
        const bool is_collection = type.kind == TypeInfo::Kind::kList || type.kind == TypeInfo::Kind::kMap;
        if (is_collection)
            for (const JsonItem& item : tree.items) value(type.items[0], item.value);
        if (type.kind == TypeInfo::Kind::kAnyOf)
            for (const TypeInfo& choice : type.items) value(choice, tree);
        if (type.kind == TypeInfo::Kind::kColor)
            if (const auto color = color_of(document_, tree)) write(*color, tree.span);
    }

    void write(const Rgb& color, Span span) {
        json_.begin_object().key("range");
        document_.text().write_range(json_, span);
        json_.key("color")
            .begin_object()
            .field("red", color[0])
            .field("green", color[1])
            .field("blue", color[2]);
        json_.field("alpha", 1).end_object().end_object();
    }

    const Document& document_;
    JsonWriter json_;
};

}  // namespace

std::string colors(const Known& known) { return Swatches(known.document).run(); }

std::string color_presentations(const Known& known, const Value& color, Span at) {
    Rgb picked{};
    const std::array<const char*, 3> names{"red", "green", "blue"};
    for (std::size_t i = 0; i < 3; ++i)
        if (const Value* v = color.find(names[i])) picked[i] = std::clamp(v->number, 0.0, 1.0);
    std::string hex = "\"#", list = "[";
    for (std::size_t i = 0; i < 3; ++i) {
        hex += fmt::format("{:02x}", static_cast<int>(std::lround(picked[i] * 255)));
        list += fmt::format("{}{}", i == 0 ? "" : ", ", std::round(to_linear(picked[i]) * 10000) / 10000);
    }
    std::array<std::string, 2> written{hex + "\"", list + "]"};
    if (known.document.of(at).starts_with('[')) std::swap(written[0], written[1]);
    JsonWriter json;
    json.begin_array();
    for (const std::string& text : written) json.begin_object().field("label", text).end_object();
    return json.end_array().text();
}

}  // namespace keyline::lsp
