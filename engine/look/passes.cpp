// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/look/passes.h"

#include "engine/base/channels.h"
#include "engine/base/error.h"
#include "engine/kit/cryptomatte.h"
#include "engine/look/source_channels.h"

#include <algorithm>
#include <array>
#include <optional>
#include <set>
#include <span>
#include <string_view>
#include <vector>

namespace keyline {

namespace {

using Names = std::vector<std::string>;
using Called = std::span<const std::string_view>;

// As plain() has them; the first that a file has is taken.
constexpr std::array<std::string_view, 7> kBeauty{"combined", "beauty", "rgba", "c", "ci", "rgbcolor", "rgb"};
constexpr std::array<std::string_view, 10> kAlbedo{
    "diffcol",   "diffusecolor",      "diffusealbedo", "albedo",          "diffusefilter",
    "basecolor", "vraydiffusefilter", "denoisealbedo", "denoisingalbedo", "diffusefiltercolor"};
constexpr std::array<std::string_view, 12> kNormal{"normal",      "normals",       "n",
                                                   "nn",          "nworld",        "worldnormal",
                                                   "normalworld", "vraynormals",   "shadingnormal",
                                                   "bumpnormals", "denoisenormal", "denoisingnormal"};
constexpr std::array<std::string_view, 8> kDepth{"depth",       "z",  "zdepth", "vrayzdepth",
                                                 "cameradepth", "pz", "hitpz",  "denoisingdepth"};
constexpr std::array<std::string_view, 6> kRawLight{
    "diffdir", "rawlight", "rawlighting", "vrayrawlighting", "diffuselightingraw", "rawdiffuselighting"};
constexpr std::array<std::string_view, 6> kLight{"diffusedirect", "directdiffuse", "diffuselighting",
                                                 "vraylighting",  "lighting",      "direct"};
// Of V-Ray in Maya, where it is the colour; of others it is the light.
constexpr std::array<std::string_view, 1> kDiffuse{"diffuse"};
constexpr std::array<std::string_view, 5> kOfVray{"rawlight", "rawlighting", "lighting", "selfillum",
                                                  "rawgi"};
constexpr std::array<std::string_view, 3> kOfCycles{"diffcol", "diffusecolor", "combined"};

// What a layer or channel is called by itself: "diffusecolor" for "ViewLayer.Diffuse Color".
std::string plain(std::string_view name) {
    std::string out;
    for (const char c : split_channel(name).base) {
        if (c >= 'A' && c <= 'Z') out += static_cast<char>(c - 'A' + 'a');
        if ((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9')) out += c;
    }
    return out;
}

// Of those that are picked by a selection, sorted; none where it picks nothing, or is in doubt.
std::set<std::size_t> picked(const Names& names, const std::string& selection) {
    std::set<std::size_t> out;
    try {
        for (const Picked& p : select_channels(names, selection)) out.insert(p.index);
    } catch (const Failure&) {
        out.clear();
    }
    return out;
}

// The end of a full name where that picks the same.
std::string shortest(const Names& names, const std::string& full) {
    const std::string end(split_channel(full).base);
    return picked(names, end) == picked(names, full) ? end : full;
}

Names channels_in(const Names& names, const std::string& layer) {
    Names out;
    for (const std::string& name : names)
        if (const ChannelName n = split_channel(name); n.layer == layer) out.emplace_back(n.base);
    return out;
}

bool has_components(const Names& channels, std::initializer_list<std::string_view> wanted) {
    return std::ranges::all_of(wanted, [&](std::string_view w) {
        return std::ranges::any_of(channels, [&](const std::string& c) { return component_of(c) == w; });
    });
}

bool is_colour(const Names& channels) { return has_components(channels, {"R", "G", "B"}); }
bool is_vector(const Names& channels) {
    return has_components(channels, {"X", "Y", "Z"}) || is_colour(channels);
}

class Finder {
public:
    explicit Finder(Names names) : names_(std::move(names)), layers_(layers_of(names_)) {}

    // The full name of a layer.
    template <class Fits>
    std::optional<std::string> layer(Called called, Fits fits) const {
        for (const std::string_view wanted : called)
            for (const std::string& layer : layers_)
                if (plain(layer) == wanted && fits(channels_in(names_, layer))) return layer;
        return {};
    }
    bool has(Called called) const {
        return layer(called, [](const Names&) { return true; }).has_value();
    }

    // As a selection; empty where there is none.
    std::string colour(Called called) const { return selection(layer(called, is_colour)); }
    std::string vector(Called called) const { return selection(layer(called, is_vector)); }

    // A channel without a layer, or the first of a layer.
    std::string channel(Called called) const {
        for (const std::string_view wanted : called)
            for (const std::string& name : channels_in(names_, ""))
                if (plain(name) == wanted) return name;
        const auto found = layer(called, [](const Names&) { return true; });
        if (!found) return {};
        const Names inside = channels_in(names_, *found);
        return inside.size() == 1 ? selection(found) : join_channel(*found, inside.front());
    }

    const Names& names() const { return names_; }

private:
    std::string selection(const std::optional<std::string>& layer) const {
        return layer ? shortest(names_, *layer) : "";
    }

    Names names_, layers_;
};

void find_beauty(const Finder& finder, RenderPasses& out) {
    const Names bare = channels_in(finder.names(), "");
    const auto layer = finder.layer(kBeauty, is_colour);
    if (is_colour(bare)) {
        out.beauty = ".";
        out.has_alpha = has_components(bare, {"A"});
    } else if (layer) {
        out.beauty = shortest(finder.names(), *layer);
        out.has_alpha = has_components(channels_in(finder.names(), *layer), {"A"});
    }
}

void find_light(const Finder& finder, RenderPasses& out) {
    out.light = finder.colour(kRawLight);
    out.is_raw = !out.light.empty();
    if (out.is_raw) return;
    out.light = finder.colour(kLight);
    // Cycles has "Diffuse Direct" without the colour, which others multiply in.
    out.is_raw = !out.light.empty() && finder.has(kOfCycles) && out.light.find(' ') != std::string::npos;
}

// What a Cryptomatte is of stands in its name: crypto_object, CryptoMaterial00, VRayCryptomatte.
void find_cryptomattes(const Stream& stream, RenderPasses& out) {
    std::string other;
    for (const Cryptomatte& matte : cryptomattes_of(stream)) {
        const std::string name = plain(matte.shown_name());
        const auto is_of = [&](const char* what) { return name.find(what) != std::string::npos; };
        std::string& place = is_of("material") ? out.materials : is_of("object") ? out.objects : other;
        if (place.empty()) place = split_channel(matte.shown_name()).base;
    }
    if (out.objects.empty()) out.objects = other;
}

}  // namespace

RenderPasses find_passes(const ImageSource& source) {
    const SourceChannels channels(source);
    const Finder finder(channels.stream.names());
    RenderPasses out;
    find_beauty(finder, out);
    out.albedo = finder.colour(kAlbedo);
    if (out.albedo.empty() && finder.has(kOfVray)) out.albedo = finder.colour(kDiffuse);
    find_light(finder, out);
    out.normal = finder.vector(kNormal);
    out.depth = finder.channel(kDepth);
    find_cryptomattes(channels.stream, out);
    return out;
}

}  // namespace keyline
