// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/bend.h"
#include "engine/kit/levels.h"
#include "engine/kit/line_points.h"
#include "engine/kit/object_ids.h"
#include "engine/kit/point_chains.h"
#include "engine/kit/stroke_index.h"
#include "engine/kit/strokes.h"
#include "engine/node/node_adaptor.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace keyline {

namespace {

enum class Mode { kEdge, kRidge, kValley, kLevel };

constexpr auto words(Mode) {
    return std::array{Word<Mode>{"edge", Mode::kEdge, "where values change most"},
                      Word<Mode>{"ridge", Mode::kRidge, "along the crests of values"},
                      Word<Mode>{"valley", Mode::kValley, "along their lowest floors"},
                      Word<Mode>{"level", Mode::kLevel, "where values pass a level"}};
}

// What strokes are made with, whatever they are traced from.
struct Style {
    StrokeKind kind = StrokeKind::kCrease;
    double low = 0, high = 0;
    bool soft = true;
    Rect display, window, extent;
};

constexpr double kReach = 4;       // pixels of a line that its curvature is told from
constexpr double kEpsilon = 0.15;  // how far off a point may be, on coverage of 64 samples

Stroke stroke_through(const std::vector<MapPoint>& points, bool closed, const Style& style) {
    Stroke out;
    out.kind = style.kind;
    out.closed = closed;
    const std::vector<Bend> bends = bends_of(points, closed, kReach);
    for (std::size_t i = 0; i < points.size(); ++i) {
        StrokeVertex v;
        v.x = points[i].x;
        v.y = points[i].y;
        v.curvature = bends[i].curvature;
        v.epsilon = kEpsilon;
        out.vertices.push_back(v);
    }
    return out;
}

void turn(Stroke& stroke) {
    std::ranges::reverse(stroke.vertices);
    for (StrokeVertex& v : stroke.vertices) v.curvature = -v.curvature;
}

// Whether a line that ends there has left the picture.
bool is_at_rim(const StrokeVertex& v, const Rect& extent) {
    constexpr double kNear = 1.5;  // the outermost pixel has no maximum, and a point may lie 0.6 aside
    return std::min({v.x - extent.x0, v.y - extent.y0, extent.x1 - v.x, extent.y1 - v.y}) < kNear + 0.6;
}

// Lines that are there already, by place.
struct LinesThere {
    static constexpr const char* kind = "lines by place";
    static constexpr double kBeside = 2.5;  // pixels

    StrokeIndex index{kBeside};
    std::size_t bytes() const { return index.bytes(); }
    friend bool operator==(const LinesThere&, const LinesThere&) = default;
};

struct FindLinesThere {
    struct Params {
        Input strokes;
        static constexpr auto fields = declare(input(&Params::strokes, "strokes", "", data<Strokes>()));
    };
    static LinesThere derive(const Inputs& in) {
        LinesThere out;
        for (const Stroke& s : in.datum<Strokes>(0).strokes) out.index.add(s);
        return out;
    }
    static std::size_t datum_bytes() { return kUsualStrokes; }
};

struct NoLinesThere {
    struct Params {
        static constexpr auto fields = declare();
    };
    static LinesThere derive(const Inputs&) { return {}; }
    static std::size_t datum_bytes() { return 0; }
};

// The points of a frame, linked.
struct LinkPoints {
    struct Params {
        Input points, except;
        static constexpr auto fields = declare(input(&Params::points, "points", "", any_channels()),
                                               input(&Params::except, "except", "", data<LinesThere>()));
    };
    using State = std::vector<LinePoint>;
    using Partial = std::vector<LinePoint>;

    static State start(const Rect&) { return {}; }
    Partial map(const State&, const Inputs& in, const Rect& block, Scratch&) const {
        std::vector<LinePoint> points = points_in(in.slot(0), block);
        const StrokeIndex& there = in.datum<LinesThere>(1).index;
        std::erase_if(points, [&](const LinePoint& p) {
            const MapPoint at = place(p);
            return there.has({at.x, at.y, double{p.tx}, double{p.ty}, StrokeKind::kUser});
        });
        return points;
    }
    static void fold(State& state, Partial&& found) { state.insert(state.end(), found.begin(), found.end()); }
    Strokes finish(State state) const {
        Strokes out{style.display, style.window, {}, {}};
        for (const PointChain& chain : link_points(std::move(state), directed, style.high))
            out.strokes.push_back(stroke_of(chain));
        arrange(out);
        return out;
    }

    static constexpr std::size_t kBusy = 50;  // a pixel in so many is on a line of a busy picture
    static std::size_t state_bytes(const Rect& window) {
        return static_cast<std::size_t>(window.area()) / kBusy * 3 * sizeof(LinePoint);
    }
    static std::size_t partial_bytes(const Rect& block) {
        return static_cast<std::size_t>(block.area()) * sizeof(LinePoint);
    }
    static std::size_t datum_bytes(const Rect& window) {
        return static_cast<std::size_t>(window.area()) / kBusy * sizeof(StrokeVertex);
    }

