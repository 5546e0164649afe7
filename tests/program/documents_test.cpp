// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/program/program.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

// The commands that the documents show, run on what is shipped, and the examples of the manual.

namespace keyline::test {

namespace {

std::vector<std::string> words_of(const std::string& command) {
    std::istringstream words(command);
    std::vector<std::string> out;
    for (std::string word; words >> word;) out.push_back(word);
    return out;
}

// Lines of a document that are a command of Keyline's, as its arguments.
std::vector<std::vector<std::string>> commands_in(const std::string& text) {
    const std::string_view program = "    keyline ";
    std::vector<std::vector<std::string>> commands;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        if (!line.starts_with(program)) continue;
        std::erase(line, '\'');  // a shell's; no argument holds blanks
        commands.push_back(words_of(line.substr(0, line.find('#')).substr(program.size())));
    }
    return commands;
}

struct Block {
    std::string language, text;
};

std::vector<Block> blocks_in(const std::string& document) {
    std::vector<Block> blocks;
    std::istringstream lines(document);
    bool is_open = false;
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("```")) {
            is_open = !is_open;
            if (is_open) blocks.push_back({line.substr(3), ""});
        } else if (is_open) {
            blocks.back().text += line + '\n';
        }
    }
    return blocks;
}

// An example is a graph, or lines of its nodes.
std::string graph_of(const std::string& example) {
    if (example.starts_with("{\n  \"keyline\"")) return example;
    return R"({ "keyline": 1, "nodes": { "render": { "type": "read", "file": "plates/street.####.exr" },
                "out": { "type": "write", "in": "render", "file": "out.####.exr" },
    )" + example +
           "}}";
}

// Without their places, which the documents leave out, and without warnings.
std::string errors_of(const std::string& messages) {
    std::string errors;
    std::istringstream lines(messages);
    for (std::string line; std::getline(lines, line);)
        if (const auto at = line.find("error: "); at != std::string::npos) errors += line.substr(at) + '\n';
    return errors;
}

class Documents : public ProgramTest {
protected:
    // Laid out as in the repository.
    Documents() {
        fs::create_directory(folder() / "graphs");
        fs::create_symlink(plates(), folder() / "graphs" / "plates");
        fs::create_symlink(plates().parent_path() / "groups", folder() / "graphs" / "groups");
        for (const auto& entry : fs::directory_iterator(plates().parent_path()))
            if (entry.path().extension() == ".json" || entry.path().extension() == ".csv")
                fs::copy(entry.path(), folder() / "graphs" / entry.path().filename());
    }

    void expect_that_commands_work(const std::string& document) const {
        const auto commands = commands_in(document);
        EXPECT_FALSE(commands.empty());
        for (const auto& arguments : commands) {
            const Outcome run = keyline(arguments);
            std::string all;
            for (const std::string& a : arguments) all += a + ' ';
            EXPECT_EQ(run.status, 0) << all << ": " << run.err;
        }
    }
};

TEST_F(Documents, TheReadmesGraphAndCommandsWork) {
    const std::string readme = read(fs::path(KEYLINE_DOCS).parent_path() / "README.md");
    const std::size_t begin = readme.find("```json\n") + 8;
    write("toon.json", readme.substr(begin, readme.find("```", begin) - begin));
    fs::create_symlink(plates(), folder() / "plates");
    expect_that_commands_work(readme);
    EXPECT_TRUE(exists("out/toon.0001.exr"));
}

TEST_F(Documents, TheCookbooksCommandsWork) {
    expect_that_commands_work(read(fs::path(KEYLINE_DOCS) / "cookbook.md"));
}

TEST_F(Documents, TheCookbooksGraphsAreSoundAndLaidOutAndRender) {
    std::size_t graphs = 0;
    for (const Block& block : blocks_in(read(fs::path(KEYLINE_DOCS) / "cookbook.md"))) {
        if (!block.text.starts_with("{\n  \"keyline\"")) continue;
        write("graphs/task.json", block.text);
        const Outcome run = keyline({"check", "graphs/task.json"});
        EXPECT_EQ(run.status, 0) << run.err << block.text;
        EXPECT_EQ(run.err.find("warning:"), std::string::npos) << run.err << block.text;
        EXPECT_EQ(keyline({"fmt", "--check", "graphs/task.json"}).status, 0) << block.text;
        const Outcome made = keyline({"render", "graphs/task.json", "--frames", "all"});
        EXPECT_EQ(made.status, 0) << made.err << block.text;
        ++graphs;
    }
    EXPECT_GE(graphs, 26U);
}

// Thirty tasks, each in the words of two other programs, and with its time.
TEST_F(Documents, TheCookbooksTasksAreToldInOtherProgramsWordsAndTimed) {
    const std::string page = read(fs::path(KEYLINE_DOCS) / "cookbook.md");
    const std::regex section(R"(\n### (.+)\n)");
    std::size_t tasks = 0;
    for (auto s = std::sregex_iterator(page.begin(), page.end(), section); s != std::sregex_iterator(); ++s) {
        const std::string text = s->suffix().str().substr(0, s->suffix().str().find("\n### "));
        if (text.find("*Nuke*") == std::string::npos) continue;
        EXPECT_NE(text.find("*Blender*"), std::string::npos) << s->str(1);
        EXPECT_NE(page.find("| " + s->str(1) + " | "), std::string::npos) << s->str(1) << " has no time";
        ++tasks;
    }
    EXPECT_GE(tasks, 30U);
}

