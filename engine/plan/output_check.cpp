// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/plan/output_check.h"

#include "engine/base/index.h"
#include "engine/io/file_place.h"
#include "engine/io/input_check.h"
#include "engine/io/output_file.h"
#include "engine/params/frames.h"
#include "engine/plan/demand.h"
#include "engine/plan/output_names.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <optional>
#include <set>

namespace keyline {

namespace {

namespace fs = std::filesystem;

// Up to so many frames, files are looked at one by one; beyond, their folder is listed.
constexpr std::size_t kFewFrames = 256;

// The files that a frame reads pixels or data of; nodes that no sink needs read none.
std::vector<fs::path> inputs_of(const ResolvedFrame& frame) {
    const Demand demanded = demand(frame);
    std::vector<fs::path> out;
    for (std::size_t i = 0; i < frame.ops.size(); ++i) {
        const Op& op = frame.ops[i];
        if (!demanded.needs(i)) continue;
        if (op.source) out.push_back(op.source->header().file);
        if (op.derivation && !op.derivation->file().empty()) out.push_back(op.derivation->file());
    }
    return out;
}

const Node* node_of(const FrameNodes& nodes, int i) { return nodes[index(i)].get(); }

// Names that a file or a sequence may have, in one folder.
struct Names {
    FilePlace folder;
    std::string head, tail;  // before and after the frame; the whole name and nothing where it holds none
    bool has_frame = false;
};

FilePlace folder_place(const fs::path& folder) { return place_of(folder / "."); }

// Two frames that have no digit in common at their ends.
constexpr int kSample = 1'111'111'111, kOtherSample = 2'000'000'000;

bool has_frame_in_folder(const FileName& file) {
    return file.at(kSample).parent_path() != file.at(kOtherSample).parent_path();
}

Names names_of(const FileName& file) {
    const std::string one = file.at(kSample).filename().string(),
                      other = file.at(kOtherSample).filename().string();
    const FilePlace folder = folder_place(file.at(kSample).parent_path());
    const auto from_front = std::ranges::mismatch(one, other);
    if (from_front.in1 == one.end()) return {folder, one, {}, false};
    std::string head(one.begin(), from_front.in1);
    while (head.ends_with('0')) head.pop_back();  // padding beyond ten digits
    const auto from_back = std::mismatch(one.rbegin(), one.rend(), other.rbegin());
    return {folder, std::move(head), std::string(from_back.first.base(), one.end()), true};
}

// Where a link leads to.
Names names_behind(const fs::path& link) {
    const fs::path target = behind_links(link);
    return {folder_place(target.parent_path()), target.filename().string(), {}, false};
}

// Whether `longer` can be `shorter` with a frame and more after it.
bool may_begin(const Names& shorter, const Names& longer) {
    if (!longer.head.starts_with(shorter.head)) return false;
    if (longer.head.size() == shorter.head.size()) return true;
    const char next = longer.head[shorter.head.size()];
    return shorter.has_frame && (next == '-' || (next >= '0' && next <= '9'));
}

// False only where no frame of the one is called as a frame of the other.
bool may_be_equal(const Names& a, const Names& b) {
    if (a.folder != b.folder) return false;
    if (!may_begin(a, b) && !may_begin(b, a)) return false;
    const std::string_view ends_a = a.has_frame ? a.tail : a.head, ends_b = b.has_frame ? b.tail : b.head;
    return ends_a.ends_with(ends_b) || ends_b.ends_with(ends_a);
}

// The links among the files that a name stands for.
std::vector<fs::path> links_of(const FileName& file, std::span<const int> frames) {
    std::vector<fs::path> out;
    std::error_code error;
    const auto take_link = [&](const fs::path& path) {
        if (fs::is_symlink(fs::symlink_status(path, error))) out.push_back(path);
    };
    if (!file.has_frame()) {
        take_link(file.at(0));
    } else if (frames.size() <= kFewFrames) {
        for (const int frame : frames) take_link(file.at(frame));
    } else {
        const Names names = names_of(file);
        const fs::path folder = file.at(kSample).parent_path();
        for (fs::directory_iterator entry(folder.empty() ? "." : folder, error), end; !error && entry != end;
             entry.increment(error)) {
            const std::string name = entry->path().filename().string();
            if (entry->is_symlink() && name.starts_with(names.head) && name.ends_with(names.tail))
                out.push_back(entry->path());
        }
    }
    return out;
}

// Of a run's sinks or sources; nothing where they can't be told from a frame or two.
std::optional<std::vector<Names>> names_of(const std::vector<int>& nodes, const FrameNodes& first,
                                           const FrameNodes& last, std::span<const int> frames) {
    std::vector<Names> out;
    for (const int i : nodes) {
        if (!has_fixed_names(node_of(first, i), node_of(last, i))) return std::nullopt;
        for (const FileName& file : node_of(first, i)->files()) {
            if (has_frame_in_folder(file)) return std::nullopt;
            out.push_back(names_of(file));
            for (const fs::path& link : links_of(file, frames)) out.push_back(names_behind(link));
        }
    }
    return out;
}

std::vector<int> sources_of(const Graph& graph) {
    std::vector<int> out;
    for (const int i : graph.nodes_in_use())
        if (graph.nodes()[index(i)].type->kind == NodeKind::kSource) out.push_back(i);
    return out;
}

// Whether names alone leave it open that a frame reads what another writes.
bool may_meet(const Graph& graph, std::span<const int> frames) {
    Diagnostics ignored;  // told frame by frame
    const FrameNodes first = graph.at(frames.front(), ignored), last = graph.at(frames.back(), ignored);
    const auto read = names_of(sources_of(graph), first, last, frames);
    const auto written = names_of(graph.sinks(), first, last, frames);
    if (!read || !written) return true;
    return std::ranges::any_of(*read, [&](const Names& r) {
        return std::ranges::any_of(*written, [&](const Names& w) { return may_be_equal(r, w); });
    });
}

// The outputs of all frames, and the sink that makes each.
std::map<FilePlace, int> outputs_of(const Graph& graph, std::span<const int> frames) {
    std::map<FilePlace, int> out;
    const OutputNames names(graph, frames);
    for (const int frame : frames)
        for (const OutputNames::Output& output : names.at(frame))
            out.emplace(place_of(output.file), output.sink);
    return out;
}

// An output that some frame of some source has the name of, and its sink.
std::optional<std::pair<fs::path, int>> output_with_name_of_input(const Graph& graph,
                                                                  std::span<const int> frames,
                                                                  const std::map<FilePlace, int>& outputs) {
    Diagnostics ignored;
    const FrameNodes nodes = graph.at(frames.front(), ignored);
    for (const int i : sources_of(graph)) {
        if (!node_of(nodes, i)) continue;
        for (const FileName& file : node_of(nodes, i)->files()) {
            std::vector<int> candidates = file.frames_on_disk();
            candidates.insert(candidates.end(), frames.begin(), frames.end());
            for (const int frame : candidates)
                if (const auto output = outputs.find(place_of(file.at(frame))); output != outputs.end())
                    return std::pair(file.at(frame), output->second);
        }
    }
    return std::nullopt;
}

// Tells what is wrong with a sink, once each.
class SinkFaults {
public:
    SinkFaults(const Graph& graph, Diagnostics& diagnostics) : graph_(graph), diagnostics_(diagnostics) {}

