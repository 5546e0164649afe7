// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/ink.h"
#include "engine/node/node_adaptor.h"

#include <algorithm>

namespace keyline {

namespace {

enum class Overlap { kUnion, kOver };

constexpr auto words(Overlap) {
    return std::array{Word<Overlap>{"union", Overlap::kUnion,
                                    "as dark as the darkest of them: crossings don't show in pale ink"},
                      Word<Overlap>{"over", Overlap::kOver, "each over those after it, as films lie"}};
}

struct MakeInk {
    struct Params {
        Input strokes;
        static constexpr auto fields = declare(input(&Params::strokes, "strokes", "", data<Strokes>()));
    };
    Ink derive(const Inputs& in) const { return ink_of(in.datum<Strokes>(0), window, color); }
    // A drawing of 60,000 pixels' length takes 0.7 bytes a pixel of a 4K frame.
    std::size_t datum_bytes() const { return static_cast<std::size_t>(window.area()); }

    Rect window;
    Color color;
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
        for (int y = rect.y0; y < rect.y1; ++y) {
            for (auto& channel : row) std::ranges::fill(channel, 0.0F);
            for (const InkSpan& span : ink.row(y)) lay(ink, span, rect, row);
            if (overlap == Overlap::kUnion) unite(row);
            for (std::size_t c = 0; c < out.size(); ++c) std::ranges::copy(row[c], out[c].row(y));
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
        std::optional<Input> like;

        static constexpr auto fields = declare(
            input(&Params::in, "in", "The strokes.", data<Strokes>()),
            field(&Params::color, "color",
                  "Of strokes that have none of their own: scene-linear, or sRGB as \"#rrggbb\".",
                  at_least(0).tested_to(8)),
            field(&Params::overlap, "overlap", "What becomes of strokes over each other."),
            input(&Params::like, "like", "An image whose windows to take instead of the strokes' frame."));
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
        const Stream ink = add_operation(builder, MakeInk{stream.window, params.color}, {stream});
        return add_operation(builder, LayInk{params.overlap}, {ink});
    }

    const Params params;
};

}  // namespace

KEYLINE_NODE(draw, DrawStrokes)

}  // namespace keyline
