// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/look/differences.h"

#include "engine/base/channels.h"
#include "engine/look/region.h"
#include "engine/look/source_channels.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <map>

namespace keyline {

namespace {

double error_of(double a, double b) {
    if (a == b || (std::isnan(a) && std::isnan(b))) return 0;
    const double error = std::abs(a - b);
    return std::isfinite(error) ? error : std::numeric_limits<double>::infinity();
}

bool are_same(double a, double b, double error, const Tolerance& tolerance) {
    return error <= tolerance.absolute || error <= tolerance.relative * std::max(std::abs(a), std::abs(b));
}

// A channel of both.
struct Pair {
    std::size_t a, b;  // numbers among the sources' channels
};

// The numbers of the channels that are compared, by name.
std::map<std::string, std::size_t> chosen(const SourceChannels& channels, const std::string& selection) {
    const std::vector<std::string> names = channels.stream.names();
    std::map<std::string, std::size_t> out;
    if (selection.empty())
        for (std::size_t i = 0; i < names.size(); ++i) out[names[i]] = i;
    else
        for (const Picked& picked : select_channels(names, selection))
            out[names[picked.index]] = picked.index;
    return out;
}

void compare_names(const SourceChannels& a, const SourceChannels& b, const std::string& selection,
                   PictureDifferences& out, std::vector<Pair>& pairs) {
    const auto in_a = chosen(a, selection), in_b = chosen(b, selection);
    for (const auto& [name, i] : in_a) {
        const auto it = in_b.find(name);
        if (it == in_b.end()) {
            out.only_in_a.push_back(name);
            continue;
        }
        pairs.push_back({i, it->second});
        if (a.types[i] != b.types[it->second]) out.types.push_back({name, a.types[i], b.types[it->second]});
    }
    for (const auto& [name, unused] : in_b)
        if (!in_a.contains(name)) out.only_in_b.push_back(name);
}

void compare_attributes(const Metadata& a, const Metadata& b, PictureDifferences& out) {
    for (const Attribute& attribute : a.attributes()) {
        const Attribute* other = b.find(attribute.name);
        if (!other || *other != attribute) out.attributes.push_back({attribute.name, &attribute, other});
    }
    for (const Attribute& attribute : b.attributes())
        if (!a.find(attribute.name)) out.attributes.push_back({attribute.name, nullptr, &attribute});
}

class Comparison {
public:
    Comparison(const Tolerance& tolerance, ChannelDifference& out) : tolerance_(tolerance), out_(out) {}

    void add(double a, double b, int x, int y) {
        const double error = error_of(a, b);
        ++out_.samples;
        out_.counts.add(error);
        if (out_.is_id ? error != 0 : !are_same(a, b, error, tolerance_)) ++out_.different;
        if (std::isinf(error)) {
            if (out_.infinite++ == 0) out_.x = x, out_.y = y;
            return;
        }
        out_.sum += error;
        if (error <= out_.largest) return;
        out_.largest = error;
        if (out_.infinite == 0) out_.x = x, out_.y = y;
    }

private:
    const Tolerance& tolerance_;
    ChannelDifference& out_;
};

void add_to_map(ErrorMap& map, const Rect& strip, const std::vector<double>& a,
                const std::vector<double>& b) {
    float* to = map.errors.data() + std::ptrdiff_t{strip.y0 - map.window.y0} * map.window.width();
    for (std::size_t i = 0; i < a.size(); ++i) {
        const double error = error_of(a[i], b[i]);
        if (std::isfinite(error)) to[i] = std::max(to[i], static_cast<float>(error));
    }
}

}  // namespace

void ErrorCounts::add(double error) {
    ++bins_[std::bit_cast<uint32_t>(static_cast<float>(error)) >> 16U];
    ++all_;
}

double ErrorCounts::percentile(double share) const {
    const auto rank = static_cast<int64_t>(std::ceil(share * static_cast<double>(all_)));
    int64_t below = 0;
    for (std::size_t bin = 0; bin < kBins; ++bin)
        if ((below += bins_[bin]) >= std::max<int64_t>(rank, 1))
            return double{std::bit_cast<float>(static_cast<uint32_t>(bin) << 16U)};
    return 0;
}

PictureDifferences differences_of(const ImageSource& a, const ImageSource& b, const std::string& selection,
                                  const Tolerance& tolerance, ErrorMap* map) {
    const SourceChannels channels_a(a), channels_b(b);
    PictureDifferences out;
    out.display = a.header().display_window != b.header().display_window;
    out.data = a.header().data_window != b.header().data_window;
    compare_attributes(a.header().metadata, b.header().metadata, out);
    std::vector<Pair> pairs;
    compare_names(channels_a, channels_b, selection, out, pairs);
    for (const Pair& pair : pairs) {
        const StreamChannel &ca = channels_a.stream.channels[pair.a],
                            &cb = channels_b.stream.channels[pair.b];
        out.channels.emplace_back().channel = ca.name;
        out.channels.back().is_id = ca.holds == Holds::kId || cb.holds == Holds::kId;
    }
    const Rect window = unite(a.header().data_window, b.header().data_window);
    if (map) *map = {window, std::vector<float>(static_cast<std::size_t>(window.area()))};
    for (const Rect& strip : strips_of(window, pairs.size())) {
        const auto of_a = read_region(a, strip), of_b = read_region(b, strip);
        for (std::size_t i = 0; i < pairs.size(); ++i) {
            const std::vector<double>&from_a = of_a[pairs[i].a], &from_b = of_b[pairs[i].b];
            Comparison comparison(tolerance, out.channels[i]);
            std::size_t at = 0;
            for (int y = strip.y0; y < strip.y1; ++y)
                for (int x = strip.x0; x < strip.x1; ++x, ++at) comparison.add(from_a[at], from_b[at], x, y);
            if (map && !out.channels[i].is_id) add_to_map(*map, strip, from_a, from_b);
        }
    }
    return out;
}

}  // namespace keyline
