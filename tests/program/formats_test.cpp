// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/program/program.h"

#include <algorithm>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <iterator>
#include <sys/resource.h>

// Every format that is read and written: from and to, as a user would.  All of them are in one graph, as the
// libraries behind them take longer to load than the pictures to make.

namespace keyline::test {

namespace {

using testing::HasSubstr;

struct Format {
    const char *extension, *name;
    bool is_grey = false;  // holds one channel only
};

const std::vector<Format> kFormats = {
    {"bmp", "bmp"},   {"dpx", "dpx"},          {"exr", "openexr"},  {"fits", "fits", true}, {"gif", "gif"},
    {"hdr", "hdr"},   {"iff", "iff"},          {"jp2", "jpeg2000"}, {"jpg", "jpeg"},        {"png", "png"},
    {"ppm", "pnm"},   {"rla", "rla"},          {"sgi", "sgi"},      {"tga", "targa"},       {"tif", "tiff"},
    {"webp", "webp"}, {"zfile", "zfile", true}};

std::ptrdiff_t lines_in(std::string_view text) { return std::ranges::count(text, '\n'); }

class Formats : public ProgramTest {
protected:
    // make.json makes plate.EXT of every format, 64 × 48 with an edge; use.json writes half of its red or
    // grey to `out`, a name in which ${ext} and the like stand for the format.
    Formats() {
        std::string make = R"("back":  { "type": "constant", "color": [0.25, 0.5, 0.75], "size": [64, 48] },
            "front": { "type": "constant", "color": [1, 0.5, 0.25], "size": [20, 30] },
            "both":  { "type": "over", "fg": "front", "bg": "back" })";
        for (const Format& f : kFormats)
            make += fmt::format(
                R"(, "{0}": {{ "type": "write", "in": "both", "file": "plate.{0}", "channels": {1} }})",
                f.extension, channels(f));
        graph(make);
        fs::rename(folder() / "graph.json", folder() / "make.json");
    }

    static std::string channels(const Format& f) { return f.is_grey ? R"(["R"])" : R"(["R", "G", "B"])"; }

    // Each plate, with its channels halved, to a file of a format.
    void use(const std::string& folder_and_stem, const std::string& extension = {}) const {
        std::string nodes;
        for (const Format& f : kFormats) {
            const std::string stem = fmt::format(fmt::runtime(folder_and_stem), f.extension);
            nodes += fmt::format(R"({0} "r_{1}": {{ "type": "read", "file": "plate.{1}" }},
                "h_{1}": {{ "type": "math", "op": "multiply", "in": "r_{1}", "value": 0.5 }},
                "w_{1}": {{ "type": "write", "in": "h_{1}", "file": "{2}.{3}" {4} }})",
                                 nodes.empty() ? "" : ",", f.extension, stem,
                                 extension.empty() ? f.extension : extension,
                                 f.is_grey ? "" : R"(, "channels": ["R", "G", "B"])");
        }
        graph(nodes);
    }

    Outcome expect_success(const std::vector<std::string>& arguments) const {
        Outcome run = keyline(arguments);
        EXPECT_EQ(run.status, 0) << arguments[0] << ": " << run.err;
        return run;
    }
};

TEST_F(Formats, AreCheckedPlannedWrittenAndRead) {
    expect_success({"check", "make.json"});
    expect_success({"plan", "make.json"});
    expect_success({"render", "make.json"});
    std::vector<std::string> info = {"info", "--all"};
    for (const auto& [stem, extension] : {std::pair("half/{}", ""), std::pair("as_exr/{}", "exr")}) {
        use(stem, extension);
        expect_success({"check", "graph.json"});
        const Outcome plan = expect_success({"plan", "graph.json"});
        expect_success({"render", "graph.json"});
        for (const Format& f : kFormats) {
            EXPECT_THAT(plan.out, HasSubstr(fmt::format("plate.{}", f.extension)));
            info.push_back(fmt::format(fmt::runtime(stem), f.extension) + "." +
                           (*extension == '\0' ? f.extension : extension));
        }
    }
    const Outcome told = expect_success(info);
    for (const Format& f : kFormats)
        EXPECT_THAT(told.out, HasSubstr(fmt::format("half/{0}.{0}: {1}, 1 part", f.extension, f.name)));
    std::size_t pictures = 0;
    for (auto at = told.out.find("64 × 48"); at != std::string::npos; at = told.out.find("64 × 48", at + 1))
        ++pictures;
    EXPECT_EQ(pictures, 2 * 2 * kFormats.size());  // both windows of each
}

