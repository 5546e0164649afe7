// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/node/reference.h"

#include "engine/json/json_writer.h"
#include "engine/node/registry.h"

#include <algorithm>
#include <fmt/format.h>

namespace keyline {

namespace {

// "lines" → "Lines"
std::string heading_of(std::string room) {
    if (!room.empty() && room[0] >= 'a' && room[0] <= 'z') room[0] = static_cast<char>(room[0] - 'a' + 'A');
    return room;
}

bool is_input(const TypeInfo& type) {
    const bool holds_one = type.kind == TypeInfo::Kind::kMap || type.kind == TypeInfo::Kind::kList;
    return type.kind == TypeInfo::Kind::kInput || (holds_one && is_input(type.items[0]));
}

std::string json_of(const Value& v) { return JsonWriter().value(v).text(); }

// What to say of the default; empty strings and empty collections are told as what they are in JSON.
std::string default_text(const FieldInfo& f) {
    if (f.required) return "required";
    if (f.default_value.is(Value::Kind::kNull)) return "optional";
    return "default " + json_of(f.default_value);
}

std::string type_text(const TypeInfo& type) {
    std::string out = type.kind == TypeInfo::Kind::kWord ? "a word" : type.text();
    if (const std::string range = type.range_text(); !range.empty()) out += ", " + range;
    if (type.leading) out += "; windows and metadata come from it";
    return out;
}

std::string outputs_text(const NodeType& type) {
    const bool has_none = type.kind == NodeKind::kSink || type.kind == NodeKind::kGroup;
    if (has_none || !type.gives.empty()) return "";
    if (type.kind == NodeKind::kSource) return "the file's channels";
    if (type.outputs.empty()) return "those of its input";
    std::string out;
    for (const std::string& name : type.outputs) out += (out.empty() ? "" : " ") + name;
    return out;
}

// What links to a group may ask it for.
std::string links_text(const NodeType& type) {
    if (type.kind != NodeKind::kGroup) return "";
    std::string out;
    for (const std::string& name : type.outputs)
        out +=
            out.empty() ? name + (type.outputs.size() > 1 ? ", which the id alone means" : "") : "; " + name;
    return out;
}

// What a type is: a group may have versions.
std::string kind_text(const NodeType& type) {
    const bool says_version = type.kind == NodeKind::kGroup && type.version > 1;
    return says_version ? fmt::format("group, version {}", type.version) : node_kind_name(type.kind);
}

// Breaks text at blanks so that lines stay below `width` columns, each indented.
// The first line may start further left.
std::string wrapped(std::string_view text, std::size_t indent, std::string label = "",
                    std::size_t width = 78) {
    std::string out, line = std::move(label);
    line.resize(std::max(line.size(), indent), ' ');
    while (!text.empty()) {
        const std::string_view word = text.substr(0, text.find(' '));
        if (line.size() > indent && line.size() + 1 + word.size() > width) {
            out += line + "\n";
            line.assign(indent, ' ');
        }
        if (line.size() > indent) line += ' ';
        line += word;
        text.remove_prefix(std::min(text.size(), word.size() + 1));
    }
    return out + line + "\n";
}

// For the terminal.
class TerminalText {
public:
    void node(const NodeType& type) {
        out_ += fmt::format("{} ({})\n", type.name, kind_text(type)) + wrapped(type.help, 2);
        fields("inputs", type.fields, true);
        fields("parameters", type.fields, false);
        if (const std::string outputs = outputs_text(type); !outputs.empty())
            out_ += "\nchannels\n" + wrapped(outputs, 2);
        if (const std::string links = links_text(type); !links.empty())
            out_ += "\noutputs\n" + wrapped(links, 2);
        if (!type.gives.empty()) out_ += "\ngives\n" + wrapped(type.gives + ", not pixels", 2);
    }
    const std::string& text() const { return out_; }

private:
    void fields(const char* heading, const std::vector<FieldInfo>& all, bool inputs) {
        bool any = false;
        for (const FieldInfo& f : all) {
            if (is_input(f.type) != inputs) continue;
            if (!any) out_ += fmt::format("\n{}\n", heading);
            any = true;
            field(f, 2);
        }
    }

    void field(const FieldInfo& f, std::size_t indent) {
        out_ += wrapped(fmt::format("{}: {} ({})", f.name, type_text(f.type), default_text(f)), indent);
        out_ += wrapped(f.help, indent + 4);
        details(f.type, indent + 4);
    }

