// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/graph/group_search.h"

#include "engine/base/identifier.h"
#include "engine/base/library_place.h"
#include "engine/graph/group.h"
#include "engine/graph/other_names.h"
#include "engine/graph/read_text.h"
#include "engine/json/json_reader.h"
#include "engine/node/registry.h"

#include <algorithm>
#include <cstdlib>
#include <fmt/format.h>
#include <map>
#include <optional>

namespace keyline {

namespace fs = std::filesystem;

namespace {

bool is_there(const fs::path& file) {
    std::error_code error;
    return fs::exists(file, error);
}

// The graphs that come with Keyline: beside the library, in the build as when it is installed.
std::optional<fs::path> shipped_graphs() {
    fs::path folder = library_folder();
    for (int up = 0; up < 4; ++up, folder = folder.parent_path())
        if (fs::path graphs = folder / KEYLINE_DATA_FOLDER / "keyline" / "graphs"; is_there(graphs))
            return graphs;
    return std::nullopt;
}

std::vector<fs::path> folders_of_path() {
    std::vector<fs::path> out;
    const char* path = std::getenv("KEYLINE_PATH");
    std::string rest = path ? path : "";
    while (!rest.empty()) {
        const std::size_t colon = std::min(rest.find(':'), rest.size());
        if (colon > 0) out.emplace_back(rest.substr(0, colon));
        rest.erase(0, colon + 1);
    }
    return out;
}

std::vector<fs::path> shipped_folders() {
    const auto graphs = shipped_graphs();
    return graphs ? std::vector{*graphs / "groups"} : std::vector<fs::path>{};
}

// Where groups have names, the first before the others.
std::vector<fs::path> folders_of_names() {
    std::vector<fs::path> out = folders_of_path();
    for (fs::path& folder : shipped_folders()) out.push_back(std::move(folder));
    return out;
}

struct Name {
    std::string base;
    std::optional<int> version;  // none: the one that has the plain name

    std::string text() const { return version ? fmt::format("{}@{}", base, *version) : base; }
};

// "canny" or "canny@2"; nothing for what no group can be called.
std::optional<Name> name_of(const std::string& type) {
    const std::size_t at = std::min(type.find('@'), type.size());
    Name out{type.substr(0, at), std::nullopt};
    if (!is_identifier(out.base)) return std::nullopt;
    if (at == type.size()) return out;
    const std::string digits = type.substr(at + 1);
    const bool is_number = !digits.empty() && digits.size() < 10 && digits[0] != '0' &&
                           digits.find_first_not_of("0123456789") == std::string::npos;
    if (!is_number) return std::nullopt;
    out.version = std::stoi(digits);
    return out;
}

// What a file says of itself.
struct Heading {
    bool is_group = false;
    int version = 0;  // 0: it says none
};

// A file that can't be read counts as a group where it is asked for, so that its fault is told.
std::optional<Heading> heading_of(const fs::path& file) {
    if (!is_there(file)) return std::nullopt;
    try {
        const Value root = parse_json(read_text(file, "the group"), file.string());
        return Heading{root.find("outputs") != nullptr, version_of_group(root).value_or(0)};
    } catch (const Failure&) {
        return Heading{true, 0};
    }
}

bool is_wanted(const fs::path& file, const std::optional<int>& version) {
    const auto heading = heading_of(file);
    return heading && heading->is_group && (!version || heading->version == *version);
}

// A version has a file of its own, canny@2.json, until it is the one that has the plain name.
std::vector<std::string> file_names(const Name& name) {
    const std::string plain = name.base + ".json";
    return name.version ? std::vector{name.text() + ".json", plain} : std::vector{plain};
}

fs::path file_of_name(const Name& name) {
    for (const fs::path& folder : folders_of_names())
        for (const std::string& file : file_names(name))
            if (is_wanted(folder / file, name.version)) return folder / file;
    return {};
}

fs::path file_at(const std::string& path, const fs::path& folder) {
    if (is_there(folder / path)) return folder / path;
    for (const fs::path& f : folders_of_path())
        if (is_there(f / path)) return f / path;
    const auto graphs = shipped_graphs();
    return graphs && is_there(*graphs / path) ? *graphs / path : folder / path;
}

std::vector<NamedGroup> groups_in(const std::vector<fs::path>& folders) {
    std::map<std::string, fs::path> found;
    std::error_code error;
    for (const fs::path& folder : folders)
        for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
            const auto name = it->path().extension() == ".json" ? name_of(it->path().stem()) : std::nullopt;
            if (!name || (!name->version && registry().find(name->base))) continue;
            if (is_wanted(it->path(), name->version)) found.try_emplace(name->text(), it->path());
        }
    std::vector<NamedGroup> out;
    for (const auto& [name, file] : found) out.push_back({name, file});
    return out;
}

}  // namespace

fs::path group_file(const std::string& type, const fs::path& folder) {
    if (registry().find(type)) return {};
    if (is_group_file(type)) return file_at(type, folder);
    const auto name = name_of(type);
    return name ? file_of_name(*name) : fs::path();
}

std::vector<NamedGroup> named_groups() { return groups_in(folders_of_names()); }

std::vector<NamedGroup> shipped_groups() { return groups_in(shipped_folders()); }

std::vector<NodeType> types_of(const std::vector<NamedGroup>& groups) {
    std::vector<NodeType> out;
    for (const NamedGroup& g : groups) {
        Diagnostics faults;
        const auto group = read_group(g.file, {}, faults);
        if (!faults.ok()) continue;
        out.push_back(group->type);
        out.back().name = g.name;
    }
    return out;
}

std::string near_type(const std::string& type, const fs::path& folder) {
    const auto name = name_of(type);
    if (name && name->version) {
        const Name plain{name->base, std::nullopt};
        if (registry().find(plain.base))
            return fmt::format("'{}' is a node, which has no versions", plain.base);
        if (const fs::path file = file_of_name(plain); !file.empty()) {
            const int version = heading_of(file)->version;
            return version == 0 ? fmt::format("'{}' says no version", name->base)
                                : fmt::format("'{}' is version {}", name->base, version);
        }
    }
    if (name && is_wanted(folder / (name->base + ".json"), name->version))
        return fmt::format("for the file beside this one write \"{}.json\"", name->base);
    std::vector<std::string> known = registry().names();
    for (NamedGroup& g : named_groups()) {
        if (name && name->version) known.push_back(Name{g.name, name->version}.text());
        known.push_back(std::move(g.name));
    }
    std::string hint = own_name_of(type);
    if (hint.empty()) hint = did_you_mean(type, known);
    return hint.empty() ? "'keyline nodes' lists those there are" : hint;
}

}  // namespace keyline
