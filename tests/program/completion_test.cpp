// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/program/program.h"

#include <array>
#include <cstdio>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <sstream>

// keyline completion: what shells offer, asked through the shells themselves.

namespace keyline::test {

namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::IsSupersetOf;
using ::testing::Not;

using Words = std::vector<std::string>;

bool is_installed(const std::string& shell) {
    return std::system(fmt::format("command -v {} >/dev/null 2>&1", shell).c_str()) ==
           0;  // NOLINT(cert-env33-c)
}

class Completion : public ProgramTest {
protected:
    Completion() {
        fs::copy(plates() / "street.0001.exr", folder() / "street.exr");
        graph(R"("render": { "type": "read", "file": "street.exr" },
                 "blur": { "type": "gaussian", "in": "render:Combined", "sigma": "${sigma}" },
                 "out": { "type": "write", "in": "blur", "file": "out.exr" })",
              R"("variables": { "sigma": 2 },)");
    }

    // The words that are offered for a line whose last word is being typed.
    Words offered(const Words& line) const {
        Words arguments{"complete"};
        arguments.insert(arguments.end(), line.begin(), line.end());
        std::istringstream lines(keyline(arguments).out);
        Words out;
        for (std::string one; std::getline(lines, one);) out.push_back(one.substr(0, one.find('\t')));
        return out;
    }

    // What a shell that reads `script` prints, with the program in its path.
    Words said_by(const std::string& shell, const std::string& script) const {
        write("asked", script);
        const std::string command =
            fmt::format("cd '{}' && PATH='{}':\"$PATH\" {} ./asked 2>&1", folder().string(),
                        fs::path(KEYLINE_PROGRAM).parent_path().string(), shell);
        Words out;
        FILE* pipe = popen(command.c_str(), "r");  // NOLINT(cert-env33-c)
        std::array<char, 4096> line{};
        while (fgets(line.data(), line.size(), pipe) != nullptr) {
            out.emplace_back(line.data());
            out.back().erase(out.back().find_last_not_of(" \n") + 1);
        }
        pclose(pipe);
        return out;
    }
};

TEST_F(Completion, OffersCommandsOptionsAndWords) {
    EXPECT_THAT(offered({""}), IsSupersetOf({"render", "check", "new", "view"}));
    EXPECT_THAT(offered({""}), Not(Contains("complete")));
    EXPECT_THAT(offered({"re"}), ElementsAre("render"));
    EXPECT_THAT(offered({"render", "--fr"}), ElementsAre("--frames"));
    EXPECT_THAT(offered({"render", "--only-"}), IsEmpty()) << "hidden options are";
    EXPECT_THAT(offered({"view", "--as", ""}), ElementsAre("kitty", "iterm", "sixel", "blocks"));
    EXPECT_THAT(offered({"new", "--look=o"}), ElementsAre("--look=over"));
    EXPECT_THAT(offered({"nodes", "gau"}), ElementsAre("gaussian"));
    EXPECT_THAT(offered({"submit", "sl"}), ElementsAre("slurm"));
    EXPECT_THAT(offered({"explain", "unknown-n"}), ElementsAre("unknown-node"));
    EXPECT_THAT(offered({"render", "graph.json", "--progress", "b"}), ElementsAre("bar"));
    EXPECT_THAT(offered({"render", ""}), ElementsAre(":files"));
    EXPECT_THAT(offered({"render", "graph.json", "--profile", "x"}), ElementsAre(":files"));
    EXPECT_THAT(offered({"render", "graph.json", "--threads", ""}), IsEmpty());
}

TEST_F(Completion, OffersWhatTheGraphHas) {
    EXPECT_THAT(offered({"view", "graph.json", ""}), ElementsAre("render", "blur"));
    EXPECT_THAT(offered({"view", "graph.json", "render:ViewLayer.No"}),
                ElementsAre("render:ViewLayer.Normal", "render:ViewLayer.Normal.X",
                            "render:ViewLayer.Normal.Y", "render:ViewLayer.Normal.Z"));
    EXPECT_THAT(offered({"render", "graph.json", "--only", ""}), ElementsAre("out"));
    EXPECT_THAT(offered({"render", "graph.json", "--output", "b"}), ElementsAre("blur="));
    EXPECT_THAT(offered({"render", "graph.json", "--set", "bl"}), ElementsAre("blur."));
    EXPECT_THAT(offered({"render", "graph.json", "--set", "blur."}), ElementsAre("blur.in=", "blur.sigma="));
    EXPECT_THAT(offered({"render", "graph.json", "--var", ""}), ElementsAre("sigma="));
    EXPECT_THAT(offered({"view", "none.json", ""}), IsEmpty());
}

// As bash calls it: with its own idea of words, parted at : and =.
TEST_F(Completion, InBash) {
    const auto asked = [&](const std::string& line, const std::string& words, int at) {
        return said_by(
            "bash",
            fmt::format("source <(keyline completion bash)\nCOMP_LINE='{}' COMP_POINT={} COMP_CWORD={}\n"
                        "COMP_WORDS=({})\n_keyline\nprintf '%s\\n' \"${{COMPREPLY[@]}}\"\n",
                        line, line.size(), at, words));
    };
    EXPECT_THAT(asked("keyline view graph.json bl", "keyline view graph.json bl", 3), ElementsAre("blur"));
    EXPECT_THAT(asked("keyline view graph.json render:ViewLayer.Dep",
                      "keyline view graph.json render : ViewLayer.Dep", 5),
                ElementsAre("ViewLayer.Depth", "ViewLayer.Depth.Z"));
    EXPECT_THAT(asked("keyline new --look=", "keyline new --look =", 3),
                ElementsAre("drawing", "over", "lines"));
    EXPECT_THAT(asked("keyline render --fra", "keyline render --fra", 2), ElementsAre("--frames"));
}

TEST_F(Completion, InFish) {
    if (!is_installed("fish")) GTEST_SKIP() << "fish is not installed";
    const auto asked = [&](const std::string& line) {
        return said_by(
            "fish",
            fmt::format("keyline completion fish | source\ncomplete -C '{}' | string split -f 1 \\t\n",
                        line));
    };
    EXPECT_THAT(asked("keyline view graph.json bl"), ElementsAre("blur"));
    EXPECT_THAT(asked("keyline nodes hyst"), ElementsAre("hysteresis"));
    EXPECT_THAT(asked("keyline render gra"), ElementsAre("graph.json"));
}

// With what it would add written out instead.
TEST_F(Completion, InZsh) {
    if (!is_installed("zsh")) GTEST_SKIP() << "zsh is not installed";
    const auto asked = [&](const std::string& words, int at) {
        return said_by(
            "zsh -f",
            fmt::format("compdef() {{}}\ncompadd() {{ print -l -- \"$@\" }}\n_files() {{ print files }}\n"
                        "source <(keyline completion zsh)\nwords=({}) CURRENT={}\n_keyline\n",
                        words, at));
    };
    EXPECT_THAT(asked("keyline view graph.json bl", 4), ElementsAre("--", "blur"));
    EXPECT_THAT(asked("keyline render graph.json --set bl", 5), ElementsAre("-S", "", "--", "blur."));
    EXPECT_THAT(asked("keyline render ''", 3), ElementsAre("files"));
}

TEST_F(Completion, OfAnotherShellIsRefused) {
    EXPECT_EQ(keyline({"completion", "csh"}).err,
              "error: there is no completion for 'csh'; possible: 'bash', 'zsh' and 'fish'\n");
}

}  // namespace

}  // namespace keyline::test
