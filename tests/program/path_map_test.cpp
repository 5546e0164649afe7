// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/program/program.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

// A graph with the paths of another machine.

namespace keyline::test {

namespace {

using testing::HasSubstr;

class PathMaps : public ProgramTest {
protected:
    PathMaps() {
        fs::create_directories(folder() / "local/plates");
        fs::copy(plates() / "street.0001.exr", folder() / "local/plates/a.0001.exr");
    }

    // One rule a line: format, source, destination below this test's folder.
    void rules(const std::vector<std::array<std::string, 3>>& all) const {
        std::string text;
        for (const auto& [format, source, destination] : all)
            text += fmt::format(
                R"({}{{ "source_path_format": "{}", "source_path": "{}", "destination_path": "{}" }})",
                text.empty() ? "" : ",\n", format, source, (folder() / destination).string());
        write("rules.json", R"({ "version": "pathmapping-1.0", "path_mapping_rules": [)" + text + "] }");
    }
    void between(const std::string& in, const std::string& out) const {
        graph(fmt::format(R"("r":   {{ "type": "read", "file": "{}" }},
                             "out": {{ "type": "write", "in": "r:Combined", "file": "{}" }})",
                          in, out));
    }
    Outcome render(std::vector<std::string> more = {}) const {
        more.insert(more.begin(), {"render", "graph.json", "--frames", "1", "--path-map", "rules.json"});
        return keyline(more);
    }
};

TEST_F(PathMaps, InputsAndOutputsAreMoved) {
    between("/show/plates/a.####.exr", "/show/comp/b.####.exr");
    rules({{"POSIX", "/show", "local"}});
    const Outcome run = render();
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_TRUE(exists("local/comp/b.0001.exr"));
    // All commands take it, and what was made so is current.
    EXPECT_EQ(keyline({"check", "graph.json", "--path-map", "rules.json"}).status, 0);
    EXPECT_EQ(keyline({"verify", "graph.json", "--frames", "1", "--path-map", "rules.json"}).status, 0);
}

TEST_F(PathMaps, TheLongestSourceCountsAndNamesAreWhole) {
    between("/sys/plates/a.####.exr", "b.exr");
    rules({{"POSIX", "/sys", "nowhere"},
           {"POSIX", "/sys/plates/", "local/plates"},
           {"POSIX", "/sys/plates", "later"}});
    const Outcome run = render({"--set", "out.file=/sys/comp/b.exr"});
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_TRUE(exists("nowhere/comp/b.exr"));
    EXPECT_EQ(render({"--set", "out.file=/sys/plates.exr"}).status, 0) << "it does not lie in /sys/plates";
    EXPECT_TRUE(exists("nowhere/plates.exr"));
}

TEST_F(PathMaps, WindowsPathsHaveTwoSeparatorsAndNoCase) {
    rules({{"WINDOWS", R"(P:\\Show)", "local"}, {"WINDOWS", R"(\\\\server\\share)", "local"}});
    for (const char* in : {R"(P:\\show\\plates\\a.####.exr)", "p:/SHOW/plates/a.%04d.exr",
                           R"(\\\\Server\\share\\plates\\a.####.exr)"}) {
        between(in, R"(P:\\Show\\comp\\b.exr)");
        const Outcome run = render();
        EXPECT_EQ(run.status, 0) << in << run.err;
        EXPECT_TRUE(exists("local/comp/b.exr"));
        fs::remove(folder() / "local/comp/b.exr");
    }
}

TEST_F(PathMaps, ADriveThatNoRuleIsAboutIsAnErrorOfTheGraph) {
    rules({{"WINDOWS", R"(P:\\Show)", "local"}});
    for (const char* in : {R"(Q:\\show\\a.####.exr)", R"(\\\\server\\a.####.exr)"}) {
        between(in, "b.exr");
        const Outcome run = render();
        EXPECT_EQ(run.status, 2) << in;
        EXPECT_THAT(run.err, HasSubstr("is one of Windows"));
        EXPECT_THAT(run.err, HasSubstr("--path-map"));
    }
}

TEST_F(PathMaps, ColourConfigsAreMoved) {
    between("/show/plates/a.####.exr", "/show/b.exr");
    rules({{"POSIX", "/show", "local"}});
    EXPECT_THAT(render({"--set", "r.colorspace=ACEScg", "--ocio", "/show/config.ocio"}).err,
                HasSubstr((folder() / "local/config.ocio").string()));
}

TEST_F(PathMaps, WhatIsNoRulesFileIsToldWithItsPlace) {
    between("/show/plates/a.####.exr", "b.exr");
    struct Case {
        const char *text, *says;
    };
    for (
        const Case& c :
        {Case{"[]", "rules.json:1:1: error: path mapping rules are an object"},
         Case{R"({ "version": "pathmapping-2.0" })",
              "rules.json:1:14: error: 'version' must be 'pathmapping-1.0'"},
         Case{R"({ "path_mapping_rules": [] })", "rules.json:1:1: error: a rule must have 'version'"},
         Case{
             R"({ "version": "pathmapping-1.0", "path_mapping_rules": [{ "source_path_format": "POSIX" }] })",
             "a rule must have 'destination_path'"},
         Case{R"({ "version": "pathmapping-1.0", "path_mapping_rules": [{ "source_path_format": "URI",
                    "source_path": "/a", "destination_path": "/b" }] })",
              "it must be POSIX or WINDOWS"},
         Case{R"({ "version": "pathmapping-1.0", "path_mapping_rules": [{ "source_path_format": "POSIX",
                    "source_path": "a", "destination_path": "/b" }] })",
              "'source_path' is 'a'; it must be absolute"},
         Case{R"({ "version": "pathmapping-1.0", "rules": [] })", "unknown key 'rules'"}}) {
        write("rules.json", c.text);
        const Outcome run = render();
        EXPECT_EQ(run.status, 2) << c.text;
        EXPECT_THAT(run.err, HasSubstr(c.says));
    }
    fs::remove(folder() / "rules.json");
    EXPECT_THAT(render().err,
                HasSubstr("--path-map rules.json: error: cannot read the path map 'rules.json': "));
}

TEST_F(PathMaps, NoRulesChangeNothing) {
    between("local/plates/a.####.exr", "b.exr");
    write("rules.json", "{}");
    EXPECT_EQ(render().status, 0);
}

}  // namespace

}  // namespace keyline::test
