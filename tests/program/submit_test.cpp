// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/program/program.h"

#include <cstdlib>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

// What a render farm's manager is given.  A real one runs it in tests/farm.

namespace keyline::test {

namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using Json = nlohmann::json;

class Submit : public ProgramTest {
protected:
    Submit() {
        graph(R"("c":   { "type": "constant", "color": [0.5, "${green}", 0], "size": [64, 64] },
                 "out": { "type": "write", "in": "c", "file": "out/a.####.exr" })",
              R"("variables": { "green": 0.25 },)");
    }
    Outcome slurm(std::vector<std::string> more) const {
        more.insert(more.begin(), {"submit", "slurm", "graph.json", "--print", "--frames", "1-12"});
        return keyline(more);
    }
    Json json(const std::string& name) const { return Json::parse(read(folder() / name)); }
};

TEST_F(Submit, SlurmGetsAnArrayAndAJobAfterIt) {
    const Outcome run = slurm({"--chunk", "5", "--threads", "3", "--set", "out.file=b c.#.exr", "--name",
                               "look", "--partition", "p1"});
    EXPECT_EQ(run.status, 0) << run.err;
    for (const char* line :
         {"#SBATCH --job-name=look\n", "#SBATCH --array=0-2\n", "#SBATCH --cpus-per-task=3\n",
          "#SBATCH --mem=", "#SBATCH --requeue\n", "#SBATCH --open-mode=append\n",
          "#SBATCH --signal=B:TERM@60\n", "#SBATCH --partition=p1\n", "frames=(1-5 6-10 11,12)\n",
          " render graph.json --set 'out.file=b c.#.exr' ", "scontrol requeue",
          "# sbatch --dependency=afterany:JOB\n",
          " verify graph.json --set 'out.file=b c.#.exr' --frames=1-12 --list=stale,damaged,missing,foreign",
          " submit slurm graph.json --set 'out.file=b c.#.exr' --frames=\"$left\" --chunk=5 --name=look ",
          " --name=look --threads=3 ", "--round=2 --rounds=3 --partition=p1\n"})
        EXPECT_THAT(run.out, HasSubstr(line));
    EXPECT_THAT(files(), ElementsAre("graph.json")) << "nothing is submitted, nothing is written";
}

TEST_F(Submit, TheLastRoundSubmitsNothingMore) {
    const Outcome run = slurm({"--round", "3"});
    EXPECT_THAT(run.out, testing::Not(HasSubstr("submit slurm")));
    EXPECT_THAT(run.out, HasSubstr("echo \"not current after 3 rounds: $left\"\nexit 1\n"));
    const auto memory = [](const std::string& text) {
        return std::stoi(text.substr(text.find("--mem=") + 6));
    };
    EXPECT_GE(memory(run.out), 3 * (memory(slurm({}).out) - 1)) << "what ran out of memory gets more";
}

TEST_F(Submit, AGraphThatIsWrongIsNotSubmitted) {
    EXPECT_EQ(slurm({"--set", "c.sise=3"}).status, 2);
    EXPECT_EQ(slurm({"--chunk", "0"}).status, 2);
    EXPECT_THAT(slurm({"--chunks", "3"}).err, HasSubstr("did you mean '--chunk'?"));
    const Outcome unknown = keyline({"submit", "slrum", "graph.json"});
    EXPECT_EQ(unknown.status, 2);
    EXPECT_THAT(unknown.err, HasSubstr("error: "));
}

TEST_F(Submit, OpenJobDescriptionGetsABundle) {
    const Outcome run = keyline({"submit", "openjd", "graph.json", "--frames", "1-12", "--chunk", "5",
                                 "--bundle", "job", "--name", "look", "--var", "green=0.5"});
    EXPECT_EQ(run.status, 0) << run.err;
    const Json job = json("job/template.json");
    EXPECT_EQ(job.at("specificationVersion"), "jobtemplate-2023-09");
    EXPECT_EQ(job.at("name"), "look");
    const Json &render = job.at("steps").at(0), &verify = job.at("steps").at(1);
    EXPECT_EQ(render.at("parameterSpace").at("taskParameterDefinitions").at(0).at("range"),
              Json({"1-5", "6-10", "11,12"}));
    const Json& action = render.at("script").at("actions").at("onRun");
    EXPECT_EQ(action.at("command"), "keyline");
    EXPECT_EQ(
        action.at("args"),
        Json({"render", "{{Param.Graph}}", "--path-map={{Session.PathMappingRulesFile}}", "--var=green=0.5",
              "--frames={{Task.Param.Frames}}", "--stale", "--keep-going", "--progress=openjd"}));
    EXPECT_EQ(action.at("cancelation").at("mode"), "NOTIFY_THEN_TERMINATE");
    EXPECT_EQ(verify.at("dependencies").at(0).at("dependsOn"), "Render");
    EXPECT_EQ(json("job/parameter_values.json").at("parameterValues").at(0).at("value"),
              (folder() / "graph.json").string());
    EXPECT_EQ(json("job/asset_references.json").at("assetReferences").at("outputs").at("directories").at(0),
              (folder() / "out").string());
}

