// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/strokes_json.h"

#include "engine/base/error.h"
#include "engine/json/json_reader.h"
#include "engine/json/json_writer.h"
#include "engine/params/params.h"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>

namespace keyline {

namespace {

constexpr int kVersion = 1;

// One number for all vertices, or one a vertex.
using Column = std::variant<double, std::vector<double>>;

// A stroke as the file has it.
struct Line {
    StrokeKind kind = StrokeKind::kUser;
    std::string near, far;
    bool closed = false;
    std::vector<StrokeEnd> ends{StrokeEnd::kEnd, StrokeEnd::kEnd};
    std::optional<Color> color;
    std::vector<std::array<double, 2>> points;
    Column width = 1.0, opacity = 1.0, depth = 0.0, curvature = 0.0, strength = 1.0, sharpness = 0.0,
           epsilon = 0.0, thickness = 0.0;
    StrokeAnchor anchor = StrokeAnchor::kNone;
    std::vector<std::array<double, 3>> anchors;

    static constexpr auto fields = declare(
        field(&Line::kind, "kind", "What it is."),
        field(&Line::near, "near", "The object that it belongs to: a name, or the id of one without."),
        field(&Line::far, "far", "The object behind it."),
        field(&Line::closed, "closed", "Whether it goes on from its last point to its first."),
        field(&Line::ends, "ends", "What is at its first point and its last."),
        field(&Line::color, "color", "Its own colour."),
        field(&Line::points, "points", "Its way: x and y of each point.").required(),
        field(&Line::width, "width", "Across, in pixels.", at_least(0)),
        field(&Line::opacity, "opacity", "How much it covers.", between(0, 1)),
        field(&Line::depth, "depth", "Of the nearer side."),
        field(&Line::curvature, "curvature", "1 / pixels."),
        field(&Line::strength, "strength", "How surely there is a line."),
        field(&Line::sharpness, "sharpness", "The angle between the normals on both sides, in degrees.",
              between(0, 180)),
        field(&Line::epsilon, "epsilon", "How far off the points may be, in pixels.", at_least(0)),
        field(&Line::thickness, "thickness", "Of what it is the middle of, in pixels; 0: of nothing.",
              at_least(0)),
        field(&Line::anchor, "anchor", "What the anchors are."),
        field(&Line::anchors, "anchors", "A place on the surface for each point."));
};

struct File {
    int strokes = 0;
    std::array<int, 4> display{}, window{};
    Map<std::string> objects;
    std::vector<Line> lines;

    static constexpr auto fields =
        declare(field(&File::strokes, "strokes", "The version of the format.").required(),
                field(&File::display, "display", "The display window: x0, y0, x1, y1.",
                      between(-kMaxCoordinate, kMaxCoordinate))
                    .required(),
                field(&File::window, "window", "The data window.", between(-kMaxCoordinate, kMaxCoordinate))
                    .required(),
                field(&File::objects, "objects", "The names of objects, by their ids."),
                field(&File::lines, "lines", "The strokes.").required());
};

// What of a vertex stands in a column of its own.
struct ColumnField {
    const char* name;
    Column Line::*column;
    double StrokeVertex::*number;
};
constexpr std::array kColumns{ColumnField{"width", &Line::width, &StrokeVertex::width},
                              ColumnField{"opacity", &Line::opacity, &StrokeVertex::opacity},
                              ColumnField{"depth", &Line::depth, &StrokeVertex::depth},
                              ColumnField{"curvature", &Line::curvature, &StrokeVertex::curvature},
                              ColumnField{"strength", &Line::strength, &StrokeVertex::strength},
                              ColumnField{"sharpness", &Line::sharpness, &StrokeVertex::sharpness},
                              ColumnField{"epsilon", &Line::epsilon, &StrokeVertex::epsilon},
                              ColumnField{"thickness", &Line::thickness, &StrokeVertex::thickness}};

std::string hexadecimal(uint32_t id) { return fmt::format("{:08x}", id); }

std::optional<uint32_t> id_of_hexadecimal(std::string_view text) {
    uint32_t id = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), id, 16);
    const bool whole = error == std::errc{} && end == text.data() + text.size() && text.size() == 8;
    return whole ? std::optional(id) : std::nullopt;
}

std::array<int, 4> numbers(const Rect& r) { return {r.x0, r.y0, r.x1, r.y1}; }
Rect rect(const std::array<int, 4>& n) { return {n[0], n[1], n[2], n[3]}; }

// From strokes to the file.

