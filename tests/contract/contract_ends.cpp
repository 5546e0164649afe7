// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/plan/planner.h"
#include "engine/plan/resolve.h"
#include "tests/contract/contract.h"
#include "tests/support/draw.h"

#include <cmath>
#include <exception>
#include <fmt/format.h>
#include <optional>

namespace keyline::testing {

namespace {

using Kind = TypeInfo::Kind;

constexpr unsigned kSeed = 5;
constexpr Rect kFewPixels{-2, 1, 4, 5};

// What the planner may estimate for a result of few pixels, and how many of them are computed to see that
// nothing hangs.  What becomes larger is told by its size, before anything is computed.
constexpr double kSoon = 5;
constexpr int64_t kFew = 1 << 18;

bool has_ends(const TypeInfo& type) {
    const bool numeric = type.kind == Kind::kNumber || type.kind == Kind::kInteger ||
                         type.kind == Kind::kPair || type.kind == Kind::kNumbers;
    return numeric && std::isfinite(type.range.min) && std::isfinite(type.range.max);
}

Json with_all(const TypeInfo& type, double value) {
    return type.kind == Kind::kNumbers ? Json::array(std::vector<Json>(type.count, value)) : Json(value);
}

// The node with one parameter at an end of its range.  Nothing where it is refused whatever the others are:
// then it was told.
std::optional<NodeCase> case_at(const NodeType& type, const FieldInfo& field, double end) {
    Draw draw(kSeed);
    for (int tries = 0; tries < 30; ++tries) {
        NodeCase c;
        Json node = draw.parameters(type, [&](const TypeInfo& t) {
            const std::string name = fmt::format("image{}", c.inputs.size());
            for (int frame = 0; frame < 3; ++frame) c.inputs[name].push_back(draw.image(t.takes, kFewPixels));
            return name;
        });
        c.nodes.set(c.id, node.set(field.name, with_all(field.type, end)));
        try {
            c.resolve();
            return c;
        } catch (const Failure&) {
            continue;
        }
    }
    return std::nullopt;
}

int64_t pixels_written(const Plan& plan) {
    int64_t sum = 0;
    for (const Sink& sink : plan.frame.sinks) sum += sink.request.spec.data_window.area();
    return sum;
}

}  // namespace

Complaints check_ends(const NodeType& type) {
    Complaints out;
    for (const FieldInfo& field : type.fields) {
        if (!has_ends(field.type)) continue;
        for (const double end : {field.type.range.min, field.type.range.max}) {
            const std::string who = fmt::format("'{}' at {}", field.name, end);
            try {
                const std::optional<NodeCase> c = case_at(type, field, end);
                if (!c) continue;
                Plan plan = make_plan(c->resolve(), {2, 0, 0});
                if (pixels_written(plan) > kFew) continue;
                if (plan.seconds > kSoon)
                    out.push_back(fmt::format("{} is planned to take {:.0f} seconds", who, plan.seconds));
                else
                    render(std::move(plan));
            } catch (const std::exception& e) {
                out.push_back(fmt::format("{} threw: {}", who, e.what()));
            }
        }
    }
    return out;
}

}  // namespace keyline::testing
