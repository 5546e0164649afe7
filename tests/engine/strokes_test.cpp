// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/strokes.h"

#include "engine/node/datum.h"

#include <gmock/gmock.h>

namespace keyline {
namespace {

using ::testing::ElementsAre;

Stroke stroke(StrokeKind kind, const std::vector<std::array<double, 2>>& places, bool closed = false) {
    Stroke out;
    out.kind = kind;
    out.closed = closed;
    for (const auto& [x, y] : places) {
        out.vertices.emplace_back();
        out.vertices.back().x = x;
        out.vertices.back().y = y;
    }
    return out;
}

std::vector<double> xs(const Stroke& s) {
    std::vector<double> out;
    for (const StrokeVertex& v : s.vertices) out.push_back(v.x);
    return out;
}

TEST(Strokes, AreAKindOfData) {
    static_assert(DataKind<Strokes>);
    Strokes strokes{{}, {}, {}, {stroke(StrokeKind::kCrease, {{0, 0}, {3, 4}})}};
    EXPECT_STREQ(make_datum(strokes)->kind(), "strokes");
    EXPECT_GE(strokes.bytes(), 2 * sizeof(StrokeVertex));
    EXPECT_TRUE(make_datum(strokes)->equals(*make_datum(strokes)));
    Strokes other = strokes;
    other.strokes[0].vertices[1].anchor[2] = 1;
    EXPECT_FALSE(make_datum(strokes)->equals(*make_datum(other)));
}

TEST(Strokes, AreMeasuredAlongTheirWay) {
    Stroke open = stroke(StrokeKind::kUser, {{0, 0}, {3, 4}, {3, 9}});
    measure(open);
    EXPECT_EQ(open.vertices[1].arc, 5);
    EXPECT_EQ(open.vertices[2].arc, 10);
    EXPECT_EQ(open.vertices[1].u, 0.5);
    EXPECT_EQ(open.vertices[2].u, 1);

    Stroke square = stroke(StrokeKind::kUser, {{0, 0}, {2, 0}, {2, 2}, {0, 2}}, true);
    measure(square);
    EXPECT_EQ(length_of(square), 8);
    EXPECT_EQ(square.vertices[3].u, 0.75) << "the way back counts";
}

TEST(Strokes, StandInOneOrderHoweverTheyWereFound) {
    Strokes a{{},
              {},
              {},
              {stroke(StrokeKind::kCrease, {{0, 0}, {1, 1}}), stroke(StrokeKind::kOutline, {{5, 2}, {6, 3}}),
               stroke(StrokeKind::kOutline, {{4, 2}, {6, 3}}), stroke(StrokeKind::kOutline, {{9, 1}, {6, 3}}),
               stroke(StrokeKind::kOutline, {{9, 1}, {6, 2}})}};
    a.strokes[1].near = 7;
    Strokes b = a;
    std::ranges::reverse(b.strokes);
    arrange(a);
    arrange(b);
    EXPECT_EQ(a, b);
    std::vector<double> first;
    for (const Stroke& s : a.strokes) first.push_back(s.vertices[0].x);
    EXPECT_THAT(first, ElementsAre(9, 9, 4, 5, 0));
    EXPECT_EQ(a.strokes[0].vertices[1].y, 2);
}

TEST(Strokes, ThatAreClosedBeginAtTheTop) {
    Strokes strokes{{}, {}, {}, {stroke(StrokeKind::kOutline, {{5, 3}, {2, 5}, {1, 1}, {4, 1}}, true)}};
    arrange(strokes);
    EXPECT_THAT(xs(strokes.strokes[0]), ElementsAre(1, 4, 5, 2));
    EXPECT_EQ(strokes.strokes[0].vertices[0].arc, 0);
}

TEST(Strokes, DropWhatIsNoStroke) {
    Strokes strokes{{},
                    {},
                    {{1, "a"}, {2, "b"}},
                    {stroke(StrokeKind::kOutline, {{5, 3}}), stroke(StrokeKind::kOutline, {{5, 3}, {2, 5}}),
                     stroke(StrokeKind::kOutline, {})}};
    strokes.strokes[1].far = 2;
    arrange(strokes);
    EXPECT_EQ(strokes.strokes.size(), 1U);
    EXPECT_THAT(strokes.names, ElementsAre(std::pair<const uint32_t, std::string>(2, "b")));
}

TEST(Strokes, HaveAWordForEachOfTheirKinds) {
    EXPECT_STREQ(word_of(StrokeKind::kOutline), "outline");
    EXPECT_STREQ(word_of(StrokeKind::kUser), "user");
    EXPECT_STREQ(word_of(StrokeEnd::kRim), "rim");
    EXPECT_STREQ(word_of(StrokeAnchor::kRest), "rest");
}

}  // namespace
}  // namespace keyline
