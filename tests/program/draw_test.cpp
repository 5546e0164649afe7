// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/program/program.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

// keyline draw: graphs as drawings.

namespace keyline::test {

namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class Draw : public ProgramTest {
protected:
    Outcome draw(std::vector<std::string> more = {}, RunOptions options = {}) const {
        more.insert(more.begin(), {"draw", "graph.json", "-o", "graph.svg"});
        return keyline(more, std::move(options));
    }
    std::string drawing() const { return read(folder() / "graph.svg"); }
    void sound() const {
        graph(R"("c":    { "type": "constant", "color": [0.2, 0.5, 0], "size": [32, 16] },
                 "blur": { "type": "gaussian", "in": "c:R", "sigma": 2.5 },
                 "out":  { "type": "write", "in": "blur", "file": "<out>&.exr" })");
    }
};

TEST_F(Draw, NodesWithTheirTypesParametersAndPictures) {
    sound();
    const Outcome run = draw();
    EXPECT_EQ(run.status, 0) << run.err;
    const std::string svg = drawing();
    for (const char* text : {">blur<", ">gaussian<", ">sigma", "2.5<", ">R<", "&lt;out&gt;&amp;.exr", "<svg"})
        EXPECT_THAT(svg, HasSubstr(text));
    std::size_t pictures = 0;
    for (auto at = svg.find("data:image/png;base64,"); at != std::string::npos;
         at = svg.find("data:image/png;base64,", at + 1))
        ++pictures;
    EXPECT_EQ(pictures, 2U);                        // of what gives pixels
    EXPECT_THAT(svg, Not(HasSubstr("/keyline-")));  // nothing lies elsewhere
    EXPECT_EQ(files(), (std::vector<std::string>{"graph.json", "graph.svg"}));
}

TEST_F(Draw, WithoutPictures) {
    sound();
    EXPECT_EQ(draw({"--no-pictures"}).status, 0);
    EXPECT_THAT(drawing(), Not(HasSubstr("data:image")));
}

TEST_F(Draw, APageThatStandsByItself) {
    sound();
    const Outcome run = keyline({"draw", "graph.json", "-o", "graph.html"});
    EXPECT_EQ(run.status, 0) << run.err;
    const std::string page = read(folder() / "graph.html");
    EXPECT_THAT(page, ::testing::StartsWith("<!DOCTYPE html>"));
    for (const char* text :
         {"<h2>blur <small>gaussian</small></h2>", "<td>sigma</td><td>2.5</td>",
          "<td>data window</td><td>32 × 16 at (0, 0)</td>", "data:image/jpeg;base64,/9j/",
          "<td>R</td><td class=\"number\">0.2</td>", "&lt;out&gt;&amp;.exr", "id=\"node0\""})
        EXPECT_THAT(page, HasSubstr(text));
    EXPECT_THAT(page, Not(HasSubstr("src=\"http")));
    EXPECT_THAT(page, Not(HasSubstr("<link")));
    EXPECT_EQ(files(), (std::vector<std::string>{"graph.html", "graph.json"}));
}

TEST_F(Draw, GroupsAreBoxes) {
    write("soft.json", R"({ "keyline": 1, "inputs": { "in": {} }, "outputs": { "out": "b" },
                            "nodes": { "b": { "type": "gaussian", "in": "in" } } })");
    graph(R"("c":   { "type": "constant", "color": [0.2, 0.5, 0], "size": [32, 16] },
             "g":   { "type": "soft.json", "in": "c" },
             "out": { "type": "write", "in": "g", "file": "out.exr" })");
    const Outcome run = draw();
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_THAT(drawing(), HasSubstr("class=\"cluster\""));
}

TEST_F(Draw, FaultsAreRedAndTheStatus) {
    graph(R"("c":   { "type": "constant", "color": [0.2, 0.5, 0], "size": [32, 16] },
             "b":   { "type": "gaussian", "in": "c", "sigma": -1 },
             "out": { "type": "write", "in": "b", "file": "out.exr" })");
    const Outcome run = draw();
    EXPECT_EQ(run.status, 2);
    EXPECT_THAT(run.err, HasSubstr("node 'b' (gaussian)"));
    EXPECT_THAT(drawing(), HasSubstr("#b00020"));
    EXPECT_THAT(drawing(), HasSubstr("&#39;sigma&#39; is &#45;1"));
}

TEST_F(Draw, AFileThatIsNotThereIsAFaultOfItsNode) {
    graph(R"("r":   { "type": "read", "file": "none.exr" },
             "out": { "type": "write", "in": "r", "file": "out.exr" })");
    const Outcome run = draw();
    EXPECT_EQ(run.status, 3) << run.err;
    EXPECT_THAT(drawing(), HasSubstr("#b00020"));
}

TEST_F(Draw, ChoosesNoOutputs) {
    sound();
    const Outcome run = draw({"--only", "out"});
    EXPECT_EQ(run.status, 2);
    EXPECT_THAT(run.err, HasSubstr("here no write of the graph runs"));
}

TEST_F(Draw, WithoutGraphvizItSaysWhatToInstall) {
    sound();
    const Outcome run = draw({"--no-pictures"}, {.environment = {"PATH=/nowhere"}});
    EXPECT_EQ(run.status, 1);
    EXPECT_THAT(run.err, HasSubstr("the graph is laid out by Graphviz: dot can't be started"));
    EXPECT_THAT(run.err, HasSubstr("install it, on Debian as graphviz"));
}

TEST_F(Draw, IsSvg) {
    sound();
    const Outcome run = keyline({"draw", "graph.json", "-o", "graph.pdf"});
    EXPECT_EQ(run.status, 2);
    EXPECT_EQ(run.err, "-o graph.pdf: error: a drawing is a file .svg, or a page .html\n");
}

}  // namespace

}  // namespace keyline::test
