// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/graph/references.h"

#include "engine/base/error.h"
#include "engine/base/identifier.h"
#include "engine/expr/expression.h"

#include <algorithm>
#include <fmt/format.h>
#include <optional>

namespace keyline {

namespace {

std::optional<Piece> parse_reference(std::string_view name) {
    constexpr std::string_view kEnv = "env:";
    if (name == "frame") return Piece{Piece::Kind::kFrame, {}};
    if (is_identifier(name)) return Piece{Piece::Kind::kVariable, std::string(name)};
    if (!name.starts_with(kEnv) || name.size() == kEnv.size()) return std::nullopt;
    return Piece{Piece::Kind::kEnvironment, std::string(name.substr(kEnv.size()))};
}

void append_text(Template& out, std::string_view text) {
    if (out.pieces.empty() || out.pieces.back().kind != Piece::Kind::kText)
        out.pieces.push_back({Piece::Kind::kText, {}});
    out.pieces.back().text += text;
}

}  // namespace

Piece piece_of_name(const std::string& name) {
    const auto reference = parse_reference(name);
    const bool is_name = !reference || reference->kind == Piece::Kind::kVariable;
    return is_name ? Piece{Piece::Kind::kName, name} : *reference;
}

std::vector<Piece> references_in(const Value& string, bool computes) {
    if (!computes || !is_expression(string.text)) return parse_template(string.text).pieces;
    std::vector<Piece> out;
    try {
        for (const NameInExpression& n : Expression(string.text).names())
            out.push_back(piece_of_name(n.name));
    } catch (const ExpressionFault&) {  // told by whoever evaluates it
    }
    return out;
}

bool is_computed(const Value& value, const Guide& guide) {
    if (value.is(Value::Kind::kString)) return guide.computes() && is_expression(value.text);
    bool out = guide.animates() && is_animation(value);
    for_each_part(value, guide,
                  [&](const Value& part, const Guide& of_it) { out = out || is_computed(part, of_it); });
    return out;
}

Template parse_template(std::string_view text) {
    Template out;
    while (!text.empty()) {
        const std::size_t dollar = std::min(text.find('$'), text.size());
        if (dollar > 0) append_text(out, text.substr(0, dollar));
        text.remove_prefix(dollar);
        if (text.starts_with("$${")) {
            append_text(out, "${");
            text.remove_prefix(3);
        } else if (text.starts_with("${")) {
            const std::size_t close = text.find('}');
            if (close == std::string_view::npos) {
                out.fault = fmt::format("{} has no '}}'", in_quotes(text));
                return out;
            }
            auto reference = parse_reference(text.substr(2, close - 2));
            if (!reference) {
                out.fault = fmt::format("{} names no variable", in_quotes(text.substr(0, close + 1)));
                return out;
            }
            out.pieces.push_back(std::move(*reference));
            text.remove_prefix(close + 1);
        } else if (!text.empty()) {
            append_text(out, "$");
            text.remove_prefix(1);
        }
    }
    return out;
}

}  // namespace keyline
