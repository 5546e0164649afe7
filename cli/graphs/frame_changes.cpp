// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/graphs/frame_changes.h"

#include "engine/base/channels.h"
#include "engine/base/index.h"
#include "engine/params/frames.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <set>

namespace keyline::cli {

namespace {

using Types = std::map<std::string, std::string>;

Types types_of(const ResolvedFrame& frame, const Stream& stream) {
    Types out;
    for (const StreamChannel& c : stream.channels)
        if (const auto stored = frame.info(c.value).stored) out[c.name] = sample_type_name(*stored);
    return out;
}

std::vector<std::string> only_in(const Types& a, const Types& b) {
    std::vector<std::string> out;
    for (const auto& [name, type] : a)
        if (!b.contains(name)) out.push_back(name);
    return out;
}

// "'R' and 'G' are float, half before"
std::vector<std::string> changed(const Types& before, const Types& now) {
    std::map<std::pair<std::string, std::string>, std::vector<std::string>> names;
    for (const auto& [name, type] : now)
        if (const auto it = before.find(name); it != before.end() && it->second != type)
            names[{type, it->second}].push_back(name);
    std::vector<std::string> out;
    for (const auto& [types, channels] : names)
        out.push_back(fmt::format("{} {} {}, and {} before", some_of(channels),
                                  channels.size() == 1 ? "is" : "are", types.first, types.second));
    return out;
}

// What files say of the colours that they hold.
constexpr std::array kOfColours{"chromaticities", "colorSpace", "colorInteropID", "acesImageContainerFlag"};

std::vector<Attribute> colours_of(const Stream& stream) {
    std::vector<Attribute> out;
    for (const char* name : kOfColours)
        if (const Attribute* attribute = stream.metadata->find(name)) out.push_back(*attribute);
    return out;
}

// Of the attributes that only one has, or that differ.
std::vector<std::string> names_of_difference(const std::vector<Attribute>& a,
                                             const std::vector<Attribute>& b) {
    std::set<std::string> out;
    for (const auto& [one, other] : {std::pair(&a, &b), std::pair(&b, &a)})
        for (const Attribute& attribute : *one)
            if (std::ranges::find(*other, attribute) == other->end()) out.insert(attribute.name);
    return {out.begin(), out.end()};
}

}  // namespace

void FrameChanges::look(const ResolvedFrame& frame, Diagnostics& diagnostics) {
    for (const NodeStream& s : frame.streams) {
        const GraphNode& node = graph_.nodes()[index(s.node)];
        if (node.type->kind != NodeKind::kSource || s.stream.is_data()) continue;
        const Seen now{frame.frame, s.stream.display, types_of(frame, s.stream), colours_of(s.stream)};
        const auto [it, is_first] = seen_.try_emplace(s.node, now);
        const Seen before = std::exchange(it->second, now);
        if (is_first) continue;
        const auto warn = [&](std::string what) {
            diagnostics.warning({ErrorKind::kInput, node.place,
                                 fmt::format("{}, frame {}", node.title(), frame.frame),
                                 std::move(what) + fmt::format(" in frame {}", before.frame),
                                 "'keyline info' tells of both files", Passing::kNever, Code::kFramesDiffer});
        };
        if (now.display != before.display)
            warn(fmt::format("the display window is {}, and {}", to_string(now.display),
                             to_string(before.display)));
        if (now.colours != before.colours)
            warn(fmt::format("the colour space, by {}, is another than",
                             some_of(names_of_difference(before.colours, now.colours))));
        if (const auto lost = only_in(before.types, now.types); !lost.empty())
            warn(fmt::format("{} {} missing, which {} there", some_of(lost), lost.size() == 1 ? "is" : "are",
                             lost.size() == 1 ? "was" : "were"));
        if (const auto come = only_in(now.types, before.types); !come.empty())
            warn(fmt::format("{} {} new, which {} not there", some_of(come), come.size() == 1 ? "is" : "are",
                             come.size() == 1 ? "was" : "were"));
        for (std::string& change : changed(before.types, now.types)) warn(std::move(change));
    }
}

void warn_of_gaps(const std::vector<int>& frames, Diagnostics& diagnostics) {
    const std::set<int> there(frames.begin(), frames.end());
    std::vector<int> missing;
    for (int f = *there.begin(); f < *there.rbegin(); ++f)
        if (!there.contains(f)) missing.push_back(f);
    if (missing.empty()) return;
    diagnostics.warning(
        {ErrorKind::kInput,
         {"--frames all", 0, 0},
         {},
         fmt::format("between frames {} and {}, {} {} not on disk", *there.begin(), *there.rbegin(),
                     format_frames(missing), missing.size() == 1 ? "is" : "are"),
         "say which frames there are to be, as in --frames 1-24, where that is meant",
         Passing::kNever,
         Code::kFramesMissing});
}

}  // namespace keyline::cli
