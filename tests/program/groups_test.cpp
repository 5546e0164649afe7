// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/program/program.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

// Groups: graph files that are node types.

namespace keyline::test {

namespace {

using testing::HasSubstr;
using testing::Not;

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
    EXPECT_THAT(text, HasSubstr("out, which the id alone means; less; toned"));
}

TEST_F(Groups, PassTheirInputOnWhereTheyAreNotEnabled) {
    const std::string part = pixels("", "part");
    const std::string group = R"("g": { "type": "groups/twice.json", "in": "part", "enabled": )";
    EXPECT_EQ(pixels(group + "false },", "g"), part);
    EXPECT_EQ(pixels(group + "true },", "g", {"--set", "g.enabled=false"}), part);
    EXPECT_NE(pixels(group + "true },", "g"), part);
    EXPECT_EQ(pixels(R"("g": { "type": "groups/soft.json", "in": "part:G", "enabled": false },)", "g:less"),
              pixels("", "part:G"));
}

// What only it would have used is in reserve.
TEST_F(Groups, ThatAreNotEnabledLeaveNobodyUnused) {
    graph(kSource + std::string(R"("spare": { "type": "gaussian", "in": "c", "sigma": 1 },
        "g": { "type": "groups/soft.json", "in": "part", "mask": "spare:R", "enabled": false },
        "out": { "type": "write", "in": "g", "file": "a.exr" })"));
    EXPECT_EQ(keyline({"check", "graph.json"}).err, "");
}

// Groups that have a name: those that come with Keyline, and a show's.
class NamedGroups : public Groups {
protected:
    NamedGroups() {
        write("show/soft.json", version(3, 3));
        write("show/soft@2.json", version(2, 2));
        write("site/soft.json", version(4, 4));
        write("site/canny.json", version(7, 1));
        write("site/gaussian.json", version(1, 1));
        write("site/graph.json", R"({ "keyline": 1, "nodes": {} })");
    }

    static std::string version(int version, int sigma) {
        return fmt::format(R"({{ "keyline": 1, "version": {}, "inputs": {{ "in": {{}} }},
            "outputs": {{ "out": "b" }},
            "nodes": {{ "b": {{ "type": "gaussian", "in": "in", "sigma": {} }} }} }})",
                           version, sigma);
    }

    Outcome check(const std::string& type, const std::string& path = "show:site") const {
        graph(kSource + fmt::format(R"("g": {{ "type": "{}", "in": "part" }},
                                       "out": {{ "type": "write", "in": "g", "file": "a.exr" }})",
                                    type));
        return keyline({"check", "graph.json", "--streams"}, {.environment = {"KEYLINE_PATH=" + path}});
    }

    // The sigma of the group that a type means.
    std::string told(const std::string& type, const std::string& path = "show:site") const {
        graph(kSource + fmt::format(R"("g": {{ "type": "{}", "in": "part" }},
                                       "out": {{ "type": "write", "in": "g", "file": "a.exr" }})",
                                    type));
        const Outcome run = keyline({"render", "graph.json", "--no-provenance", "--progress", "none"},
                                    {.environment = {"KEYLINE_PATH=" + path}});
        EXPECT_EQ(run.status, 0) << run.err;
        return read(folder() / "a.exr");
    }
};

TEST_F(NamedGroups, AreFoundInThePathBeforeThoseThatAreShipped) {
    EXPECT_EQ(told("soft"), told("show/soft.json"));
    EXPECT_EQ(told("soft", "site:show"), told("site/soft.json"));
    EXPECT_EQ(told("canny"), told("site/canny.json"));
    EXPECT_EQ(told("gaussian"), told("gaussian", "")) << "a node's name is the node's";
}

TEST_F(NamedGroups, HaveVersions) {
    EXPECT_EQ(told("soft@2"), told("show/soft@2.json"));
    EXPECT_EQ(told("soft@3"), told("show/soft.json"));
    EXPECT_EQ(told("soft@4"), told("site/soft.json"));
    EXPECT_EQ(told("gaussian@1"), told("site/gaussian.json"));
    EXPECT_THAT(check("soft@5").err, HasSubstr("no node type 'soft@5'; 'soft' is version 3"));
}

TEST_F(NamedGroups, ComeWithKeyline) {
    const fs::path shipped = plates().parent_path() / "groups" / "normal_lines.json";
    graph(kSource + std::string(R"("g": { "type": "normal_lines", "normal": "part" },
                                   "out": { "type": "write", "in": "g", "file": "a.exr" })"));
    EXPECT_EQ(keyline({"check", "graph.json"}).err, "");
    EXPECT_EQ(keyline({"nodes", "normal_lines"}).out, keyline({"nodes", shipped.string()}).out);
    graph(kSource + std::string(R"("g": { "type": "groups/normal_lines.json", "normal": "part" },
                                   "out": { "type": "write", "in": "g", "file": "a.exr" })"));
    fs::remove_all(folder() / "groups");
    EXPECT_EQ(keyline({"check", "graph.json"}).err, "") << "as a file too";
}

TEST_F(NamedGroups, AreListedAndSuggested) {
    const RunOptions with_path{.environment = {"KEYLINE_PATH=show:site"}};
    const std::string list = keyline({"nodes"}, with_path).out;
    EXPECT_THAT(list, HasSubstr("\nGroups\n  canny"));
    EXPECT_THAT(list, HasSubstr("\n  soft@2"));
    EXPECT_THAT(list, Not(HasSubstr("\n  graph"))) << "it has no outputs";
    EXPECT_THAT(keyline({"schema"}, with_path).out, HasSubstr("\"soft@2\""));
    EXPECT_THAT(check("sofft").err, HasSubstr("no node type 'sofft'; did you mean 'soft'?"));
    write("mine.json", version(1, 1));
    EXPECT_THAT(check("mine").err, HasSubstr("for the file beside this one write \"mine.json\""));
}

TEST_F(NamedGroups, ThatAreBrokenAreTold) {
    write("show/broken.json", "{ \"keyline\": 1,");
    EXPECT_THAT(check("broken").err, HasSubstr("show/broken.json:1:"));
}

}  // namespace

}  // namespace keyline::test
