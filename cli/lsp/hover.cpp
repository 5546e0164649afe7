// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/lsp/answers.h"
#include "cli/lsp/offers.h"
#include "cli/lsp/site.h"
#include "engine/base/print.h"
#include "engine/base/text.h"

#include <algorithm>
#include <fmt/format.h>

namespace keyline::lsp {

namespace {

constexpr std::size_t kMostChannels = 24;

// As Markdown.
class Hover {
public:
    Hover(const Known& known, std::size_t byte)
        : known_(known), document_(known.document), byte_(byte), site_(site_at(document_, byte)) {}

    std::string run() {
        if (!site_.container || !site_.item) return "null";
        const std::string text = said();
        if (text.empty()) return "null";
        JsonWriter json;
        json.begin_object().key("contents").begin_object().field("kind", "markdown").field("value", text);
        json.end_object().key("range");
        document_.text().write_range(json, site_.token);
        return json.end_object().text();
    }

private:
    std::string said() {
        const std::vector<Mention> mentions = mentions_in(document_);
        const Mention* mention = mention_at(mentions, byte_);
        if (mention && mention->of == Mention::Of::kVariable) return variable(*mention);
        if (mention) return node(mention->name);
        if (site_.path.size() == 1) return top_level();
        const Meaning meaning = meaning_of(document_, site_.path);
        if (!meaning.node) return "";
        const std::string key = site_.path.size() == 3 ? document_.string_of(site_.path[2]->key) : "";
        if (key == "type") return type(meaning);
        if (meaning.field) return parameter(meaning);
        for (const Offer& offer : keys_of_node(nullptr))
            if (offer.label == key) return fmt::format("**{}**: {}", key, offer.help);
        return "";
    }

    std::string top_level() const {
        const std::string key = document_.string_of(site_.path[0]->key);
        for (const Offer& offer : top_level_keys())
            if (offer.label == key) return fmt::format("**{}**: {}", key, offer.help);
        return "";
    }

    static std::string type(const Meaning& meaning) {
        if (!meaning.of_node.type) return "";
        const NodeType& type = *meaning.of_node.type;
        return fmt::format("**{}** ({}): {}", type.name, node_kind_name(type.kind), type.help);
    }

    std::string parameter(const Meaning& meaning) const {
        const FieldInfo& f = *meaning.field;
        std::string out = fmt::format("**{}**: {}\n\n{}", f.name, f.help, detail_of(f));
        const Value* given = value_of(meaning);
        if (given && given->is(Value::Kind::kString))
            for (const TypeInfo::WordInfo& w : f.type.words)
                if (w.word == given->text) out += fmt::format("\n\n\"{}\": {}", w.word, w.help);
        if (const std::string now = now_of(meaning, given); !now.empty())
            out += fmt::format("\n\nAt frame {}: `{}`", known_.analysis.frame, now);
        return out;
    }

    const GraphNode* graph_node(const std::string& id) const {
        const int i = known_.analysis.graph ? known_.analysis.graph->index_of(id) : -1;
        return i < 0 ? nullptr : &known_.analysis.graph->nodes()[static_cast<std::size_t>(i)];
    }

    const Value* value_of(const Meaning& meaning) const {
        const GraphNode* node = graph_node(document_.string_of(meaning.node->key));
        return node ? node->object.find(meaning.field->name) : nullptr;
    }

    // What a parameter comes to that is computed; "" for others.
    std::string now_of(const Meaning& meaning, const Value* given) const {
        const GraphNode* node = graph_node(document_.string_of(meaning.node->key));
        if (!node || !given) return "";
        const InputSizes sizes = sizes_of(*node);
        const bool knows_sizes = !sizes.display.empty();
        if (!knows_sizes && node->variables().uses_sizes(*given, meaning.field->type)) return "";
        Diagnostics faults;
        const Moment moment{known_.analysis.frame, knows_sizes ? &sizes : nullptr};
        const Value value = node->variables().evaluate(*given, meaning.field->type, moment, faults);
        return faults.ok() && value.shown() != given->shown() ? value.shown() : "";
    }

    const Stream* stream_of(const std::string& id) const {
        const int i = known_.analysis.graph ? known_.analysis.graph->index_of(id) : -1;
        if (!known_.analysis.streams) return nullptr;
        const auto& all = known_.analysis.streams->streams;
        const auto it = std::ranges::find(all, i, &NodeStream::node);
        return i < 0 || it == all.end() ? nullptr : &it->stream;
    }

    InputSizes sizes_of(const GraphNode& node) const {
        const int i = known_.analysis.graph->index_of(node.id);
        const auto input = known_.analysis.graph->leading_input(i, known_.analysis.frame);
        const Stream* stream = input ? stream_of(input->node) : nullptr;
        return stream ? InputSizes{stream->display, stream->window} : InputSizes{};
    }

    std::string node(const std::string& id) const {
        const JsonTree* nodes = document_.section("nodes");
        const JsonItem* item = nodes ? document_.member(*nodes, id) : nullptr;
        if (!item) return fmt::format("**{}**: an input of this group", escaped(id));
        const NodeMeaning meaning = meaning_of_node(document_, item->value);
        std::string out = fmt::format("**{}**", escaped(id));
        if (meaning.type) out += fmt::format(": {}. {}", meaning.type->name, meaning.type->help);
        if (const JsonItem* about = document_.member(item->value, "about"))
            out += "\n\n" + escaped(document_.string_of(about->value.span));
        if (const Stream* stream = stream_of(id)) out += "\n\n" + flow(*stream);
        return out;
    }

    // What flows there.
    std::string flow(const Stream& stream) const {
        const std::string at = fmt::format("At frame {}: ", known_.analysis.frame);
        if (stream.is_data()) return at + stream.data;
        const std::vector<std::string> names = stream.names();
        std::string channels;
        for (std::size_t i = 0; i < std::min(names.size(), kMostChannels); ++i)
            channels += (i == 0 ? "" : " ") + escaped(names[i]);
        if (names.size() > kMostChannels)
            channels += fmt::format(" and {} more", names.size() - kMostChannels);
        const std::string window =
            stream.window == stream.display ? "" : ", data " + to_string(stream.window);
        return fmt::format("{}{}{}\n\n`{}`", at, to_string(stream.display), window, channels);
    }

    std::string variable(const Mention& mention) const {
        for (const char* section : {"variables", "parameters"})
            if (const JsonTree* tree = document_.section(section))
                if (const JsonItem* item = document_.member(*tree, mention.name))
                    return fmt::format("**{}**: `{}`", mention.name, document_.of(item->value.span));
        return "";
    }

    const Known& known_;
    const Document& document_;
    std::size_t byte_;
    Site site_;
};

}  // namespace

std::string hover(const Known& known, std::size_t byte) { return Hover(known, byte).run(); }

}  // namespace keyline::lsp
