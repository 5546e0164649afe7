// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/program/program.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

// --skip-existing: what is whole is left alone, what lost a part of itself is rendered again.

namespace keyline::test {

namespace {

using testing::HasSubstr;

struct Format {
    const char *name, *extension, *more;  // of the write
    bool is_followed = true;              // to its end: its structure tells of every byte
};

// A compressed file of two thirds of its bytes and zeros is damaged in its structure; one of plain samples is
// black at the bottom, which no structure tells.
const std::vector<Format> kFormats = {
    {"exr", "exr", ""},
    {"exr_none", "exr", R"(, "compression": "none")"},
    {"exr_piz", "exr", R"(, "compression": "piz")"},
    {"exr_dwaa", "exr", R"(, "compression": "dwaa")"},
    {"png", "png", ""},
    {"png16", "png", R"(, "depth": "uint16")"},
    {"tif", "tif", "", false},
    {"tif_none", "tif", R"(, "compression": "none")", false},
    {"jpg", "jpg", R"(, "compression": "jpeg:95")"},
    {"tga", "tga", "", false},
    {"webp", "webp", "", false},
};

class SkipExisting : public ProgramTest, public testing::WithParamInterface<Format> {
protected:
    SkipExisting() {
        graph(fmt::format(R"("r":   {{ "type": "read", "file": "{}" }},
                             "out": {{ "type": "write", "in": "r:Combined", "channels": ["R", "G", "B"],
                                       "file": "out.#.{}"{} }})",
                          (plates() / "street.0001.exr").string(), GetParam().extension, GetParam().more));
        EXPECT_EQ(render().status, 0);
        whole_ = read(file());
    }

    Outcome render() const {
        return keyline({"render", "graph.json", "--frames", "1", "--skip-existing", "--progress", "lines"});
    }
    fs::path file() const { return folder() / fmt::format("out.1.{}", GetParam().extension); }

    void expect_rendered_again(const std::string& damaged) const {
        write(file().filename(), damaged);
        const Outcome run = render();
        EXPECT_EQ(run.status, 0) << run.err;
        EXPECT_THAT(run.err, HasSubstr("frame 1: done"));
        EXPECT_EQ(read(file()).size(), whole_.size());
    }

    std::string whole_;
};

TEST_P(SkipExisting, LeavesWhatIsWholeAlone) {
    const auto before = fs::last_write_time(file());
    EXPECT_THAT(render().err, HasSubstr("frame 1: skipped"));
    EXPECT_EQ(fs::last_write_time(file()), before);
}

TEST_P(SkipExisting, RendersAgainWhatWasCutOff) {
    for (const double share : {0.0, 0.1, 0.5, 0.99}) {
        SCOPED_TRACE(share);
        expect_rendered_again(whole_.substr(0, static_cast<std::size_t>(share * double(whole_.size()))));
    }
    if (GetParam().is_followed) expect_rendered_again(whole_.substr(0, whole_.size() - 1));
}

TEST_P(SkipExisting, RendersAgainWhatEndsInZeros) {
    if (!GetParam().is_followed) return;
    const std::string half = whole_.substr(0, whole_.size() / 2);
    expect_rendered_again(half + std::string(whole_.size() - half.size(), '\0'));
}

TEST_P(SkipExisting, RendersAgainWhatIsOfAnotherSize) {
    graph(fmt::format(R"("c":   {{ "type": "constant", "color": [0.5, 0.25, 0, 1], "size": [24, 16] }},
                         "out": {{ "type": "write", "in": "c", "channels": ["R", "G", "B"],
                                   "file": "out.#.{}"{} }})",
                      GetParam().extension, GetParam().more));
    EXPECT_THAT(render().err, HasSubstr("frame 1: done"));
    EXPECT_THAT(render().err, HasSubstr("frame 1: skipped"));
}

INSTANTIATE_TEST_SUITE_P(Formats, SkipExisting, testing::ValuesIn(kFormats),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace

}  // namespace keyline::test
