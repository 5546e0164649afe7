// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/base/channels.h"

#include "engine/base/error.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <fmt/format.h>
#include <iterator>

namespace keyline {

std::string some_of(const std::vector<std::string>& words) {
    if (words.size() <= kMostListed + 1) return listed(words);
    std::string out;
    for (std::size_t i = 0; i < kMostListed; ++i) out += (i > 0 ? ", " : "") + in_quotes(words[i]);
    return fmt::format("{} and {} more", out, words.size() - kMostListed);
}

namespace {

using Names = std::span<const std::string>;
using Words = std::vector<std::string>;

// "layer 'a'", "channels 'R' and 'G'"
std::string counted(std::string_view noun, const Words& words) {
    return fmt::format("{}{} {}", noun, words.size() == 1 ? "" : "s", some_of(words));
}

std::string there_is(std::string_view noun, const Words& words) {
    return fmt::format("there {} the {}", words.size() == 1 ? "is" : "are", counted(noun, words));
}

Words bare_channels(Names names) {
    Words out;
    std::copy_if(names.begin(), names.end(), std::back_inserter(out),
                 [](const std::string& name) { return split_channel(name).layer.empty(); });
    return out;
}

std::string what_there_is(Names names) {
    const Words layers = layers_of(names), bare = bare_channels(names);
    if (names.empty()) return "there are no channels";
    if (layers.empty()) return there_is("channel", bare);
    if (bare.empty()) return there_is("layer", layers);
    return fmt::format("{} and, without a layer, the {}", there_is("layer", layers),
                       counted("channel", bare));
}

std::optional<std::size_t> index_of(Names names, std::string_view name) {
    const auto found = std::find(names.begin(), names.end(), name);
    return found == names.end() ? std::nullopt
                                : std::optional(static_cast<std::size_t>(found - names.begin()));
}

bool ends_from_a_dot(std::string_view text, std::string_view end) {
    return text.size() > end.size() && text.ends_with(end) && text[text.size() - end.size() - 1] == '.';
}

// What could have been meant: every layer and channel in full and from each of its dots on.
Words candidates(Names names) {
    Words out = layers_of(names);
    out.insert(out.end(), names.begin(), names.end());
    const std::size_t full = out.size();
    for (std::size_t i = 0; i < full; ++i)
        for (std::size_t dot = 0; (dot = out[i].find('.', dot)) != std::string::npos;)
            out.push_back(out[i].substr(++dot));
    return out;
}

std::vector<Picked> pick_layer(Names names, std::string_view layer) {
    std::vector<Picked> out;
    for (std::size_t i = 0; i < names.size(); ++i)
        if (const auto [of, base] = split_channel(names[i]); of == layer)
            out.push_back({i, std::string(base)});
    return out;
}

std::vector<Picked> pick_channel(Names names, std::size_t i) {
    return {{i, std::string(split_channel(names[i]).base)}};
}

std::vector<Picked> pick_below(Names names, std::string_view prefix) {
    std::vector<Picked> out;
    Words above;
    for (std::size_t i = 0; i < names.size(); ++i) {
        const std::string_view layer = split_channel(names[i]).layer;
        if (layer.size() > prefix.size() && layer.starts_with(prefix))
            out.push_back({i, names[i].substr(prefix.size())});
        for (std::size_t dot = 0; (dot = layer.find('.', dot)) != std::string_view::npos;)
            above.emplace_back(layer.substr(0, ++dot));
    }
    if (out.empty())
        fail(Code::kUnknownChannel, ErrorKind::kGraph,
             fmt::format("no layer below {}; {}", in_quotes(prefix), what_there_is(names)),
             did_you_mean(prefix, above));
    return out;
}

// A channel that is spelled otherwise in the file: diffuse.R of diffuse.red.
std::vector<Picked> pick_spelled(Names names, std::string_view selection) {
    const auto i = find_spelled(names, selection);
    return i ? pick_channel(names, *i) : std::vector<Picked>{};
}

[[noreturn]] void refuse_ambiguous(std::string_view selection, std::string_view noun, const Words& matches) {
    fail(Code::kUnknownChannel, ErrorKind::kGraph,
         fmt::format("{} could be the {}", in_quotes(selection), counted(noun, matches)), "name one in full");
}

Words matching(const Words& words, std::string_view end) {
    Words out;
    std::copy_if(words.begin(), words.end(), std::back_inserter(out),
                 [end](const std::string& word) { return ends_from_a_dot(word, end); });
    return out;
}

constexpr std::array<std::pair<std::string_view, std::string_view>, 4> kColourWords{
    {{"red", "R"}, {"green", "G"}, {"blue", "B"}, {"alpha", "A"}}};

bool is_digit(char c) { return c >= '0' && c <= '9'; }

std::string lower(std::string_view text) {
    std::string out(text);
    std::ranges::transform(out, out.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return out;
}

// The component of a colour that serves for one of a vector; empty for others.
std::string_view axis_of(std::string_view component) {
    return component == "X" ? "R" : component == "Y" ? "G" : component == "Z" ? "B" : std::string_view{};
}

// Vectors that a renderer keeps in R G B.
std::vector<std::size_t> find_axes(Names names, Names wanted) {
    std::vector<std::size_t> out;
    for (const std::string& name : wanted) {
        const std::string_view colour = axis_of(name);
        const auto i = colour.empty() ? std::nullopt : find_spelled(names, colour);
        if (!i) return {};
        out.push_back(*i);
    }
    return out.size() == 3 ? out : std::vector<std::size_t>{};
}

}  // namespace

std::string_view component_of(std::string_view base) {
    static constexpr std::string_view kLetters = "RGBAXYZ";
    if (base.size() == 1) {
        const auto at = kLetters.find(static_cast<char>(std::toupper(static_cast<unsigned char>(base[0]))));
        return at == std::string_view::npos ? std::string_view{} : kLetters.substr(at, 1);
    }
    const std::string word = lower(base);
    for (const auto& [spelled, component] : kColourWords)
        if (word == spelled) return component;
    return {};
}

std::optional<std::size_t> find_spelled(Names names, std::string_view name) {
    if (const auto exact = index_of(names, name)) return exact;
    const auto [layer, base] = split_channel(name);
    const std::string_view component = component_of(base);
    if (component.empty()) return {};
    for (std::size_t i = 0; i < names.size(); ++i)
        if (const auto own = split_channel(names[i]);
            own.layer == layer && component_of(own.base) == component)
            return i;
    return {};
}

bool is_called(std::string_view name, std::string_view wanted) {
    return name == wanted || ends_from_a_dot(name, wanted);
}

std::optional<LevelName> level_of(std::string_view layer) {
    const std::size_t n = layer.size();
    if (n < 3 || !is_digit(layer[n - 1]) || !is_digit(layer[n - 2])) return {};
    return LevelName{layer.substr(0, n - 2), (layer[n - 2] - '0') * 10 + (layer[n - 1] - '0')};
}

ChannelName split_channel(std::string_view name) {
    const std::size_t dot = name.rfind('.');
    if (dot == std::string_view::npos) return {{}, name};
    return {name.substr(0, dot), name.substr(dot + 1)};
}

std::string join_channel(std::string_view layer, std::string_view base) {
    return layer.empty() ? std::string(base) : fmt::format("{}.{}", layer, base);
}

std::vector<std::string> layers_of(std::span<const std::string> names) {
    Words out;
    for (const std::string& name : names) {
        const std::string_view layer = split_channel(name).layer;
        if (!layer.empty() && std::find(out.begin(), out.end(), layer) == out.end()) out.emplace_back(layer);
    }
    return out;
}

std::vector<Picked> select_channels(std::span<const std::string> names, std::string_view selection) {
    if (selection.empty())
        fail(Code::kUnknownChannel, ErrorKind::kGraph, "no layer or channel is named after the ':'",
             what_there_is(names));
    if (selection == ".") {
        std::vector<Picked> bare = pick_layer(names, "");
        if (bare.empty())
            fail(Code::kUnknownChannel, ErrorKind::kGraph,
                 "no channel is without a layer; " + what_there_is(names));
        return bare;
    }
    if (selection.ends_with('.')) return pick_below(names, selection);

    if (std::vector<Picked> layer = pick_layer(names, selection); !layer.empty()) return layer;
    if (const auto channel = index_of(names, selection)) return pick_channel(names, *channel);

    const Words layers = matching(layers_of(names), selection);
    if (layers.size() > 1) refuse_ambiguous(selection, "layer", layers);
    if (layers.size() == 1) return pick_layer(names, layers[0]);
    const Words channels = matching(Words(names.begin(), names.end()), selection);
    if (channels.size() > 1) refuse_ambiguous(selection, "channel", channels);
    if (channels.size() == 1) return pick_channel(names, *index_of(names, channels[0]));
    if (std::vector<Picked> spelled = pick_spelled(names, selection); !spelled.empty()) return spelled;

    fail(Code::kUnknownChannel, ErrorKind::kGraph,
         fmt::format("no layer or channel {}; {}", in_quotes(selection), what_there_is(names)),
         did_you_mean(selection, candidates(names)));
}

ColourChannels find_colour(std::span<const std::string> names) {
    const auto r = find_spelled(names, "R"), g = find_spelled(names, "G"), b = find_spelled(names, "B");
    if (r && g && b) return {*r, *g, *b, find_spelled(names, "A")};
    Words colour;
    for (const std::string& layer : layers_of(names)) {
        const auto has = [&](std::string_view base) {
            return find_spelled(names, join_channel(layer, base)).has_value();
        };
        if (has("R") && has("G") && has("B")) colour.push_back(layer);
    }
    if (!colour.empty())
        fail(Code::kUnknownChannel, ErrorKind::kGraph,
             "there is no colour (R G B) outside of the " + counted("layer", colour),
             fmt::format("take one, as in ':{}'", colour[0]));
    fail(Code::kUnknownChannel, ErrorKind::kGraph, "there is no colour (R G B); " + what_there_is(names));
}

std::size_t find_matte(std::span<const std::string> names) {
    if (names.size() == 1) return 0;
    if (const auto a = find_spelled(names, "A")) return *a;
    fail(Code::kUnknownChannel, ErrorKind::kGraph,
         "there is no matte, which is the only channel or A; " + what_there_is(names),
         names.empty() ? "" : fmt::format("take one channel, as in ':{}'", names[0]));
}

std::vector<std::size_t> find_channels(std::span<const std::string> names,
                                       std::span<const std::string> wanted) {
    std::vector<std::size_t> out;
    Words missing;
    for (const std::string& name : wanted) {
        const auto i = find_spelled(names, name);
        if (i)
            out.push_back(*i);
        else
            missing.push_back(name);
    }
    if (missing.empty()) return out;
    if (std::vector<std::size_t> axes = find_axes(names, wanted); !axes.empty()) return axes;
    fail(Code::kUnknownChannel, ErrorKind::kGraph,
         fmt::format("the {} {} missing; {}", counted("channel", missing), missing.size() == 1 ? "is" : "are",
                     what_there_is(names)));
}

std::vector<std::size_t> rgba_order(std::span<const std::string> names) {
    static constexpr std::array<std::string_view, 4> kFirst{"R", "G", "B", "A"};
    const Words layers = layers_of(names);
    std::vector<std::array<std::ptrdiff_t, 4>> ranks;  // bare channels first, layer, component, index
    for (const std::string& name : names) {
        const auto [layer, base] = split_channel(name);
        const auto of = std::find(layers.begin(), layers.end(), layer);
        const auto component = std::find(kFirst.begin(), kFirst.end(), component_of(base));
        ranks.push_back(
            {layer.empty() ? 0 : 1, of - layers.begin(), component - kFirst.begin(), std::ssize(ranks)});
    }
    std::sort(ranks.begin(), ranks.end());
    std::vector<std::size_t> out;
    out.reserve(ranks.size());
    for (const auto& rank : ranks) out.push_back(static_cast<std::size_t>(rank.back()));
    return out;
}

}  // namespace keyline
