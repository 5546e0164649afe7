// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/base/sanitized.h"
#include "tests/program/program.h"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <fmt/format.h>
#include <gmock/gmock.h>

// Disks and file servers that fail, as faults.cpp plays them.

namespace keyline::test {

namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

constexpr const char* kNodes = R"(
    "c":   { "type": "constant", "color": [0.5, 0.25, 0], "size": ["${frame}", 16] },
    "out": { "type": "write", "in": "c", "file": "out/${name}.exr" })";
constexpr const char* kVariables = R"("variables": { "name": "a.####" },)";

class Faults : public ProgramTest {
protected:
    Faults() { graph(kNodes, kVariables); }
    void SetUp() override {
        if (kHasAddressSanitizer)
            GTEST_SKIP() << "the sanitizer's own library must be the first that is loaded";
    }

    RunOptions with(const std::string& faults) const {
        return {.folder = folder(),
                .environment = {"LD_PRELOAD=" KEYLINE_FAULTS_MODULE, "KEYLINE_FAULTS=" + faults,
                                "KEYLINE_FAULTS_LOG=" + (folder() / "log").string()}};
    }
    Outcome render(const std::string& faults, std::vector<std::string> more = {}) const {
        more.insert(more.begin(), {"render", "graph.json", "--frames", "1-4"});
        return keyline(more, with(faults));
    }
    std::vector<std::string> outputs() const {
        std::vector<std::string> out = files();
        std::erase_if(out, [](const std::string& f) { return !f.starts_with("out/"); });
        return out;
    }
    int width_of(const std::string& name) const {
        const std::string told = keyline({"info", "--all", name}).out;
        const std::size_t at = told.find("data  ");
        return at == std::string::npos ? -1 : std::stoi(told.substr(at + 4));
    }
};

// On NFS and FUSE there are no files without names.  Names of the greatest length differ at their end only.
TEST_F(Faults, FrameNHoldsPictureNWhateverItsNamesLength) {
    const std::string stem(246, 'n');
    const Outcome run = render("no_tmpfile", {"--var", "name=" + stem + ".####", "--threads", "2"});
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(outputs().size(), 4U);
    for (int frame = 1; frame <= 4; ++frame)
        EXPECT_EQ(width_of(fmt::format("out/{}.{:04}.exr", stem, frame)), frame);
}

TEST_F(Faults, ARenameWhoseAnswerWasLostIsDone) {
    const Outcome run = render("no_tmpfile rename_lost");
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_THAT(outputs(),
                ElementsAre("out/a.0001.exr", "out/a.0002.exr", "out/a.0003.exr", "out/a.0004.exr"));
}

TEST_F(Faults, WhatTheSystemSaysIsTold) {
    struct Case {
        std::string fault;
        int error;
        const char *says, *to_do, *reason;
    };
    for (const Case& c : {Case{"write", ENOSPC, "No space left on device", "make room", "space"},
                          Case{"fsync", EDQUOT, "Disk quota exceeded", "quota", "quota"},
                          Case{"fsync", EIO, "Input/output error", "the file server failed", "device"},
                          Case{"write", ETIMEDOUT, "Connection timed out", "", "timeout"},
                          Case{"rename", ESTALE, "Stale file handle", "another machine", "stale"},
                          Case{"rename", EIO, "Input/output error", "the file server failed", "device"}}) {
        SCOPED_TRACE(c.fault + " " + c.says);
        for (const char* tmpfile : {"", "no_tmpfile "}) {
            const Outcome run = render(fmt::format("{}{}={}", tmpfile, c.fault, c.error));
            EXPECT_EQ(run.status, 75) << "another try may do better";
            EXPECT_THAT(run.err,
                        HasSubstr(fmt::format("keyline: failed frames=1-4 retry=yes reason={}\n", c.reason)));
            EXPECT_THAT(run.err, HasSubstr(c.says));
            EXPECT_THAT(run.err, HasSubstr(c.to_do));
            EXPECT_THAT(outputs(), IsEmpty());
        }
    }
}

TEST_F(Faults, WhatHasNoHardLinksIsWrittenAllTheSame) {
    EXPECT_EQ(render("no_link no_tmpfile").status, 0);
    EXPECT_EQ(outputs().size(), 4U);
}

TEST_F(Faults, ASlowDiskIsWaitedFor) {
    EXPECT_EQ(render("slow=30").status, 0);
    EXPECT_EQ(outputs().size(), 4U);
}

TEST_F(Faults, ADiskThatFillsKeepsWhatWasWhole) {
    const Outcome run = render("write_from=7", {"--keep-going", "--threads", "1"});
    EXPECT_EQ(run.status, 75);
    EXPECT_THAT(run.err, HasSubstr("retry=yes reason=space\n"));
    const std::vector<std::string> whole = outputs();
    EXPECT_FALSE(whole.empty());
    EXPECT_LT(whole.size(), 4U);
    for (const std::string& file : whole) EXPECT_THAT(file, Not(HasSubstr(".keyline-")));
    EXPECT_EQ(keyline({"verify", "graph.json", "--frames", "1-4", "--list", "damaged,stale,foreign"}).out,
              "");
}

