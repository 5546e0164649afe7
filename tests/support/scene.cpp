// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/support/scene.h"

#include "engine/kit/cryptomatte.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <map>
#include <numbers>
#include <random>

namespace keyline::testing {

namespace {

constexpr double kStep = 0.02;  // between true points, at most
constexpr int kRanks = 4;

double dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

Vec3 ray_of(const Camera& c, Point p) {
    return {(p.x - c.centre.x) / c.focal, (p.y - c.centre.y) / c.focal, 1};
}

Point project(const Camera& c, const Vec3& v) {
    return {c.centre.x + c.focal * v.x / v.z, c.centre.y + c.focal * v.y / v.z};
}

// Points of a closed curve: at(t) for t from 0 to 1.
template <class At>
Curve around(int points, const At& at) {
    Curve out;
    for (int i = 0; i < points; ++i) out.push_back(at(static_cast<double>(i) / points));
    return out;
}

// A circle in space: centre, and two radii at right angles.
Curve circle(const Camera& camera, const Vec3& centre, const Vec3& u, const Vec3& v) {
    return around(4096, [&](double t) {
        const double c = std::cos(2 * std::numbers::pi * t), s = std::sin(2 * std::numbers::pi * t);
        return project(camera, {centre.x + c * u.x + s * v.x, centre.y + c * u.y + s * v.y,
                                centre.z + c * u.z + s * v.z});
    });
}

bool is_inside(const std::vector<Point>& corners, Point p) {
    bool inside = false;
    for (std::size_t i = 0, j = corners.size() - 1; i < corners.size(); j = i++) {
        const Point &a = corners[i], &b = corners[j];
        if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y))
            inside = !inside;
    }
    return inside;
}

using Shares = std::map<std::string, int>;  // of a pixel's samples, by thing; "" is nothing

void count(const Scene& scene, Point at, Shares& shares) {
    const Front front = front_of(scene, at);
    ++shares[front.thing ? front.thing->name : ""];
}

// n × n samples, no two of them in one row or column.
Shares grid(const Scene& scene, int x, int y, int n) {
    const auto share = [n](int a, int b) { return (a + (b + 0.5) / n) / n; };
    Shares out;
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) count(scene, {x + share(i, j), y + share(j, i)}, out);
    return out;
}

// Whether anything comes between samples at the corners, along the sides and inside.
bool is_mixed(const Scene& scene, int x, int y) {
    constexpr double kAcross = 5;
    Shares seen;
    for (int j = 0; j <= kAcross; ++j)
        for (int i = 0; i <= kAcross; ++i) count(scene, {x + i / kAcross, y + j / kAcross}, seen);
    return seen.size() > 1;
}

Shares at_random(const Scene& scene, int x, int y, int samples, std::mt19937& random) {
    const auto next = [&] { return static_cast<double>(random()) / 4294967296.0; };
    Shares out;
    for (int i = 0; i < samples; ++i) {
        const double dx = next(), dy = next();
        count(scene, {x + dx, y + dy}, out);
    }
    return out;
}

void set_ranks(Image& image, int x, int y, const Shares& shares) {
    int all = 0;
    std::vector<std::pair<int, std::string>> ranks;
    for (const auto& [name, n] : shares) {
        all += n;
        if (!name.empty()) ranks.emplace_back(-n, name);
    }
    std::ranges::sort(ranks);
    for (std::size_t r = 0; r < std::min<std::size_t>(ranks.size(), kRanks); ++r) {
        const std::string layer = fmt::format("CryptoObject0{}.", r / 2);
        image.at(layer + "rb"[r % 2], x, y) = std::bit_cast<float>(cryptomatte_id(ranks[r].second));
        image.at(layer + "ga"[r % 2], x, y) = static_cast<float>(-ranks[r].first) / static_cast<float>(all);
    }
}

