// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "engine/base/api.h"
#include "engine/base/geometry.h"
#include "engine/params/param_types.h"

#include <array>
#include <bit>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

// Lines as an animator draws them, as data: each a row of points with all that is known of it along its way.
//
// What a drawing is made of depends on the order of its strokes, so they stand in one that does not depend on
// how they were found: whoever makes strokes ends with arrange().

namespace KEYLINE_API keyline {

// The order is that of who gives way: where two lines would run along each other, the first stays.
enum class StrokeKind : uint8_t {
    kOutline,
    kOcclusion,
    kFold,
    kIntersection,
    kCrease,
    kRidge,
    kValley,
    kBorder,
    kMaterial,
    kLight,
    kShadow,
    kUser
};

constexpr auto words(StrokeKind) {
    using enum StrokeKind;
    return std::array{Word<StrokeKind>{"outline", kOutline, "an object before nothing or far before another"},
                      Word<StrokeKind>{"occlusion", kOcclusion, "an object before another"},
                      Word<StrokeKind>{"fold", kFold, "an object before itself"},
                      Word<StrokeKind>{"intersection", kIntersection, "where two objects meet"},
                      Word<StrokeKind>{"crease", kCrease, "where a surface bends sharply"},
                      Word<StrokeKind>{"ridge", kRidge, "the middle of a thing, or a channel's crest"},
                      Word<StrokeKind>{"valley", kValley, "the floor of a channel"},
                      Word<StrokeKind>{"border", kBorder, "where a surface ends"},
                      Word<StrokeKind>{"material", kMaterial, "between two materials"},
                      Word<StrokeKind>{"light", kLight, "where light ends"},
                      Word<StrokeKind>{"shadow", kShadow, "where a shadow ends"},
                      Word<StrokeKind>{"user", kUser, "drawn by hand"}};
}

const char* word_of(StrokeKind kind);

// What is at an end of a stroke that is not closed.
enum class StrokeEnd : uint8_t { kEnd, kOccluded, kJoined, kRim };

constexpr auto words(StrokeEnd) {
    using enum StrokeEnd;
    return std::array{
        Word<StrokeEnd>{"end", kEnd, "nothing: the line just ends"},
        Word<StrokeEnd>{"occluded", kOccluded, "something nearer, behind which the line goes on"},
        Word<StrokeEnd>{"joined", kJoined, "another line"},
        Word<StrokeEnd>{"rim", kRim, "the rim of the data window"}};
}

const char* word_of(StrokeEnd end);

// What the anchors of a stroke's vertices are.
enum class StrokeAnchor : uint8_t { kNone, kUv, kRest, kPosition };

constexpr auto words(StrokeAnchor) {
    using enum StrokeAnchor;
    return std::array{Word<StrokeAnchor>{"none", kNone, "there are none"},
                      Word<StrokeAnchor>{"uv", kUv, "the surface's texture coordinates, and 0"},
                      Word<StrokeAnchor>{"rest", kRest, "the place on the surface at rest"},
                      Word<StrokeAnchor>{"position", kPosition, "the place in the world"}};
}

const char* word_of(StrokeAnchor anchor);

// Places are in the frame's coordinates, in which the centre of the pixel (x, y) is (x + ½, y + ½).  All
// numbers are finite.
struct StrokeVertex {
    double x = 0, y = 0;
    double arc = 0;                  // length of the stroke from its first vertex, in pixels
    double u = 0;                    // the same as a share of the whole, 0 to 1
    double width = 1;                // across, in pixels
    double opacity = 1;              // 0 to 1
    double depth = 0;                // of the nearer side; 0 where it is not known
    double curvature = 0;            // 1 / pixels; above 0 where it turns from x to y: clockwise, as seen
    double strength = 1;             // how surely there is a line: 0 at the lower threshold, 1 at the upper
    double sharpness = 0;            // the angle between the normals on both sides, in degrees
    double epsilon = 0;              // how far off the place may be, in pixels
    double thickness = 0;            // of what it is the middle of, in pixels; 0: of nothing
    std::array<double, 3> anchor{};  // a place on the surface, see StrokeAnchor

    static constexpr std::size_t kNumbers = 15;
    friend bool operator==(const StrokeVertex& a, const StrokeVertex& b) {
        using Bits = std::array<uint64_t, kNumbers>;
        return std::bit_cast<Bits>(a) == std::bit_cast<Bits>(b);
    }
};

// The object that it belongs to, the nearer one, is on its right: a circle around a disc runs clockwise, as
// seen.  A closed one goes on from its last vertex to its first, which is not repeated.
struct Stroke {
    StrokeKind kind = StrokeKind::kUser;
    uint32_t near = 0, far = 0;  // Cryptomatte ids of the object that it belongs to, and of the one behind
    bool closed = false;
    std::array<StrokeEnd, 2> ends{};  // of the first vertex and the last; not of a closed one
    StrokeAnchor anchor = StrokeAnchor::kNone;
    std::optional<Color> color;  // where it has one of its own
    std::vector<StrokeVertex> vertices;

    friend bool operator==(const Stroke&, const Stroke&) = default;
};

struct Strokes {
    static constexpr const char* kind = "strokes";

    Rect display, window;                   // of the frame
    std::map<uint32_t, std::string> names;  // of ids, as far as they are known
    std::vector<Stroke> strokes;

    std::size_t bytes() const;

    // The parts that a link may pick are the kinds.
    static std::vector<std::string> part_names();
    static std::size_t usual_bytes();
    Strokes part(std::size_t which) const;

    friend bool operator==(const Strokes&, const Strokes&) = default;
};

// What a drawing takes that is about as large as they come, for the planner: 60,000 vertices.
inline constexpr std::size_t kUsualStrokes = 60'000 * sizeof(StrokeVertex);

// Pixels of the frame in one of a display window 1080 high, in which lengths are given so that a drawing is
// the same at any size.
inline double display_unit(const Strokes& strokes) {
    return (strokes.display.height() > 0 ? strokes.display.height() : 1080) / 1080.0;
}

// Sets arc and u from the places of the vertices.
void measure(Stroke& stroke);

// Length of the way along the vertices; of a closed one back to the first.
double length_of(const Stroke& stroke);

// The order that a drawing depends on: by kind, near, far, and the first vertex from top to bottom and left
// to right; then by all vertices.  A closed stroke begins at its topmost, then leftmost vertex.  Measures
// the strokes, and drops those of less than two vertices and names that no stroke has.
void arrange(Strokes& strokes);

}  // namespace keyline
