// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/look/render_levels.h"

#include "engine/base/channels.h"
#include "engine/look/region.h"
#include "engine/look/source_channels.h"
#include "engine/simd/elementary.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace keyline {

namespace {

constexpr int kStrip = 16;                // rows of a chunk, mostly
constexpr int64_t kMostPixels = 1 << 20;  // of all strips
constexpr double kLeastColour = 0.01;     // what is darker says nothing of the light on it
constexpr double kNoDepth = 1e9;          // from here on renderers mean that there is nothing
constexpr double kGamma = 2.2;

using Samples = std::vector<std::vector<double>>;  // a channel of the source each

// The grey of a layer, sample by sample.
class Grey {
public:
    Grey(const std::vector<std::string>& names, const std::string& selection) {
        if (selection.empty()) return;
        const std::vector<Picked> all = select_channels(names, selection);
        std::vector<std::string> inside;
        for (const Picked& p : all) inside.push_back(p.name);
        const ColourChannels c = find_colour(inside);
        rgb_ = {all[c.r].index, all[c.g].index, all[c.b].index};
        if (c.a) alpha_ = all[*c.a].index;
        is_there_ = true;
    }
    explicit operator bool() const { return is_there_; }
    double at(const Samples& samples, std::size_t i) const {
        constexpr std::array kWeights{0.2126, 0.7152, 0.0722};
        double out = 0;
        for (std::size_t c = 0; c < 3; ++c) out += kWeights[c] * samples[rgb_[c]][i];
        return out;
    }
    double alpha(const Samples& samples, std::size_t i) const { return alpha_ ? samples[*alpha_][i] : 1; }

private:
    std::array<std::size_t, 3> rgb_{};
    std::optional<std::size_t> alpha_;
    bool is_there_ = false;
};

double quantile(std::vector<double>& values, double share) {
    if (values.empty()) return 0;
    const auto at =
        values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::ranges::nth_element(values, at);
    return *at;
}

// The value that parts samples into two kinds which differ most, each by itself the least (Otsu, 1979). Light
// is looked at by its root, as the lit half of a round thing has many values and the shade few.
double parting(std::vector<double>& values) {
    constexpr std::size_t kBins = 256;
    const double top = std::sqrt(quantile(values, 0.98));
    if (!(top > 0)) return 0;
    std::array<double, kBins> counts{};
    for (const double v : values)
        counts[static_cast<std::size_t>(std::min(std::sqrt(v) / top, 1.0) * (kBins - 1))] += 1;
    double all = 0, sum = 0;
    for (std::size_t i = 0; i < kBins; ++i) all += counts[i], sum += counts[i] * static_cast<double>(i);
    double below = 0, sum_below = 0, best = -1;
    std::size_t at = 0;
    for (std::size_t i = 0; i + 1 < kBins; ++i) {
        below += counts[i];
        sum_below += counts[i] * static_cast<double>(i);
        if (below == 0 || below == all) continue;
        const double apart = sum_below / below - (sum - sum_below) / (all - below);
        const double between = below * (all - below) * apart * apart;
        if (between > best) best = between, at = i;
    }
    const double root = top * (static_cast<double>(at) + 1) / (kBins - 1);
    return root * root;
}

// What is looked at of each strip.
class Gathered {
public:
    Gathered(const std::vector<std::string>& names, const RenderPasses& passes)
        : is_raw_(passes.is_raw),
          beauty_(names, passes.beauty),
          albedo_(names, passes.albedo),
          light_(names, passes.light.empty() ? passes.beauty : passes.light) {
        if (!passes.depth.empty()) depth_ = select_channels(names, passes.depth).front().index;
    }

    void add(const Samples& samples, int width) {
        const std::size_t count = samples.front().size();
        for (std::size_t i = 0; i < count; ++i) {
            if (beauty_ && beauty_.alpha(samples, i) < 0.5) continue;
            if (albedo_ && light_) add_light(samples, i);
            if (depth_) add_depth(samples[*depth_][i]);
            if (beauty_) add_slope(samples, i, static_cast<std::size_t>(width));
        }
    }

    RenderLevels levels() {
        return {parting(lights_), quantile(depths_, 0.5),
                seen_ > 0 ? static_cast<double>(colourless_) / static_cast<double>(seen_) : 0,
                quantile(slopes_, 0.9)};
    }

private:
    void add_light(const Samples& samples, std::size_t i) {
        const double colour = albedo_.at(samples, i);
        ++seen_;
        if (!(colour > kLeastColour)) {
            ++colourless_;
            return;
        }
        const double light = light_.at(samples, i) / (is_raw_ ? 1 : colour);
        if (std::isfinite(light)) lights_.push_back(std::max(light, 0.0));
    }
    void add_depth(double depth) {
        if (depth > 0 && depth < kNoDepth) depths_.push_back(depth);
    }
    // Across four pixels, which noise of single ones does not change much.
    void add_slope(const Samples& samples, std::size_t i, std::size_t width) {
        constexpr std::size_t kReach = 2;
        const std::size_t x = i % width;
        if (x < kReach || x + kReach >= width) return;
        const double step = seen(samples, i + kReach) - seen(samples, i - kReach);
        if (std::isfinite(step)) slopes_.push_back(std::abs(step) / (2 * kReach));
    }
    double seen(const Samples& samples, std::size_t i) const {
        return elementary::pow(std::clamp(beauty_.at(samples, i), 0.0, 1.0), 1 / kGamma);
    }

    bool is_raw_;
    Grey beauty_, albedo_, light_;
    std::optional<std::size_t> depth_;
    int64_t seen_ = 0, colourless_ = 0;
    std::vector<double> lights_, depths_, slopes_;
};

}  // namespace

RenderLevels levels_of(const ImageSource& source, const RenderPasses& passes) {
    const Rect window = source.header().data_window;
    if (window.empty()) return {};
    Gathered gathered(SourceChannels(source).stream.names(), passes);
    const auto every = static_cast<int>(1 + (window.area() - 1) / kMostPixels);
    for (int y = window.y0; y < window.y1; y += every * kStrip) {
        const Rect strip = intersect(window, {window.x0, y, window.x1, y + kStrip});
        gathered.add(read_region(source, strip), window.width());
    }
    return gathered.levels();
}

}  // namespace keyline