    bool any() const { return !told_.empty(); }
    void refuse(int sink, std::string what) {
        if (!told_.insert(sink).second) return;
        const GraphNode& node = graph_.nodes()[index(sink)];
        diagnostics_.error({ErrorKind::kGraph, node.place, node.title(), std::move(what),
                            "write to another file", Passing::kNever, Code::kSameFile});
    }

private:
    const Graph& graph_;
    Diagnostics& diagnostics_;
    std::set<int> told_;
};

// Whether a frame reads what another writes.
void check_frames_apart(const Graph& graph, std::span<const int> frames, const ResolveOptions& options,
                        Diagnostics& diagnostics) {
    if (!may_meet(graph, frames)) return;
    const std::map<FilePlace, int> outputs = outputs_of(graph, frames);
    const auto shared = output_with_name_of_input(graph, frames, outputs);
    if (!shared) return;
    SinkFaults faults(graph, diagnostics);
    std::optional<int> unknown;
    for (const int frame : frames) {
        Diagnostics ignored;  // told when the frame's turn comes
        const auto resolved = resolve(graph, frame, options, ignored);
        if (!resolved) {
            unknown = frame;
            continue;
        }
        for (const auto& file : inputs_of(*resolved))
            if (const auto output = outputs.find(place_of(file)); output != outputs.end())
                faults.refuse(output->second, fmt::format("{} is read by frame {} of this run",
                                                          in_quotes(file.string()), frame));
    }
    // What can't be known is not risked: it may be the only copy of a plate.
    if (!faults.any() && unknown)
        faults.refuse(shared->second,
                      fmt::format("{} may be read by this run: frame {} can't be resolved to tell",
                                  in_quotes(shared->first.string()), *unknown));
}

// Several frames into one file.
void refuse_fixed_outputs(const Graph& graph, std::span<const int> frames, Diagnostics& diagnostics) {
    for (const int sink : graph.sinks()) {
        if (graph.names_frame(sink)) continue;
        const GraphNode& node = graph.nodes()[index(sink)];
        const Value* file = node.object.find("file");
        diagnostics.error(
            {ErrorKind::kGraph, file ? file->place : node.place, node.title(),
             fmt::format("frames {} would all be written to {}",
                         format_frames({frames.begin(), frames.end()}), file ? file->shown() : "one file"),
             "a run of # in the name stands for the frame, as in \"out.####.exr\"", Passing::kNever,
             Code::kOneFile});
    }
}

// Where the file of a node stands in the graph.
Place place_of_file(const Graph& graph, const std::string& title) {
    for (const GraphNode& node : graph.nodes()) {
        if (node.title() != title) continue;
        const Value* file = node.object.find("file");
        return file ? file->place : node.place;
    }
    return {};
}

}  // namespace

void check_outputs(const ResolvedFrame& frame, Diagnostics& diagnostics) {
    std::map<FilePlace, std::string> taken;  // file → who uses it
    for (const auto& file : inputs_of(frame)) taken.emplace(place_of(file), "read by this run");
    for (const Sink& sink : frame.sinks) {
        const auto [it, is_new] =
            taken.emplace(place_of(sink.request.file), "written by " + sink.title + " too");
        if (!is_new)
            diagnostics.error({ErrorKind::kGraph, sink.place, sink.title,
                               fmt::format("{} is {}", in_quotes(sink.request.file.string()), it->second),
                               "write to another file", Passing::kNever, Code::kSameFile});
    }
}

void check_inputs(const Graph& graph, const ResolvedFrame& frame, Diagnostics& diagnostics) {
    const Demand demanded = demand(frame);
    for (std::size_t i = 0; i < frame.ops.size(); ++i) {
        const Op& op = frame.ops[i];
        if (!op.source || !demanded.needs(i) || op.source->header().file.empty()) continue;
        try {
            check_finished(op.source->header().file, demanded.region(i));
        } catch (const Failure& f) {
            Error e = f.error();
            e.node = op.title;
            e.place = place_of_file(graph, op.title);
            diagnostics.error(std::move(e));
        }
    }
}

void check_places(const ResolvedFrame& frame, Diagnostics& diagnostics) {
    for (const Sink& sink : frame.sinks) {
        try {
            check_can_write(sink.request.file);
        } catch (const Failure& f) {
            Error e = f.error();
            e.place = sink.place;
            e.node = sink.title;
            e.code = Code::kCantWrite;
            diagnostics.error(std::move(e));
        }
    }
}

void check_outputs(const Graph& graph, std::span<const int> frames, const ResolveOptions& options,
                   Diagnostics& diagnostics) {
    if (frames.size() < 2) return;
    // What is wrong with an input hides nothing here: a frame that fails must not let the next overwrite a
    // plate.
    const std::size_t told = diagnostics.errors().size();
    refuse_fixed_outputs(graph, frames, diagnostics);
    if (diagnostics.errors().size() == told) check_frames_apart(graph, frames, options, diagnostics);
}

}  // namespace keyline
