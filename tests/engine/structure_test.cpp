// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0

// Who may include whom, and what the program is linked with.

#include <algorithm>
#include <array>
#include <cstdio>
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

// <vector>, <cmath>: neither a folder nor an extension.
bool is_standard(const Include& i) { return !i.own && i.what.find_first_of("./") == std::string::npos; }

// One row a folder: what lies in it may include the folder itself, base, and these.
struct Folder {
    std::string name;
    Strings may_include;
    Strings libraries;  // how the includes begin that no other folder has
};

// The rooms of commands differ by what they are for, not by what they stand on.
const Strings kOfCommands = {"cli/common",    "engine/json", "engine/expr", "engine/color", "engine/io",
                             "engine/params", "engine/node", "engine/kit",  "engine/look",  "engine/measure",
                             "engine/graph",  "engine/plan", "engine/run"};

const std::vector<Folder> kFolders = {
    {"engine/base", {}, {"xxhash"}},
    {"engine/json", {}, {"nlohmann/"}},
    {"engine/simd", {}, {"hwy/"}},
    {"engine/expr", {"engine/json", "engine/simd"}, {}},
    {"engine/color", {}, {"OpenColorIO/"}},
    {"engine/io",
     {"engine/simd", "engine/color", "engine/io/exr", "engine/io/helper", "engine/io/oiio"},
     {"Imf", "Imath", "Iex", "openexr", "OpenEXR/", "libdeflate", "zlib"}},
    {"engine/io/exr",
     {"engine/io", "engine/io/helper", "engine/simd"},
     {"Imf", "Imath", "Iex", "openexr", "OpenEXR/", "libdeflate", "zlib"}},
    {"engine/io/exr/helper",
     {"engine/io/exr", "engine/io/helper/server"},
     {"Imf", "Imath", "Iex", "openexr", "OpenEXR/"}},
    {"engine/io/helper", {}, {}},
    {"engine/io/helper/server", {"engine/io/helper"}, {}},
    {"engine/io/oiio", {"engine/io", "engine/io/helper"}, {}},
    {"engine/io/oiio/helper",
     {"engine/io", "engine/io/helper", "engine/io/helper/server", "engine/io/oiio"},
     {"OpenImageIO/", "libdeflate", "zlib"}},
    {"engine/params", {"engine/json", "engine/simd"}, {}},
    {"engine/node", {"engine/json", "engine/params", "engine/io"}, {}},
    {"engine/kit", {"engine/json", "engine/simd", "engine/color", "engine/params", "engine/node"}, {}},
    {"engine/look", {"engine/simd", "engine/io", "engine/params", "engine/node", "engine/kit"}, {}},
    {"engine/measure", {"engine/simd", "engine/io", "engine/params", "engine/kit"}, {}},
    {"engine/graph", {"engine/json", "engine/expr", "engine/params", "engine/node"}, {}},
    {"engine/plan", {"engine/color", "engine/io", "engine/params", "engine/node", "engine/graph"}, {}},
    {"engine/run",
     {"engine/json", "engine/simd", "engine/io", "engine/params", "engine/node", "engine/graph",
      "engine/plan"},
     {"tbb/", "oneapi/"}},
    {"nodes", {"engine/simd", "engine/io", "engine/params", "engine/node", "engine/kit"}, {}},
    {"cli/common",
     {"engine/json", "engine/color", "engine/io", "engine/params", "engine/node", "engine/graph",
      "engine/plan", "engine/run"},
     {"CLI/"}},
    {"cli/author", kOfCommands, {}},
    {"cli/graphs", kOfCommands, {}},
    {"cli/render", kOfCommands, {}},
    {"cli/farm", kOfCommands, {}},
    {"cli/look", kOfCommands, {}},
    {"cli/lsp", kOfCommands, {}},
    {"cli",
     {"cli/common", "cli/author", "cli/graphs", "cli/render", "cli/farm", "cli/look", "cli/lsp",
      "engine/color", "engine/io"},
     {"CLI/"}},
};

// nodes/lines/nms.cpp is of "nodes": its rooms are for people.  Null: of no folder.
const Folder* folder_of(const std::string& file) {
    const std::string folder = file.starts_with("nodes/") ? "nodes" : fs::path(file).parent_path().string();
    const auto it = std::ranges::find(kFolders, folder, &Folder::name);
    return it == kFolders.end() ? nullptr : &*it;
}

bool may_include_own(const Include& i) {
    const Folder *from = folder_of(i.from), *to = folder_of(i.what);
    if (!from || !to) return false;
    const bool node_includes_node = from->name == "nodes" && to == from;
    return !node_includes_node && (to == from || to->name == "engine/base" ||
                                   std::ranges::find(from->may_include, to->name) != from->may_include.end());
}

TEST(Structure, EveryFileLiesInAFolderOfTheTable) {
    for (const char* top : {"engine", "nodes", "cli"})
        for (const auto& entry : fs::recursive_directory_iterator(kRoot / top)) {
            const std::string extension = entry.path().extension(), file = fs::relative(entry.path(), kRoot);
            EXPECT_TRUE((extension != ".h" && extension != ".cpp") || folder_of(file)) << file;
        }
}

