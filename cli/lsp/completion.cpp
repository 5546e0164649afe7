// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/lsp/answers.h"
#include "cli/lsp/offers.h"
#include "cli/lsp/site.h"
#include "engine/json/json_reader.h"
#include "engine/node/reference.h"
#include "engine/node/registry.h"

#include <algorithm>

namespace keyline::lsp {

namespace {

std::string as_json(const std::string& text) { return JsonWriter().value(text).text(); }

// What may stand where the cursor is, and is written in place of the token that it touches.
class Completion {
public:
    Completion(const Known& known, std::size_t byte)
        : known_(known), document_(known.document), byte_(byte), site_(site_at(document_, byte)) {}

    std::string run() {
        if (site_.container) site_.part == Site::Part::kKey ? keys() : values();
        JsonWriter json;
        json.begin_object().field("isIncomplete", false).key("items").begin_array();
        for (const Offer& offer : offers_) write(json, offer);
        return json.end_array().end_object().text();
    }

private:
    // Before the cursor, without the quote.
    std::string typed() const {
        std::string_view raw = document_.of({site_.token.begin, std::max(site_.token.begin, byte_)});
        if (raw.starts_with('"')) raw.remove_prefix(1);
        return std::string(raw);
    }

    void keys() {
        std::vector<const JsonItem*> path = site_.path;
        if (site_.item) path.pop_back();
        is_key_ = true;
        if (path.empty()) return add(top_level_keys());
        const Meaning meaning = meaning_of(document_, path);
        if (meaning.node && path.size() == 2) return add(keys_of_node(meaning.of_node.type));
        if (!meaning.type) return;
        if (meaning.type->kind == TypeInfo::Kind::kObject) return add(keys_of(meaning.type->fields));
        if (meaning.type->kind == TypeInfo::Kind::kMap)
            return add(named(meaning.type->names, known_, owner_of(meaning)));
        add(keys_of_animation());
    }

    void values() {
        const std::string before = typed();
        const bool is_string = document_.of(site_.token).starts_with('"');
        const std::size_t reference = before.rfind("${");
        if (is_string && reference != std::string::npos && before.find('}', reference) == std::string::npos)
            return embed(variables(), before.substr(0, reference + 2), "}");
        std::vector<const JsonItem*> path = site_.path;
        if (path.size() == 3 && document_.string_of(path[0]->key) == "nodes" &&
            document_.string_of(path[2]->key) == "type")
            return add(types(document_, before));
        if (path.size() >= 3 && document_.string_of(path[0]->key) == "nodes" &&
            document_.string_of(path[2]->key) == "meant")
            return add(mistakes());
        if (!site_.item && site_.container->is(JsonTree::Kind::kArray)) return of_new_item(path, before);
        const Meaning meaning = meaning_of(document_, path);
        if (meaning.type) return of_type(*meaning.type, before, meaning);
        if (path.size() == 2 && document_.string_of(path[0]->key) == "outputs")
            add(links(known_, before, "", {}));
    }

    void of_new_item(const std::vector<const JsonItem*>& path, const std::string& before) {
        const Meaning meaning = meaning_of(document_, path);
        if (!meaning.type) return;
        const bool is_list =
            meaning.type->kind == TypeInfo::Kind::kList || meaning.type->kind == TypeInfo::Kind::kNumbers;
        if (is_list) of_type(meaning.type->items[0], before, meaning);
    }

    void of_type(const TypeInfo& type, const std::string& before, const Meaning& meaning) {
        if (before.starts_with('=')) return of_expression(before);
        const std::string id = meaning.node ? document_.string_of(meaning.node->key) : "";
        switch (type.kind) {
            case TypeInfo::Kind::kWord: return add(words(type));
            case TypeInfo::Kind::kBool: return add(truths());
            case TypeInfo::Kind::kInput: return add(links(known_, before, id, type.takes));
            case TypeInfo::Kind::kFile: return add(files(document_.folder(), before));
            case TypeInfo::Kind::kString: return add(named(type.names, known_, owner_of(meaning)));
            case TypeInfo::Kind::kAnyOf:
                for (const TypeInfo& choice : type.items) of_type(choice, before, meaning);
                return;
            default: return;
        }
    }