TEST_F(Formats, AreNotWrittenOntoWhatIsRead) {
    expect_success({"render", "make.json"});
    std::vector<std::string> before;
    for (const Format& f : kFormats) {
        before.push_back(read(folder() / fmt::format("plate.{}", f.extension)));
        fs::create_symlink(fmt::format("plate.{}", f.extension),
                           folder() / fmt::format("link.{}", f.extension));
    }
    for (const char* name : {"plate", "./link"})
        for (const char* command : {"check", "plan", "render"}) {
            use(name);
            const Outcome run = keyline({command, "graph.json"});
            EXPECT_EQ(run.status, 2) << command << ' ' << name << ": " << run.err;
            for (const Format& f : kFormats)
                EXPECT_THAT(run.err, HasSubstr(fmt::format("{}.{}' is read by this run", name, f.extension)));
        }
    for (std::size_t i = 0; i < kFormats.size(); ++i)
        EXPECT_EQ(read(folder() / fmt::format("plate.{}", kFormats[i].extension)), before[i]);
}

TEST_F(Formats, AreNotWrittenOntoWhatALaterFrameReads) {
    std::string make = R"("c": { "type": "constant", "color": [1, 0, 0], "size": [8, 8] })", shift;
    for (const char* extension : {"exr", "png", "tif"}) {
        make += fmt::format(R"(, "{0}": {{ "type": "write", "in": "c", "file": "p.#.{0}" }})", extension);
        shift += fmt::format(R"({1} "r_{0}": {{ "type": "read", "file": "p.#.{0}", "frame": "-1" }},
                               "w_{0}": {{ "type": "write", "in": "r_{0}", "file": "p.#.{0}" }})",
                             extension, shift.empty() ? "" : ",");
    }
    graph(make);
    expect_success({"render", "graph.json", "--frames", "1-2"});
    const std::string before = read(folder() / "p.2.png");
    graph(shift);
    const Outcome run = keyline({"render", "graph.json", "--frames", "2-3"});
    EXPECT_EQ(run.status, 2) << run.err;
    for (const char* extension : {"exr", "png", "tif"})
        EXPECT_THAT(run.err, HasSubstr(fmt::format("p.2.{}' is read by frame 3 of this run", extension)));
    EXPECT_EQ(read(folder() / "p.2.png"), before);
}

TEST_F(Formats, WhatIsCutShortMayBeWrittenStill) {
    expect_success({"render", "make.json"});
    for (const char* extension : {"exr", "jpg", "png", "tif"}) {
        const std::string name = fmt::format("plate.{}", extension), whole = read(folder() / name);
        write(name, whole.substr(0, whole.size() / 2));
        graph(fmt::format(R"("r": {{ "type": "read", "file": "{}" }},
                             "out": {{ "type": "write", "in": "r", "file": "out.exr" }})",
                          name));
        const Outcome run = keyline({"render", "graph.json", "--progress", "none"});
        EXPECT_EQ(run.status, 75) << run.err;
        EXPECT_THAT(run.err, HasSubstr(name + ": "));
        EXPECT_THAT(run.err, HasSubstr("; it is still being written or copied, or it was cut off\n"));
        EXPECT_THAT(run.err, HasSubstr("keyline: failed frames=1 retry=yes reason=unfinished\n"));
        EXPECT_EQ(lines_in(run.err), 2) << run.err;
        EXPECT_FALSE(exists("out.exr"));
    }
}