// What objects are called by: their names, where no other has the same, else their ids.
class Names {
public:
    explicit Names(const std::map<uint32_t, std::string>& names) : names_(names) {
        for (const auto& [id, name] : names) ++count_[name];
    }
    std::string of(uint32_t id) const {
        const auto it = names_.find(id);
        if (it != names_.end() && !it->second.empty() && count_.at(it->second) == 1) return it->second;
        return id == 0 ? "" : hexadecimal(id);
    }
    Map<std::string> objects() const {
        Map<std::string> out;
        for (const auto& [id, name] : names_) out.entries.emplace_back(hexadecimal(id), name);
        return out;
    }

private:
    const std::map<uint32_t, std::string>& names_;
    std::map<std::string, int> count_;
};

Column column_of(const Stroke& stroke, double StrokeVertex::*number) {
    const auto bits = [&](const StrokeVertex& v) { return std::bit_cast<uint64_t>(v.*number); };
    const uint64_t first = bits(stroke.vertices.front());
    if (std::ranges::all_of(stroke.vertices, [&](const auto& v) { return bits(v) == first; }))
        return stroke.vertices.front().*number;
    std::vector<double> out;
    for (const StrokeVertex& v : stroke.vertices) out.push_back(v.*number);
    return out;
}

Line line_of(const Stroke& stroke, const Names& names) {
    Line line;
    line.kind = stroke.kind;
    line.near = names.of(stroke.near);
    line.far = names.of(stroke.far);
    line.closed = stroke.closed;
    line.ends = {stroke.ends[0], stroke.ends[1]};
    line.color = stroke.color;
    line.anchor = stroke.anchor;
    for (const StrokeVertex& v : stroke.vertices) line.points.push_back({v.x, v.y});
    for (const ColumnField& c : kColumns) line.*c.column = column_of(stroke, c.number);
    if (stroke.anchor != StrokeAnchor::kNone)
        for (const StrokeVertex& v : stroke.vertices) line.anchors.push_back(v.anchor);
    return line;
}

bool same(const Value& a, const Value& b) {
    return a.kind == b.kind && JsonWriter().value(a).text() == JsonWriter().value(b).text();
}

// The members that are not what they are without being given.
Value without_defaults(Value object, const std::vector<FieldInfo>& fields) {
    std::erase_if(object.members, [&](const Member& m) {
        const auto f = std::ranges::find(fields, m.key, &FieldInfo::name);
        return !f->required && same(m.value, f->default_value);
    });
    return object;
}

// From the file to strokes.

[[noreturn]] void refuse(const Value& at, std::string what, std::string hint = {}) {
    throw Failure({ErrorKind::kInput, at.place, {}, std::move(what), std::move(hint)});
}

// The objects of a file, by what lines call them.
class Objects {
public:
    Objects(const Map<std::string>& objects, const Value& value) {
        for (const auto& [text, name] : objects.entries) {
            const auto id = id_of_hexadecimal(text);
            if (!id)
                refuse(*value.find(text), fmt::format("the id of {} is {}; it must be 8 hexadecimal digits",
                                                      in_quotes(name), in_quotes(text)));
            names_[*id] = name;
            ids_[name].push_back(*id);
        }
    }

    const std::map<uint32_t, std::string>& names() const { return names_; }

    uint32_t id(const Value& owner) const {
        if (owner.text.empty()) return 0;
        if (const auto it = ids_.find(owner.text); it != ids_.end()) {
            if (it->second.size() == 1) return it->second.front();
            refuse(owner,
                   fmt::format("{} is the name of {} objects", in_quotes(owner.text), it->second.size()),
                   fmt::format("write an id, as {}", in_quotes(hexadecimal(it->second.front()))));
        }
        if (const auto id = id_of_hexadecimal(owner.text)) return *id;
        std::string hint = did_you_mean(owner.text, known());
        if (hint.empty()) hint = "add it to 'objects', or write an id of 8 hexadecimal digits";
        refuse(owner, fmt::format("{} is not among the objects", in_quotes(owner.text)), std::move(hint));
    }

private:
    std::vector<std::string> known() const {
        std::vector<std::string> out;
        for (const auto& [name, ids] : ids_) out.push_back(name);
        return out;
    }

    std::map<uint32_t, std::string> names_;
    std::map<std::string, std::vector<uint32_t>> ids_;
};

class LineReader {
public:
    LineReader(const Line& line, const Value& object, const Objects& objects)
        : line_(line), object_(object), objects_(objects) {}

