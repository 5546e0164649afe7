// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/base/channels.h"
#include "engine/base/error.h"
#include "engine/kit/color_operation.h"
#include "engine/kit/cryptomatte.h"
#include "engine/kit/false_color.h"
#include "engine/kit/numbers.h"
#include "engine/node/node_adaptor.h"
#include "engine/node/pixel_loop.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace keyline {

namespace {

using Rgb = std::array<float, 3>;

enum class Referred { kScene, kDisplay };

constexpr auto words(Referred) {
    return std::array{Word<Referred>{"scene", Referred::kScene, "light, in the space scene_linear"},
                      Word<Referred>{"display", Referred::kDisplay, "as a display takes it"}};
}

// What is shown, and how.
enum class Kind { kColour, kGrey, kDepth, kVector, kDirection, kCoordinates, kId, kCryptomatte };

struct Shown {
    Kind kind = Kind::kGrey;
    std::vector<StreamChannel> channels;
};

struct Range {
    float low = 0, high = 1;
};

constexpr Rgb kNotANumber{1, 0, 1};
constexpr float kNoDepth = 1e9F;  // from here on renderers mean that there is nothing

// A gather: the least and the largest of all samples that are numbers and mean something.
struct Extremes {
    struct Params {
        Input in;
        static constexpr auto fields = declare(input(&Params::in, "in", "", any_channels()));
    };
    using State = Range;
    using Partial = Range;
    static constexpr float kInfinity = std::numeric_limits<float>::infinity();

    static State start(const Rect&) { return {kInfinity, -kInfinity}; }
    static Partial map(const State&, const Inputs& in, const Rect& block, Scratch&) {
        Range out{kInfinity, -kInfinity};
        for (const View& view : in.slot(0))
            for (int y = block.y0; y < block.y1; ++y)
                for (int i = 0; i < block.width(); ++i) {
                    const float v = view.at(block.x0, y)[i];
                    if (std::abs(v) < kNoDepth) fold(out, {v, v});
                }
        return out;
    }
    static void fold(State& state, Partial more) {
        state = {std::min(state.low, more.low), std::max(state.high, more.high)};
    }
    static Numbers finish(const State& state) { return {{double{state.low}, double{state.high}}}; }
    static std::size_t state_bytes(const Rect&) { return sizeof(State); }
    static std::size_t partial_bytes(const Rect&) { return sizeof(Partial); }
    static std::size_t datum_bytes(const Rect&) { return 2 * sizeof(double); }
};

float placed(float v, const Range& range) {
    return std::clamp((v - range.low) / (range.high - range.low), 0.0F, 1.0F);
}

// From −high to high.
float placed_around_zero(float v, const Range& range) {
    return std::isnan(v) ? 1 : std::clamp(0.5F + 0.5F * v / range.high, 0.0F, 1.0F);
}

Rgb of_cryptomatte(std::span<const float> ranks) {
    Rgb out{};
    for (std::size_t i = 0; i + 1 < ranks.size(); i += 2) {
        const Rgb object = colour_of_id(std::bit_cast<uint32_t>(ranks[i]));
        for (std::size_t c = 0; c < 3; ++c) out[c] += ranks[i + 1] * object[c];
    }
    for (float& v : out) v = std::clamp(v, 0.0F, 1.0F);
    return out;
}

Rgb false_color(Kind kind, std::span<const float> v, const Range& range) {
    switch (kind) {
        case Kind::kVector:
            return {placed_around_zero(v[0], range), placed_around_zero(v[1], range),
                    placed_around_zero(v[2], range)};
        case Kind::kDirection:
            return {placed_around_zero(v[0], range), placed_around_zero(v[1], range), 0.5F};
        case Kind::kCoordinates: return {placed(v[0], range), placed(v[1], range), 0};
        case Kind::kId: return colour_of_id(std::bit_cast<uint32_t>(v[0]));
        case Kind::kCryptomatte: return of_cryptomatte(v);
        default: break;
    }
    if (std::isnan(v[0])) return kNotANumber;
    const float grey =
        kind == Kind::kDepth ? 1 - placed(v[0], range) : placed(v[0], range);  // the near is light
    return {grey, grey, grey};
}

// What the frame's extremes are shown as.
Range range_of(Kind kind, float low, float high) {
    if (!(low <= high)) return {};  // there are no samples
    if (kind == Kind::kVector || kind == Kind::kDirection) {
        const float most = std::max(std::abs(low), std::abs(high));
        const bool is_unit = most > 0.5F && most < 1.001F;  // normals are comparable between frames
        return {0, most == 0 || is_unit ? 1 : most};
    }
    if (kind != Kind::kDepth && low >= 0 && high <= 1) return {};
    return low < high ? Range{low, high} : Range{low, low + 1};
}

// R G B from channels and the two numbers of a range.
class Paint final : public Operation {
public:
    Paint(Kind kind, bool measured) : kind_(kind), measured_(measured) {}

