// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/base/index.h"
#include "engine/base/pixel_aspect.h"
#include "engine/kit/filter.h"
#include "engine/node/node_adaptor.h"
#include "engine/node/pixel_loop.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numeric>

namespace keyline {

namespace {

enum class Fit { kFit, kFill, kWidth, kHeight, kDistort, kNone };

constexpr auto words(Fit) {
    using W = Word<Fit>;
    return std::array{W{"fit", Fit::kFit, "the whole image, centred, with room left over"},
                      W{"fill", Fit::kFill, "no room left over; what does not fit lies outside"},
                      W{"width", Fit::kWidth, "as wide as the format"},
                      W{"height", Fit::kHeight, "as high as the format"},
                      W{"distort", Fit::kDistort, "as wide and as high"},
                      W{"none", Fit::kNone, "not resized, only centred"}};
}

// How one axis of the image is laid on the format: out = in × scale + offset, both from pixels' edges.
struct Axis {
    double scale, offset;

    double to_in(double out) const { return (out - offset) / scale; }
    int first(double edge) const { return nearest_pixel(std::floor(edge * scale + offset)); }
    int last(double edge) const { return nearest_pixel(std::ceil(edge * scale + offset)); }

    // Of the pixels from out0 to out1 those that may see one of [in0, in1).
    std::pair<int, int> seeing(Filter filter, int in0, int in1, int out0, int out1) const {
        const double reach = filter_radius(filter) * filter_stretch(filter, 1 / scale) + 1;
        return {std::max(out0, first(in0 - reach)), std::min(out1, last(in1 + reach))};
    }
};

// The input's pixels under each pixel of an axis, and their weights; what lies beyond the picture's ends, in0
// and in1, is left out and the rest weighed anew.
class Taps {
public:
    Taps(Filter filter, const Axis& axis, int out0, int out1, int in0, int in1) : origin_(out0) {
        const double stretch = filter_stretch(filter, 1 / axis.scale);
        for (int o = out0; o < out1; ++o) {
            const double centre = axis.to_in(o + 0.5) - 0.5;
            const double reach = filter_radius(filter) * stretch;
            const int low = std::clamp(static_cast<int>(std::floor(centre - reach)), in0, in1 - 1);
            const int high = std::clamp(static_cast<int>(std::ceil(centre + reach)), in0, in1 - 1);
            spans_.push_back({low, high - low + 1, weights_.size()});
            for (int i = low; i <= high; ++i)
                weights_.push_back(filter_weight(filter, (i - centre) / stretch));
            normalise(spans_.back(), static_cast<int>(std::floor(centre + 0.5)));
        }
    }

    struct Span {
        int first, count;
        std::size_t weights;
    };
    const Span& operator[](int out) const { return spans_[index(out - origin_)]; }
    const double* weights(const Span& span) const { return weights_.data() + span.weights; }

    // First and one past the last of the input's pixels for [out0, out1).
    std::pair<int, int> reach(int out0, int out1) const {
        const Span &a = (*this)[out0], &b = (*this)[out1 - 1];
        return {a.first, b.first + b.count};
    }

private:
    void normalise(const Span& span, int nearest) {
        const std::span<double> weights{weights_.data() + span.weights, static_cast<std::size_t>(span.count)};
        double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
        if (sum == 0) {
            // Only a pixel whose centre is beyond the image's edge can be without weight: it shows the edge.
            const int tap = std::clamp(nearest - span.first, 0, span.count - 1);
            weights[index(tap)] = sum = 1;
        }
        for (double& w : weights) w /= sum;
    }

    int origin_;
    std::vector<Span> spans_;
    std::vector<double> weights_;
};

template <bool kAlongX>
struct Resample {
    Rect demand(const Rect& out, int) const {
        if (out.empty()) return {};
        const auto [first, end] = kAlongX ? taps->reach(out.x0, out.x1) : taps->reach(out.y0, out.y1);
        return kAlongX ? Rect{first, out.y0, end, out.y1} : Rect{out.x0, first, out.x1, end};
    }
    double cost() const { return 20; }

    void compute(const View& in, const MutView& out, Scratch&) const {
        const std::ptrdiff_t step = kAlongX ? 1 : in.stride;
        for (int y = out.rect.y0; y < out.rect.y1; ++y)
            for (int x = out.rect.x0; x < out.rect.x1; ++x) {
                const Taps::Span& span = (*taps)[kAlongX ? x : y];
                const float* from = kAlongX ? in.at(span.first, y) : in.at(x, span.first);
                const double* weights = taps->weights(span);
                if (exact) {
                    const double* one =
                        std::find_if(weights, weights + span.count - 1, [](double w) { return w != 0; });
                    *out.at(x, y) = from[(one - weights) * step];
                    continue;
                }
                double sum = 0;
                for (int i = 0; i < span.count; ++i) {
                    // A weight of 0 takes nothing, not even NaN or infinity.
                    if (weights[i] != 0) sum += weights[i] * double{from[i * step]};
                }
                *out.at(x, y) = with_one_nan(static_cast<float>(sum));
            }
    }