// Each row: what, `OLD` → `NEW` in the graph of the README, or a command, or both; and what is said.
TEST_F(Documents, AHundredMistakesAreToldAsTheirPageSays) {
    const std::string readme = read(fs::path(KEYLINE_DOCS).parent_path() / "README.md");
    const std::string graph = blocks_in(readme).front().text;
    fs::create_symlink(plates(), folder() / "plates");
    std::istringstream page(read(fs::path(KEYLINE_DOCS) / "mistakes.md"));
    const std::regex row(R"(\| (.+) \| (?:`(.+)` → `(.+?)`)?(?:, )?(?:`keyline (.+)`)? \| `(.+)` \|)");
    std::size_t mistakes = 0;
    std::smatch m;
    for (std::string line; std::getline(page, line);) {
        if (!std::regex_match(line, m, row)) continue;
        std::string text = graph;
        if (m[2].matched) {
            const std::size_t at = text.find(m.str(2));
            ASSERT_NE(at, std::string::npos) << line;
            text.replace(at, m.str(2).size(), m.str(3));
        }
        write("toon.json", text);
        const Outcome run = keyline(words_of(m[4].matched ? m.str(4) : "check toon.json"));
        EXPECT_THAT(run.err, testing::HasSubstr(m.str(5) + "\n")) << line;
        ++mistakes;
    }
    EXPECT_GE(mistakes, 100U);
}

// Its graph finds the lines that its commands then measure.
TEST_F(Documents, TheGraphAndCommandsOfThePageOnLinesWork) {
    const std::string page = read(fs::path(KEYLINE_DOCS) / "lines.md");
    for (const Block& block : blocks_in(page))
        if (block.language == "json") write("graphs/lines.json", block.text);
    expect_that_commands_work(page);
    EXPECT_TRUE(exists("out/missed.json"));

    // As good as the page says, against the lines of the meshes.
    const Outcome run =
        keyline({"measure", "out/lines.0012.json", "graphs/plates/garden_lines.0012.json", "--json"});
    const auto told = nlohmann::json::parse(run.out);
    EXPECT_GT(told["accuracy"]["precision"], 0.95);
    EXPECT_GT(told["accuracy"]["recall"], 0.77);
    EXPECT_EQ(told["accuracy"]["drawn"][0]["kind"], "outline");
    EXPECT_LT(told["accuracy"]["drawn"][0]["rms"], 0.09);
    EXPECT_LT(told["accuracy"]["drawn"][0]["robust"], 0.04);
    EXPECT_LT(told["form"]["doubles"], 0.01);
    EXPECT_LT(told["form"]["ripple"], 0.05);
}

TEST_F(Documents, TheWayFromAFileToAPictureIsOne) {
    expect_that_commands_work(read(fs::path(KEYLINE_DOCS) / "first_graph.md"));
    EXPECT_TRUE(exists("out/night.png"));
}

TEST_F(Documents, TheTestsOfThePageOnTestsPass) {
    const std::string page = read(fs::path(KEYLINE_DOCS) / "tests.md");
    write("tests.json", blocks_in(page).front().text);
    expect_that_commands_work(page);
    EXPECT_TRUE(exists("results.xml"));
}

TEST_F(Documents, TheManualsCommandsWork) {
    expect_that_commands_work(read(fs::path(KEYLINE_DOCS) / "graphs.md"));
}

TEST_F(Documents, TheManualsExamplesAreSoundOrToldAsItSays) {
    fs::create_symlink(plates(), folder() / "plates");
    fs::create_symlink(plates().parent_path() / "groups", folder() / "groups");
    const std::vector<Block> blocks = blocks_in(read(fs::path(KEYLINE_DOCS) / "graphs.md"));
    std::size_t examples = 0;
    for (std::size_t i = 0; i < blocks.size(); ++i) {
        if (blocks[i].language != "json") continue;
        const bool is_wrong = i + 1 < blocks.size() && blocks[i + 1].language == "text";
        write("example.json", graph_of(blocks[i].text));
        const Outcome run = keyline({"check", "example.json"});
        EXPECT_EQ(errors_of(run.err), is_wrong ? blocks[i + 1].text : "") << blocks[i].text << run.err;
        EXPECT_EQ(run.status == 0, !is_wrong) << blocks[i].text;
        ++examples;
    }
    EXPECT_GT(examples, 0U);
}

// A table of faults is worth what its tests are.
TEST_F(Documents, EveryFaultOfThePageOnFarmsNamesItsTest) {
    const fs::path repository = fs::path(KEYLINE_DOCS).parent_path();
    std::string sources;
    for (const auto& entry : fs::recursive_directory_iterator(repository / "tests"))
        if (entry.path().extension() == ".cpp") sources += read(entry.path());
    std::istringstream page(read(fs::path(KEYLINE_DOCS) / "farm.md"));
    const std::regex row(R"(\| .+ \| .+ \| `(\w+)\.(\w+)` \|)"),
        script(R"(\| .+ \| .+ \| `(tests/.+\.sh)` \|)");
    int faults = 0;
    std::smatch m;
    for (std::string line; std::getline(page, line);) {
        if (std::regex_match(line, m, script)) {
            EXPECT_TRUE(fs::exists(repository / m.str(1))) << line;
        } else if (std::regex_match(line, m, row)) {
            const bool is_there = sources.find("(" + m.str(1) + ", " + m.str(2) + ")") != std::string::npos;
            EXPECT_TRUE(is_there) << line;
        } else {
            continue;
        }
        ++faults;
    }
    EXPECT_GE(faults, 30);
}

TEST_F(Documents, TheManualIsTheProgramsHelp) {
    const Outcome run = keyline({"help", "graphs"});
    EXPECT_EQ(run.status, 0);
    EXPECT_EQ(run.out, read(fs::path(KEYLINE_DOCS) / "graphs.md"));
}

}  // namespace

}  // namespace keyline::test
