// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/base/sanitized.h"
#include "tests/program/program.h"

#include <algorithm>
#include <csignal>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <memory>

// Several processes at the same frames, folders that are moved, inputs that are written anew, and machines
// that are cut off and come back.

namespace keyline::test {

namespace {

using testing::HasSubstr;

constexpr const char* kCopy = R"(
    "r":   { "type": "read", "file": "in.exr" },
    "out": { "type": "write", "in": "r", "file": "out/a.####.exr" })";

class Together : public ProgramTest {
protected:
    Together() {
        graph(R"("c":    { "type": "constant", "color": ["${frame}", 0.25, 0], "size": [200, 150] },
                 "soft": { "type": "gaussian", "in": "c", "sigma": 9 },
                 "out":  { "type": "write", "in": "soft", "file": "out/a.####.exr" })");
    }
    static std::vector<std::string> render(const char* frames) {
        return {"render", "graph.json", "--frames", frames, "--threads", "1", "--progress", "lines"};
    }
    // All are whole, of this graph, and nothing lies beside them.
    void expect_all(const char* frames, std::size_t count) const {
        const Outcome run = keyline({"verify", "graph.json", "--frames", frames});
        EXPECT_EQ(run.status, 0) << run.out;
        EXPECT_EQ(std::distance(fs::directory_iterator(folder() / "out"), fs::directory_iterator()),
                  static_cast<std::ptrdiff_t>(count));
    }
    // As on a file server, where a file has a name while it is written.
    RunOptions on_a_server() const {
        return {
            .folder = folder(),
            .environment = {"LD_PRELOAD=" KEYLINE_FAULTS_MODULE, "KEYLINE_FAULTS=no_tmpfile no_link slow=2"}};
    }
};

TEST_F(Together, ThreeProcessesOnTheSameFramesAreRight) {
    if (kHasAddressSanitizer) GTEST_SKIP() << "the sanitizer's own library must be the first that is loaded";
    for (const RunOptions& options : {RunOptions{.folder = folder()}, on_a_server()}) {
        std::vector<std::unique_ptr<Process>> all;
        for (int i = 0; i < 3; ++i) all.push_back(std::make_unique<Process>(render("1-12"), options));
        for (const auto& process : all) EXPECT_EQ(process->wait().status, 0);
        expect_all("1-12", 12);
        fs::remove_all(folder() / "out");
    }
}

// A machine that nobody hears from any more goes on, or goes on later: another has made its frames meanwhile.
TEST_F(Together, AMachineThatWasCutOffAndComesBackDoesNoHarm) {
    if (kHasAddressSanitizer) GTEST_SKIP() << "the sanitizer's own library must be the first that is loaded";
    Process lost(render("1-12"), on_a_server());
    ASSERT_TRUE(lost.read_until("frame 2: done"));
    lost.signal(SIGSTOP);
    EXPECT_EQ(keyline(render("1-12"), on_a_server()).status, 0);
    lost.signal(SIGCONT);
    EXPECT_EQ(lost.wait().status, 0);
    expect_all("1-12", 12);
}

TEST_F(Together, AFolderThatIsMovedAwayIsNoSuccess) {
    graph(R"("c":    { "type": "constant", "color": [0.5, 0.25, 0], "size": ["${frame}", 3000] },
             "blur": { "type": "gaussian", "in": "c", "sigma": 60 },
             "out":  { "type": "write", "in": "blur", "file": "out/a.####.exr" })");
    Process process(render("1,1000"), {.folder = folder()});
    ASSERT_TRUE(process.read_until("frame 1: done"));
    fs::rename(folder() / "out", folder() / "old");
    const Outcome run = process.wait();
    EXPECT_NE(run.status, 0) << run.err;
    EXPECT_THAT(run.err, HasSubstr("a.0001.exr"));
    EXPECT_TRUE(exists("old/a.0001.exr")) << "what was moved is whole";
}

// Right, or failed: a picture of two plates would be wrong.
TEST_F(Together, AnInputThatIsWrittenAnewMeanwhileIsNeverHalfOfTwo) {
    std::vector<std::string> plates, pictures;
    for (const char* level : {"0.25", "0.75"}) {
        graph(fmt::format(R"("c":   {{ "type": "constant", "color": [{}, 0.25, 0], "size": [256, 256] }},
                             "out": {{ "type": "write", "in": "c", "file": "in.exr" }})",
                          level));
        ASSERT_EQ(keyline({"render", "graph.json", "--no-provenance"}).status, 0);
        plates.push_back(read(folder() / "in.exr"));
        graph(kCopy);
        ASSERT_EQ(keyline({"render", "graph.json", "--frames", "1", "--no-provenance"}).status, 0);
        pictures.push_back(read(folder() / "out/a.0001.exr"));
    }
    Process process({"render", "graph.json", "--frames", "1-200", "--keep-going", "--no-provenance",
                     "--progress", "lines", "--threads", "1"},
                    {.folder = folder()});
    ASSERT_TRUE(process.read_until("frame 3: done"));
    for (std::size_t i = 0; i < 40; ++i) write("in.exr", plates[i % 2]);
    const Outcome run = process.wait();
    EXPECT_TRUE(run.status == 0 || run.status == 3 || run.status == 75) << run.err;
    for (const auto& entry : fs::directory_iterator(folder() / "out"))
        EXPECT_NE(std::ranges::find(pictures, read(entry.path())), pictures.end()) << entry.path();
}

}  // namespace

}  // namespace keyline::test
