// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/run/provenance.h"

#include "engine/base/index.h"
#include "engine/graph/read_text.h"
#include "engine/io/describe_image.h"
#include "engine/io/file_identity.h"
#include "engine/io/other_formats.h"
#include "engine/io/output_file.h"
#include "engine/io/output_format.h"
#include "engine/io/versions.h"
#include "engine/json/json_reader.h"
#include "engine/json/json_writer.h"

#include <algorithm>
#include <compare>
#include <fmt/format.h>
#include <map>
#include <set>
#include <span>
#include <typeinfo>

namespace keyline {

namespace {

namespace fs = std::filesystem;

// Bytes that a session counts for one file's digest: of a long run it keeps the last few thousand.
constexpr std::size_t kCountedAs = 4096;

// An input as the origin tells it.
struct Input {
    int node, frame;
    std::string name;  // of the file, without its folders
    Digest content;

    friend auto operator<=>(const Input&, const Input&) = default;
};

// One output of one frame.
class OriginOf {
public:
    OriginOf(const Graph& graph, const fs::path& ocio, Session& session, const ResolvedFrame& frame,
             const Sink& sink)
        : graph_(graph), ocio_(ocio), session_(session), frame_(frame), sink_(sink) {
        find_used();
        for (const FrameInput& input : frame.inputs)
            if (used_.contains(input.node))
                inputs_.insert({input.node, input.frame, input.file.filename().string(), content_of(input)});
        uses_colours_ =
            std::ranges::any_of(frame.nodes_with_colours, [&](int n) { return used_.contains(n); });
        if (uses_colours_ && !ocio.empty()) colours_ = content_of({-1, 0, ocio, file_identity(ocio)});
    }

    Origin origin() {
        const Digest digest = digest_of_output();
        return {digest, text(digest)};
    }

private:
    // Chains may be longer than a stack is deep.
    void find_used() {
        used_.insert(sink_.node);
        for (auto it = graph_.order().rbegin(); it != graph_.order().rend(); ++it)
            if (used_.contains(*it)) used_.insert(graph_.links(*it).begin(), graph_.links(*it).end());
    }

    // Once for as long as the file stays the same.
    Digest content_of(const FrameInput& input) {
        if (!input.identity.known()) return Digester("absent").digest();
        const Digest key = Digester("content").add(input.identity).digest();
        const auto read = [&] {
            auto content = std::make_shared<Digest>(file_content(input.file));
            if (file_identity(input.file) == input.identity) return content;
            fail(ErrorKind::kInput, fmt::format("{}: changed while it was read", input.file.string()),
                 "it is still being written or copied", Passing::kUnfinished);
        };
        return *std::static_pointer_cast<const Digest>(
            session_.remember(key, typeid(Digest), kCountedAs, read));
    }

    // An image in memory is like no other.
    bool has_unknown_source() const {
        return std::ranges::any_of(frame_.ops, [&](const Op& op) {
            return op.source && used_.contains(op.node) && !op.source->digest().known();
        });
    }

    Digest digest_of_output() {
        if (has_unknown_source()) return {};
        for (const int node : graph_.order())
            if (used_.contains(node)) digests_[node] = digest_of_node(node);
        return Digester("output").add(frame_.frame).add(digests_.at(sink_.node)).digest();
    }

    // Of one whose inputs have theirs.
    Digest digest_of_node(int node) const {
        Digester digester("made");
        for (const NodeAtFrame& at : frame_.nodes) {
            if (at.node != node) continue;
            digester.add(at.frame - frame_.frame).add(digest_of(type_of(node), *at.parsed));
            for (const keyline::Input& in : at.parsed->inputs())
                digester.add(in.selector).add(digests_.at(graph_.index_of(in.node)));
        }
        for (const Input& in : inputs_)
            if (in.node == node) digester.add(in.frame - frame_.frame).add(in.name).add(in.content);
        if (frame_.nodes_with_colours.contains(node)) digester.add("colours").add(colours_);
        return digester.digest();
    }

    const NodeType& type_of(int node) const { return *graph_.nodes()[index(node)].type; }

    // One that --output made has no id.
    std::string id_of(int node) const {
        const GraphNode& n = graph_.nodes()[index(node)];
        std::string id = n.place.line == 0 ? "output" : n.id;
        while (n.place.line == 0 && graph_.index_of(id) >= 0) id += '_';
        return id;
    }

