// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/cryptomatte.h"
#include "tests/nodes/plate.h"

#include <bit>

namespace keyline::testing {
namespace {

using Images = std::map<std::string, Image>;

Image edges(const Image& drawing) {
    Image out = drawing;
    out.channels[0].name = "edge";
    return out;
}

Image only(const std::string& channel, Image image) {
    image.channels = {image.channel(channel)};
    return image;
}

Image line(const Json& params, const Images& inputs) { return only("edge", run("idedge", params, inputs)); }
Image line(const Json& params, const Image& ids) { return line(params, Images{{"in", ids}}); }

const Image& two_objects() {
    static const Image ids = ascii({"......", "..11..", "..12..", "......"});
    return ids;
}

TEST(IdEdge, DrawsBothSides) {
    EXPECT_IMAGE(line({}, two_objects()), edges(ascii({"..11..", ".1111.", ".1111.", "..11.."})));
}

TEST(IdEdge, BelongsToTheLargerIdWithoutDepth) {
    EXPECT_IMAGE(line({{"side", "inner"}}, two_objects()),
                 edges(ascii({"......", "..11..", "..11..", "......"})));
    EXPECT_IMAGE(line({{"side", "outer"}}, two_objects()),
                 edges(ascii({"..11..", ".1.11.", ".11.1.", "..11.."})));
}

TEST(IdEdge, BelongsToTheNearerObject) {
    const Image ids = ascii({"1122"}), depth = ascii({"5533"}), behind = ascii({"1144"});
    EXPECT_IMAGE(line({{"side", "inner"}}, Images{{"in", ids}, {"depth", depth}}), edges(ascii({"..1."})));
    EXPECT_IMAGE(line({{"side", "outer"}}, Images{{"in", ids}, {"depth", depth}}), edges(ascii({".1.."})));
    EXPECT_IMAGE(line({{"side", "inner"}}, Images{{"in", ids}, {"depth", behind}}), edges(ascii({".1.."})));
}

TEST(IdEdge, TheBorderOfTheImageIsNoEdge) {
    EXPECT_IMAGE(line({}, ascii({"11", "11"})), edges(ascii({"..", ".."})));
    EXPECT_IMAGE(line({}, ascii({"1"})), edges(ascii({"."})));
}

// A row of pixels that a covers from the left up to `edge`, and b from there on.
Image antialiased(double edge, int width) {
    Image image({0, 0, width, 1}, {"Id00.r", "Id00.g", "Id00.b", "Id00.a"});
    const float a = std::bit_cast<float>(cryptomatte_id("a")), b = std::bit_cast<float>(cryptomatte_id("b"));
    for (int x = 0; x < width; ++x) {
        const auto covered = static_cast<float>(std::clamp(edge - x, 0.0, 1.0));
        const bool a_first = covered > 0.5F;
        image.at("Id00.r", x, 0) = a_first ? a : b;
        image.at("Id00.g", x, 0) = a_first ? covered : 1 - covered;
        image.at("Id00.b", x, 0) = a_first ? b : a;
        image.at("Id00.a", x, 0) = a_first ? 1 - covered : covered;
    }
    return image;
}

// The ranks say where in the pixel the edge is: the line lies exactly there, and keeps its width.
TEST(IdEdge, CoveragePlacesTheEdgeInsideThePixel) {
    for (const double edge : {4.0, 4.2, 4.45, 4.75, 5.0}) {
        SCOPED_TRACE(edge);
        const Image in = antialiased(edge, 9);
        const Image near_a = Image({0, 0, 9, 1}, {"Z"}).fill("Z", [](int x, int) { return x; });
        for (const std::string side : {"both", "inner", "outer"}) {
            const double from = side == "outer" ? edge : edge - 1, to = side == "inner" ? edge : edge + 1;
            const Image out = line({{"side", side}}, Images{{"in", in}, {"depth", near_a}});
            for (int x = 0; x < 9; ++x)
                ASSERT_NEAR(out.at("edge", x, 0),
                            std::max(0.0, std::min(to, x + 1.0) - std::max(from, double(x))), 1e-5)
                    << side << ' ' << x;
        }
    }
}

TEST(IdEdge, TheOwnerIsTheNearerObject) {
    const Image ids = ascii({"1122"}), near2 = ascii({"5533"}), near1 = ascii({"1144"});
    const auto owner = [&](const char* side, const Image& depth) {
        Image out = only("owner", run("idedge", {{"side", side}}, Images{{"in", ids}, {"depth", depth}}));
        out.channels[0].name = ascii({"."}).channels[0].name;
        return out;
    };
    EXPECT_IMAGE(owner("both", near2), ascii({".22."}));
    EXPECT_IMAGE(owner("outer", near2), ascii({".2.."}));
    EXPECT_IMAGE(owner("both", near1), ascii({".11."}));
}

// The lines are a Cryptomatte: by name they come apart again, and together they are all there is.
TEST(IdEdge, LinesArePickedByTheNameOfTheirOwner) {
    const auto of = [](const char* objects) {
        return Json{{"type", "cryptomatte"}, {"in", "lines"}, {"objects", {objects}}};
    };
    const Json nodes{
        {"r", {{"type", "read"}, {"file", KEYLINE_PLATE}}},
        {"lines", {{"type", "idedge"}, {"in", "r"}, {"layer", "CryptoObject"}, {"depth", "r:Depth"}}},
        {"monkey", of("suzanne")},
        {"all", of("*")}};
    const Image lines = run_graph(nodes, "lines", Images{}), monkey = run_graph(nodes, "monkey", Images{});
    const float id = std::bit_cast<float>(cryptomatte_id("suzanne"));
    int seen = 0;
    for (int y = 0; y < 270; ++y)
        for (int x = 0; x < 480; ++x) {
            const bool hers = lines.at("owner", x, y) == id;
            ASSERT_EQ(monkey.at("matte", x, y), hers ? lines.at("edge", x, y) : 0) << x << ' ' << y;
            seen += hers ? 1 : 0;
        }
    EXPECT_GT(seen, 300);
    EXPECT_EQ(run_graph(nodes, "all", Images{}).channel("matte").samples, lines.channel("edge").samples);
}

TEST(IdEdge, DoesNotDependOnTheTile) {
    const Json nodes{{"r", {{"type", "read"}, {"file", KEYLINE_PLATE}}},
                     {"e",
                      {{"type", "idedge"},
                       {"in", "r"},
                       {"layer", "CryptoObject"},
                       {"side", "inner"},
                       {"depth", "r:Depth"}}}};
    const Image whole = run_graph(nodes, "e", Images{}, {1, 0});
    EXPECT_IMAGE(run_graph(nodes, "e", Images{}, {2, 37}), whole);
    double sum = 0;
    for (const float s : whole.channel("edge").samples) {
        ASSERT_TRUE(s >= 0 && s <= 1.000001F) << s;
        sum += double{s};
    }
    EXPECT_GT(sum, 2000);   // the outlines of a street
    EXPECT_LT(sum, 23000);  // … and not its surfaces
}

}  // namespace
}  // namespace keyline::testing