TEST_F(Faults, AFolderWhereNothingMayBeMadeIsTheOutputsFault) {
    for (const char* tmpfile : {"", "no_tmpfile "}) {
        const Outcome run = render(fmt::format("{}create={}", tmpfile, EACCES));
        EXPECT_EQ(run.status, 4) << run.err;
        EXPECT_THAT(run.err, HasSubstr("Permission denied"));
        EXPECT_THAT(outputs(), IsEmpty());
    }
}

// A read may give less than was asked for, which is no end.
TEST_F(Faults, ReadsThatGiveLessAreGoneOnWith) {
    fs::copy(plates() / "street.0001.exr", folder() / "plate.exr");
    graph(R"("r": { "type": "read", "file": "plate.exr" },
             "out": { "type": "write", "in": "r:Combined", "file": "out.exr" })");
    EXPECT_EQ(keyline({"render", "graph.json"}).status, 0);
    const std::string whole = read(folder() / "out.exr");
    EXPECT_EQ(keyline({"render", "graph.json"}, with("short=1000")).status, 0);
    EXPECT_EQ(read(folder() / "out.exr"), whole);
}

TEST_F(Faults, AServerThatFailsNowAndThenIsTriedAgain) {
    fs::copy(plates() / "street.0001.exr", folder() / "plate.exr");
    graph(R"("r": { "type": "read", "file": "plate.exr" },
             "out": { "type": "write", "in": "r:Combined", "file": "out.exr" })");
    const Outcome run = keyline({"render", "graph.json"}, with("read_every=3"));
    EXPECT_EQ(run.status, 75) << run.err;
    EXPECT_THAT(run.err, HasSubstr("retry=yes reason=device\n"));
    EXPECT_FALSE(exists("out.exr"));
}

// What no other try mends is not hidden by what one may.
TEST_F(Faults, WhatStaysDecides) {
    const Outcome run = render(fmt::format("write={}", EFBIG));
    EXPECT_EQ(run.status, 4);
    EXPECT_THAT(run.err, HasSubstr("retry=no reason=output\n"));
}

TEST_F(Faults, AnInputThatTheServerForgotIsAskedForAgain) {
    fs::copy(plates() / "street.0001.exr", folder() / "plate.exr");
    graph(R"("r": { "type": "read", "file": "plate.exr" },
             "out": { "type": "write", "in": "r:Combined", "file": "out.exr" })");
    EXPECT_EQ(keyline({"render", "graph.json"}, with("stale_once")).status, 0);
}

TEST_F(Faults, AServerThatFailsIsNotADamagedFile) {
    fs::copy(plates() / "street.0001.exr", folder() / "plate.exr");
    graph(R"("r": { "type": "read", "file": "plate.exr" },
             "out": { "type": "write", "in": "r:Combined", "file": "out.exr" })");
    const Outcome run = keyline({"render", "graph.json"}, with(fmt::format("read={}", EIO)));
    EXPECT_EQ(run.status, 75);
    EXPECT_THAT(run.err, HasSubstr("plate.exr"));
    EXPECT_THAT(run.err, HasSubstr("Input/output error"));
    EXPECT_THAT(run.err, HasSubstr("keyline: failed frames=1 retry=yes reason=device\n"));
    EXPECT_THAT(run.err, Not(HasSubstr("damaged")));
    EXPECT_FALSE(exists("out.exr"));
}

TEST_F(Faults, WhatAKilledRunLeftGoesWithTheNext) {
    graph(R"("c":    { "type": "constant", "color": [0.5, 0.25, 0], "size": [6000, 6000] },
             "blur": { "type": "gaussian", "in": "c", "sigma": 100 },
             "out":  { "type": "write", "in": "blur", "file": "out/slow.exr" })");
    Process process({"render", "graph.json", "--progress", "json", "--threads", "1"}, with("no_tmpfile"));
    ASSERT_TRUE(process.read_until("frame_started"));
    process.signal(SIGKILL);
    process.wait();
    ASSERT_THAT(outputs(), ElementsAre(testing::StartsWith("out/.keyline-")));
    graph(kNodes, kVariables);
    EXPECT_EQ(render("no_tmpfile").status, 0);
    EXPECT_EQ(outputs().size(), 4U);
}

// Ten thousand frames in a folder of a server are not listed for each of them.
TEST_F(Faults, AFolderIsListedOnceARun) {
    EXPECT_EQ(render("").status, 0);
    const std::string listed = read(folder() / "log");
    EXPECT_LE(std::ranges::count(listed, '\n'), 1) << listed;
}

}  // namespace

}  // namespace keyline::test
