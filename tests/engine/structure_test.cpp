// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0

// Who may include whom, and what the program is linked with.

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

namespace keyline {
namespace {

namespace fs = std::filesystem;
using ::testing::IsEmpty;
using Strings = std::vector<std::string>;

const fs::path kRoot = KEYLINE_SOURCE_DIR;

std::string contents(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

struct Include {
    std::string from, what;  // from: relative to the root
    bool own = false;        // in quotes
    std::string text() const { return from + " includes " + what; }
};

// Of `#include "what"` or `#include <what>`, with blanks anywhere; nothing for other lines.
std::optional<Include> parse_include(std::string line) {
    std::erase_if(line, [](char c) { return c == ' ' || c == '\t'; });
    if (!line.starts_with("#include")) return {};
    const std::size_t open = line.find_first_of("\"<"), close = line.find_first_of("\">", open + 1);
    if (open == std::string::npos || close == std::string::npos) return {};
    return Include{"", line.substr(open + 1, close - open - 1), line[open] == '"'};
}

std::vector<Include> includes_below(const std::string& folder) {
    std::vector<Include> out;
    for (const auto& entry : fs::recursive_directory_iterator(kRoot / folder)) {
        const std::string extension = entry.path().extension();
        if (extension != ".h" && extension != ".cpp") continue;
        std::ifstream in(entry.path());
        for (std::string line; std::getline(in, line);)
            if (auto found = parse_include(line)) {
                found->from = fs::relative(entry.path(), kRoot);
                out.push_back(*found);
            }
    }
    EXPECT_FALSE(out.empty()) << folder;
    return out;
}

template <class Wrong>
Strings wrong_includes(const std::string& folder, const Wrong& wrong) {
    Strings out;
    for (const Include& i : includes_below(folder))
        if (wrong(i)) out.push_back(i.text());
    return out;
}

bool begins_with_any(const std::string& text, const Strings& beginnings) {
    return std::ranges::any_of(beginnings, [&](const std::string& b) { return text.starts_with(b); });
}

// <vector>, <cmath>: neither a folder nor an extension.
bool is_standard(const Include& i) { return !i.own && i.what.find_first_of("./") == std::string::npos; }

TEST(Structure, TheEngineKnowsNoNodeProgramOrTest) {
    EXPECT_THAT(wrong_includes("engine",
                               [](const Include& i) {
                                   return begins_with_any(i.what, {"nodes/", "cli/", "tests/", "bench/"});
                               }),
                IsEmpty());
}

TEST(Structure, TheProgramIncludesTheEngineAndItself) {
    EXPECT_THAT(wrong_includes("cli",
                               [](const Include& i) {
                                   return i.own && !begins_with_any(i.what, {"engine/", "cli/"});
                               }),
                IsEmpty());
}

TEST(Structure, ANodeIncludesTheEngineTheStandardLibraryAndFmt) {
    EXPECT_THAT(wrong_includes("nodes",
                               [](const Include& i) {
                                   const bool allowed = i.own ? i.what.starts_with("engine/")
                                                              : is_standard(i) || i.what.starts_with("fmt/");
                                   return !allowed;
                               }),
                IsEmpty());
}

struct Library {
    const char* name;
    Strings headers;  // how its includes begin
    Strings homes;    // where they may stand
};

const Library kLibraries[] = {
    {"nlohmann", {"nlohmann/"}, {"engine/params", "engine/graph_json", "engine/schema"}},
    {"TBB", {"tbb/", "oneapi/"}, {"engine/execute"}},
    {"Highway", {"hwy/"}, {"engine/simd/"}},
    {"OpenEXR", {"Imf", "Imath", "Iex", "openexr", "OpenEXR/"}, {"engine/io/"}},
    {"OpenColorIO", {"OpenColorIO/"}, {"engine/io/"}},
    {"OpenImageIO", {"OpenImageIO/"}, {"engine/io/image_io"}},
    {"libdeflate", {"libdeflate", "zlib"}, {"engine/io/"}},
    {"CLI11", {"CLI/"}, {"cli/"}},
};

TEST(Structure, EachLibraryHasItsPlace) {
    for (const Library& library : kLibraries)
        for (const char* folder : {"engine", "nodes", "cli"})
            EXPECT_THAT(wrong_includes(folder,
                                       [&](const Include& i) {
                                           return begins_with_any(i.what, library.headers) &&
                                                  !begins_with_any(i.from, library.homes);
                                       }),
                        IsEmpty())
                << library.name;
}

// From the ground up; a file includes none of a later line.
const std::vector<Strings> kLayers = {
    {"aligned", "error", "geometry", "image", "metadata", "value", "channels", "json_text"},
    {"file_name", "param_types", "params", "stream"},
    {"node", "node_type", "node_adaptor", "registry"},
    {"graph", "graph_json", "graph_load", "variables", "frames"},
    {"resolve"},
    {"demand"},
    {"plan", "plan_cost", "plan_memory", "plan_text"},
    {"tiles", "sweep_run", "frame_run", "execute"},
    {"render"},
};

// -1 for a file of no layer.
int layer_of(const std::string& file) {
    const fs::path path(file);
    if (path.parent_path() != "engine") return -1;
    for (std::size_t layer = 0; layer < kLayers.size(); ++layer)
        if (std::ranges::find(kLayers[layer], path.stem().string()) != kLayers[layer].end())
            return static_cast<int>(layer);
    return -1;
}

TEST(Structure, InTheEngineNothingIncludesWhatStandsOnIt) {
    EXPECT_THAT(wrong_includes("engine",
                               [](const Include& i) {
                                   const int from = layer_of(i.from), to = layer_of(i.what);
                                   return from >= 0 && to > from;
                               }),
                IsEmpty());
    for (const Strings& layer : kLayers)
        for (const std::string& name : layer)
            EXPECT_TRUE(fs::exists(kRoot / "engine" / (name + ".h")) ||
                        fs::exists(kRoot / "engine" / (name + ".cpp")))
                << name;
}

TEST(Structure, KernelsKnowPixelsAndNothingElse) {
    EXPECT_THAT(wrong_includes("engine/simd",
                               [](const Include& i) {
                                   return i.own &&
                                          !begins_with_any(
                                              i.what, {"engine/simd/", "engine/geometry.h", "engine/image.h",
                                                       "engine/aligned.h", "engine/error.h"});
                               }),
                IsEmpty());
}

TEST(Structure, EveryNodeIsInTheRegistrysList) {
    const std::string list = contents(kRoot / "nodes/CMakeLists.txt");
    for (const auto& entry : fs::directory_iterator(kRoot / "nodes")) {
        if (entry.path().extension() != ".cpp") continue;
        EXPECT_NE(list.find("\n  " + entry.path().stem().string() + "\n"), std::string::npos) << entry.path();
    }
}

// OpenImageIO brings some sixty libraries; only the module that is loaded for it may need it.
TEST(Structure, NeitherTheProgramNorTheLibraryNeedsOpenImageIO) {
    for (const char* file : {KEYLINE_PROGRAM, KEYLINE_LIBRARY}) {
        const std::string bytes = contents(file);
        EXPECT_NE(bytes.find("libstdc++.so"), std::string::npos) << file;
        EXPECT_EQ(bytes.find("libOpenImageIO"), std::string::npos) << file;
    }
    EXPECT_NE(contents(KEYLINE_IMAGE_IO).find("libOpenImageIO"), std::string::npos);
}

}  // namespace
}  // namespace keyline
