// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/lsp/analysis.h"

#include "engine/graph/group.h"
#include "engine/io/describe_image.h"
#include "engine/kit/cryptomatte.h"

#include <algorithm>
#include <set>
#include <variant>

namespace keyline::lsp {

namespace {

// A group's nodes are read where it is used; its declarations stand alone.
bool is_group_file(const Value& root) {
    return root.find("outputs") && root.find("nodes") && root.find("keyline");
}

// The files that sources read at the frame.
std::vector<std::filesystem::path> files_of(const Analysis& analysis, const std::string& id) {
    std::vector<std::filesystem::path> out;
    if (!analysis.graph) return out;
    Diagnostics ignored;  // they were told
    for (std::size_t i = 0; i < analysis.graph->nodes().size(); ++i) {
        const GraphNode& node = analysis.graph->nodes()[i];
        if (node.type->kind != NodeKind::kSource || (!id.empty() && node.id != id)) continue;
        if (const auto parsed = analysis.graph->at(static_cast<int>(i), analysis.frame, ignored))
            for (const FileName& file : parsed->files()) out.push_back(file.at(analysis.frame));
    }
    return out;
}

std::optional<ImageDescription> described(const std::filesystem::path& file) {
    try {
        return describe_image(file);
    } catch (const Failure&) {  // told by check
        return std::nullopt;
    }
}

std::string text_of(const Attribute& attribute) {
    const std::string* text = std::get_if<std::string>(&attribute.value);
    return text ? *text : "";
}

// "cryptomatte/1234567/name" and "cryptomatte/1234567/manifest".
std::vector<NamedObjects> cryptomattes_in(const Metadata& metadata) {
    std::vector<NamedObjects> out;
    for (const Attribute& a : metadata.attributes()) {
        if (!a.name.starts_with("cryptomatte/") || !a.name.ends_with("/name")) continue;
        const std::string prefix = a.name.substr(0, a.name.rfind('/'));
        NamedObjects named{text_of(a), {}};
        if (const Attribute* manifest = metadata.find(prefix + "/manifest"))
            named.objects = CryptomatteManifest::parse(text_of(*manifest)).names();
        out.push_back(std::move(named));
    }
    return out;
}

}  // namespace

Analysis analyse(const Document& document, const std::shared_ptr<Session>& session) {
    Analysis out;
    if (is_group_file(document.value())) {
        group_from(document.file(), document.value(), out.diagnostics);
        return out;
    }
    RenderOptions options;
    options.session = session;
    out.graph = Graph::of_what_is_sound(document.value(), document.folder(), {}, out.diagnostics);
    if (!out.graph) return out;
    out.frame = out.graph->first_frame().value_or(1);
    if (out.diagnostics.ok())
        out.streams = check(*out.graph, out.frame, options, out.diagnostics);
    else
        check_what_is_sound(*out.graph, out.frame, options, out.diagnostics);
    out.diagnostics.sort_by_place();
    return out;
}

std::vector<std::string> channels_of(const Analysis& analysis, const std::string& id) {
    std::vector<std::string> out;
    const int node = analysis.graph ? analysis.graph->index_of(id) : -1;
    if (analysis.streams)
        for (const NodeStream& s : analysis.streams->streams)
            if (s.node == node) out = s.stream.names();
    if (!out.empty()) return out;
    for (const auto& file : files_of(analysis, id))
        if (const auto image = described(file))
            for (const ImagePart& part : image->parts)
                for (const FileChannel& c : part.channels) out.push_back(c.name);
    if (out.empty() && node >= 0) out = analysis.graph->nodes()[static_cast<std::size_t>(node)].type->outputs;
    return out;
}

std::vector<NamedObjects> cryptomattes_of(const Analysis& analysis) {
    std::vector<NamedObjects> out;
    std::set<std::filesystem::path> seen;
    for (const auto& file : files_of(analysis, ""))
        if (seen.insert(file).second)
            if (const auto image = described(file))
                for (const ImagePart& part : image->parts)
                    for (NamedObjects& named : cryptomattes_in(part.metadata))
                        out.push_back(std::move(named));
    return out;
}

std::shared_ptr<const ColorConfig> colors_of(const Analysis& analysis, Session& session) {
    try {
        return session.colors(analysis.graph ? analysis.graph->ocio() : std::filesystem::path());
    } catch (const Failure&) {  // told by check
        return nullptr;
    }
}

}  // namespace keyline::lsp
