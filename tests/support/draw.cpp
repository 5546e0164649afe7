// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/support/draw.h"

#include "engine/node/registry.h"
#include "engine/plan/resolve.h"
#include "tests/support/strokes.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace keyline::testing {

namespace {

using Kind = TypeInfo::Kind;

// Values that no declaration lists, for the nodes that need one.
std::optional<Json> known_word(const std::string& type, const std::string& field) {
    if (type == "colorspace" && field == "to") return Json("ACEScg");
    if (type == "namedtransform" && field == "transform") return Json("sRGB - Curve");
    if (type == "laplacian" && field == "neighbours") return Json(8);
    return {};
}

bool takes_data(const TypeInfo& type) {
    return (type.kind == Kind::kInput && type.takes.kind == Takes::Kind::kData) ||
           std::ranges::any_of(type.items, takes_data);
}

// Some node that makes the kind of data that a port takes, and not of other data.
const NodeType& giver_of(const Takes& takes) {
    register_random_strokes();
    for (const auto& [name, type] : registry().types())
        if (!type.gives.empty() && (!takes.data || type.gives == takes.data) &&
            std::ranges::none_of(type.fields, takes_data, &FieldInfo::type) && !has_files(type))
            return type;
    fail(ErrorKind::kInternal, "no node gives what a port takes");
}

bool is_text(const TypeInfo& type) { return type.kind == Kind::kString || type.kind == Kind::kFile; }

}  // namespace

// Without a distribution of the library: those draw differently elsewhere.
int Draw::whole(int low, int high) {
    return low + static_cast<int>(random_() % static_cast<unsigned>(high - low + 1));
}

double Draw::number(const Range& range) {
    const double low = std::isfinite(range.min) ? range.min : -4;
    const double most = std::min(range.max, range.test_max);
    const double high = std::isfinite(most) ? most : low + 8;
    if (one_in(4)) return low;
    if (one_in(8)) return high;
    return low + (high - low) * whole(0, 1 << 20) / (1 << 20);
}

Rect Draw::window(int most_width, int most_height) {
    const int width = one_in(8) ? 1 : whole(2, most_width), height = one_in(8) ? 1 : whole(2, most_height);
    const int x = whole(-width, 20), y = whole(-height, 20);
    return {x, y, x + width, y + height};
}

std::vector<std::string> Draw::channels(const Takes& takes) {
    std::vector<std::string> names;
    switch (takes.kind) {
        case Takes::Kind::kAny:
            if (one_in(3)) return {"A", "U", "V"};
            if (one_in(3)) return {"Id00.r", "Id00.g", "Id00.b", "Id00.a"};  // of a Cryptomatte
            return one_in(2) ? std::vector<std::string>{"Y"} : std::vector<std::string>{"R", "G", "B", "A"};
        case Takes::Kind::kColour:
            names = {"R", "G", "B"};
            if (!one_in(3)) names.emplace_back("A");
            break;
        case Takes::Kind::kMatte:
            if (takes.preferred && one_in(2)) return {takes.preferred, "A"};
            return one_in(2) ? std::vector<std::string>{"Y"} : std::vector<std::string>{"R", "A"};
        case Takes::Kind::kData: break;
        case Takes::Kind::kNamed:
            for (const char* name : takes.names)
                if (name) names.emplace_back(name);
            break;
    }
    if (one_in(2)) names.emplace_back("depth.Z");
    return names;
}

Image Draw::image(const Takes& takes, const Rect& window) {
    // One after the other: compilers evaluate arguments in orders of their own, and draws must be the same.
    const std::vector<std::string> names = channels(takes);
    const auto seed = static_cast<unsigned>(random_());
    Image image = noise(window, names, seed, -0.25F, 1);
    image.display = one_in(2) ? window : translate({-5, 4, 25, 24}, window.x0, window.y0);
    const bool coarse = one_in(3);
    for (Image::Channel& c : image.channels) {
        if (one_in(4)) c.type = SampleType::kHalf;
        for (float& s : c.samples)
            if (coarse) s = std::round(s * 4) / 4;
    }
    return image;
}

Json Draw::parameters(const NodeType& type, const NameInput& input) {
    Json out = object(type.fields, input);
    for (const FieldInfo& f : type.fields)
        if (const auto word = known_word(type.name, f.name)) out.set(f.name, *word);
    return out.set("type", type.name);
}

