// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/lsp/offers.h"

#include "engine/base/channels.h"
#include "engine/expr/functions.h"
#include "engine/graph/group_search.h"
#include "engine/json/json_reader.h"
#include "engine/node/parts.h"
#include "engine/node/reference.h"
#include "engine/node/registry.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <map>

namespace keyline::lsp {

namespace fs = std::filesystem;

std::string detail_of(const FieldInfo& field) {
    std::string out = field.type.kind == TypeInfo::Kind::kWord ? "a word" : field.type.text();
    if (const std::string range = field.type.range_text(); !range.empty()) out += ", " + range;
    if (field.required) return out + "; required";
    if (field.default_value.is(Value::Kind::kNull)) return out;
    return fmt::format("{}; default {}", out, JsonWriter().value(field.default_value).text());
}

// The schema says what they are.
std::vector<Offer> top_level_keys() {
    static const Value schema = parse_json(schema_json(), "schema");
    std::vector<Offer> out;
    for (const Member& m : schema.find("properties")->members)
        out.push_back({m.key, OfferKind::kProperty, "", m.value.find("description")->text});
    return out;
}

std::vector<Offer> keys_of(const std::vector<FieldInfo>& fields) {
    std::vector<Offer> out;
    for (const FieldInfo& f : fields) out.push_back({f.name, OfferKind::kField, detail_of(f), f.help});
    return out;
}

std::vector<Offer> keys_of_node(const NodeType* type) {
    std::vector<Offer> out{{"type", OfferKind::kProperty, "a node type, or a group by its name or file", ""}};
    if (type) {
        const std::vector<Offer> own = keys_of(type->fields);
        out.insert(out.end(), own.begin(), own.end());
    }
    out.push_back({"about", OfferKind::kProperty, "a string", "What the node is for, in words."});
    out.push_back({"enabled", OfferKind::kProperty, "true or false",
                   "Where false, the node passes its leading input on."});
    out.push_back({"meant", OfferKind::kProperty, "a warning's code, or a list",
                   "What would be warned of, and is right so."});
    return out;
}

std::vector<Offer> mistakes() {
    std::vector<Offer> out;
    for (const Code code : all_codes())
        if (can_be_meant(code))
            out.push_back({std::string(code_name(code)), OfferKind::kValue, "what is warned of", ""});
    return out;
}

std::vector<Offer> keys_of_animation() {
    return {{"keys", OfferKind::kProperty, "[[FRAME, VALUE], …]", "The value goes from key to key."},
            {"before", OfferKind::kProperty, "\"hold\", \"loop\" or \"extend\"", "Before the first key."},
            {"after", OfferKind::kProperty, "\"hold\", \"loop\" or \"extend\"", "After the last key."},
            {"on", OfferKind::kProperty, "a whole number",
             "2 is on twos: each value is held for so many frames."}};
}

std::vector<Offer> types(const Document& document, const std::string& typed) {
    std::vector<Offer> out;
    for (const auto& [name, type] : registry().types())
        out.push_back({name, OfferKind::kClass, node_kind_name(type.kind), type.help});
    for (const NodeType& group : types_of(named_groups()))
        out.push_back({group.name, OfferKind::kClass, node_kind_name(group.kind), group.help});
    for (Offer& o : files(document.folder(), typed))
        if (o.kind == OfferKind::kFolder || (is_group_file(o.label) && o.label != document.file().filename()))
            out.push_back(std::move(o));
    return out;
}

std::vector<Offer> words(const TypeInfo& type) {
    std::vector<Offer> out;
    for (const TypeInfo::WordInfo& w : type.words) out.push_back({w.word, OfferKind::kWord, "", w.help});
    return out;
}

std::vector<Offer> truths() {
    return {{"true", OfferKind::kValue, "", "", "true"}, {"false", OfferKind::kValue, "", "", "false"}};
}

std::vector<Offer> names_in_expressions() {
    std::vector<Offer> out;
    for (const char* name : {"frame", "first", "last", "fps", "width", "height", "x", "y", "pixel_aspect",
                             "data.width", "data.height", "data.x", "data.y", "pi"})
        out.push_back({name, OfferKind::kVariable, "", ""});
    for (const std::string& name : function_names()) out.push_back({name, OfferKind::kFunction, "", ""});
    return out;
}

namespace {

// Whether an input takes a layer that has these channels.
bool fits(const Takes& takes, const std::vector<std::string>& channels) {
    const auto has = [&](const char* name) { return std::ranges::count(channels, name) > 0; };
    switch (takes.kind) {
        case Takes::Kind::kAny: return true;
        case Takes::Kind::kColour: return has("R") && has("G") && has("B");
        case Takes::Kind::kMatte: return channels.size() == 1 || has("A");
        case Takes::Kind::kNamed:
            return std::ranges::all_of(takes.names, [&](const char* name) { return !name || has(name); });
        case Takes::Kind::kData: break;
    }
    return false;
}

// What a port that takes data may pick of them.
std::vector<Offer> parts(const std::string& id, const Takes& takes) {
    std::vector<Offer> out;
    if (const DataParts* of = takes.data ? parts_of_kind(takes.data) : nullptr)
        for (const std::string& name : of->names)
            out.push_back({id + ":" + name, OfferKind::kReference, takes.data, ""});
    return out;
}

std::vector<Offer> layers(const Known& known, const std::string& id, const Takes& takes) {
    if (takes.kind == Takes::Kind::kData) return parts(id, takes);
    std::vector<Offer> out;
    std::map<std::string, std::vector<std::string>> channels;  // of each layer
    for (const std::string& name : channels_of(known.analysis, id)) {
        const ChannelName parts = split_channel(name);
        channels[std::string(parts.layer)].emplace_back(parts.base);
    }
    for (const auto& [layer, names] : channels)
        if (!layer.empty())
            out.push_back({id + ":" + layer,
                           OfferKind::kReference,
                           fmt::format("{}", fmt::join(names, " ")),
                           "",
                           {},
                           fits(takes, names)});
    for (const std::string& name : channels_of(known.analysis, id))
        out.push_back({id + ":" + name,
                       OfferKind::kReference,
                       "one channel",
                       "",
                       {},
                       fits(takes, {std::string(split_channel(name).base)})});
    return out;
}

}  // namespace

std::vector<Offer> links(const Known& known, const std::string& typed, const std::string& own,
                         const Takes& takes) {
    if (const std::size_t colon = typed.find(':'); colon != std::string::npos)
        return layers(known, typed.substr(0, colon), takes);
    std::vector<Offer> out;
    for (const char* section : {"nodes", "inputs"}) {
        const JsonTree* tree = known.document.section(section);
        if (!tree) continue;
        for (const JsonItem& item : tree->items) {
            const std::string id = known.document.string_of(item.key);
            const JsonItem* type = known.document.member(item.value, "type");
            if (id != own)
                out.push_back({id, OfferKind::kReference,
                               type ? known.document.string_of(type->value.span) : section, ""});
        }
    }
    return out;
}

namespace {

// "a.0001.exr" → "a.####.exr"; the same where no number of two digits or more stands before the extension.
std::string as_sequence(const std::string& name) {
    const std::size_t dot = name.rfind('.');
    if (dot == std::string::npos) return name;
    std::size_t begin = dot;
    while (begin > 0 && name[begin - 1] >= '0' && name[begin - 1] <= '9') --begin;
    if (dot - begin < 2) return name;
    return name.substr(0, begin) + std::string(dot - begin, '#') + name.substr(dot);
}

}  // namespace

std::vector<Offer> files(const fs::path& folder, const std::string& typed) {
    const std::string below = typed.substr(0, typed.rfind('/') + 1);
    std::map<std::string, std::size_t> files;
    std::vector<Offer> out;
    std::error_code error;
    for (fs::directory_iterator it(folder / below, error), end; !error && it != end; it.increment(error)) {
        const std::string name = it->path().filename().string();
        if (name.starts_with('.')) continue;
        if (it->is_directory(error))
            out.push_back({below + name + "/", OfferKind::kFolder, "", ""});
        else
            ++files[as_sequence(name)];
    }
    std::ranges::sort(out, {}, &Offer::label);
    for (const auto& [name, count] : files)
        out.push_back({below + name, OfferKind::kFile, count > 1 ? fmt::format("{} frames", count) : "", ""});
    return out;
}

namespace {

std::vector<Offer> listed(const std::vector<std::string>& names, const char* detail) {
    std::vector<Offer> out;
    for (const std::string& name : names) out.push_back({name, OfferKind::kValue, detail, ""});
    return out;
}

}  // namespace

std::vector<Offer> named(Naming names, const Known& known, const std::string& owner) {
    std::vector<Offer> out;
    const auto config = colors_of(known.analysis, known.session);
    switch (names) {
        case Naming::kNothing: break;
        case Naming::kColorSpace: return config ? listed(config->color_spaces(), "a colour space") : out;
        case Naming::kDisplay: return config ? listed(config->displays(), "a display") : out;
        case Naming::kView: {
            if (!config || config->displays().empty()) return out;
            return listed(config->views(owner.empty() ? config->displays().front() : owner), "a view");
        }
        case Naming::kCryptomatte:
            for (const NamedObjects& c : cryptomattes_of(known.analysis))
                out.push_back(
                    {c.cryptomatte, OfferKind::kValue, fmt::format("{} objects", c.objects.size()), ""});
            break;
        case Naming::kObject:
            for (const NamedObjects& c : cryptomattes_of(known.analysis)) {
                if (!c.cryptomatte.ends_with(owner)) continue;
                for (const std::string& object : c.objects)
                    out.push_back({object, OfferKind::kValue, "an object of " + c.cryptomatte, ""});
            }
            break;
    }
    return out;
}

}  // namespace keyline::lsp