    const Style style;
    const bool edges;     // which have a right: that of their larger values
    const bool directed;  // whether each point knows which that is

private:
    static MapPoint place(const LinePoint& p) { return {p.x + 0.5 + double{p.dx}, p.y + 0.5 + double{p.dy}}; }

    Stroke stroke_of(const PointChain& chain) const {
        std::vector<MapPoint> places;
        for (const LinePoint& p : chain.points) {
            MapPoint& at = places.emplace_back(place(p));
            (p.by_column ? at.y : at.x) += double{p.aside};
        }
        Stroke out = stroke_through(places, chain.closed, style);
        out.near = out.far = owner_of(chain);
        grade(chain, out);
        if (is_backwards(chain, places)) turn(out);
        if (is_at_rim(out.vertices.front(), style.extent)) out.ends[0] = StrokeEnd::kRim;
        if (is_at_rim(out.vertices.back(), style.extent)) out.ends[1] = StrokeEnd::kRim;
        return out;
    }

    static uint32_t owner_of(const PointChain& chain) { return chain.points.front().owner; }

    // How sure the line is along its way, and so how much of it there is.
    void grade(const PointChain& chain, Stroke& stroke) const {
        constexpr int kAround = 3;
        const std::vector<double> strengths = strengths_along(chain, kAround);
        for (std::size_t i = 0; i < strengths.size(); ++i) {
            StrokeVertex& v = stroke.vertices[i];
            const double range = style.high - style.low;
            v.strength = range > 0 ? std::clamp((strengths[i] - style.low) / range, 0.0, 1.0) : 1;
            if (style.soft) v.opacity = v.width = v.strength;
        }
    }

    // An edge has its larger values on the right, by the vote of its points; a ridge, which has no right,
    // begins at its upper end.
    bool is_backwards(const PointChain& chain, const std::vector<MapPoint>& places) const {
        if (!edges)
            return std::pair(places.back().y, places.back().x) <
                   std::pair(places.front().y, places.front().x);
        double along = 0;
        for (std::size_t i = 0; i + 1 < places.size(); ++i)
            along += (places[i + 1].x - places[i].x) * double{chain.points[i].tx} +
                     (places[i + 1].y - places[i].y) * double{chain.points[i].ty};
        return along < 0;
    }
};

// The lines of one level: the borders of what reaches it.
struct LinkLevels {
    struct Params {
        Input levels;
        static constexpr auto fields = declare(input(&Params::levels, "levels", "", any_channels()));
    };
    using State = std::vector<Crossing>;
    using Partial = std::vector<Crossing>;

    static State start(const Rect&) { return {}; }
    static Partial map(const State&, const Inputs& in, const Rect& block, Scratch&) {
        return levels_in(in.slot(0), block);
    }
    static void fold(State& state, Partial&& found) { state.insert(state.end(), found.begin(), found.end()); }
    Strokes finish(State state) const {
        Strokes out{style.display, style.window, {}, {}};
        const BorderMap borders = link_borders(std::move(state), style.extent);
        for (const Border& border : borders.borders) {
            std::vector<MapPoint> places;
            for (const int c : border.crossings) places.push_back(borders.at(c));
            Stroke stroke = stroke_through(places, border.closed, style);
            stroke.ends = {StrokeEnd::kRim, StrokeEnd::kRim};
            if (border.left == 1) turn(stroke);
            out.strokes.push_back(std::move(stroke));
        }
        arrange(out);
        return out;
    }
    static std::size_t state_bytes(const Rect& window) {
        return static_cast<std::size_t>(window.area()) / LinkPoints::kBusy * 3 * sizeof(Crossing);
    }
    static std::size_t partial_bytes(const Rect& block) {
        return static_cast<std::size_t>(2 * block.area()) * sizeof(Crossing);
    }
    static std::size_t datum_bytes(const Rect& window) { return LinkPoints::datum_bytes(window); }

    const Style style;
};

struct Trace {
    static constexpr Info info{"trace", "Lines along edges, crests or levels of a channel, as strokes."};

    struct Params {
        Input in;
        Mode mode = Mode::kEdge;
        double sigma = 1;
        std::optional<double> low, high, level;
        StrokeKind kind = StrokeKind::kCrease;
        bool soft = true;
        std::optional<Input> owner;
        std::string layer;
        std::optional<Input> except, normal;