    // The display that a view is to be of, the Cryptomatte that an object is to be of; empty where the node
    // does not say.
    std::string owner_of(const Meaning& meaning) const {
        if (!meaning.node || !meaning.of_node.type || !meaning.type) return "";
        const Naming owner = meaning.type->names == Naming::kView     ? Naming::kDisplay
                             : meaning.type->names == Naming::kObject ? Naming::kCryptomatte
                                                                      : Naming::kNothing;
        for (const FieldInfo& f : meaning.of_node.type->fields)
            if (owner != Naming::kNothing && f.type.names == owner)
                if (const JsonItem* item = document_.member(meaning.node->value, f.name))
                    return document_.string_of(item->value.span);
        return "";
    }

    void of_expression(const std::string& before) {
        const auto is_part = [](char c) {
            return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '.';
        };
        std::size_t begin = before.size();
        while (begin > 0 && is_part(before[begin - 1])) --begin;
        embed(variables(), before.substr(0, begin), "");
        embed(names_in_expressions(), before.substr(0, begin), "");
    }

    std::vector<Offer> variables() const {
        std::vector<Offer> out;
        for (const char* section : {"variables", "parameters"})
            if (const JsonTree* tree = document_.section(section))
                for (const JsonItem& item : tree->items)
                    out.push_back({document_.string_of(item.key), OfferKind::kVariable,
                                   std::string(document_.of(item.value.span)), ""});
        return out;
    }

    // In a text: what stands behind the cursor, up to the quote, stays.
    void embed(const std::vector<Offer>& offers, const std::string& before, const std::string& end) {
        const std::size_t quote = document_.of(site_.token).starts_with('"') ? 1 : 0;
        at_ = {site_.token.begin + quote + before.size(), byte_};
        const bool is_ended = document_.text().all().compare(byte_, end.size(), end) == 0;
        for (Offer o : offers) {
            o.written = o.label + (is_ended ? "" : end);
            offers_.push_back(std::move(o));
        }
    }

    void add(const std::vector<Offer>& offers) {
        at_ = site_.token;
        const JsonItem* item = site_.item;
        const bool has_value =
            is_key_ && item &&
            (!item->value.is(JsonTree::Kind::kMissing) || item->value.span.begin > item->key.end);
        for (Offer o : offers) {
            if (is_key_ && is_there(o.label)) continue;
            if (o.written.empty()) o.written = as_json(o.label);
            if (is_key_ && !has_value) o.written += ": ";
            offers_.push_back(std::move(o));
        }
    }

    // A key of another member.
    bool is_there(const std::string& key) const {
        return std::ranges::any_of(site_.container->items, [&](const JsonItem& i) {
            return &i != site_.item && document_.string_of(i.key) == key;
        });
    }

    void write(JsonWriter& json, const Offer& offer) const {
        json.begin_object().field("label", offer.label).field("kind", static_cast<int>(offer.kind));
        if (!offer.detail.empty()) json.field("detail", offer.detail);
        if (!offer.help.empty()) json.field("documentation", offer.help);
        if (!offer.fits) json.field("sortText", "~" + offer.label);
        json.field("filterText", offer.written).key("textEdit").begin_object().key("range");
        document_.text().write_range(json, at_);
        json.field("newText", offer.written).end_object().end_object();
    }

    const Known& known_;
    const Document& document_;
    std::size_t byte_;
    Site site_;
    Span at_;
    bool is_key_ = false;
    std::vector<Offer> offers_;
};

}  // namespace

std::string completions(const Known& known, std::size_t byte) { return Completion(known, byte).run(); }

}  // namespace keyline::lsp
