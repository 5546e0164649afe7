// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/cryptomatte.h"
#include "engine/kit/ink.h"
#include "engine/kit/line_values.h"
#include "engine/kit/stroke_samples.h"
#include "engine/node/node_adaptor.h"
#include "engine/node/pixel_loop.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace keyline {

namespace {

enum class Overlap { kUnion, kOver };

constexpr auto words(Overlap) {
    return std::array{Word<Overlap>{"union", Overlap::kUnion,
                                    "as dark as the darkest of them: crossings don't show in pale ink"},
                      Word<Overlap>{"over", Overlap::kOver, "each over those after it, as films lie"}};
}

enum class LineChannel { kId, kU, kV, kWidth, kDepth };

constexpr auto words(LineChannel) {
    using enum LineChannel;
    return std::array{
        Word<LineChannel>{"id", kId, "which of the strokes it is, from 1 on, a whole number"},
        Word<LineChannel>{"u", kU, "how far along the stroke, 0 to 1"},
        Word<LineChannel>{"v", kV, "how far across it, -1 to 1 on its owner's side"},
        Word<LineChannel>{"width", kWidth, "how wide the stroke is there, in pixels"},
        Word<LineChannel>{"Z", kDepth, "the depth of its owner there, 0 where it is not known"}};
}

struct MakeInk {
    struct Params {
        Input strokes, red, green, blue;
        static constexpr auto fields = declare(input(&Params::strokes, "strokes", "", data<Strokes>()),
                                               input(&Params::red, "red", "", data<StrokeSamples>()),
                                               input(&Params::green, "green", "", data<StrokeSamples>()),
                                               input(&Params::blue, "blue", "", data<StrokeSamples>()));
    };
    Ink derive(const Inputs& in) const {
        const auto& strokes = in.datum<Strokes>(0);
        std::vector<Ink::Colour> colours;
        for (const Stroke& s : strokes.strokes) {
            const Color c = s.color.value_or(color);
            colours.push_back({static_cast<float>(c.r), static_cast<float>(c.g), static_cast<float>(c.b)});
        }
        for (int channel = 0; tinted && channel < 3; ++channel)
            tint(in.datum<StrokeSamples>(1 + channel).samples, index(channel), colours);
        return ink_of(strokes, window, std::move(colours));
    }
    // A drawing of 60,000 pixels' length takes 0.7 bytes a pixel of a 4K frame.
    std::size_t datum_bytes() const { return static_cast<std::size_t>(window.area()); }

    Rect window;
    Color color;
    bool tinted = false;

private:
    // By the mean along each stroke, so that a line has one colour; what is no number changes nothing.
    static void tint(const std::vector<StrokeSample>& samples, std::size_t channel,
                     std::vector<Ink::Colour>& colours) {
        for (std::size_t i = 0; i < samples.size();) {
            const uint32_t stroke = samples[i].stroke;
            double sum = 0;
            int count = 0;
            for (; i < samples.size() && samples[i].stroke == stroke; ++i)
                if (std::isfinite(samples[i].value)) {
                    sum += double{samples[i].value};
                    ++count;
                }
            if (count > 0) colours[stroke][channel] *= static_cast<float>(sum / count);
        }
    }
};

struct LayInk {
    struct Params {
        Input ink;
        static constexpr auto fields = declare(input(&Params::ink, "ink", "", data<Ink>()));
    };
    static constexpr std::array outputs{"R", "G", "B", "A"};

    void compute(const Inputs& in, Outputs out, Scratch& scratch) const {
        const Ink& ink = in.datum<Ink>(0);
        const Rect& rect = out[0].rect;
        const auto n = static_cast<std::size_t>(rect.width());
        std::array<std::span<float>, 5> row;
        for (auto& channel : row) channel = scratch.floats(n);
        for (auto& channel : row) std::ranges::fill(channel, 0.0F);
        for (int y = rect.y0; y < rect.y1; ++y) {
            int from = rect.x1, to = rect.x0;  // where there are strokes
            for (const InkSpan& span : ink.row(y)) {
                if (span.x1 <= rect.x0 || span.x0 >= rect.x1) continue;
                from = std::min(from, std::max(span.x0, rect.x0));
                to = std::max(to, std::min(span.x1, rect.x1));
                lay(ink, span, rect, row);
            }
            Row inked;
            for (std::size_t c = 0; c < row.size() && from < to; ++c)
                inked[c] = row[c].subspan(index(from - rect.x0), index(to - from));
            if (overlap == Overlap::kUnion) unite(inked);
            for (std::size_t c = 0; c < out.size(); ++c)
                std::ranges::transform(row[c], out[c].row(y), with_one_nan);
            for (const std::span<float> channel : inked) std::ranges::fill(channel, 0.0F);
        }
    }

    Overlap overlap;

private:
    using Row = std::array<std::span<float>, 5>;  // R G B A of what lies over each other, and the most opaque

    static void lay(const Ink& ink, const InkSpan& span, const Rect& rect, const Row& row) {
        const Ink::Colour& colour = ink.colours[span.stroke];
        for (int x = std::max(span.x0, rect.x0); x < std::min(span.x1, rect.x1); ++x) {
            const std::size_t from = span.first + (span.even ? 0 : static_cast<std::size_t>(x - span.x0));
            const auto to = static_cast<std::size_t>(x - rect.x0);
            const float cover = ink.covers[from], seen = (1 - row[3][to]) * cover;
            for (std::size_t c = 0; c < 3; ++c) row[c][to] += seen * colour[c];
            row[3][to] += seen;
            row[4][to] = std::max(row[4][to], cover);
        }
    }

