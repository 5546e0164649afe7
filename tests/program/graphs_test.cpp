// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/program/program.h"

#include <algorithm>
#include <map>

// The graphs that Keyline ships with, on the plates that lie beside them.

namespace keyline::test {

namespace {

std::vector<std::string> shipped_graphs() {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(plates().parent_path()))
        if (entry.path().extension() == ".json") names.push_back(entry.path().stem());
    std::ranges::sort(names);
    return names;
}

class ShippedGraph : public ProgramTest, public testing::WithParamInterface<std::string> {
protected:
    // Laid out as in the repository: outputs go to `out`, beside the graphs.
    ShippedGraph() {
        fs::create_directory(folder() / "graphs");
        fs::create_symlink(plates(), folder() / "graphs" / "plates");
        fs::create_symlink(plates().parent_path() / "groups", folder() / "graphs" / "groups");
        fs::copy(plates().parent_path() / (GetParam() + ".json"), folder() / graph_);
    }

    // The first frame that there is.
    std::string frame() const {
        const std::string said = keyline({"check", graph_}).out;
        return std::to_string(std::stoi(said.substr(said.rfind(' '))));
    }

    // What is written, by file name.
    std::map<std::string, std::string> render(std::vector<std::string> options) const {
        options.insert(options.begin(), {"render", graph_, "--frames", frame(), "--progress", "none"});
        const Outcome run = keyline(options);
        EXPECT_EQ(run.status, 0) << run.err;
        std::map<std::string, std::string> out;
        for (const auto& entry : fs::directory_iterator(folder() / "out"))
            out[entry.path().filename()] = read(entry.path());
        fs::remove_all(folder() / "out");
        return out;
    }

    const std::string graph_ = "graphs/" + GetParam() + ".json";
};

TEST_P(ShippedGraph, IsSoundAndSaysWhatItIs) {
    const Outcome run = keyline({"check", graph_});
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_NE(read(folder() / graph_).find("\"about\""), std::string::npos);
}

TEST_P(ShippedGraph, GivesTheSameFilesUnderEverySchedule) {
    const auto usual = render({});
    EXPECT_FALSE(usual.empty());
    EXPECT_EQ(render({"--threads", "1", "--tile", "50"}), usual);
    EXPECT_EQ(render({"--threads", "3", "--tile", "500"}), usual);
}

INSTANTIATE_TEST_SUITE_P(All, ShippedGraph, testing::ValuesIn(shipped_graphs()),
                         [](const auto& test) { return test.param; });

}  // namespace

}  // namespace keyline::test