    std::shared_ptr<const Taps> taps;
    bool exact = false;  // the bits of the only pixel with a weight, whatever they stand for
};

struct Reformat {
    static constexpr Info info{"reformat", "Resizes an image to a format."};

    struct Params {
        Input in;
        std::array<int, 2> size{};
        Fit resize = Fit::kFit;
        Filter filter = Filter::kCubic;

        static constexpr auto fields =
            declare(input(&Params::in, "in", "The image; its display window becomes the format."),
                    field(&Params::size, "size", "Width and height of the format.",
                          between(1, 1 << 20, "pixels").tested_to(64))
                        .required(),
                    field(&Params::resize, "resize", "How the image is laid on the format."),
                    field(&Params::filter, "filter", "What the image is resampled with."));
    };

    explicit Reformat(const Params& p) : params(p) {}

    Stream expand(Builder& builder) const {
        const Stream in = builder.input(params.in);
        Stream out = in;
        out.display = {0, 0, params.size[0], params.size[1]};
        if (in.window.empty() || in.display.empty()) return out;
        const auto [ax, ay] = axes(in.display);
        if (ax.scale != ay.scale) out.metadata = distorted(*in.metadata, ay.scale / ax.scale);
        const Rect &w = in.window, e = in.extent();
        const Rect whole{ax.first(e.x0), ay.first(e.y0), ax.last(e.x1), ay.last(e.y1)};
        const auto [x0, x1] = ax.seeing(params.filter, w.x0, w.x1, whole.x0, whole.x1);
        const auto [y0, y1] = ay.seeing(params.filter, w.y0, w.y1, whole.y0, whole.y1);
        out.window = {x0, y0, x1, y1};
        // The picture ends where it did, though what is beyond the format is 0.
        if (!out.extent().contains(whole)) out.window = whole;
        refuse_unreachable(out.window);
        refuse_longer_than_tables(out.window);
        const Rect between{out.window.x0, w.y0, out.window.x1, w.y1},
            narrow{out.window.x0, e.y0, out.window.x1, e.y1};
        if (params.filter != Filter::kNearest && (ax.scale != 1 || ay.scale != 1))
            tell_of_ids(builder, in, "each pixel takes the nearest");
        for (const bool exact : {false, true}) {
            const Filter filter = exact ? Filter::kNearest : params.filter;
            const auto x = pass<true>({filter, ax, out.window.x0, out.window.x1, e.x0, e.x1}, exact);
            const auto y = pass<false>({filter, ay, out.window.y0, out.window.y1, e.y0, e.y1}, exact);
            for (StreamChannel& c : out.channels) {
                if (c.exact() != exact) continue;
                const ValueRef wide = builder.add(x, {{in, {c.value}}}, between, 1).front();
                c.value = builder.add(y, {{between, narrow, {wide}}}, out.window, 1).front();
            }
        }
        return out;
    }

    const Params params;

private:
    // What is shown keeps its shape, so its pixels take another.
    static std::shared_ptr<const Metadata> distorted(Metadata metadata, double factor) {
        set_pixel_aspect(metadata, double{pixel_aspect(metadata)} * factor);
        return std::make_shared<const Metadata>(std::move(metadata));
    }

    std::pair<Axis, Axis> axes(const Rect& display) const {
        const double sx = double(params.size[0]) / display.width(),
                     sy = double(params.size[1]) / display.height();
        const double both = params.resize == Fit::kFit      ? std::min(sx, sy)
                            : params.resize == Fit::kFill   ? std::max(sx, sy)
                            : params.resize == Fit::kWidth  ? sx
                            : params.resize == Fit::kHeight ? sy
                                                            : 1;
        const bool distort = params.resize == Fit::kDistort;
        return {axis(distort ? sx : both, display.x0, display.x1, params.size[0]),
                axis(distort ? sy : both, display.y0, display.y1, params.size[1])};
    }

    // Each pixel of an axis has its own weights.  The format itself has fewer pixels than this.
    static void refuse_longer_than_tables(const Rect& window) {
        constexpr int kMost = 1 << 22;
        if (window.width() <= kMost && window.height() <= kMost) return;
        fail(
            ErrorKind::kGraph,
            fmt::format("the picture would become {} × {} pixels, most of them outside of the format; it can "
                        "have {} along a side",
                        window.width(), window.height(), kMost),
            "crop it before");
    }

    // Centre on centre; unresized, by whole pixels.
    static Axis axis(double scale, int from, int to, int size) {
        const double offset = size * 0.5 - (double(from) + to) * 0.5 * scale;
        return {scale, scale == 1 ? std::floor(offset) : offset};
    }

    template <bool kAlongX>
    static std::shared_ptr<const Operation> pass(Taps taps, bool exact) {
        return make_operation(std::make_shared<const Resample<kAlongX>>(
            Resample<kAlongX>{std::make_shared<const Taps>(std::move(taps)), exact}));
    }
};

}  // namespace

KEYLINE_NODE(reformat, Reformat)

}  // namespace keyline
