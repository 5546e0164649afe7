// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/node/reference.h"
#include "engine/plan/output_check.h"
#include "engine/plan/planner.h"
#include "tests/engine/test_nodes.h"
#include "tests/support/interpret.h"
#include "tests/support/run.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <stdexcept>

// Values of a frame that are not pixels: gathered, derived, read from outside, drawn and written.

namespace keyline::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

using Data = std::vector<std::shared_ptr<const Datum>>;

// Pixels and data over four sweeps: the sum of the first is read in the second and the third, what is derived
// from it in the last.
Json graph_of_all() {
    register_test_nodes<PointFile, SumOfAll, CountAbove, MovePoints, DrawPoints, Crop>();
    return {{"corners", {{"type", "point_file"}}},
            {"sum", {{"type", "sum_of_all"}, {"in", "in"}}},
            {"count", {{"type", "count_above"}, {"in", "in"}, {"sum", "sum"}}},
            {"moved", {{"type", "move_points"}, {"points", "corners"}, {"by", "sum"}}},
            {"drawn", {{"type", "draw_points"}, {"in", "in"}, {"points", "moved"}, {"number", "count"}}}};
}

Sequences one_image() { return {{"in", {noise({-3, 5, 60, 45}, {"Y"}, 7, -0.25F, 1)}}}; }

ResolvedFrame resolved(const Json& nodes, const std::vector<std::string>& ids,
                       const std::vector<std::string>& data_ids) {
    return resolve_graph(nodes, ids, one_image(), 1, true, data_ids);
}

Data of_sinks(const ResolvedFrame& frame) {
    const Data all = interpret_all(frame).data;
    Data out;
    for (const Sink& sink : frame.sinks)
        if (sink.request.stream.is_data())
            out.push_back(all[static_cast<std::size_t>(sink.request.stream.datum.op)]);
    return out;
}

bool equal(const Data& a, const Data& b) {
    return std::ranges::equal(a, b, [](const auto& x, const auto& y) { return x->equals(*y); });
}

std::string error_of_graph(const Json& nodes, const std::string& id) {
    try {
        run_graph(nodes, id, one_image());
        return "";
    } catch (const Failure& f) {
        return f.error().what;
    }
}

struct Made {
    std::string kind;
    int made_before, last_sweep;
    friend bool operator==(const Made&, const Made&) = default;
    friend void PrintTo(const Made& m, std::ostream* out) {
        *out << m.kind << ' ' << m.made_before << ' ' << m.last_sweep;
    }
};

std::vector<Made> made_in(const Plan& plan) {
    std::vector<Made> out;
    for (const PlannedDatum& d : plan.data)
        out.push_back({plan.frame.ops[static_cast<std::size_t>(d.op)].title, d.made_before, d.last_sweep});
    return out;
}

TEST(Data, AreTheSameForEverySchedule) {
    const Json nodes = graph_of_all();
    const std::vector<std::string> data_ids{"sum", "count", "moved"};
    const ResolvedFrame plain = resolved(nodes, {"drawn"}, data_ids);
    const Image expected = interpret(plain).front();
    const Data expected_data = of_sinks(plain);
    ASSERT_EQ(expected_data.size(), 3U);
    EXPECT_GT(datum_as<Numbers>(*expected_data[1]).values[0], 0);
    PlanOptions all;
    all.weigh_all = true;
    const std::size_t least =
        make_plan(resolved(nodes, {"drawn"}, data_ids), all).weighed.back().memory_bytes;
    for (const std::size_t memory : {std::size_t{0}, least})
        for (const int tile : {1, 7, 64, 4096})
            for (const int threads : {1, 2, 7}) {
                if (memory > 0 && threads > 1) continue;
                const Image image = render(make_plan(resolved(nodes, {"drawn"}, data_ids),
                                                     {threads, memory ? 0 : tile, memory}))
                                        .front();
                EXPECT_TRUE(same(image, expected)) << tile << ' ' << threads << ' ' << memory;
                EXPECT_TRUE(equal(rendered_data(), expected_data)) << tile << ' ' << threads << ' ' << memory;
            }
}

TEST(Data, LiveFromTheSweepThatMakesThemToTheLastThatReadsThem) {
    const Plan plan = make_plan(resolved(graph_of_all(), {"drawn"}, {}), {});
    EXPECT_EQ(plan.sweeps.size(), 4U);
    EXPECT_THAT(made_in(plan), ::testing::UnorderedElementsAre(Made{"node 'corners' (point_file)", 1, 0},
                                                               Made{"node 'sum' (sum_of_all)", 1, 2},
                                                               Made{"node 'count' (count_above)", 3, 3},
                                                               Made{"node 'moved' (move_points)", 1, 3}));
}

