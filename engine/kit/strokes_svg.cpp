// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/strokes_svg.h"

#include "engine/base/text.h"
#include "engine/kit/bezier.h"
#include "engine/kit/outline.h"
#include "engine/simd/elementary.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace keyline {

namespace {

// sRGB, as "#rrggbb".
std::string hexadecimal(const Color& color) {
    const auto coded = [](double linear) {
        const double v = std::clamp(linear, 0.0, 1.0);
        const double s = v <= 0.0031308 ? 12.92 * v : 1.055 * elementary::pow(v, 1 / 2.4) - 0.055;
        return static_cast<int>(std::floor(s * 255 + 0.5));
    };
    return fmt::format("#{:02x}{:02x}{:02x}", coded(color.r), coded(color.g), coded(color.b));
}

// Hundredths of a pixel, without zeros that say nothing.
std::string number(double d) {
    std::string out = fmt::format("{:.2f}", d);
    out.erase(out.find_last_not_of('0') + 1);
    if (out.back() == '.') out.pop_back();
    return out == "-0" ? "0" : out;
}

std::string at(const CurvePoint& p) { return number(p.x) + "," + number(p.y); }

std::string curve(const std::vector<CurvePoint>& points, bool closed, double tolerance) {
    std::string out = "M" + at(points.front());
    for (const Bezier& b : fit_beziers(points, closed, tolerance))
        out += fmt::format(" C{} {} {}", at(b[0]), at(b[1]), at(b[2]));
    return closed ? out + " Z" : out;
}

std::string path_of(const Stroke& s, const SvgStyle& style) {
    std::vector<CurvePoint> points;
    if (style.width == SvgStyle::Width::kStroke) {
        for (const StrokeVertex& v : s.vertices) points.push_back({v.x, v.y});
        return curve(points, s.closed, style.tolerance);
    }
    std::string out;
    for (const Loop& loop : outline_of(s)) {
        points.clear();
        for (const FixedPoint& p : loop)
            points.push_back({static_cast<double>(p.x) / kFixedOne, static_cast<double>(p.y) / kFixedOne});
        out += (out.empty() ? "" : " ") + curve(points, true, style.tolerance);
    }
    return out;
}

// The mean along the way.
double mean(const Stroke& s, double StrokeVertex::*what) {
    double sum = 0;
    for (const StrokeVertex& v : s.vertices) sum += v.*what;
    return sum / static_cast<double>(s.vertices.size());
}

class SvgWriter {
public:
    SvgWriter(const Strokes& strokes, const SvgStyle& style) : strokes_(strokes), style_(style) {}

    std::string text() {
        const Rect& d = strokes_.display;
        out_ = fmt::format(R"(<?xml version="1.0" encoding="UTF-8"?>
<svg xmlns="http://www.w3.org/2000/svg" xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape")"
                           R"( width="{}" height="{}" viewBox="{} {} {} {}">)",
                           d.width(), d.height(), d.x0, d.y0, d.width(), d.height());
        // Inkscape has the topmost layer last, as SVG draws; strokes come with the topmost first.
        std::vector<std::string> layers = layer_names();
        std::ranges::reverse(layers);
        for (const std::string& layer : layers) add_layer(layer);
        return out_ + "\n</svg>\n";
    }

private:
    std::string name(uint32_t id) const {
        const auto it = strokes_.names.find(id);
        if (it != strokes_.names.end() && !it->second.empty()) return it->second;
        return id == 0 ? "" : fmt::format("{:08x}", id);
    }

    std::string layer_of(const Stroke& s) const {
        if (style_.layers == SvgStyle::Layers::kKind) return word_of(s.kind);
        const std::string owner = name(s.near);
        return owner.empty() ? "nobody" : owner;
    }

    std::vector<std::string> layer_names() const {
        std::vector<std::string> out;
        for (const Stroke& s : strokes_.strokes)
            if (std::string layer = layer_of(s); std::ranges::find(out, layer) == out.end())
                out.push_back(std::move(layer));
        return out;
    }

    void add_layer(const std::string& layer) {
        out_ += fmt::format("\n<g inkscape:groupmode=\"layer\" inkscape:label=\"{}\">", for_xml(layer));
        for (std::size_t i = strokes_.strokes.size(); i-- > 0;)
            if (layer_of(strokes_.strokes[i]) == layer) add_path(strokes_.strokes[i], i);
        out_ += "\n</g>";
    }

    void add_path(const Stroke& s, std::size_t index) {
        const std::string d = path_of(s, style_);
        if (d.empty()) return;
        const std::string color = hexadecimal(s.color.value_or(style_.color)),
                          opacity = number(mean(s, &StrokeVertex::opacity));
        out_ += fmt::format("\n<path id=\"stroke{}\" data-kind=\"{}\" data-owner=\"{}\" data-behind=\"{}\" ",
                            index, word_of(s.kind), for_xml(name(s.near)), for_xml(name(s.far)));
        if (style_.width == SvgStyle::Width::kOutline)
            out_ += fmt::format("fill=\"{}\" fill-opacity=\"{}\" fill-rule=\"nonzero\" d=\"{}\"/>", color,
                                opacity, d);
        else
            out_ += fmt::format(
                "fill=\"none\" stroke=\"{}\" stroke-opacity=\"{}\" stroke-width=\"{}\" "
                "stroke-linecap=\"round\" stroke-linejoin=\"round\" d=\"{}\"/>",
                color, opacity, number(mean(s, &StrokeVertex::width)), d);
    }

    const Strokes& strokes_;
    const SvgStyle& style_;
    std::string out_;
};

}  // namespace

std::string strokes_svg(const Strokes& strokes, const SvgStyle& style) {
    return SvgWriter(strokes, style).text();
}

}  // namespace keyline