    void compute(const Inputs& in, Outputs out, Scratch& scratch) const override {
        const std::span<const View> from = in.slot(0);
        const Range range = range_for(in);
        const std::span<float> pixel = scratch.floats(from.size());
        const Rect& rect = out[0].rect;
        for (int y = rect.y0; y < rect.y1; ++y)
            for (int x = rect.x0; x < rect.x1; ++x) {
                for (std::size_t c = 0; c < from.size(); ++c) pixel[c] = *from[c].at(x, y);
                const Rgb color = false_color(kind_, pixel, range);
                for (std::size_t c = 0; c < 3; ++c) *out[c].at(x, y) = with_one_nan(color[c]);
            }
    }
    double cost() const override { return 40; }

private:
    Range range_for(const Inputs& in) const {
        const std::vector<double>& ends = in.datum<Numbers>(1).values;
        const auto low = static_cast<float>(ends[0]), high = static_cast<float>(ends[1]);
        return measured_ ? range_of(kind_, low, high) : Range{low, high};
    }

    Kind kind_;
    bool measured_;
};

// Premultiplied colour over a board of two greys, so that what can be seen through is seen to be so.
class OverBoard final : public Operation {
public:
    void compute(const Inputs& in, Outputs out, Scratch&) const override {
        const std::span<const View> from = in.slot(0);
        const Rect& rect = out[0].rect;
        for (std::size_t c = 0; c < 3; ++c)
            for (int y = rect.y0; y < rect.y1; ++y)
                for (int x = rect.x0; x < rect.x1; ++x)
                    *out[c].at(x, y) =
                        with_one_nan(*from[c].at(x, y) + (1 - *from[3].at(x, y)) * board(x, y));
    }
    double cost() const override { return 10; }

private:
    static float board(int x, int y) {
        constexpr int kSquare = 8;
        return (floor_div(x, kSquare) + floor_div(y, kSquare)) % 2 == 0 ? 0.66F : 0.76F;
    }
};

std::optional<StreamChannel> spelled(const Stream& stream, const std::string& layer, const char* base) {
    const StreamChannel* c = stream.find_spelled(join_channel(layer, base));
    return c ? std::optional(*c) : std::nullopt;
}

// The channels of these names in a layer; none where one is not there.
std::vector<StreamChannel> all_of(const Stream& stream, const std::string& layer,
                                  std::initializer_list<const char*> bases) {
    std::vector<StreamChannel> out;
    for (const char* base : bases) {
        const auto c = spelled(stream, layer, base);
        if (!c) return {};
        out.push_back(*c);
    }
    return out;
}

bool holds(const std::vector<StreamChannel>& channels, Holds what) {
    return !channels.empty() && std::ranges::all_of(channels, [&](const StreamChannel& c) {
        return c.holds == what && !c.exact();
    });
}

std::optional<Shown> find_colour_of(const Stream& stream, const std::string& layer) {
    std::vector<StreamChannel> rgb = all_of(stream, layer, {"R", "G", "B"});
    if (!holds(rgb, Holds::kColour)) return std::nullopt;
    if (const auto a = spelled(stream, layer, "A")) rgb.push_back(*a);
    return Shown{Kind::kColour, std::move(rgb)};
}

// As a renderer wrote it: what was made of a depth is a number like others.
bool is_depth(const Builder& builder, const StreamChannel& c) {
    return c.holds == Holds::kData && component_of(split_channel(c.name).base) == "Z" &&
           builder.stored_type(c.value).has_value();
}

// What is no colour, of the layer of one channel.
Shown find_data(const Builder& builder, const Stream& stream, const StreamChannel& first) {
    if (first.exact()) return {Kind::kId, {first}};
    const std::string layer(split_channel(first.name).layer);
    for (const auto& xyz : {all_of(stream, layer, {"X", "Y", "Z"}), all_of(stream, layer, {"R", "G", "B"})})
        if (!xyz.empty()) return {Kind::kVector, xyz};
    for (const auto& xy : {all_of(stream, layer, {"dx", "dy"}), all_of(stream, layer, {"X", "Y"})})
        if (!xy.empty()) return {Kind::kDirection, xy};
    if (auto uv = all_of(stream, layer, {"U", "V"}); !uv.empty()) return {Kind::kCoordinates, uv};
    return {is_depth(builder, first) ? Kind::kDepth : Kind::kGrey, {first}};
}

// Colour where there is some, else the first that there is.
Shown what_to_show(const Builder& builder, const Stream& stream) {
    if (stream.channels.empty()) fail(ErrorKind::kGraph, "the input has no channels");
    const std::vector<std::string> names = stream.names();
    std::vector<std::string> layers = layers_of(names);
    layers.insert(layers.begin(), "");
    for (const std::string& layer : layers)
        if (auto colour = find_colour_of(stream, layer)) return *colour;
    const StreamChannel& first = stream.channels[rgba_order(names).front()];
    if (!first.cryptomatte) return find_data(builder, stream, first);
    Shown out{Kind::kCryptomatte, {}};
    for (const ValueRef value : cryptomattes_of(stream).front().values()) {
        out.channels.push_back(first);
        out.channels.back().value = value;
    }
    return out;
}

struct FalseColor {
    static constexpr Info info{
        "falsecolor",
        "Any image as a picture to look at: colour as a display shows it, all else in false colours."};

