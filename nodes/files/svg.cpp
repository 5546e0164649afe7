// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/io/text_file.h"
#include "engine/kit/strokes_svg.h"
#include "engine/node/node_adaptor.h"

namespace keyline {

constexpr auto words(SvgStyle::Layers) {
    using enum SvgStyle::Layers;
    return std::array{Word<SvgStyle::Layers>{"kind", kKind, "outlines, creases, …"},
                      Word<SvgStyle::Layers>{"object", kObject, "each object's lines"}};
}

constexpr auto words(SvgStyle::Width) {
    using enum SvgStyle::Width;
    return std::array{
        Word<SvgStyle::Width>{"outline", kOutline, "filled shapes, which show it as it is along the stroke"},
        Word<SvgStyle::Width>{"stroke", kStroke, "paths with the stroke's mean width, easy to change"},
        Word<SvgStyle::Width>{"split", kSplit,
                              "paths that are cut where the width changes, for programs in which a path has "
                              "one: Blender's Grease Pencil"}};
}

namespace {

class WriteSvg final : public DataSink {
public:
    WriteSvg(std::filesystem::path file, const SvgStyle& style) : file_(std::move(file)), style_(style) {}
    void write(const std::shared_ptr<const Datum>& datum) override {
        write_text_file(file_, strokes_svg(datum_as<Strokes>(*datum), style_));
    }

private:
    std::filesystem::path file_;
    SvgStyle style_;
};

struct Svg {
    static constexpr Info info{"svg", "Writes strokes as SVG, in layers as Inkscape has them."};

    struct Params {
        Input in;
        FileName file;
        SvgStyle::Layers layers = SvgStyle::Layers::kKind;
        SvgStyle::Width width = SvgStyle::Width::kOutline;
        Color color;
        double tolerance = 0.2;

        static constexpr auto fields = declare(
            input(&Params::in, "in", "The strokes.", data<Strokes>()),
            field(&Params::file, "file", "The file; a run of # stands for the frame number.").required(),
            field(&Params::layers, "layers", "What the layers are."),
            field(&Params::width, "width", "How the width of strokes is kept."),
            field(&Params::color, "color", "Of strokes that have none of their own.", between(0, 1)),
            field(&Params::tolerance, "tolerance", "How far the curves may be from the strokes.",
                  px(0.01, 10)));
    };

    explicit Svg(Params p) : params(std::move(p)) {}

    void write(Builder& builder) const {
        SinkRequest request;
        request.stream = builder.input(params.in);
        request.file = params.file.at(builder.frame());
        request.create_for_data = [file = request.file, style = style()] {
            return std::make_unique<WriteSvg>(file, style);
        };
        builder.add_sink(std::move(request));
    }

    const Params params;

private:
    SvgStyle style() const { return {params.layers, params.width, params.color, params.tolerance}; }
};

}  // namespace

KEYLINE_NODE(svg, Svg)

}  // namespace keyline