    std::string text(const Digest& digest) const {
        JsonWriter json;
        json.begin_object().field("digest", to_string(digest)).field("output", id_of(sink_.node));
        json.field("frame", frame_.frame).field("keyline", keyline_version());
        json.key("libraries").begin_object();
        for (const LibraryVersion& v : library_versions()) json.field(v.name, v.version);
        json.end_object();
        write_node_versions(json);
        if (uses_colours_)
            json.key("ocio")
                .begin_object()
                .field("config", ocio_.empty() ? "built-in" : ocio_.filename().string())
                .field("content", to_string(colours_))
                .end_object();
        write_inputs(json);
        write_graph(json);
        return json.end_object().text();
    }

    void write_node_versions(JsonWriter& json) const {
        std::map<std::string, int> versions;
        for (const int node : used_) versions[type_of(node).name] = type_of(node).version;
        json.key("nodes").begin_object();
        for (const auto& [name, version] : versions) json.field(name, version);
        json.end_object();
    }

    void write_inputs(JsonWriter& json) const {
        json.key("inputs").begin_array();
        for (const Input& in : inputs_) {
            json.begin_object().field("node", id_of(in.node)).field("file", in.name);
            json.field("content", to_string(in.content)).end_object();
        }
        json.end_array();
    }

    // As a graph file has it, with what --set and --var said, and only what this output needs.
    void write_graph(JsonWriter& json) const {
        json.key("graph").begin_object().field("keyline", 1);
        if (const auto variables = graph_.variables().given(); !variables.empty()) {
            json.key("variables").begin_object();
            for (const auto& [name, value] : variables) json.field(name, value);
            json.end_object();
        }
        json.key("nodes").begin_object();
        for (const int node : used_) {
            json.key(id_of(node)).begin_object().field("type", type_of(node).name);
            for (const Member& m : graph_.nodes()[index(node)].object.members) json.field(m.key, m.value);
            json.end_object();
        }
        json.end_object().end_object();
    }

    const Graph& graph_;
    const fs::path& ocio_;
    Session& session_;
    const ResolvedFrame& frame_;
    const Sink& sink_;
    std::set<int> used_;  // nodes that the output needs
    std::set<Input> inputs_;
    bool uses_colours_ = false;
    Digest colours_ = Digester("built-in").digest();
    std::map<int, Digest> digests_;  // by node
};

bool holds_provenance(const fs::path& output) {
    return !is_other_format(output) || extension_of(output) == "png";
}

// Nothing for another program's words.
std::optional<Value> parsed(const std::string& text, const fs::path& file) {
    try {
        return parse_json(text, file.string());
    } catch (const Failure&) {
        return std::nullopt;
    }
}

std::optional<Value> read_inside(const fs::path& file) {
    for (const ImagePart& part : describe_image(file).parts) {
        const Attribute* found = part.metadata.find(kProvenance);
        const auto* text = found ? std::get_if<std::string>(&found->value) : nullptr;
        if (text) return parsed(*text, file);
    }
    return std::nullopt;
}

// What lies beside an output: nothing where nothing does that can be read.
std::optional<Value> beside(const fs::path& file) {
    const fs::path beside = file.string() + kBeside;
    std::error_code error;
    if (!fs::is_regular_file(beside, error)) return std::nullopt;
    return parsed(read_text(beside, "the origin"), beside);
}

bool tells_of_these_bytes(const Value& beside, const fs::path& file) {
    const Value* content = beside.find("content");
    return content && content->text == to_string(file_content(file));
}

std::optional<Value> read_beside(const fs::path& file) {
    const std::optional<Value> all = beside(file);
    const Value* origin = all && tells_of_these_bytes(*all, file) ? all->find("provenance") : nullptr;
    return origin ? std::optional(*origin) : std::nullopt;
}

}  // namespace

Origin Origins::of(const ResolvedFrame& frame, const Sink& sink) const {
    return OriginOf(graph_, ocio_, *session_, frame, sink).origin();
}

void write_provenance_beside(const fs::path& output, const std::string& text) {
    if (holds_provenance(output)) return;
    OutputFile file(output.string() + kBeside);
    const std::string all =
        fmt::format("{{\"content\": \"{}\", \"provenance\": {}}}\n", to_string(file_content(output)), text);
    file.append(std::as_bytes(std::span(all)));
    file.publish();
}

std::optional<Value> read_provenance(const fs::path& file) {
    return holds_provenance(file) ? read_inside(file) : read_beside(file);
}

bool was_changed_since_made(const fs::path& file) {
    if (holds_provenance(file)) return false;
    const std::optional<Value> all = beside(file);
    return all && !tells_of_these_bytes(*all, file);
}

}  // namespace keyline
