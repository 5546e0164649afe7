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
#include <limits>
#include <set>

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

std::string shape_of(const Stroke& s, double tolerance) {
    std::vector<CurvePoint> points;
    std::string out;
    for (const Loop& loop : outline_of(s)) {
        points.clear();
        for (const FixedPoint& p : loop)
            points.push_back({static_cast<double>(p.x) / kFixedOne, static_cast<double>(p.y) / kFixedOne});
        out += (out.empty() ? "" : " ") + curve(points, true, tolerance);
    }
    return out;
}

std::string way_of(const Stroke& s, double tolerance) {
    std::vector<CurvePoint> points;
    for (const StrokeVertex& v : s.vertices) points.push_back({v.x, v.y});
    return curve(points, s.closed, tolerance);
}

// The mean along the way.
double mean(const Stroke& s, double StrokeVertex::*what) {
    double sum = 0;
    for (const StrokeVertex& v : s.vertices) sum += v.*what;
    return sum / static_cast<double>(s.vertices.size());
}

// What a part of a stroke may differ by in itself: a share of its width or so many pixels, whichever is more.
constexpr double kPartWidth = 0.25, kPartPixels = 0.3, kPartOpacity = 0.15;
constexpr double kMostSteps = 64;  // between two points

double step_of_width(double widest) { return std::max(kPartPixels, kPartWidth * widest); }

// Whether a row of points has one width and one opacity to the eye.
class Evenness {
public:
    bool holds_with(const StrokeVertex& v) {
        narrowest_ = std::min(narrowest_, v.width);
        widest_ = std::max(widest_, v.width);
        palest_ = std::min(palest_, v.opacity);
        darkest_ = std::max(darkest_, v.opacity);
        return widest_ - narrowest_ <= step_of_width(widest_) && darkest_ - palest_ <= kPartOpacity;
    }

private:
    double narrowest_ = std::numeric_limits<double>::infinity(), widest_ = 0;
    double palest_ = 1, darkest_ = 0;
};

// All along its way, back to the first of a closed one, with more between two that differ.
std::vector<StrokeVertex> finely(const Stroke& s) {
    std::vector<StrokeVertex> out{s.vertices.front()};
    for (std::size_t i = 1; i < s.vertices.size() + (s.closed ? 1 : 0); ++i) {
        const StrokeVertex a = s.vertices[i - 1], &b = s.vertices[i % s.vertices.size()];
        const double apart =
            2 * std::max(std::fabs(b.width - a.width) / step_of_width(std::max(a.width, b.width)),
                         std::fabs(b.opacity - a.opacity) / kPartOpacity);
        const int steps = static_cast<int>(std::min(std::ceil(apart), kMostSteps));
        for (int k = 1; k < steps; ++k) {
            const auto between = [share = static_cast<double>(k) / steps](double from, double to) {
                return from + share * (to - from);
            };
            StrokeVertex v = a;
            v.x = between(a.x, b.x);
            v.y = between(a.y, b.y);
            v.width = between(a.width, b.width);
            v.opacity = between(a.opacity, b.opacity);
            out.push_back(v);
        }
        out.push_back(b);
    }
    return out;
}

// Parts that have one width each, as far as the eye can tell; each begins where the one before ends.
std::vector<Stroke> parts_of(const Stroke& s) {
    const std::vector<StrokeVertex> all = finely(s);
    std::vector<Stroke> out;
    for (std::size_t from = 0; from + 1 < all.size();) {
        Evenness even;
        even.holds_with(all[from]);
        std::size_t to = from + 1;
        for (bool holds = even.holds_with(all[to]); holds && to + 1 < all.size();)
            if ((holds = even.holds_with(all[to + 1]))) ++to;
        out.emplace_back(s);
        out.back().closed = false;
        out.back().vertices.assign(all.begin() + static_cast<std::ptrdiff_t>(from),
                                   all.begin() + static_cast<std::ptrdiff_t>(to) + 1);
        from = to;
    }
    return out.size() == 1 ? std::vector{s} : out;
}

// What an XML name may be made of; bytes of other letters stay.
std::string for_id(std::string text) {
    const auto is_letter = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' ||
               static_cast<signed char>(c) < 0;
    };
    for (char& c : text)
        if (!is_letter(c) && !(c >= '0' && c <= '9') && c != '.' && c != '-') c = '_';
    return text.empty() || !is_letter(text.front()) ? "_" + text : text;
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

    // Inkscape shows a layer's label, Blender its id.
    void add_layer(const std::string& layer) {
        std::string id = for_id(layer);
        while (id.starts_with("stroke") || !ids_.insert(id).second) id.insert(0, "_");
        out_ += fmt::format("\n<g id=\"{}\" inkscape:groupmode=\"layer\" inkscape:label=\"{}\">", for_xml(id),
                            for_xml(layer));
        for (std::size_t i = strokes_.strokes.size(); i-- > 0;)
            if (layer_of(strokes_.strokes[i]) == layer) add_stroke(strokes_.strokes[i], i);
        out_ += "\n</g>";
    }

    void add_stroke(const Stroke& s, std::size_t index) {
        const std::string id = fmt::format("stroke{}", index);
        const std::string what =
            fmt::format("id=\"{}\" data-kind=\"{}\" data-owner=\"{}\" data-behind=\"{}\"", id,
                        word_of(s.kind), for_xml(name(s.near)), for_xml(name(s.far)));
        if (style_.width == SvgStyle::Width::kOutline) return add_shape(s, what);
        const std::vector<Stroke> parts =
            style_.width == SvgStyle::Width::kSplit ? parts_of(s) : std::vector{s};
        if (parts.size() == 1) return add_path(s, what);
        out_ += fmt::format("\n<g {}>", what);
        for (std::size_t i = 0; i < parts.size(); ++i) add_path(parts[i], fmt::format("id=\"{}.{}\"", id, i));
        out_ += "\n</g>";
    }

    void add_shape(const Stroke& s, const std::string& what) {
        const std::string d = shape_of(s, style_.tolerance);
        if (d.empty()) return;
        out_ += fmt::format("\n<path {} fill=\"{}\" fill-opacity=\"{}\" fill-rule=\"nonzero\" d=\"{}\"/>",
                            what, color_of(s), number(mean(s, &StrokeVertex::opacity)), d);
    }

    void add_path(const Stroke& s, const std::string& what) {
        const std::string width = number(mean(s, &StrokeVertex::width));
        if (width == "0") return;
        out_ += fmt::format(
            "\n<path {} fill=\"none\" stroke=\"{}\" stroke-opacity=\"{}\" stroke-width=\"{}\" "
            "stroke-linecap=\"round\" stroke-linejoin=\"round\" d=\"{}\"/>",
            what, color_of(s), number(mean(s, &StrokeVertex::opacity)), width, way_of(s, style_.tolerance));
    }

    std::string color_of(const Stroke& s) const { return hexadecimal(s.color.value_or(style_.color)); }

    const Strokes& strokes_;
    const SvgStyle& style_;
    std::set<std::string> ids_;  // of layers
    std::string out_;
};

}  // namespace

std::string strokes_svg(const Strokes& strokes, const SvgStyle& style) {
    return SvgWriter(strokes, style).text();
}

}  // namespace keyline
