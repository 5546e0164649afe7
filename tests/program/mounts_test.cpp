// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/program/program.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <sys/mount.h>

// Real file systems that are full, read-only, or there twice; left out where nobody may mount.

namespace keyline::test {

namespace {

using testing::HasSubstr;

class Mounts : public ProgramTest {
protected:
    // Eight frames of some 100 KB.
    Mounts() {
        fs::create_directory(disk());
        graph(R"("r":   { "type": "read", "file": ")" + (plates() / "street.0001.exr").string() + R"(" },
                 "out": { "type": "write", "in": "r:Combined", "compression": "none", "file": "disk/a.#.exr" })");
    }
    ~Mounts() override {
        if (is_mounted_) umount(disk().c_str());
    }
    fs::path disk() const { return folder() / "disk"; }
    bool mount_memory(const char* options, unsigned long flags = 0) {
        is_mounted_ = mount("tmpfs", disk().c_str(), "tmpfs", flags, options) == 0;
        return is_mounted_;
    }
    Outcome render() const { return keyline({"render", "graph.json", "--frames", "1-8", "--keep-going"}); }

    // Some are there, all of those whole, and the rest may be made once there is room.
    void expect_that_some_are_there(const Outcome& run) const {
        EXPECT_EQ(run.status, 75) << run.err;
        EXPECT_THAT(run.err, HasSubstr("retry=yes reason=space\n"));
        const auto count = std::distance(fs::directory_iterator(disk()), fs::directory_iterator());
        EXPECT_GT(count, 0);
        EXPECT_LT(count, 8);
        const std::string faults =
            keyline({"verify", "graph.json", "--frames", "1-8", "--list", "damaged"}).out;
        EXPECT_EQ(faults, "") << "what is there is whole";
    }

private:
    bool is_mounted_ = false;
};

TEST_F(Mounts, AFullDiskKeepsWhatWasWhole) {
    if (!mount_memory("size=6m")) GTEST_SKIP() << "no mounts here";
    expect_that_some_are_there(render());
}

TEST_F(Mounts, ADiskWithoutInodesKeepsWhatWasWhole) {
    if (!mount_memory("nr_inodes=5")) GTEST_SKIP() << "no mounts here";
    expect_that_some_are_there(render());
}

TEST_F(Mounts, AReadOnlyDiskIsTheOutputsFault) {
    if (!mount_memory("", MS_RDONLY)) GTEST_SKIP() << "no mounts here";
    const Outcome run = render();
    EXPECT_EQ(run.status, 4) << run.err;
    EXPECT_THAT(run.err, HasSubstr("Read-only file system"));
    EXPECT_THAT(run.err, HasSubstr("keyline: failed frames=1-8 retry=no reason=output\n"));
}

TEST_F(Mounts, APlateIsNotOverwrittenThroughAnotherMount) {
    fs::create_directory(folder() / "plates");
    fs::copy(plates() / "street.0001.exr", folder() / "plates/a.1.exr");
    const std::string before = read(folder() / "plates/a.1.exr");
    if (mount((folder() / "plates").c_str(), disk().c_str(), nullptr, MS_BIND, nullptr) != 0)
        GTEST_SKIP() << "no mounts here";
    graph(R"("r":   { "type": "read", "file": "plates/a.#.exr" },
             "out": { "type": "write", "in": "r:Combined", "file": "disk/a.#.exr" })");
    const Outcome run = keyline({"render", "graph.json", "--frames", "1"});
    umount(disk().c_str());
    EXPECT_EQ(run.status, 2) << run.err;
    EXPECT_EQ(read(folder() / "plates/a.1.exr"), before);
}

}  // namespace

}  // namespace keyline::test