void set_centre(Image& image, const Scene& scene, int x, int y) {
    const Point at{x + 0.5, y + 0.5};
    const Front front = front_of(scene, at);
    const double z = front.hit.depth;
    const Vec3 ray = ray_of(scene.camera, at), &n = front.hit.normal;
    const auto set = [&](const char* name, double v) { image.at(name, x, y) = static_cast<float>(v); };
    set("Depth.Z", z);
    if (!front.thing) return;
    set("Normal.X", n.x), set("Normal.Y", -n.y), set("Normal.Z", -n.z);
    set("Position.X", ray.x * z), set("Position.Y", -ray.y * z), set("Position.Z", -z);
}

std::string manifest_of(const Scene& scene) {
    std::string out;
    for (const Thing& t : scene.things)
        out += fmt::format("{}\"{}\":\"{:08x}\"", out.empty() ? "" : ",", t.name, cryptomatte_id(t.name));
    return "{" + out + "}";
}

// What borders at p, whose neighbourhood the unit vector `across` cuts.
std::optional<TruePoint> border_at(const Scene& scene, Point p, Point across) {
    constexpr double kAside = 1e-4;
    const auto side = [&](double d) { return front_of(scene, {p.x + d * across.x, p.y + d * across.y}); };
    Front a = side(-kAside), b = side(kAside);
    if (a.thing == b.thing) return {};
    if (b.hit.depth < a.hit.depth) {
        std::swap(a, b);
        across = {-across.x, -across.y};
    }
    return TruePoint{p, across, a.thing->name, b.thing ? b.thing->name : "", a.hit.depth, b.hit.depth, 0};
}

void add_visible(const Scene& scene, const Curve& curve, std::vector<TruePoint>& out) {
    for (std::size_t i = 0; i < curve.size(); ++i) {
        const Point &a = curve[i], &b = curve[(i + 1) % curve.size()];
        const double dx = b.x - a.x, dy = b.y - a.y, length = std::hypot(dx, dy);
        const int n = static_cast<int>(length / kStep) + 1;
        for (int k = 0; k < n && length > 0; ++k) {
            const double t = (k + 0.5) / n;
            auto point = border_at(scene, {a.x + t * dx, a.y + t * dy}, {-dy / length, dx / length});
            if (!point) continue;
            point->length = length / n;
            out.push_back(*point);
        }
    }
}

}  // namespace

Thing disc(const std::string& name, Point centre, double radius, double depth) {
    const auto hit = [=](Point p) -> std::optional<Thing::Hit> {
        if (std::hypot(p.x - centre.x, p.y - centre.y) > radius) return {};
        return Thing::Hit{depth, {0, 0, -1}};
    };
    const Curve rim = around(4096, [&](double t) {
        const double angle = 2 * std::numbers::pi * t;
        return Point{centre.x + radius * std::cos(angle), centre.y + radius * std::sin(angle)};
    });
    return {name, hit, {rim}};
}

Thing polygon(const std::string& name, const std::vector<Point>& corners, double depth) {
    const auto hit = [=](Point p) -> std::optional<Thing::Hit> {
        if (!is_inside(corners, p)) return {};
        return Thing::Hit{depth, {0, 0, -1}};
    };
    return {name, hit, {corners}};
}

Thing wire(const std::string& name, Point from, Point to, double width, double depth) {
    const double length = std::hypot(to.x - from.x, to.y - from.y);
    const double x = -(to.y - from.y) / length * width / 2, y = (to.x - from.x) / length * width / 2;
    return polygon(
        name,
        {{from.x - x, from.y - y}, {to.x - x, to.y - y}, {to.x + x, to.y + y}, {from.x + x, from.y + y}},
        depth);
}

