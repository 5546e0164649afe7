// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/graph/group.h"

#include "engine/base/identifier.h"
#include "engine/graph/graph_error.h"
#include "engine/graph/read_text.h"
#include "engine/json/json_reader.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace keyline {

namespace {

using Kind = Value::Kind;

constexpr double kMostVersion = 999'999'999;

const std::vector<std::string> kTypes{"number", "integer", "bool", "text", "file", "word", "pair", "color"};

// Reads what a group's file declares.
class DeclarationReader {
public:
    DeclarationReader(Group& group, Diagnostics& diagnostics) : group_(group), diagnostics_(diagnostics) {}

    void read() {
        static const std::vector<std::string> kKnown{"keyline", "version",   "about", "inputs", "parameters",
                                                     "outputs", "variables", "nodes", "$schema"};
        for (const Member& m : group_.root.members) {
            if (std::ranges::find(kKnown, m.key) == kKnown.end()) unknown_key(m, kKnown);
            if (m.key == "about" || m.key == "$schema") check_text(m, diagnostics_);
        }
        read_version();
        const Value& nodes = *group_.root.find("nodes");
        if (!nodes.is(Kind::kObject))
            refuse(nodes.place,
                   fmt::format("'nodes' is {}; it must be an object of id: node", nodes.shown()));
        if (const Value* about = group_.root.find("about")) group_.type.help = about->text;
        each("inputs", [&](const Member& m) { read_input(m); });
        each("parameters", [&](const Member& m) { read_parameter(m); });
        each("outputs", [&](const Member& m) { read_output(m); });
        if (group_.outputs.empty())
            graph_error(diagnostics_, group_.root.place, "a group gives nothing without 'outputs'",
                        "add \"outputs\": { \"out\": \"NODE\" }");
    }

private:
    void read_version() {
        const Value* given = group_.root.find("version");
        if (!given) return;
        if (const auto version = version_of_group(group_.root))
            group_.type.version = *version;
        else
            refuse(given->place,
                   fmt::format("'version' is {}; it must be a whole number from 1 on", given->shown()));
    }

    template <class Read>
    void each(const char* key, const Read& read) {
        const Value* list = group_.root.find(key);
        if (!list) return;
        if (!list->is(Kind::kObject))
            return graph_error(diagnostics_, list->place,
                               fmt::format("'{}' is {}; it must be an object", key, list->shown()));
        for (const Member& m : list->members) {
            if (is_identifier(m.key))
                read(m);
            else
                refuse(m.key_place,
                       fmt::format("{} is no name: a name is {}", in_quotes(m.key), kIdentifierForm));
        }
    }

    void refuse(const Place& place, std::string what, std::string hint = {}) {
        graph_error(diagnostics_, place, std::move(what), std::move(hint), {}, Code::kWrongValue);
    }

    // The members of a declaration; false where it is no object.
    bool check(const Member& m, const std::vector<std::string>& known) {
        if (!m.value.is(Kind::kObject)) {
            refuse(m.value.place, fmt::format("'{}' is {}; it must be an object with {}", m.key,
                                              m.value.shown(), listed(known)));
            return false;
        }
        for (const Member& part : m.value.members) {
            if (std::ranges::find(known, part.key) == known.end())
                unknown_key(part, known);
            else if (part.key == "optional" && !part.value.is(Kind::kBool))
                refuse(part.value.place,
                       fmt::format("'optional' is {}; it must be true or false", part.value.shown()));
            if (part.key == "about") check_text(part, diagnostics_);
        }
        return true;
    }

    void unknown_key(const Member& m, const std::vector<std::string>& known) {
        const std::string hint = did_you_mean(m.key, known);
        graph_error(diagnostics_, m.key_place, "unknown key " + in_quotes(m.key),
                    hint.empty() ? "known are " + listed(known) : hint, {}, Code::kUnknownKey);
    }

    static std::string text_of(const Value& declared, const char* key) {
        const Value* value = declared.find(key);
        return value ? value->text : "";
    }

    void read_input(const Member& m) {
        if (!check(m, {"about", "optional"})) return;
        const Value* optional = m.value.find("optional");
        FieldInfo field{m.key,
                        text_of(m.value, "about"),
                        TypeInfo::input(any_channels(), false),
                        {},
                        !(optional && optional->boolean)};
        group_.type.fields.push_back(std::move(field));
    }