// The same bytes whenever and wherever they are written: no clock and no path is in them.
TEST_F(Formats, HoldNeitherTheClockNorThePath) {
    const auto written = [&](const std::string& at, const char* clock) {
        const fs::path place = folder() / at;
        fs::create_directories(place);
        fs::copy(folder() / "make.json", place / "make.json");
        const Outcome run = keyline(
            {"render", (place / "make.json").string()},
            {.environment = {"LD_PRELOAD=" KEYLINE_TEST_CLOCK, std::string("KEYLINE_CLOCK=") + clock}});
        EXPECT_EQ(run.status, 0) << run.err;
        std::vector<std::string> bytes;
        for (const Format& f : kFormats) bytes.push_back(read(place / fmt::format("plate.{}", f.extension)));
        return bytes;
    };
    const auto once = written("a", "1000000000"), later = written("somewhere/else", "1500000000");
    for (std::size_t i = 0; i < kFormats.size(); ++i)
        EXPECT_TRUE(once[i] == later[i]) << kFormats[i].extension;
}

// A limit on the size of files stands for a full disk.
TEST_F(Formats, ThatMayNotGrowAreErrorsOfTheOutput) {
    for (const char* extension : {"dpx", "jpg", "png", "rla", "sgi", "tif"}) {
        graph(fmt::format(R"("r":   {{ "type": "read", "file": "{}" }},
                             "out": {{ "type": "write", "in": "r:Combined", "file": "out.{}",
                                       "channels": ["R", "G", "B"], "meant": "linear-in-file" }})",
                          (plates() / "street.0001.exr").string(), extension));
        rlimit before{};
        getrlimit(RLIMIT_FSIZE, &before);
        const rlimit little{4096, before.rlim_max};
        setrlimit(RLIMIT_FSIZE, &little);
        Process process({"render", "graph.json", "--progress", "none"}, {.folder = folder()});
        setrlimit(RLIMIT_FSIZE, &before);
        const Outcome run = process.wait();
        EXPECT_EQ(run.status, 4) << run.err;
        EXPECT_THAT(run.err, HasSubstr(fmt::format("out.{}: can't be written: ", extension)));
        EXPECT_EQ(lines_in(run.err), 2) << run.err;
    }
    EXPECT_THAT(files(), testing::ElementsAre("graph.json", "make.json"));
}

// Files that crash the libraries that read them, or make them take gigabytes.
class HostilePictures : public ProgramTest {
protected:
    HostilePictures() {
        for (const auto& entry : fs::directory_iterator(KEYLINE_HOSTILE))
            fs::copy(entry.path(), folder() / fmt::format("h.{}.img", ++count_));
        graph(R"("r":   { "type": "read", "file": "h.#.img" },
                 "out": { "type": "write", "in": "r", "file": "out.#.exr" })");
    }

    // One line each that names it; a render has one more, how it ended.
    void expect_refused(const Outcome& run, int more = 0) const {
        EXPECT_EQ(run.status, 3) << run.err;
        EXPECT_EQ(lines_in(run.err), count_ + more) << run.err;
        for (int i = 1; i <= count_; ++i) EXPECT_THAT(run.err, HasSubstr(fmt::format("h.{}.img: ", i)));
    }

    std::string frames() const { return fmt::format("1-{}", count_); }
    int count_ = 0;
};

TEST_F(HostilePictures, AreRefusedByInfo) {
    std::vector<std::string> arguments = {"info"};
    for (int i = 1; i <= count_; ++i) arguments.push_back(fmt::format("h.{}.img", i));
    expect_refused(keyline(arguments));
}

TEST_F(HostilePictures, AreRefusedByCheck) {
    expect_refused(keyline({"check", "graph.json", "--frames", frames()}));
}

TEST_F(HostilePictures, FailTheirFramesAndNoOther) {
    write(fmt::format("h.{}.img", count_ + 1), read(plates() / "street.0001.exr"));
    const Outcome run = keyline({"render", "graph.json", "--frames", fmt::format("1-{}", count_ + 1),
                                 "--keep-going", "--progress", "none"});
    expect_refused(run, 1);
    EXPECT_TRUE(exists(fmt::format("out.{}.exr", count_ + 1)));
}

}  // namespace

}  // namespace keyline::test