    Stroke stroke() const {
        check();
        Stroke out;
        out.kind = line_.kind;
        out.near = owner("near");
        out.far = owner("far");
        out.closed = line_.closed;
        out.ends = {line_.ends[0], line_.ends[1]};
        out.anchor = line_.anchor;
        out.color = line_.color;
        out.vertices.resize(line_.points.size());
        for (std::size_t i = 0; i < out.vertices.size(); ++i) out.vertices[i] = vertex(i);
        return out;
    }

private:
    const Value& at(const char* name) const {
        const Value* v = object_.find(name);
        return v ? *v : object_;
    }

    uint32_t owner(const char* name) const {
        const Value* v = object_.find(name);
        return v ? objects_.id(*v) : 0;
    }

    void check() const {
        const std::size_t points = line_.points.size();
        if (points < 2) refuse(at("points"), fmt::format("'points' has {}; a line has two or more", points));
        if (line_.ends.size() != 2)
            refuse(at("ends"), fmt::format("'ends' has {} items; it must have two", line_.ends.size()));
        for (const ColumnField& c : kColumns)
            if (const auto* list = std::get_if<std::vector<double>>(&(line_.*c.column)))
                check_length(c.name, list->size());
        if (line_.anchor != StrokeAnchor::kNone)
            check_length("anchors", line_.anchors.size());
        else if (!line_.anchors.empty())
            refuse(at("anchors"), "'anchors' are given, but no 'anchor' that says what they are",
                   "give 'anchor' as uv, rest or position, or leave 'anchors' out");
    }

    void check_length(const char* name, std::size_t items) const {
        if (items != line_.points.size())
            refuse(at(name),
                   fmt::format("'{}' has {} items, 'points' has {}", name, items, line_.points.size()),
                   "give one for each point");
    }

    StrokeVertex vertex(std::size_t i) const {
        StrokeVertex v;
        v.x = line_.points[i][0];
        v.y = line_.points[i][1];
        for (const ColumnField& c : kColumns) {
            const double* all = std::get_if<double>(&(line_.*c.column));
            v.*c.number = all ? *all : std::get<std::vector<double>>(line_.*c.column)[i];
        }
        if (!line_.anchors.empty()) v.anchor = line_.anchors[i];
        return v;
    }

    const Line& line_;
    const Value& object_;
    const Objects& objects_;
};

// Before all else: of another version nothing else is known.
void check_version(const Value& file) {
    const Value* version = file.find("strokes");
    if (version && version->is(Value::Kind::kNumber) && version->number != kVersion)
        refuse(*version, fmt::format("these are strokes of version {}; this build reads version {}",
                                     version->text, kVersion));
}

Value checked(std::string_view text, const std::string& file) {
    try {
        Value value = parse_json(text, file);
        check_version(value);
        Diagnostics faults;
        ParamReader reader(faults, {}, {});
        validate(TypeInfo::object(describe_fields<File>()), value, "strokes", reader);
        faults.sort_by_place();
        if (!faults.ok()) throw Failure(faults.errors().front());
        return value;
    } catch (const Failure& f) {
        rethrow_with(f, [](Error& e) { e.kind = ErrorKind::kInput; });
    }
}

}  // namespace

std::string strokes_json(const Strokes& strokes) {
    const Names names(strokes.names);
    const auto text = [](const Value& v) { return JsonWriter().value(v).text(); };
    File head;
    head.strokes = kVersion;
    head.display = numbers(strokes.display);
    head.window = numbers(strokes.window);
    head.objects = names.objects();
    std::string out = "{";
    for (const Member& m : fields_to_value(head).members)
        if (m.key != "lines") out += fmt::format("\n\"{}\": {},", m.key, text(m.value));
    out += "\n\"lines\": [";
    const std::vector<FieldInfo> fields = describe_fields<Line>();
    const char* before = "\n";
    for (const Stroke& s : strokes.strokes) {
        out += before + text(without_defaults(fields_to_value(line_of(s, names)), fields));
        before = ",\n";
    }
    return out + "\n]\n}\n";
}

Strokes parse_strokes(std::string_view text, const std::string& file) {
    const Value value = checked(text, file);
    File content;
    read_fields(value, describe_fields<File>(), {}, content);
    const Value *names = value.find("objects"), *lines = value.find("lines");
    const Objects objects(content.objects, names ? *names : value);
    Strokes out;
    out.display = rect(content.display);
    out.window = rect(content.window);
    out.names = objects.names();
    for (std::size_t i = 0; i < content.lines.size(); ++i)
        out.strokes.push_back(LineReader(content.lines[i], lines->items[i], objects).stroke());
    arrange(out);
    return out;
}

}  // namespace keyline