    void details(const TypeInfo& type, std::size_t indent) {
        for (const TypeInfo::WordInfo& w : type.words)
            out_ += wrapped(w.help, indent + 14, fmt::format("{:{}}\"{}\" ", "", indent, w.word));
        for (const FieldInfo& f : type.fields) field(f, indent);
        for (const TypeInfo& item : type.items) details(item, indent);
    }

    std::string out_;
};

class MarkdownText {
public:
    void node(const NodeType& type) {
        out_ += fmt::format("\n### {}\n\n{} ({})\n", type.name, sentence(type.help), kind_text(type));
        if (!type.fields.empty()) out_ += "\n| name | type | default | |\n| --- | --- | --- | --- |\n";
        for (const FieldInfo& f : type.fields) row(f, "");
        if (const std::string outputs = outputs_text(type); !outputs.empty())
            out_ += fmt::format("\nChannels: {}.\n", outputs);
        if (const std::string links = links_text(type); !links.empty())
            out_ += fmt::format("\nOutputs: {}.\n", links);
        if (!type.gives.empty()) out_ += fmt::format("\nGives {}, not pixels.\n", type.gives);
    }
    void heading(const std::string& text) { out_ += fmt::format("\n## {}\n", text); }
    std::string& text() { return out_; }

private:
    // A table's cells may not hold a bare '|'.
    static std::string cell(const std::string& text) {
        std::string out;
        for (const char c : text) c == '|' ? out.append("\\|") : out.append(1, c);
        return out;
    }

    void row(const FieldInfo& f, const std::string& prefix) {
        const std::string name = prefix + f.name;
        const std::string shown = f.required ? "required"
                                  : f.default_value.is(Value::Kind::kNull)
                                      ? "–"
                                      : fmt::format("`{}`", json_of(f.default_value));
        out_ += fmt::format("| `{}` | {} | {} | {} |\n", name, cell(type_text(f.type)), shown,
                            cell(sentence(f.help) + words(f.type)));
        nested(f.type, name);
    }

    // The fields of structs inside lists, as `lights[].size`.
    void nested(const TypeInfo& type, const std::string& name) {
        for (const FieldInfo& f : type.fields) row(f, name + ".");
        for (const TypeInfo& item : type.items) nested(item, name + "[]");
    }

    static std::string words(const TypeInfo& type) {
        std::string out;
        for (const TypeInfo::WordInfo& w : type.words)
            out += fmt::format("{}`\"{}\"`{}", out.empty() ? " " : "; ", w.word,
                               w.help.empty() ? "" : ": " + w.help);
        for (const TypeInfo& item : type.items) out += words(item);
        return sentence(out);
    }

    // Authors of groups may leave out the point.
    static std::string sentence(const std::string& text) {
        return text.empty() || text.ends_with('.') ? text : text + '.';
    }

    std::string out_;
};

}  // namespace

std::string node_list_text(const std::vector<NodeType>& groups) {
    std::size_t width = 0;
    for (const auto& [name, type] : registry().types()) width = std::max(width, name.size());
    for (const NodeType& t : groups) width = std::max(width, t.name.size());
    std::string out;
    const auto line = [&](const NodeType& t) { out += fmt::format("  {:<{}}  {}\n", t.name, width, t.help); };
    for (const std::string& room : registry().rooms()) {
        out += fmt::format("{}{}\n", out.empty() ? "" : "\n", heading_of(room));
        for (const NodeType* t : registry().types_in(room)) line(*t);
    }
    if (!groups.empty()) out += "\nGroups\n";
    std::ranges::for_each(groups, line);
    return out;
}

std::string node_text(const NodeType& type) {
    TerminalText text;
    text.node(type);
    return text.text();
}

std::string reference_markdown(const std::vector<NodeType>& groups) {
    MarkdownText text;
    text.text() = "# Nodes\n\nWritten by `keyline nodes --markdown` from the nodes' own declarations.\n";
    for (const std::string& room : registry().rooms()) {
        text.heading(heading_of(room));
        for (const NodeType* t : registry().types_in(room)) text.node(*t);
    }
    if (!groups.empty()) text.heading("Groups");
    for (const NodeType& t : groups) text.node(t);
    return std::move(text.text());
}

}  // namespace keyline