TEST(Data, ThatASinkTakesLiveToTheEnd) {
    const Plan plan = make_plan(resolved(graph_of_all(), {}, {"sum"}), {});
    EXPECT_THAT(made_in(plan), ElementsAre(Made{"node 'sum' (sum_of_all)", 1, 1}));
}

TEST(Data, TwoGathersOfOneInputShareASweep) {
    Json nodes = graph_of_all();
    nodes.set("again", {{"type", "sum_of_all"}, {"in", "in"}});
    const Plan plan = make_plan(resolved(nodes, {}, {"sum", "again"}), {});
    ASSERT_EQ(plan.sweeps.size(), 1U);
    EXPECT_EQ(plan.sweeps[0].roots.size(), 2U);
    EXPECT_EQ(plan.stores.size(), 1U) << "decoded once for both";
}

TEST(Data, FromOutsideAreReadOnceJustBeforeTheSweepThatNeedsThem) {
    Json nodes = graph_of_all();
    nodes.set("late", {{"type", "draw_points"}, {"in", "in"}, {"points", "corners"}, {"number", "count"}});
    const Plan plan = make_plan(resolved(nodes, {"late"}, {}), {});
    EXPECT_THAT(made_in(plan), ::testing::Contains(Made{"node 'corners' (point_file)", 3, 3}));
    PointFile::reads() = 0;
    render(make_plan(resolved(nodes, {"late", "drawn"}, {"corners"}), {2, 7, 0}));
    EXPECT_EQ(PointFile::reads(), 1);
}

TEST(Data, AloneNeedNoSweep) {
    const Plan plan = make_plan(resolved(graph_of_all(), {}, {"corners"}), {});
    EXPECT_TRUE(plan.sweeps.empty());
    EXPECT_GT(plan.memory_bytes, 0U);
    render(make_plan(resolved(graph_of_all(), {}, {"corners"}), {}));
    EXPECT_EQ(datum_as<Points>(*rendered_data().front()).at.back(), (std::array{10, 10}));
}

TEST(Data, ThatNobodyNeedsAreNotMade) {
    Json nodes = graph_of_all();
    nodes.set("nothing", {{"type", "cut_out"}, {"in", "drawn"}, {"window", {500, 500, 510, 510}}});
    PointFile::reads() = SumOfAll::finished() = 0;
    render(make_plan(resolved(nodes, {"nothing"}, {}), {}));
    EXPECT_EQ(PointFile::reads(), 0);
    EXPECT_EQ(SumOfAll::finished(), 0);
}

TEST(Data, OfAnEmptyImageAreMadeToo) {
    const Json nodes = graph_of_all();
    const Sequences empty{{"in", {Image({0, 0, 0, 0}, {"Y"})}}};
    render(make_plan(resolve_graph(nodes, {}, empty, 1, true, {"sum"}), {}));
    EXPECT_EQ(datum_as<Numbers>(*rendered_data().front()).values, (std::vector<double>{0}));
}

TEST(Data, APortThatTakesDataRefusesPixels) {
    Json nodes = graph_of_all();
    nodes.set("drawn", {{"type", "draw_points"}, {"in", "in"}, {"points", "in"}});
    EXPECT_THAT(error_of_graph(nodes, "drawn"),
                HasSubstr("node 'drawn' (draw_points): 'points' takes points; 'in' gives pixels; "
                          "no node turns pixels into points"));
}

TEST(Data, APortThatTakesPixelsRefusesDataAndSaysWhatToPutBetween) {
    Json nodes = graph_of_all();
    nodes.set("soft", {{"type", "gaussian"}, {"in", "moved"}});
    EXPECT_THAT(error_of_graph(nodes, "soft"),
                HasSubstr("node 'soft' (gaussian): 'in' takes pixels; 'moved' gives points; "
                          "put a 'draw_points' between"));
}

TEST(Data, APortThatTakesOneKindRefusesAnotherAndNamesEveryWay) {
    Json nodes = graph_of_all();
    nodes.set("moved", {{"type", "move_points"}, {"points", "sum"}, {"by", "in"}});
    const std::string text = error_of_graph(nodes, "drawn");
    EXPECT_THAT(text, HasSubstr("'points' takes points; 'sum' gives numbers; put a 'move_points' between"));
    EXPECT_THAT(text, HasSubstr("'by' takes numbers; 'in' gives pixels; put a 'count_above' or 'sum_of_all' "
                                "between"));
}

TEST(Data, HaveNoChannelsToPick) {
    Json nodes = graph_of_all();
    nodes.set("drawn", {{"type", "draw_points"}, {"in", "in"}, {"points", "corners:X"}});
    EXPECT_THAT(error_of_graph(nodes, "drawn"),
                HasSubstr("'corners' gives points, which has no channels to pick; write 'corners'"));
}