TEST(Structure, AFolderIncludesWhatTheTableLetsIt) {
    for (const char* top : {"engine", "nodes", "cli"})
        EXPECT_THAT(wrong_includes(top, [](const Include& i) { return i.own && !may_include_own(i); }),
                    IsEmpty());
}

bool is_format(const std::string& folder) { return folder == "engine/io/exr" || folder == "engine/io/oiio"; }

// The table itself: who may include whom makes no circle, so that the rooms stand on each other.  io and its
// formats are the ones that know each other: parent and children.
TEST(Structure, NoCircleIsAllowed) {
    const auto reaches = [](const auto& self, const Folder& from, const std::string& goal) -> bool {
        return std::ranges::any_of(from.may_include, [&](const std::string& name) {
            if (name == goal) return true;
            if (from.name == "engine/io" && is_format(name)) return false;
            const auto to = std::ranges::find(kFolders, name, &Folder::name);
            EXPECT_NE(to, kFolders.end()) << name;
            return to != kFolders.end() && self(self, *to, goal);
        });
    };
    for (const Folder& f : kFolders)
        EXPECT_FALSE(!is_format(f.name) && reaches(reaches, f, f.name)) << f.name;
}

TEST(Structure, EveryEngineFolderSaysWhatItIsFor) {
    for (const Folder& f : kFolders) EXPECT_TRUE(fs::exists(kRoot / f.name / "README.md")) << f.name;
}

TEST(Structure, EachLibraryHasItsPlace) {
    for (const Folder& home : kFolders)
        for (const std::string& library : home.libraries)
            for (const char* top : {"engine", "nodes", "cli"})
                EXPECT_THAT(wrong_includes(top,
                                           [&](const Include& i) {
                                               const Folder* from = folder_of(i.from);
                                               return !i.own && i.what.starts_with(library) && from &&
                                                      std::ranges::find(from->libraries, library) ==
                                                          from->libraries.end();
                                           }),
                            IsEmpty())
                    << library;
}

TEST(Structure, ANodeIncludesTheEngineTheStandardLibraryAndFmt) {
    EXPECT_THAT(wrong_includes("nodes",
                               [](const Include& i) {
                                   return !i.own && !is_standard(i) && !i.what.starts_with("fmt/");
                               }),
                IsEmpty());
}

// A header is public by opening its namespace with KEYLINE_API (base/api.h).
bool is_public(const std::string& header) {
    return header == "engine/base/api.h" ||
           contents(kRoot / header).find("namespace KEYLINE_API keyline {") != std::string::npos;
}

// Installed headers are enough to compile against, and what they declare is enough to link.
TEST(Structure, PublicHeadersNodesAndTheProgramIncludePublicHeadersOnly) {
    const auto keeps_to_the_public_ones = [](const Include& i) {
        const bool bound = i.from.starts_with("engine/") ? i.from.ends_with(".h") && is_public(i.from) : true;
        return bound && i.own && i.what.starts_with("engine/") && !is_public(i.what);
    };
    for (const char* top : {"engine", "nodes", "cli"})
        EXPECT_THAT(wrong_includes(top, keeps_to_the_public_ones), IsEmpty());
}

// The names that a shared library shows, as the linker spells them.
Strings shown_symbols(const std::string& library) {
    Strings out;
    std::FILE* const nm =
        popen(("nm -D --defined-only --format=just-symbols '" + library + "'").c_str(), "r");
    if (!nm) return out;
    std::array<char, 1 << 14> line;
    while (std::fgets(line.data(), static_cast<int>(line.size()), nm)) out.emplace_back(line.data());
    pclose(nm);
    return out;
}

TEST(Structure, TheLibraryShowsWhatPublicHeadersDeclareAndNoMore) {
#ifdef __clang__
    GTEST_SKIP() << "clang hides nothing; see engine/CMakeLists.txt";
#endif
    const Strings shown = shown_symbols(KEYLINE_LIBRARY);
    const auto names = [&](const std::string& part) {
        return std::ranges::count_if(shown,
                                     [&](const std::string& s) { return s.find(part) != std::string::npos; });
    };
    EXPECT_GT(names("7keyline5Graph4load"), 0);
    EXPECT_EQ(names("7keyline3exr"), 0) << "how OpenEXR's files are read stays at home";
    EXPECT_EQ(names("7keyline4oiio"), 0);
    EXPECT_EQ(names("7Planner"), 0);
    EXPECT_EQ(names("keyline_node_type_"), 0) << "nodes are found in the registry";
}

// OpenImageIO brings some sixty libraries; only the helper program for it may need it.
TEST(Structure, NeitherTheProgramNorTheLibraryNeedsOpenImageIO) {
    for (const char* file : {KEYLINE_PROGRAM, KEYLINE_LIBRARY}) {
        const std::string bytes = contents(file);
        EXPECT_NE(bytes.find("libstdc++.so"), std::string::npos) << file;
        EXPECT_EQ(bytes.find("libOpenImageIO"), std::string::npos) << file;
    }
    EXPECT_NE(contents(KEYLINE_PICTURE_HELPER).find("libOpenImageIO"), std::string::npos);
}

}  // namespace
}  // namespace keyline
