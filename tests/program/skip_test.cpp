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
    bool is_followed = true;              // its structure alone tells of every byte
    std::size_t unseen = 0;               // zeros fewer than these are pixels that nothing tells of
};

// Without its origin a file is known by its structure: that of a format of plain samples tells nothing of
// zeros in them.
const std::vector<Format> kFormats = {
    {"exr", "exr", ""},
    {"exr_none", "exr", R"(, "compression": "none")", true, 4096},
    {"exr_piz", "exr", R"(, "compression": "piz")"},
    {"exr_dwaa", "exr", R"(, "compression": "dwaa")"},
    {"png", "png", ""},
    {"png16", "png", R"(, "depth": "uint16")"},
    {"tif", "tif", "", false},
    {"tif_none", "tif", R"(, "compression": "none")", false},
    {"jpg", "jpg", R"(, "compression": "jpeg:95")"},
    {"tga", "tga", "", false},
    {"webp", "webp", "", false},
    {"bmp", "bmp", "", false},
    {"hdr", "hdr", "", false},
    {"jp2", "jp2", "", false},
    {"ppm", "ppm", "", false},
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

    Outcome render(const std::vector<std::string>& more = {}) const {
        std::vector<std::string> arguments = {"render",          "graph.json", "--frames", "1",
                                              "--skip-existing", "--progress", "lines"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return keyline(arguments);
    }
    fs::path file() const { return folder() / fmt::format("out.1.{}", GetParam().extension); }

    void expect_rendered_again(const std::string& damaged, const std::vector<std::string>& more = {}) const {
        write(file().filename(), damaged);
        const Outcome run = render(more);
        EXPECT_EQ(run.status, 0) << run.err;
        EXPECT_THAT(run.err, HasSubstr("frame 1: done"));
        if (more.empty()) {
            EXPECT_EQ(read(file()).size(), whole_.size());
        }
    }

    std::string with_zeros(std::size_t last) const {
        return whole_.substr(0, whole_.size() - last) + std::string(last, '\0');
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
    expect_rendered_again(whole_.substr(0, whole_.size() - 1));
}

// What a machine leaves that lost its power.
TEST_P(SkipExisting, RendersAgainWhatEndsInZeros) {
    for (const std::size_t last : {std::size_t{64}, std::size_t{4096}, whole_.size() / 2}) {
        SCOPED_TRACE(last);
        if (last >= GetParam().unseen && with_zeros(last) != whole_) expect_rendered_again(with_zeros(last));
    }
}

TEST_P(SkipExisting, KnowsAFileByItsStructureWhereNothingTellsOfItsBytes) {
    fs::remove(file().string() + ".origin.json");
    expect_rendered_again(whole_.substr(0, whole_.size() / 2), {"--no-provenance"});
    if (!GetParam().is_followed) return;
    whole_ = read(file());  // without the text of its origin
    expect_rendered_again(whole_.substr(0, whole_.size() - 1), {"--no-provenance"});
    expect_rendered_again(with_zeros(whole_.size() / 2), {"--no-provenance"});
}

TEST_P(SkipExisting, RendersAgainWhatIsOfAnotherSize) {
    graph(fmt::format(R"("c":   {{ "type": "constant", "color": [0.5, 0.25, 0, 1], "size": [48, 32] }},
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
