// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/io/exr/parts.h"

#include "engine/base/channels.h"
#include "engine/base/error.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <fmt/format.h>
#include <map>
#include <optional>
#include <set>
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

// What renderers and compositors call the part with the picture.
bool is_name_of_main(std::string_view part_name) {
    static constexpr std::array<std::string_view, 6> kMain = {"", "rgba", "rgb", "beauty", "main", "alpha"};
    return std::ranges::any_of(kMain, [&](std::string_view known) {
        return std::ranges::equal(known, part_name, [](char a, char b) {
            return a == std::tolower(static_cast<unsigned char>(b));
        });
    });
}

// The view that a channel of a part with several is of, and its name without it.  OpenEXR puts the view
// before the last dot (depth.right.Z), Nuke before the first (right.depth.Z).
struct NameInView {
    std::string view, name;  // an empty view: the name tells none
};

NameInView split_view(const Part& part, const std::string& name) {
    const std::size_t last = name.rfind('.');
    if (last == std::string::npos) return {part.views.front(), name};
    const std::size_t before = last == 0 ? std::string::npos : name.rfind('.', last - 1);
    const std::size_t own = before == std::string::npos ? 0 : before + 1;
    if (const std::string view = name.substr(own, last - own); contains(part.views, view))
        return {view, name.substr(0, own) + name.substr(last + 1)};
    const std::size_t first = name.find('.');
    if (const std::string view = name.substr(0, first); contains(part.views, view))
        return {view, name.substr(first + 1)};
    return {{}, name};
}

// The layers of which a view has channels of its own.
std::set<std::string, std::less<>> layers_of_view(const Part& part, const std::string& view) {
    std::set<std::string, std::less<>> layers;
    for (const ChannelInfo& c : delivered_channels(part))
        if (const auto [own, name] = split_view(part, c.name); own == view)
            layers.emplace(split_channel(name).layer);
    return layers;
}

// The names that the channels of a part have in a view; nothing for those of another.  A layer that names no
// view belongs to all that have none of that name for themselves.
std::vector<std::optional<std::string>> names_in_view(const Part& part, const std::string& view) {
    std::vector<std::optional<std::string>> out;
    if (part.views.empty()) {
        for (const ChannelInfo& c : delivered_channels(part)) out.emplace_back(c.name);
        return out;
    }
    const auto own_layers = layers_of_view(part, view);
    for (const ChannelInfo& c : delivered_channels(part)) {
        auto [own, name] = split_view(part, c.name);
        const bool is_its = own == view || (own.empty() && !own_layers.contains(split_channel(name).layer));
        out.push_back(is_its ? std::optional(std::move(name)) : std::nullopt);
    }
    return out;
}

std::vector<std::string> bare_names(const Part& part, const std::string& view) {
    std::vector<std::string> out;
    for (const auto& name : names_in_view(part, view))
        if (name && name->find('.') == std::string::npos) out.push_back(*name);
    return out;
}

bool has_rgb(const std::vector<std::string>& names) {
    return find_spelled(names, "R") && find_spelled(names, "G") && find_spelled(names, "B");
}

// Whether a part by itself is a level of a Cryptomatte, whose R G B A are no colour.
bool is_cryptomatte_level(std::span<const Part> parts, const Part& part) {
    const auto level = level_of(name_without_view(part));
    if (!level) return false;
    return std::ranges::any_of(parts, [&](const Part& any) {
        return std::ranges::any_of(any.metadata.attributes(), [&](const Attribute& a) {
            const auto* text = std::get_if<std::string>(&a.value);
            return text && *text == level->name && a.name.starts_with("cryptomatte/") &&
                   a.name.ends_with("/name");
        });
    });
}

// Which parts of a view keep bare names: the first with colour, and one that adds an A to it.
class MainPart {
public:
    MainPart(std::span<const Part> parts, const std::string& view) {
        for (std::size_t i = 0; i < parts.size(); ++i) {
            if (!parts[i].view.empty() && parts[i].view != view) continue;
            bare_.emplace_back(i, bare_names(parts[i], view));
        }
        const auto find = [&](const auto& is_it) {
            const auto it =
                std::ranges::find_if(bare_, [&](const auto& b) { return is_it(parts[b.first], b.second); });
            if (it != bare_.end()) main_ = it->first;
        };
        if (parts.size() == 1) main_ = 0;
        if (!main_)
            find([&](const Part& part, const auto& names) {
                return has_rgb(names) && !is_cryptomatte_level(parts, part);
            });
        if (!main_)
            find([](const Part& part, const auto&) { return is_name_of_main(name_without_view(part)); });
        find_alpha(parts);
    }

    bool keeps_bare(std::size_t part) const { return part == main_ || part == alpha_; }

private:
    void find_alpha(std::span<const Part> parts) {
        for (const auto& [i, names] : bare_)
            if (i == main_ && (!has_rgb(names) || find_spelled(names, "A"))) return;
        for (const auto& [i, names] : bare_)
            if (i != main_ && !alpha_ && !has_rgb(names) && find_spelled(names, "A") &&
                is_name_of_main(name_without_view(parts[i])))
                alpha_ = i;
    }

    std::vector<std::pair<std::size_t, std::vector<std::string>>> bare_;
    std::optional<std::size_t> main_, alpha_;
};

TakenPart name_channels(const Part& part, std::size_t index, const std::string& layer,
                        const std::string& view) {
    TakenPart taken{index, {}};
    const std::vector<ChannelInfo> channels = delivered_channels(part);
    auto names = names_in_view(part, view);
    for (std::size_t i = 0; i < channels.size(); ++i) {
        std::optional<std::string>& name = names[i];
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
    const MainPart main(parts, view);
    for (std::size_t i = 0; i < parts.size(); ++i) {
        if (!parts[i].view.empty() && parts[i].view != view) continue;
        std::string layer(name_without_view(parts[i]));
        if (main.keeps_bare(i)) layer.clear();
        if (!only || *only == i) taken.push_back(name_channels(parts[i], i, layer, view));
    }
    refuse_deep(file, parts, taken);
    refuse_duplicates(file, parts, taken);
    return taken;
}

}  // namespace keyline::exr