    void read_parameter(const Member& m) {
        if (!check(m, {"type", "default", "range", "words", "about"})) return;
        FieldInfo field{m.key, text_of(m.value, "about"), type_of(m), {}, true};
        if (const Value* value = m.value.find("default")) {
            field.default_value = *value;
            field.required = false;
            const bool has_no_words = field.type.kind == TypeInfo::Kind::kWord && field.type.words.empty();
            ParamReader reader(diagnostics_, "the group " + in_quotes(group_.type.name), {});
            if (!has_no_words) validate(field.type, *value, m.key, reader);
        }
        group_.type.fields.push_back(std::move(field));
    }

    TypeInfo type_of(const Member& m) {
        const std::string type = text_of(m.value, "type");
        const Range range = range_of(m);
        if (type == "number") return TypeInfo::number(range);
        if (type == "integer") return TypeInfo::integer(range);
        if (type == "bool") return TypeInfo::boolean();
        if (type == "text") return TypeInfo::string();
        if (type == "file") return TypeInfo::file();
        if (type == "word") return TypeInfo::one_of(words_of(m));
        if (type == "pair") return TypeInfo::pair(range);
        if (type == "color") return TypeInfo::color(range);
        const Value* given = m.value.find("type");
        refuse(given ? given->place : m.key_place,
               fmt::format("the type of '{}' is {}; it must be one of {}", m.key,
                           given ? given->shown() : "missing", listed(kTypes)),
               did_you_mean(type, kTypes));
        return TypeInfo::number({});
    }

    Range range_of(const Member& m) {
        const Value* range = m.value.find("range");
        if (!range) return {};
        const bool is_pair = range->items.size() == 2 && range->items[0].is(Kind::kNumber) &&
                             range->items[1].is(Kind::kNumber) &&
                             range->items[0].number <= range->items[1].number;
        if (is_pair) return {range->items[0].number, range->items[1].number};
        refuse(range->place, fmt::format("'range' is {}; it must be [LEAST, MOST]", range->shown()));
        return {};
    }

    std::vector<TypeInfo::WordInfo> words_of(const Member& m) {
        std::vector<TypeInfo::WordInfo> out;
        if (const Value* words = m.value.find("words"))
            for (const Value& word : words->items) {
                if (!word.is(Kind::kString))
                    refuse(word.place,
                           fmt::format("a word of '{}' is {}; it must be a string", m.key, word.shown()));
                out.push_back({word.text, ""});
            }
        if (out.empty()) refuse(m.value.place, fmt::format("'{}' is a word, and has no \"words\"", m.key));
        return out;
    }

    void read_output(const Member& m) {
        if (m.value.is(Kind::kString)) {
            group_.type.outputs.push_back(m.key);
            return group_.outputs.push_back({m.key, m.value});
        }
        refuse(m.value.place,
               fmt::format("'{}' is {}; it must be \"NODE\" or \"NODE:LAYER\"", m.key, m.value.shown()));
    }

    Group& group_;
    Diagnostics& diagnostics_;
};

}  // namespace

bool Group::has_input(std::string_view name) const {
    const auto it = std::ranges::find(type.fields, name, &FieldInfo::name);
    return it != type.fields.end() && it->type.kind == TypeInfo::Kind::kInput;
}

std::optional<int> version_of_group(const Value& root) {
    const Value* version = root.find("version");
    const bool is_one = version && version->is(Kind::kNumber) && version->number >= 1 &&
                        version->number <= kMostVersion && version->number == std::floor(version->number);
    return is_one ? std::optional(static_cast<int>(version->number)) : std::nullopt;
}

std::shared_ptr<const Group> group_from(const std::filesystem::path& file, const Value& root,
                                        Diagnostics& diagnostics) {
    auto group = std::make_shared<Group>();
    group->file = file;
    group->type.name = file.stem().string();
    group->type.kind = NodeKind::kGroup;
    group->root = root;
    DeclarationReader(*group, diagnostics).read();
    return group;
}

std::shared_ptr<const Group> read_group(const std::filesystem::path& file, const Place& use,
                                        Diagnostics& diagnostics) {
    try {
        const Value root = parse_json(read_text(file, "the group"), file.string());
        if (root.is(Kind::kObject) && root.find("nodes") && root.find("keyline"))
            return group_from(file, root, diagnostics);
        graph_error(diagnostics, root.place,
                    "a group is a graph file, with 'keyline', 'nodes' and 'outputs'");
    } catch (const Failure& f) {
        Error e = f.error();
        if (e.place.file.empty()) e.place = use;
        diagnostics.error(std::move(e));
    }
    return nullptr;
}

}  // namespace keyline