    // The colours stay as they mix.
    static void unite(const Row& row) {
        for (std::size_t i = 0; i < row[3].size(); ++i) {
            if (!(row[3][i] > row[4][i])) continue;
            const float share = row[4][i] / row[3][i];
            for (std::size_t c = 0; c < 3; ++c) row[c][i] *= share;
            row[3][i] = row[4][i];
        }
    }
};

struct DrawStrokes {
    static constexpr Info info{"draw", "Strokes as pixels: what each covers, exactly, in its colour."};

    struct Params {
        Input in;
        Color color;
        Overlap overlap = Overlap::kUnion;
        std::optional<Input> tint, like, owner;
        std::string layer;
        std::vector<LineChannel> channels;

        static constexpr auto fields = declare(
            input(&Params::in, "in", "The strokes.", data<Strokes>()),
            field(&Params::color, "color",
                  "Of strokes that have none of their own: scene-linear, or sRGB as \"#rrggbb\".",
                  at_least(0).tested_to(8)),
            field(&Params::overlap, "overlap", "What becomes of strokes over each other."),
            input(
                &Params::tint, "tint",
                "Multiplied into the colour: an image, as an albedo, looked up beside each stroke on what it "
                "belongs to. A stroke has one colour along its way.",
                colour_without_alpha()),
            input(&Params::like, "like", "An image whose windows to take instead of the strokes' frame."),
            input(
                &Params::owner, "owner",
                "The image with the Cryptomatte that the strokes' objects are of: the drawing gets a channel "
                "'edge' and a Cryptomatte of the same name, so that a cryptomatte node after this one picks "
                "lines by their objects' names. Only the names are read.",
                any_channels()),
            field(&Params::layer, "layer", "The Cryptomatte's name; empty where there is but one.")
                .naming(Naming::kCryptomatte),
            field(&Params::channels, "channels",
                  "What else to tell of each pixel's line, as channels 'line.id', 'line.u', ...; of several "
                  "that of the one that covers most of it."));
    };
    static constexpr std::array outputs{"R", "G", "B", "A"};

    explicit DrawStrokes(Params p) : params(std::move(p)) {}

    Stream expand(Builder& builder) const {
        Stream stream = builder.input(params.in);
        if (params.like) {
            const Stream like = builder.input(*params.like);
            stream.display = like.display;
            stream.window = like.window;
        }
        stream.window = stream.extent();
        const std::array<Stream, 3> tint = tint_beside(builder, stream);
        const Stream ink =
            add_operation(builder, MakeInk{stream.window, params.color, params.tint.has_value()},
                          {stream, tint[0], tint[1], tint[2]});
        Stream out = add_operation(builder, LayInk{params.overlap}, {ink});
        if (params.owner || !params.channels.empty()) add_lines(builder, stream, ink, out);
        return out;
    }

    const Params params;

private:
    // What the lines are, to what they look like.
    void add_lines(Builder& builder, const Stream& strokes, const Stream& ink, Stream& out) const {
        const Stream places = add_operation(builder, FindLinePlaces{}, {strokes});
        const Stream lines = add_operation(builder, LayLineValues{}, {ink, places});
        const auto value = [&](LayLineValues::Output o) { return lines.channels[o].value; };
        if (params.owner) {
            const Cryptomatte of = find_cryptomatte(builder, builder.input(*params.owner), params.layer);
            out.set("edge", value(LayLineValues::kEdge));
            add_cryptomatte(out, of, {value(LayLineValues::kOwner), value(LayLineValues::kEdge)},
                            value(LayLineValues::kNothing));
        }
        for (const LineChannel channel : params.channels) {
            const bool id = channel == LineChannel::kId;
            out.set({fmt::format("line.{}", word_of(channel)), value(output_of(channel)),
                     id ? Holds::kId : Holds::kData, id});
        }
    }

    static LayLineValues::Output output_of(LineChannel channel) {
        switch (channel) {
            case LineChannel::kId: return LayLineValues::kStroke;
            case LineChannel::kU: return LayLineValues::kU;
            case LineChannel::kV: return LayLineValues::kV;
            case LineChannel::kWidth: return LayLineValues::kWidth;
            case LineChannel::kDepth: break;
        }
        return LayLineValues::kDepth;
    }

    static const char* word_of(LineChannel channel) {
        for (const auto& w : words(channel))
            if (w.value == channel) return w.word;
        return "";
    }

    // Red, green and blue.
    std::array<Stream, 3> tint_beside(Builder& builder, const Stream& strokes) const {
        std::array<Stream, 3> out;
        if (!params.tint) {
            out.fill(add_operation(builder, NoSamples{}, {}));
            return out;
        }
        const Stream image = builder.input(*params.tint);
        const std::vector<ValueRef> values = take_channels(builder, image, colour_without_alpha());
        const Stream beside = add_operation(builder, FindPlacesBeside{}, {strokes});
        for (std::size_t c = 0; c < out.size(); ++c) {
            Stream channel = image;
            channel.channels.clear();
            channel.set("Y", values[c]);
            out[c] = add_operation(builder, SampleBeside{}, {channel, beside});
        }
        return out;
    }
};

}  // namespace

KEYLINE_NODE(draw, DrawStrokes)

}  // namespace keyline
