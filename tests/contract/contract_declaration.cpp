// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/graph/graph.h"
#include "engine/json/json_reader.h"
#include "engine/json/json_writer.h"
#include "tests/contract/contract.h"
#include "tests/support/draw.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>

namespace keyline::testing {

namespace {

using Kind = TypeInfo::Kind;

constexpr unsigned kSeed = 1;
constexpr int kCases = 30;

void check_help(const std::string& who, const std::string& help, Complaints& out) {
    if (help.empty())
        out.push_back(who + " has no help");
    else if (!help.ends_with('.'))
        out.push_back(fmt::format("the help of {} is not a sentence: {}", who, help));
}

void check_fields(const std::string& who, const std::vector<FieldInfo>& fields, Complaints& out);

void check_type(const std::string& who, const TypeInfo& type, Complaints& out) {
    for (const TypeInfo::WordInfo& w : type.words)
        if (w.help.empty()) out.push_back(fmt::format("the word '{}' of {} has no help", w.word, who));
    if (type.range.min > type.range.max) out.push_back("the range of " + who + " is empty");
    for (const TypeInfo& item : type.items) check_type(who, item, out);
    check_fields(who, type.fields, out);
}

void check_fields(const std::string& who, const std::vector<FieldInfo>& fields, Complaints& out) {
    for (const FieldInfo& f : fields) {
        const std::string name = fmt::format("{}.{}", who, f.name);
        check_help(name, f.help, out);
        check_type(name, f.type, out);
    }
}

// A node of a graph by itself; its inputs name nodes that need not be there.
struct Parsed {
    std::unique_ptr<const Node> node;
    Diagnostics diagnostics;
};

Parsed parse(const NodeType& type, const std::string& json) {
    Parsed out;
    Value object = parse_json(json, "test.json");
    std::erase_if(object.members, [](const Member& m) { return m.key == "type"; });
    ParamReader reader(out.diagnostics, type.name, {});
    out.node = type.parse(object, reader);
    return out;
}

Json draw_parameters(const NodeType& type, Draw& draw) {
    Json params = draw.parameters(type, [](const TypeInfo&) { return "other:layer"; });
    for (const FieldInfo& f : type.fields)
        if (f.type.kind == Kind::kFile) params.set(f.name, "file.####.exr");
    return params;
}

// Drawn until the node accepts: what holds between parameters only the node knows.
Json draw_accepted(const NodeType& type, Draw& draw) {
    for (int tries = 0; tries < 200; ++tries) {
        const Json params = draw_parameters(type, draw);
        if (parse(type, params.text()).node) return params;
    }
    return draw_parameters(type, draw);
}

std::string text_of(const Value& value) { return JsonWriter().value(value).text(); }

// The words and numbers of a drawn object that are kept as they are, unlike colours and pairs.
bool is_kept_as_written(const TypeInfo& type) {
    return type.kind == Kind::kNumber || type.kind == Kind::kInteger || type.kind == Kind::kBool ||
           type.kind == Kind::kWord || type.kind == Kind::kInput || type.kind == Kind::kFile;
}

class Refusals {
public:
    Refusals(const NodeType& type, Json good) : type_(type), good_(std::move(good)) {}

    void field(const FieldInfo& f) {
        const Json wrong = f.type.kind == Kind::kBool ? Json("true") : Json(true);
        expect_refused(f.name, wrong, "a value of the wrong kind");
        const bool numeric =
            f.type.kind == Kind::kNumber || f.type.kind == Kind::kInteger || f.type.kind == Kind::kPair;
        if (numeric && std::isfinite(f.type.range.min))
            expect_refused(f.name, f.type.range.min - 1, "a value below the range");
        if (numeric && std::isfinite(f.type.range.max))
            expect_refused(f.name, f.type.range.max + 1, "a value above the range");
        if (f.type.kind == Kind::kWord) expect_refused(f.name, "no-such-word", "an unknown word");
        if (f.type.kind == Kind::kInteger) expect_refused(f.name, 1.5, "a broken number");
    }
    void unknown_key() { expect_refused("no_such_parameter", 1, "an unknown key"); }
    void missing(const FieldInfo& f) {
        Json without;
        for (const FieldInfo& other : type_.fields)
            if (other.required && other.name != f.name) without.set(other.name, "other");
        expect_error(parse(type_, without.text()), f.name, "nothing where it is required");
    }
    Complaints complaints;

private:
    void expect_refused(const std::string& name, const Json& value, const std::string& what) {
        Json bad = good_;
        expect_error(parse(type_, bad.set(name, value).text()), name, what);
    }
    void expect_error(const Parsed& parsed, const std::string& name, const std::string& what) {
        const auto& errors = parsed.diagnostics.errors();
        const auto it = std::ranges::find_if(
            errors, [&](const Error& e) { return e.what.find(name) != std::string::npos; });
        if (parsed.node || it == errors.end())
            complaints.push_back(fmt::format("'{}' takes {}", name, what));
        else if (it->place.line == 0)
            complaints.push_back(fmt::format("the error for '{}' has no place: {}", name, it->text()));
    }