        static constexpr auto fields = declare(
            input(&Params::in, "in",
                  "One channel; for edges also the dx, dy and magnitude of gradient, which are taken as they "
                  "are; either sign of them, as that of several channels has none."),
            field(&Params::mode, "mode", "What lines run along."),
            field(&Params::sigma, "sigma",
                  "Standard deviation of the blur under which one channel is looked at.",
                  px(0.5, 10).tested_to(2)),
            field(&Params::low, "low",
                  "Points above this may be part of a line: of an edge the slope a pixel, of a ridge or "
                  "valley the "
                  "bend across it, a pixel².",
                  at_least(0).tested_to(1)),
            field(&Params::high, "high", "A line has a point of at least this; 3 × low when absent.",
                  at_least(0).tested_to(1)),
            field(&Params::level, "level", "The value whose lines are traced; for levels only."),
            field(&Params::kind, "kind", "What the strokes are called."),
            field(
                &Params::soft, "soft",
                "Whether width and opacity grow from 0 at low to 1 at high along the line, so that one that "
                "fades in does not pop up."),
            input(
                &Params::owner, "owner",
                "A Cryptomatte or ids: lines belong to the object that they are on, and end where it does."),
            field(&Params::layer, "layer", "The Cryptomatte's name; empty where there is but one.")
                .naming(Naming::kCryptomatte),
            input(&Params::except, "except",
                  "Strokes that have their lines already: what runs along one is left out.", data<Strokes>()),
            input(&Params::normal, "normal",
                  "Averaged normals, for edges of what has one sample a pixel, as steps in depth: they tell "
                  "where "
                  "between two pixels one surface ends before the other.",
                  named("X", "Y", "Z")));
    };
    using Gives = Strokes;

    static void check(const Params& p, Check& c) {
        if ((p.mode == Mode::kLevel) != p.level.has_value())
            c.error("level", p.level ? "'level' is for the mode 'level'"
                                     : "'level' is missing; the mode asks for one");
        if ((p.mode == Mode::kLevel) == p.low.has_value())
            c.error("low",
                    p.low ? "a level has no thresholds" : "'low' is missing; only the mode 'level' has none");
        if (p.mode == Mode::kLevel && (p.owner || p.except))
            c.error(p.owner ? "owner" : "except", "lines of a level have no owner and no exceptions",
                    "leave it out");
        if (p.mode != Mode::kEdge && p.normal)
            c.error("normal", "'normal' places edges; the mode is another", "leave it out");
        if (p.low && p.high && *p.low > *p.high)
            c.error("low",
                    fmt::format("'low' is {}; it must not be above 'high', which is {}", *p.low, *p.high));
    }

    explicit Trace(Params p) : params(std::move(p)) {}

    Stream expand(Builder& builder) const {
        Stream in = builder.input(params.in);
        const bool gradient = params.mode == Mode::kEdge && in.find("dx") && in.find("dy");
        const Takes takes = gradient ? named("dx", "dy", "magnitude") : matte();
        const double low = params.low.value_or(0);
        const Style style{params.kind, low,        params.high.value_or(3 * low), params.soft, in.display,
                          in.window,   in.extent()};
        std::vector<Link> links{{in, take_channels(builder, in, takes)}};
        if (params.mode == Mode::kLevel)
            return add_operation(
                builder, LinkLevels{style},
                {found(builder, std::make_shared<const FindLevels>(params.sigma, *params.level), in, links)});
        ObjectIds ids;
        links.emplace_back();
        if (params.owner) {
            const Stream owner = builder.input(*params.owner);
            ids = find_object_ids(builder, owner, params.layer);
            links[1] = {owner, ids.values};
        }
        links.emplace_back();
        if (params.normal) {
            const Stream normal = builder.input(*params.normal);
            links[2] = {normal, take_channels(builder, normal, named("X", "Y", "Z"))};
        }
        const auto find =
            std::make_shared<const FindLinePoints>(feature(), gradient ? 0 : params.sigma, ids.integers, low);
        const Stream there = params.except
                                 ? add_operation(builder, FindLinesThere{}, {builder.input(*params.except)})
                                 : add_operation(builder, NoLinesThere{}, {});
        return add_operation(
            builder, LinkPoints{style, params.mode == Mode::kEdge, params.mode == Mode::kEdge && !gradient},
            {found(builder, find, in, links), there});
    }

    const Params params;

private:
    LineFeature feature() const {
        return params.mode == Mode::kEdge    ? LineFeature::kEdge
               : params.mode == Mode::kRidge ? LineFeature::kRidge
                                             : LineFeature::kValley;
    }

    template <class Find>
    static Stream found(Builder& builder, const std::shared_ptr<const Find>& find, Stream in,
                        std::vector<Link> links) {
        in.channels.clear();
        in.window = result_window(*find, links, Find::kOutputs);
        for (const ValueRef v : builder.add(find, std::move(links), in.window, Find::kOutputs))
            in.channels.push_back({fmt::format("{}", v.output), v, Holds::kData});
        return in;
    }
};

}  // namespace

KEYLINE_NODE(trace, Trace)

}  // namespace keyline