// Keeps what it is told, and the files that it is given: of those the last that names the job.
constexpr const char* kStandIn = R"(#!/bin/sh
printf '%s ' "$@" >> told
for word; do
    file=${word#@}
    case "$file" in *.plugin) ;; *) if [ -f "$file" ]; then cat "$file" >> got; fi ;; esac
done
echo JobID=60a1
)";

// Each is sent by its own command, which is given files that are there: a stand-in keeps what it is told and
// a copy.
TEST_F(Submit, JobsAreSentByTheManagersOwnCommands) {
    struct Case {
        const char *manager, *command, *arguments;
        std::vector<std::string> more = {};
    };
    const std::vector<Case> cases{
        {"opencue", "python3", "/opencue.xml ", {"--user", "artist"}},
        {"afanasy", "afcmd", "json send "},
        {"tractor", "tractor-spool", "/tractor.alf "},
        {"deadline", "deadlinecommand", "/verify.plugin "},
        {"flamenco", "curl", " http://farm:8080/api/v3/jobs ", {"--manager", "http://farm:8080"}}};
    const std::string path = "PATH=" + (folder() / "bin").string() + ":" + std::getenv("PATH");
    for (const Case& c : cases) {
        SCOPED_TRACE(c.manager);
        const fs::path program = write(std::string("bin/") + c.command, kStandIn);
        fs::permissions(program, fs::perms::owner_all);
        std::vector<std::string> arguments{"submit", c.manager, "graph.json", "--frames",
                                           "1-12",   "--name",  "look"};
        arguments.insert(arguments.end(), c.more.begin(), c.more.end());
        const Outcome run = keyline(arguments, {.environment = {path}});
        EXPECT_EQ(run.status, 0) << run.err;
        EXPECT_THAT(run.err, HasSubstr("2 tasks to render, and one that verifies"));
        EXPECT_THAT(read(folder() / "told"), HasSubstr(c.arguments));
        EXPECT_THAT(read(folder() / "got"), HasSubstr("look"));
        EXPECT_EQ(read(folder() / "got").find("JobDependencies=60a1\n") != std::string::npos,
                  c.manager == std::string("deadline"));
        for (const char* file : {"told", "got", "bin"}) fs::remove_all(folder() / file);
    }
}

TEST_F(Submit, WhatAManagerRefusesIsTold) {
    const Outcome absent = keyline({"submit", "afanasy", "graph.json", "--frames", "1-12"});
    EXPECT_EQ(absent.status, 1);
    EXPECT_THAT(absent.err, HasSubstr("afcmd can't be started"));
    const Outcome root =
        keyline({"submit", "opencue", "graph.json", "--frames", "1-12", "--user", "root", "--job", "job"});
    EXPECT_EQ(root.status, 2);
    EXPECT_THAT(root.err, HasSubstr("--user NAME"));
    const Outcome shot = keyline({"submit", "opencue", "graph.json", "--frames", "1-12", "--user", "artist",
                                  "--shot", "s1", "--job", "job"});
    EXPECT_EQ(shot.status, 2);
    EXPECT_THAT(shot.err, HasSubstr("--shot 's1'"));
    const Outcome piped =
        keyline({"submit", "slurm", "-", "--frames", "1-12", "--print"}, {.in = folder() / "graph.json"});
    EXPECT_EQ(piped.status, 2);
    EXPECT_THAT(piped.err, HasSubstr("give it as a file"));
    EXPECT_FALSE(exists("job"));
}

TEST_F(Submit, MoreTasksThanAStepCanHaveAreRefused) {
    const Outcome run =
        keyline({"submit", "openjd", "graph.json", "--frames", "1-2000", "--chunk", "1", "--bundle", "job"});
    EXPECT_EQ(run.status, 2);
    EXPECT_THAT(run.err, HasSubstr("give --chunk 2"));
    EXPECT_FALSE(exists("job"));
}

}  // namespace

}  // namespace keyline::test