    const NodeType& type_;
    const Json good_;
};

}  // namespace

Complaints check_declaration(const NodeType& type) {
    Complaints out;
    check_help(type.name, type.help, out);
    check_fields(type.name, type.fields, out);
    Draw draw(kSeed);
    const Json good = draw_accepted(type, draw);
    for (const FieldInfo& f : type.fields) {
        if (f.default_value.is(Value::Kind::kNull) || f.required) continue;
        const Json filled = Json(good).set(f.name, Json::verbatim(text_of(f.default_value)));
        const Parsed parsed = parse(type, filled.text());
        for (const Error& e : parsed.diagnostics.errors())
            if (e.what.find("'" + f.name + "' is") != std::string::npos)
                out.push_back(fmt::format("the default of '{}' is refused: {}", f.name, e.what));
    }
    return out;
}

Complaints check_round_trip(const NodeType& type) {
    Complaints out;
    Draw draw(kSeed);
    for (int i = 0; i < kCases; ++i) {
        const std::string given = draw_accepted(type, draw).text();
        const Parsed first = parse(type, given);
        if (!first.node)
            return {"no parameters drawn from its ranges are accepted: " +
                    first.diagnostics.errors().front().what};
        const Value written = first.node->to_value();
        const Parsed second = parse(type, text_of(written));
        if (!second.node || text_of(second.node->to_value()) != text_of(written))
            out.push_back(fmt::format("{} comes back as {}", given, text_of(written)));
        const Value object = parse_json(given, "");
        for (const FieldInfo& f : type.fields) {
            const Value *before = object.find(f.name), *after = written.find(f.name);
            if (before && is_kept_as_written(f.type) && (!after || text_of(*before) != text_of(*after)))
                out.push_back(fmt::format("'{}' was {} and comes back as {}", f.name, text_of(*before),
                                          after ? text_of(*after) : "nothing"));
        }
    }
    return out;
}

Complaints check_digest(const NodeType& type) {
    Complaints out;
    Draw draw(kSeed);
    std::map<std::string, Digest> known;
    for (int i = 0; i < kCases; ++i) {
        const std::string given = draw_accepted(type, draw).text();
        const Parsed parsed = parse(type, given);
        if (!parsed.node) return {"no parameters drawn from its ranges are accepted"};
        const std::string all = text_of(parsed.node->to_value());
        const Digest digest = digest_of(type, *parsed.node);
        for (const auto& [other, of_other] : known)
            if ((other == all) != (of_other == digest))
                out.push_back(fmt::format("{} and {} have {} digest", other, all,
                                          other == all ? "more than one" : "one"));
        known.emplace(all, digest);
    }
    NodeType next = type;
    ++next.version;
    const Parsed parsed = parse(type, draw_accepted(type, draw).text());
    if (parsed.node && digest_of(next, *parsed.node) == digest_of(type, *parsed.node))
        out.push_back("the next version has the same digest");
    return out;
}

Complaints check_refusals(const NodeType& type) {
    Draw draw(kSeed);
    Refusals refusals(type, draw_accepted(type, draw));
    refusals.unknown_key();
    for (const FieldInfo& f : type.fields) {
        refusals.field(f);
        if (f.required) refusals.missing(f);
    }
    return refusals.complaints;
}

}  // namespace keyline::testing