Thing sphere(const std::string& name, const Camera& camera, Vec3 centre, double radius) {
    const double distance2 = dot(centre, centre);
    const auto hit = [=](Point p) -> std::optional<Thing::Hit> {
        const Vec3 ray = ray_of(camera, p);
        const double a = dot(ray, ray), b = dot(ray, centre);
        const double root = b * b - a * (distance2 - radius * radius);
        if (root < 0) return {};
        const double z = (b - std::sqrt(root)) / a;
        return Thing::Hit{
            z, {(z * ray.x - centre.x) / radius, (z * ray.y - centre.y) / radius, (z - centre.z) / radius}};
    };
    // The outline is the circle in which the cone of tangents from the eye touches.
    const double along = 1 - radius * radius / distance2, r = radius * std::sqrt(along);
    const Vec3 middle{centre.x * along, centre.y * along, centre.z * along};
    const double flat = std::hypot(centre.x, centre.z), length = std::sqrt(distance2);
    const Vec3 u{r * centre.z / flat, 0, -r * centre.x / flat};
    const Vec3 v{-r * centre.x * centre.y / (flat * length), r * flat / length,
                 -r * centre.z * centre.y / (flat * length)};
    return {name, hit, {circle(camera, middle, u, v)}};
}

Thing ground(const std::string& name, const Camera& camera, double height) {
    const auto hit = [=](Point p) -> std::optional<Thing::Hit> {
        const Vec3 ray = ray_of(camera, p);
        if (ray.y <= 0) return {};
        return Thing::Hit{height / ray.y, {0, -1, 0}};
    };
    const double y = camera.centre.y;
    return {name, hit, {{{-1000, y}, {1000, y}}}};
}

Curve contact(const Camera& camera, Vec3 centre, double radius, double height) {
    const double above = height - centre.y, r = std::sqrt(radius * radius - above * above);
    return circle(camera, {centre.x, height, centre.z}, {r, 0, 0}, {0, 0, r});
}

Front front_of(const Scene& scene, Point at) {
    Front out;
    for (const Thing& thing : scene.things)
        if (const auto hit = thing.hit(at); hit && hit->depth < out.hit.depth) out = {&thing, *hit};
    return out;
}

Image passes_of(const Scene& scene, int samples) {
    constexpr int kFine = 32;  // samples across a pixel that is mixed
    std::vector<std::string> names;
    for (const char* layer : {"CryptoObject00.", "CryptoObject01."})
        for (const char c : {'r', 'g', 'b', 'a'}) names.push_back(std::string(layer) + c);
    for (const char* name :
         {"Depth.Z", "Normal.X", "Normal.Y", "Normal.Z", "Position.X", "Position.Y", "Position.Z"})
        names.emplace_back(name);
    Image image(scene.window, names);
    image.metadata.set({"cryptomatte/5ce4e00/name", "string", std::string("CryptoObject")});
    image.metadata.set({"cryptomatte/5ce4e00/manifest", "string", manifest_of(scene)});
    std::mt19937 random;
    for (int y = scene.window.y0; y < scene.window.y1; ++y)
        for (int x = scene.window.x0; x < scene.window.x1; ++x) {
            const Shares shares = samples > 0             ? at_random(scene, x, y, samples, random)
                                  : is_mixed(scene, x, y) ? grid(scene, x, y, kFine)
                                                          : grid(scene, x, y, 1);
            set_ranks(image, x, y, shares);
            set_centre(image, scene, x, y);
        }
    return image;
}

std::vector<TruePoint> lines_of(const Scene& scene) {
    std::vector<TruePoint> out;
    for (const Thing& thing : scene.things)
        for (const Curve& rim : thing.rims) add_visible(scene, rim, out);
    for (const Curve& curve : scene.contacts) add_visible(scene, curve, out);
    return out;
}

double offset_from(const std::vector<TruePoint>& lines, Point p) {
    double least = std::numeric_limits<double>::infinity(), offset = least;
    for (const TruePoint& line : lines) {
        const double dx = p.x - line.at.x, dy = p.y - line.at.y, distance2 = dx * dx + dy * dy;
        if (distance2 >= least) continue;
        least = distance2;
        offset = dx * line.outward.x + dy * line.outward.y;
    }
    return offset;
}

}  // namespace keyline::testing
