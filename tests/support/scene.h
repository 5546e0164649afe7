// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tests/support/image.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

// Scenes of simple things whose passes and lines are known exactly: the truth that strokes are measured
// against.
//
//     const Scene scene{.things = {disc("ball", {24, 24}, 12, 5)}};
//     const Image passes = passes_of(scene);               // as a renderer would write them
//     const std::vector<TruePoint> lines = lines_of(scene);

namespace keyline::testing {

// In the picture, in pixels; the centre of pixel (3, 5) lies at (3.5, 5.5).
struct Point {
    double x = 0, y = 0;
};

// Before the eye, x right, y down, z ahead.
struct Vec3 {
    double x = 0, y = 0, z = 0;
};

struct Camera {
    Point centre{24, 24};  // what it looks at
    double focal = 48;     // pixels
};

using Curve = std::vector<Point>;  // closed

struct Thing {
    struct Hit {
        double depth = 0;
        Vec3 normal;  // towards the eye
    };
    std::string name;
    std::function<std::optional<Hit>(Point)> hit;  // what is seen of it in a direction
    std::vector<Curve> rims;                       // where it may end
};

// Flat, facing the camera.  The corners of a polygon go round; it need not be convex.
Thing disc(const std::string& name, Point centre, double radius, double depth);
Thing polygon(const std::string& name, const std::vector<Point>& corners, double depth);
Thing wire(const std::string& name, Point from, Point to, double width, double depth);

Thing sphere(const std::string& name, const Camera& camera, Vec3 centre, double radius);
// The plane y = height, below the eye.
Thing ground(const std::string& name, const Camera& camera, double height);
// Where a sphere cuts the plane y = height.
Curve contact(const Camera& camera, Vec3 centre, double radius, double height);

struct Scene {
    Rect window{0, 0, 48, 48};
    Camera camera = {};
    std::vector<Thing> things;
    std::vector<Curve> contacts = {};  // where things pass through each other
};

// The thing in front, and what is seen of it; null where there is nothing.
struct Front {
    const Thing* thing = nullptr;
    Thing::Hit hit = {1e10, {}};
};
Front front_of(const Scene& scene, Point at);

// CryptoObject00 and 01 with a manifest, and one sample at each pixel's centre of Depth.Z, Normal.X Y Z and
// Position.X Y Z (y up, z towards the eye).  Coverage is of the pixel's square: exact, or from that many
// samples at random.
Image passes_of(const Scene& scene, int samples = 0);

// A point of a line that is to be seen: a border between two things, or between a thing and nothing.
struct TruePoint {
    Point at;
    Point outward;          // of length 1, across the line, away from the nearer thing
    std::string near, far;  // far: "" where there is nothing
    double near_depth = 0, far_depth = 0;
    double length = 0;  // of the line that it stands for
};

// All of them, at most 0.02 pixels apart.
std::vector<TruePoint> lines_of(const Scene& scene);

// How far a point is from the nearest of them, outward positive.
double offset_from(const std::vector<TruePoint>& lines, Point p);

}  // namespace keyline::testing