Json Draw::object(const std::vector<FieldInfo>& fields, const NameInput& input) {
    Json out;
    for (const FieldInfo& f : fields) {
        if (!f.required && one_in(f.type.optional ? 2 : 5)) continue;
        if (f.type.optional && !f.default_value.is(Value::Kind::kNull) && one_in(3)) {
            out.set(f.name, Json::verbatim("null"));
            continue;
        }
        if (auto v = value(f.type, input)) out.set(f.name, std::move(*v));
    }
    return out;
}

// Nothing for text: only the node knows what it may be.
std::optional<Json> Draw::value(const TypeInfo& type, const NameInput& input) {
    switch (type.kind) {
        case Kind::kNumber: return number(type.range);
        case Kind::kInteger: return std::round(number(type.range));
        case Kind::kBool: return Json(one_in(2));
        case Kind::kString:
        case Kind::kFile: return {};
        case Kind::kWord: return Json(of(type.words).word);
        case Kind::kPair:
            if (one_in(2)) return number(type.range);
            return Json{number(type.range), number(type.range)};
        case Kind::kColor:
            if (one_in(3)) return Json(fmt::format("#{:06x}", whole(0, 0xFFFFFF)));
            return Json{number(type.range), number(type.range), number(type.range)};
        case Kind::kNumbers: {
            std::vector<Json> items;
            for (std::size_t i = 0; i < type.count; ++i) items.emplace_back(number(type.range));
            return Json::array(items);
        }
        case Kind::kTuple: {
            std::vector<Json> items;
            for (const TypeInfo& item : type.items)
                if (auto v = value(item, input)) items.push_back(std::move(*v));
            return Json::array(items);
        }
        case Kind::kInput: return Json(input(type));
        case Kind::kObject: return object(type.fields, input);
        case Kind::kList: {
            std::vector<Json> items;
            for (int n = whole(1, 3); n > 0; --n)
                if (auto v = value(type.items[0], input)) items.push_back(std::move(*v));
            return Json::array(items);
        }
        case Kind::kMap: {
            Json out;
            for (int n = whole(1, 2); n > 0; --n)
                if (auto v = value(type.items[0], input)) out.set(fmt::format("key{}", n), std::move(*v));
            return out;
        }
        case Kind::kAnyOf: break;
    }
    std::vector<TypeInfo> choices;
    std::ranges::copy_if(type.items, std::back_inserter(choices), std::not_fn(is_text));
    return choices.empty() ? std::nullopt : value(of(choices), input);
}

ResolvedFrame NodeCase::resolve(bool leave_out_identities) const {
    const std::vector<std::string> ids{id}, none;
    return resolve_graph(nodes, gives_data ? none : ids, inputs, 1, leave_out_identities,
                         gives_data ? ids : none);
}

std::string NodeCase::text() const {
    std::string out = nodes.text();
    for (const auto& [name, images] : inputs)
        for (const Image& image : images)
            out += fmt::format("\n{}: {} × {} at {},{}", name, image.window.width(), image.window.height(),
                               image.window.x0, image.window.y0);
    return out;
}

NodeCase draw_case(const NodeType& type, Draw& draw, const std::function<Rect(Draw&)>& window) {
    std::optional<Failure> last;
    for (int tries = 0; tries < 1000; ++tries) {
        NodeCase c;
        int data = 0;
        c.gives_data = !type.gives.empty();
        const Draw::NameInput input = [&](const TypeInfo& t) {
            if (t.takes.kind == Takes::Kind::kData) {
                const std::string name = fmt::format("data{}", data++);
                const NodeType& giver = giver_of(t.takes);
                c.nodes.set(name, draw.parameters(giver, input));
                if (!giver.parts || !draw.one_in(4)) return name;
                return name + ":" + draw.of(giver.parts->names);
            }
            const std::string name = fmt::format("image{}", c.inputs.size());
            for (int frame = 0; frame < 3; ++frame)
                c.inputs[name].push_back(draw.image(t.takes, window ? window(draw) : draw.window()));
            return name;
        };
        c.nodes.set(c.id, draw.parameters(type, input));
        try {
            c.resolve();
            return c;
        } catch (const Failure& f) {
            last = f;
        }
    }
    throw Failure(*last);
}

bool has_files(const NodeType& type) {
    return std::ranges::any_of(type.fields, [](const FieldInfo& f) { return f.type.kind == Kind::kFile; });
}

}  // namespace keyline::testing
