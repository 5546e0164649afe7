// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/io/exr_parts.h"

#include "engine/error.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <fmt/format.h>
#include <map>
#include <optional>
#include <string_view>

namespace keyline::exr {

namespace {

bool contains(const std::vector<std::string>& words, std::string_view word) {
    return std::ranges::find(words, word) != words.end();
}

std::vector<std::string> views_of(std::span<const Part> parts) {
    std::vector<std::string> views;
    const auto add = [&](const std::string& view) {
        if (!view.empty() && !contains(views, view)) views.push_back(view);
    };
    for (const Part& part : parts) std::ranges::for_each(part.views, add);
    for (const Part& part : parts) add(part.view);
    return views;
}

std::string part_label(const Part& part, std::size_t index) {
    return part.name.empty() ? std::to_string(index) : part.name;
}

// The part that `wanted` names, or counts from 0.
std::size_t find_part(const std::string& file, std::span<const Part> parts, const std::string& wanted) {
    const auto found = std::ranges::find(parts, wanted, &Part::name);
    if (found != parts.end()) return static_cast<std::size_t>(found - parts.begin());
    std::size_t index = 0;
    const char* end = wanted.data() + wanted.size();
    const auto parsed = std::from_chars(wanted.data(), end, index);
    if (parsed.ec == std::errc() && parsed.ptr == end && index < parts.size()) return index;
    std::vector<std::string> labels;
    for (std::size_t i = 0; i < parts.size(); ++i) labels.push_back(part_label(parts[i], i));
    fail(ErrorKind::kInput, fmt::format("{}: no part {}", file, in_quotes(wanted)),
         fmt::format("its parts are {}", listed(labels)));
}

std::string choose_view(const std::string& file, std::span<const Part> parts, const OpenOptions& options,
                        const Part* only) {
    const std::vector<std::string> views = views_of(parts);
    if (!options.view.empty()) {
        if (!contains(views, options.view))
            fail(ErrorKind::kInput, fmt::format("{}: no view {}", file, in_quotes(options.view)),
                 views.empty() ? "it has no views" : fmt::format("its views are {}", listed(views)));
        if (only != nullptr && !only->view.empty() && only->view != options.view)
            fail(ErrorKind::kInput,
                 fmt::format("{}: part {} is of view {}, not {}", file, in_quotes(only->name),
                             in_quotes(only->view), in_quotes(options.view)));
        return options.view;
    }
    if (only != nullptr && !only->view.empty()) return only->view;
    return views.empty() ? "" : views.front();
}

// A part's name without the ending that tells its view.
std::string_view name_without_view(const Part& part) {
    std::string_view name = part.name;
    for (const char separator : {'_', '.'}) {
        const std::string ending = separator + part.view;
        if (!part.view.empty() && name.size() > ending.size() && name.ends_with(ending))
            return name.substr(0, name.size() - ending.size());
    }
    return name == part.view ? std::string_view{} : name;
}

bool is_main(std::string_view part_name) {
    static constexpr std::array<std::string_view, 5> kMain = {"", "rgba", "rgb", "beauty", "main"};
    return std::ranges::find(kMain, part_name) != kMain.end();
}

// In a part that holds several views, a channel is of the view that stands before its last dot, or of the
// default one where it has no layer; another layer belongs to all.  Returns the name without the view, or
// nothing for a channel of another view.
std::optional<std::string> name_in_view(const Part& part, const std::string& name, const std::string& view) {
    if (part.views.empty()) return name;
    const std::size_t dot = name.rfind('.');
    if (dot == std::string::npos) return view == part.views.front() ? std::optional(name) : std::nullopt;
    const std::size_t start = dot == 0 ? std::string::npos : name.rfind('.', dot - 1);
    const std::size_t first = start == std::string::npos ? 0 : start + 1;
    const std::string_view own = std::string_view(name).substr(first, dot - first);
    if (!contains(part.views, own)) return name;
    return own == view ? std::optional(name.substr(0, first) + name.substr(dot + 1)) : std::nullopt;
}

TakenPart name_channels(const Part& part, std::size_t index, const std::string& layer,
                        const std::string& view) {
    TakenPart taken{index, {}};
    const std::vector<ChannelInfo> channels = delivered_channels(part);
    for (std::size_t i = 0; i < channels.size(); ++i) {
        auto name = name_in_view(part, channels[i].name, view);
        if (!name) continue;
        if (!layer.empty() && name->find('.') == std::string::npos) name = layer + "." + *name;
        taken.channels.push_back({i, {*name, channels[i].type}});
    }
    return taken;
}

void refuse_duplicates(const std::string& file, std::span<const Part> parts,
                       const std::vector<TakenPart>& taken) {
    std::map<std::string_view, std::size_t> part_of;
    for (const TakenPart& part : taken)
        for (const DeliveredChannel& channel : part.channels) {
            const auto [entry, is_new] = part_of.emplace(channel.info.name, part.index);
            if (is_new) continue;
            fail(
                ErrorKind::kInput,
                fmt::format("{}: channel {} is in part {} and in part {}", file, in_quotes(channel.info.name),
                            in_quotes(part_label(parts[entry->second], entry->second)),
                            in_quotes(part_label(parts[part.index], part.index))),
                "take one of them with 'part'");
        }
}

void refuse_deep(const std::string& file, std::span<const Part> parts, const std::vector<TakenPart>& taken) {
    for (const TakenPart& part : taken)
        if (parts[part.index].storage == Storage::kDeep)
            fail(
                ErrorKind::kInput,
                parts.size() == 1 ? fmt::format("{}: deep images can't be read", file)
                                  : fmt::format("{}: part {} is deep, which can't be read", file,
                                                in_quotes(part_label(parts[part.index], part.index))),
                parts.size() == 1 ? "flatten it first" : "take a flat part with 'part', or flatten it first");
}

}  // namespace

bool is_luminance_chroma(const Part& part) {
    std::size_t known = 0;
    for (const StoredChannel& c : part.channels) {
        if (c.name == "Y" || c.name == "A")
            known += c.subsampled() ? 0 : 1;
        else if (c.name == "RY" || c.name == "BY")
            known += c.x_sampling == 2 && c.y_sampling == 2 ? 1 : 0;
    }
    const bool has_alpha = std::ranges::find(part.channels, "A", &StoredChannel::name) != part.channels.end();
    return known == part.channels.size() && known == (has_alpha ? 4U : 3U);
}

std::vector<ChannelInfo> delivered_channels(const Part& part) {
    std::vector<ChannelInfo> channels;
    if (is_luminance_chroma(part)) {
        if (part.channels.size() == 4) channels.push_back({"A", SampleType::kHalf});
        for (const char* name : {"B", "G", "R"}) channels.push_back({name, SampleType::kHalf});
        return channels;
    }
    for (const StoredChannel& channel : part.channels) channels.push_back({channel.name, channel.type});
    return channels;
}

std::vector<TakenPart> choose_parts(const std::string& file, std::span<const Part> parts,
                                    const OpenOptions& options) {
    std::optional<std::size_t> only;
    if (!options.part.empty()) only = find_part(file, parts, options.part);
    const std::string view = choose_view(file, parts, options, only ? &parts[*only] : nullptr);

    // Names do not depend on `part`: they are those that the part's channels have beside the others.
    std::vector<TakenPart> taken;
    bool has_main = false;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        if (!parts[i].view.empty() && parts[i].view != view) continue;
        std::string layer(name_without_view(parts[i]));
        const bool bare = parts.size() == 1 || (!has_main && is_main(layer));
        if (bare) layer.clear();
        has_main = has_main || bare;
        if (!only || *only == i) taken.push_back(name_channels(parts[i], i, layer, view));
    }
    refuse_deep(file, parts, taken);
    refuse_duplicates(file, parts, taken);
    return taken;
}

}  // namespace keyline::exr
