// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/common/options.h"
#include "cli/common/temporary_folder.h"
#include "cli/render/run_report.h"

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <iterator>

namespace keyline::cli {

namespace {

namespace fs = std::filesystem;

// Made by the engine in one run, whose frames are the files in turn.
constexpr const char* kGraph = R"({{ "keyline": 1, "nodes": {{
  "file":  {{ "type": "read", "file": "file.######{}" }},
  "seen":  {{ "type": "falsecolor", "in": "file" }},
  "small": {{ "type": "reformat", "in": "seen", "size": [160, 90], "filter": "box" }},
  "out":   {{ "type": "write", "in": "small", "file": "small.######.jpg", "channels": ["R", "G", "B"], "depth": "uint8" }}
}} }})";

// Of the frames that have an output of that node, at most so many, evenly.
std::vector<const FrameReport*> chosen(const RunReport& report, const std::string& node, std::size_t most) {
    std::vector<const FrameReport*> all, out;
    for (const FrameReport& f : report.frames)
        if (std::ranges::find(f.outputs, node, &Verdict::node) != f.outputs.end()) all.push_back(&f);
    const std::size_t count = std::min(all.size(), most);
    for (std::size_t i = 0; i < count; ++i) out.push_back(all[i * all.size() / count]);
    return out;
}

// Of the first output that is a picture; null where there is none.
const Verdict* first_picture(const RunReport& report) {
    for (const FrameReport& f : report.frames)
        for (const Verdict& v : f.outputs)
            if (!v.hashes.empty()) return &v;
    return nullptr;
}

std::string contents_of(const std::string& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

std::map<int, std::string> thumbnails_of(const RunReport& report, std::size_t most) {
    std::map<int, std::string> out;
    const Verdict* first = first_picture(report);
    if (!first) return out;
    const std::vector<const FrameReport*> frames = chosen(report, first->node, most);
    const std::string extension = first->file.extension().string();
    const TemporaryFolder folder;
    std::ofstream(folder / "graph.json") << fmt::format(kGraph, extension);
    for (std::size_t i = 0; i < frames.size(); ++i) {
        const auto output = std::ranges::find(frames[i]->outputs, first->node, &Verdict::node);
        fs::create_symlink(fs::absolute(output->file),
                           folder / fmt::format("file.{:06}{}", i + 1, extension));
    }
    GraphArguments arguments;
    arguments.graph = folder / "graph.json";
    arguments.frames = fmt::format("1-{}", frames.size());
    Diagnostics diagnostics;
    LoadedGraph loaded = load_graph(arguments, diagnostics);
    if (!diagnostics.ok()) fail(ErrorKind::kInternal, diagnostics.errors().front().text());
    loaded.options.provenance = false;
    loaded.options.keep_going = true;
    RenderObserver nobody;  // a file that can't be shown has no thumbnail
    render(*loaded.graph, loaded.options, nobody, std::atomic<bool>(false));
    for (std::size_t i = 0; i < frames.size(); ++i) {
        std::string small = contents_of(folder / fmt::format("small.{:06}.jpg", i + 1));
        if (!small.empty()) out[frames[i]->frame] = std::move(small);
    }
    return out;
}

}  // namespace keyline::cli