    struct Params {
        Input in;
        std::optional<std::array<double, 2>> range;
        Referred referred = Referred::kScene;

        static constexpr auto fields = declare(
            input(
                &Params::in, "in",
                "What to show: its colour, else its first layer. Vectors become R G B around grey, depth is "
                "light where it is near, ids have a colour each.",
                any_channels()),
            field(&Params::range, "range",
                  "What is shown black and white; absent: the frame's least and largest sample, or 0 and 1 "
                  "where "
                  "all lie between."),
            field(&Params::referred, "referred", "What colour is made for."));
    };
    static constexpr std::array outputs{"R", "G", "B"};

    static void check(const Params& p, Check& c) {
        if (p.range && (*p.range)[0] >= (*p.range)[1])
            c.error("range", "it must be two numbers, the smaller first");
    }

    explicit FalseColor(const Params& p) : params(p) {}

    Stream expand(Builder& builder) const {
        const Stream in = builder.input(params.in);
        const Shown shown = what_to_show(builder, in);
        return shown.kind == Kind::kColour ? show_colour(builder, in, shown) : show_data(builder, in, shown);
    }

    const Params params;

private:
    Stream show_colour(Builder& builder, const Stream& in, const Shown& shown) const {
        static constexpr std::array kNames{"R", "G", "B", "A"};
        Stream colour = in;
        colour.channels.clear();
        for (std::size_t i = 0; i < shown.channels.size(); ++i)
            colour.set(kNames[i], shown.channels[i].value);
        if (params.referred == Referred::kScene)
            colour = convert_colour(builder, colour, builder.colors().display("scene_linear", "", ""),
                                    {Nature::For::kScene, Nature::For::kDisplay});
        return colour.find("A") ? add(builder, std::make_shared<const OverBoard>(), colour, {}) : colour;
    }

    Stream show_data(Builder& builder, const Stream& in, const Shown& shown) const {
        Stream data = in;
        data.channels.clear();
        for (std::size_t i = 0; i < shown.channels.size(); ++i) {
            StreamChannel c = shown.channels[i];
            if (!c.exact()) c.value = as_number(builder, c, in.window);
            data.set(std::to_string(i), c);
        }
        const bool measured = !params.range && shown.kind != Kind::kId && shown.kind != Kind::kCryptomatte;
        const Stream range =
            measured ? add_operation(builder, Extremes{}, {data})
                     : add_operation(builder, Fixed{params.range.value_or(std::array{0.0, 1.0})}, {});
        return add(builder, std::make_shared<const Paint>(shown.kind, measured), data, {Link(range, {})});
    }

    // An operation from all channels to R G B.
    static Stream add(Builder& builder, const std::shared_ptr<const Operation>& operation, const Stream& in,
                      const std::vector<Link>& more) {
        std::vector<Link> links{{in, {}}};
        for (const StreamChannel& c : in.channels) links[0].values.push_back(c.value);
        links.insert(links.end(), more.begin(), more.end());
        Stream out = in;
        out.channels.clear();
        out.window = result_window(*operation, links, outputs.size());
        const auto values = builder.add(operation, std::move(links), out.window, outputs.size());
        for (std::size_t c = 0; c < outputs.size(); ++c) out.set(outputs[c], values[c]);
        return out;
    }
};

}  // namespace

KEYLINE_NODE(falsecolor, FalseColor)

}  // namespace keyline