// A derivation that throws.
struct NoPoints {
    static constexpr Info info{"no_points", "Throws."};
    struct Params {
        Input points;
        static constexpr auto fields = declare(input(&Params::points, "points", "", data<Points>()));
    };
    explicit NoPoints(const Params&) {}
    static Points derive(const Inputs& in) {
        if (!in.datum<Points>(0).at.empty()) throw std::runtime_error("no room");
        return {};
    }
    static std::size_t datum_bytes() { return 0; }
};

TEST(Data, ThatCanNotBeMadeEndTheFrameAndNameTheNode) {
    Json nodes = graph_of_all();
    register_test_nodes<NoPoints>();
    nodes.set("none", {{"type", "no_points"}, {"points", "moved"}});
    nodes.set("drawn", {{"type", "draw_points"}, {"in", "in"}, {"points", "none"}});
    try {
        run_graph(nodes, "drawn", one_image(), {.threads = 2, .tile = 7, .frame = 3});
        FAIL() << "it ran to the end";
    } catch (const Failure& f) {
        EXPECT_EQ(f.error().kind, ErrorKind::kInternal);
        EXPECT_EQ(f.error().node, "node 'none' (no_points), frame 3");
        EXPECT_EQ(f.error().what, "no room between two sweeps");
    }
}

TEST(Data, APlanTellsWhenTheyAreMadeAndForHowLong) {
    const std::string text = make_plan(resolved(graph_of_all(), {"drawn"}, {"moved"}), {}).text();
    EXPECT_THAT(text, HasSubstr("\n  gather   node 'sum' (sum_of_all), from "));
    EXPECT_THAT(text, HasSubstr("\n  make     numbers of node 'sum' (sum_of_all), 1M, until sweep 3\n"));
    EXPECT_THAT(text, HasSubstr("\n  make     points of node 'corners' (point_file), 1M\n"));
    EXPECT_THAT(text, HasSubstr("\n  make     points of node 'moved' (move_points), 1M, until written\n"));
    EXPECT_THAT(text, HasSubstr("\noutput "));
    const std::string alone = make_plan(resolved(graph_of_all(), {}, {"corners"}), {}).text();
    EXPECT_THAT(alone, HasSubstr("\nbefore the first sweep\n  make     points of node 'corners'"));
    EXPECT_THAT(alone, HasSubstr("\ninput corners.points, node 'corners' (point_file)\n  reads    points\n"));
}

TEST(Data, AreNotWrittenOverTheFileTheyAreReadFrom) {
    ResolvedFrame frame = resolved(graph_of_all(), {}, {"corners"});
    frame.sinks[0].request.file = "other.points";
    Diagnostics none, one;
    check_outputs(frame, none);
    EXPECT_TRUE(none.ok());
    frame.sinks[0].request.file = "corners.points";
    check_outputs(frame, one);
    ASSERT_EQ(one.errors().size(), 1U);
    EXPECT_EQ(one.errors()[0].what, "'corners.points' is read by this run");
}

// A gather whose partials are large.
struct LargePartials : SumOfAll {
    static constexpr Info info{"large_partials", "A sum with large partials."};
    using SumOfAll::SumOfAll;
    static std::size_t partial_bytes(const Rect&) { return std::size_t{1} << 20; }
};

TEST(Data, PartialsThatWaitCountAsMemory) {
    Json nodes = graph_of_all();
    register_test_nodes<LargePartials>();
    nodes.set("large", {{"type", "large_partials"}, {"in", "in"}});
    const auto memory = [&](const char* id, int threads) {
        return make_plan(resolved(nodes, {}, {id}), {threads, 16, 0}).memory_bytes;
    };
    EXPECT_GE(memory("large", 1), memory("sum", 1) + (std::size_t{1} << 20)) << "the one being folded";
    // 4 tiles a row, at least 2 rows in work.
    EXPECT_GE(memory("large", 4), memory("sum", 4) + (std::size_t{8} << 20)) << "those that wait for another";
}

TEST(Data, TheReferenceAndTheSchemaSayWhatPortsTakeAndNodesGive) {
    graph_of_all();
    EXPECT_THAT(node_text(*registry().find("draw_points")),
                HasSubstr("points: an input of points (required)"));
    EXPECT_THAT(node_text(*registry().find("sum_of_all")), HasSubstr("sum_of_all (gather)\n"));
    EXPECT_THAT(node_text(*registry().find("sum_of_all")), HasSubstr("gives\n  numbers, not pixels\n"));
    EXPECT_THAT(node_text(*registry().find("move_points")), HasSubstr("move_points (derivation)\n"));
    EXPECT_THAT(reference_markdown(), HasSubstr("Gives numbers, not pixels."));
    EXPECT_THAT(schema_json(), HasSubstr("\"description\": \"an input of points\""));
}

}  // namespace
}  // namespace keyline::testing
