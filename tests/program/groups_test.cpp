// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/program/program.h"

#include <gmock/gmock.h>

// Groups: graph files that are node types.

namespace keyline::test {

namespace {

using testing::HasSubstr;

constexpr const char* kSource = R"("c": { "type": "constant", "color": [1, 0.5, 0], "size": [40, 20] },
    "part": { "type": "crop", "in": "c", "region": [10, 5, 20, 10] },)";

class Groups : public ProgramTest {
protected:
    Groups() {
        write("groups/soft.json", R"({
            "keyline": 1, "about": "Softer",
            "inputs": { "in": { "about": "The picture" }, "mask": { "optional": true } },
            "parameters": { "s": { "type": "number", "default": 1, "range": [0, 9], "about": "How soft" } },
            "variables": { "k": "= s + 1" },
            "outputs": { "out": "blur", "less": "less:R", "toned": "toned" },
            "nodes": {
                "blur": { "type": "gaussian", "in": "in", "sigma": "${k}" },
                "toned": { "type": "grade", "in": "less", "multiply": 2, "mask": "mask" },
                "less": { "type": "gaussian", "in": "in", "sigma": "${s}" } } })");
        write("groups/twice.json", R"({
            "keyline": 1, "inputs": { "in": {} }, "outputs": { "out": "b" },
            "nodes": { "a": { "type": "soft.json", "in": "in" }, "b": { "type": "soft.json", "in": "a", "s": 2 } } })");
    }

    // The bytes of what the node `out` writes of `from`.
    std::string pixels(const std::string& nodes, const std::string& from,
                       std::vector<std::string> options = {}) const {
        graph(kSource + nodes + R"("out": { "type": "write", "in": ")" + from + R"(", "file": "####.exr" })");
        options.insert(options.begin(),
                       {"render", "graph.json", "--no-provenance", "--progress", "none", "--frames", "3"});
        const Outcome run = keyline(options);
        EXPECT_EQ(run.status, 0) << run.err;
        return read(folder() / "0003.exr");
    }
};

TEST_F(Groups, StandForTheirNodes) {
    EXPECT_EQ(pixels(R"("g": { "type": "groups/soft.json", "in": "part", "s": 2 },)", "g"),
              pixels(R"("g": { "type": "gaussian", "in": "part", "sigma": 3 },)", "g"));
    EXPECT_EQ(pixels(R"("g": { "type": "groups/soft.json", "in": "part" },)", "g:less"),
              pixels(R"("g": { "type": "gaussian", "in": "part", "sigma": 1 },)", "g:R"));
    EXPECT_EQ(pixels(R"("g": { "type": "groups/soft.json", "in": "part:G" },)", "g:G"),
              pixels(R"("g": { "type": "gaussian", "in": "part:G", "sigma": 2 },)", "g"));
}

TEST_F(Groups, DoWithoutAnInputThatIsNotConnected) {
    const std::string less = R"("less": { "type": "gaussian", "in": "part", "sigma": 1 },)";
    EXPECT_EQ(pixels(R"("g": { "type": "groups/soft.json", "in": "part", "mask": "c:G" },)", "g:toned"),
              pixels(less + R"("g": { "type": "grade", "in": "less", "multiply": 2, "mask": "c:G" },)", "g"));
    EXPECT_EQ(pixels(R"("g": { "type": "groups/soft.json", "in": "part" },)", "g:toned"),
              pixels(less + R"("g": { "type": "grade", "in": "less", "multiply": 2 },)", "g"));
}

TEST_F(Groups, TakeExpressionsAndKeys) {
    const std::string three = pixels(R"("g": { "type": "gaussian", "in": "part", "sigma": 3 },)", "g");
    for (const char* s : {"\"= frame - 1\"", "\"= width / 20\"", R"({ "keys": [[1, 0], [5, 4]] })"})
        EXPECT_EQ(
            three,
            pixels(std::string(R"("g": { "type": "groups/soft.json", "in": "part", "s": )") + s + "},", "g"))
            << s;
}

TEST_F(Groups, StandInsideOthers) {
    EXPECT_EQ(pixels(R"("g": { "type": "groups/twice.json", "in": "part" },)", "g"),
              pixels(R"("a": { "type": "gaussian", "in": "part", "sigma": 2 },
                        "g": { "type": "gaussian", "in": "a", "sigma": 3 },)",
                     "g"));
}

TEST_F(Groups, AreReachedFromTheCommandLine) {
    const std::string group = R"("g": { "type": "groups/twice.json", "in": "part" },)";
    EXPECT_EQ(pixels(group, "g", {"--set", "g/a.s=4", "--set", "g/b/blur.sigma=1"}),
              pixels(R"("a": { "type": "gaussian", "in": "part", "sigma": 5 },
                        "g": { "type": "gaussian", "in": "a", "sigma": 1 },)",
                     "g"));
    const std::string look = pixels(R"("g": { "type": "gaussian", "in": "part", "sigma": 2 },)", "g");
    EXPECT_EQ(pixels(group, "g", {"--output", "g/a=0003.exr"}), look);
    EXPECT_EQ(pixels(group, "g", {"--output", "g/a/blur=0003.exr"}), look);
}

TEST_F(Groups, AreDocumentedAsNodesAre) {
    const std::string text = keyline({"nodes", "groups/soft.json"}).out;
    EXPECT_THAT(text, HasSubstr("Softer"));
    EXPECT_THAT(text, HasSubstr("How soft"));
    EXPECT_THAT(text, HasSubstr("from 0 to 9"));
}

}  // namespace

}  // namespace keyline::test
