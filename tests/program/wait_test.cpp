// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/program/program.h"

#include <csignal>
#include <gmock/gmock.h>

// --wait-inputs: what others are still making is waited for, and what is damaged is not.

namespace keyline::test {

namespace {

using testing::HasSubstr;
using testing::Not;

class WaitInputs : public ProgramTest {
protected:
    WaitInputs() { read_from("in.#.exr", "r:Combined"); }
    void read_from(const std::string& file, const std::string& layer) const {
        graph(R"("r": { "type": "read", "file": ")" + file + R"(" },
                 "out": { "type": "write", "in": ")" +
              layer + R"(", "file": "out.#.exr" })");
    }
    // As a renderer finishes a file: another one takes its name.
    void appears(const std::string& name, std::string_view bytes) const {
        write("new", bytes);
        fs::rename(folder() / "new", folder() / name);
    }
    std::string plate() const { return read(plates() / "street.0001.exr"); }
    std::string picture(const char* format) const {
        graph(R"("c":   { "type": "constant", "color": [0.5, 0.25, 0], "size": [640, 480] },
                 "out": { "type": "write", "in": "c", "file": "made.)" +
              std::string(format) + "\" }");
        EXPECT_EQ(keyline({"render", "graph.json"}).status, 0);
        return read(folder() / (std::string("made.") + format));
    }
    std::vector<std::string> waiting(const char* frames, const char* most) const {
        return {"render", "graph.json", "--frames", frames,        "--wait-inputs",
                most,     "--progress", "lines",    "--heartbeat", "0.05"};
    }
};

TEST_F(WaitInputs, FramesComeAsTheirInputsDo) {
    appears("in.1.exr", plate());
    Process process(waiting("1-3", "1h"), {.folder = folder()});
    ASSERT_TRUE(process.read_until("frame 2 waits: ")) << "it is not there";
    appears("in.2.exr", plate().substr(0, plate().size() / 2));
    ASSERT_TRUE(process.read_until("chunks are not there")) << "it is said again, with what is wrong now";
    appears("in.2.exr", plate());
    ASSERT_TRUE(process.read_until("frame 3 waits: "));
    appears("in.3.exr", plate());
    const Outcome run = process.wait();
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_THAT(run.err, Not(HasSubstr("error")));
    EXPECT_TRUE(exists("out.3.exr"));
}

TEST_F(WaitInputs, WhatDidNotComeMayDoSoBeforeAnotherTry) {
    appears("in.1.exr", plate());
    appears("in.3.exr", plate().substr(0, plate().size() / 2));
    std::vector<std::string> arguments = waiting("1-4", "0.3s");
    arguments.emplace_back("--keep-going");
    const Outcome run = keyline(arguments);
    EXPECT_EQ(run.status, 75);
    EXPECT_THAT(run.err, HasSubstr("keyline: failed frames=2-4 retry=yes reason=unfinished\n"));
    EXPECT_EQ(keyline({"render", "graph.json", "--frames", "2"}).status, 3) << "where nobody waits for it";
}

// An hour would be waited here otherwise.
TEST_F(WaitInputs, WhatIsDamagedIsNotWaitedFor) {
    std::string damaged = plate();
    for (std::size_t i = damaged.size() / 2; i < damaged.size() / 2 + 64; ++i) damaged[i] = '\x5a';
    appears("in.1.exr", damaged);
    const Outcome run = keyline(waiting("1", "1h"));
    EXPECT_EQ(run.status, 3) << run.err;
    EXPECT_THAT(run.err, HasSubstr("retry=no reason=input\n"));
    EXPECT_THAT(run.err, Not(HasSubstr("waits")));
}

TEST_F(WaitInputs, OtherFormatsAreWaitedForToo) {
    for (const char* format : {"png", "tif", "tga"}) {
        SCOPED_TRACE(format);
        const std::string whole = picture(format), name = std::string("in.1.") + format;
        read_from(std::string("in.#.") + format, "r");
        appears(name, whole.substr(0, whole.size() * 9 / 10));
        Process process(waiting("1", "1h"), {.folder = folder()});
        ASSERT_TRUE(process.read_until("frame 1 waits: "));
        appears(name, whole);
        // Whose structure tells nothing is at rest some seconds after it was written.
        fs::last_write_time(folder() / name, fs::file_time_type::clock::now() - std::chrono::hours(1));
        const Outcome run = process.wait();
        EXPECT_EQ(run.status, 0) << run.err;
    }
}

TEST_F(WaitInputs, ASignalEndsTheWait) {
    Process process(waiting("1", "1h"), {.folder = folder()});
    ASSERT_TRUE(process.read_until("frame 1 waits: "));
    process.signal(SIGTERM);
    const Outcome run = process.wait();
    EXPECT_EQ(run.status, 143);
    EXPECT_THAT(run.err, HasSubstr("keyline: failed frames=1 retry=yes reason=stopped\n"));
}

TEST_F(WaitInputs, ATimeIsANumberWithAUnit) {
    for (const char* wrong : {"soon", "10 m", "-3s", "0", "2w", "m", "9999h"}) {
        const Outcome run =
            keyline({"render", "graph.json", "--frames", "1", "--wait-inputs=" + std::string(wrong)});
        EXPECT_EQ(run.status, 2) << wrong;
        EXPECT_THAT(run.err, HasSubstr("--wait-inputs " + std::string(wrong))) << wrong;
    }
}

}  // namespace

}  // namespace keyline::test
