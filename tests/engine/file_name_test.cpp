// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/params/file_name.h"

#include "engine/base/error.h"

#include <climits>
#include <fstream>
#include <gtest/gtest.h>
#include <unistd.h>

namespace keyline {
namespace {

namespace fs = std::filesystem;

struct Case {
    std::string text;
    int frame;
    std::string path;
};

class FileNames : public testing::TestWithParam<Case> {};

TEST_P(FileNames, HoldTheFrame) {
    EXPECT_EQ(FileName(GetParam().text).at(GetParam().frame).string(), GetParam().path) << GetParam().text;
}

INSTANTIATE_TEST_SUITE_P(
    Tokens, FileNames,
    testing::Values(Case{"a.####.exr", 7, "a.0007.exr"}, Case{"a.####.exr", 12345, "a.12345.exr"},
                    Case{"a.####.exr", -7, "a.-0007.exr"}, Case{"a.#.exr", 12, "a.12.exr"},
                    Case{"a.%04d.exr", 7, "a.0007.exr"}, Case{"a.%04d.exr", -7, "a.-0007.exr"},
                    Case{"a.%d.exr", 7, "a.7.exr"}, Case{"a.%010d.exr", 7, "a.0000000007.exr"},
                    Case{"##/x_%03d/a.#.exr", 5, "05/x_005/a.5.exr"},
                    Case{"100%%/a%%04d.##", 5, "100%/a%04d.05"}, Case{"plain.exr", 5, "plain.exr"},
                    Case{"take#1/a.#.exr", 5, "take#1/a.5.exr"}, Case{"#/a.exr", 5, "#/a.exr"},
                    Case{"take##/a.exr", 5, "take05/a.exr"}, Case{"take%d/a.exr", 5, "take5/a.exr"},
                    Case{"a\\#.#.exr", 5, "a#.5.exr"}, Case{"\\#\\#/a.exr", 5, "##/a.exr"},
                    Case{"a\\##.exr", 5, "a#5.exr"}, Case{"\\$F4/\\@\\@\\%d\\~", 5, "$F4/@@%d~"},
                    Case{"./~/a~.exr", 5, "./~/a~.exr"}, Case{"a@2x.exr", 5, "a@2x.exr"},
                    Case{"5$/$5.exr", 5, "5$/$5.exr"}, Case{"#", INT_MIN, "-2147483648"},
                    Case{"##%02d", 3, "0303"}));

TEST(FileName, KnowsWhetherItHoldsAFrame) {
    EXPECT_TRUE(FileName("a.####.exr").has_frame());
    EXPECT_TRUE(FileName("%d/a.exr").has_frame());
    EXPECT_FALSE(FileName("a%%04d.exr").has_frame());
}

TEST(FileName, IsRelativeToItsBase) {
    EXPECT_EQ(FileName("b/a.#.exr", "/root/#%").at(3), "/root/#%/b/a.3.exr");
    EXPECT_EQ(FileName("/abs/a.#.exr", "/root").at(3), "/abs/a.3.exr");
    EXPECT_EQ(FileName("a.exr", "graphs").at(3), "graphs/a.exr");
}

std::string fault(std::string_view text) {
    try {
        const FileName name(text);
    } catch (const Failure& f) {
        EXPECT_EQ(f.error().kind, ErrorKind::kGraph);
        return f.what();
    }
    return "no fault";
}

TEST(FileName, TellsWhatIsWrong) {
    EXPECT_EQ(fault("a.####.exr"), "no fault");
    EXPECT_EQ(fault(""), "error: a file name is empty");
    EXPECT_EQ(fault("out/"), "error: 'out/' names a folder, not a file");
    EXPECT_EQ(fault(std::string_view("a\0b", 3)), "error: the file name 'a\\x00b' holds a NUL");
    for (const std::string text :
         {"%", "a%s", "%4d", "%0d", "%00d", "%04", "%04x", "%-4d", "%99999999999999999999d", "%ü"})
        EXPECT_EQ(fault(text), "error: a '%' in the file name '" + text +
                                   "' starts neither %d nor %04d; a percent sign is written %%");
    EXPECT_EQ(fault("%021d"), "error: the file name '%021d' pads the frame to 21 digits; the most is 20");
}

// What is written so elsewhere, and how it is written here.
TEST(FileName, TellsWhatOtherProgramsAndSystemsWrite) {
    for (const auto& [text, way] : std::vector<std::pair<std::string, std::string>>{
             {"~/a.exr", "write ${env:HOME}"},
             {"~show/a.exr", "write ${env:HOME}"},
             {"$SHOW/a.exr", "written ${env:SHOW}, one of the graph ${SHOW}, a '$' itself \\$"},
             {"a.$F4.exr", "holds $F4; the frame is written ####"},
             {"a.$F.exr", "the frame is written ####"},
             {"$FX/a.exr", "written ${env:FX}"},
             {"a.@@@@.exr", "the frame is written ####"},
             {"a.%V.exr", "holds %V for a view"},
             {"a_%v.exr", "holds %v for a view"},
             {"D:\\a\\b.exr", "one of Windows"},
             {"wall.<UDIM>.exr", "holds <UDIM>, the tiles of a texture; a file is one picture here"},
             {"D:/a/b.exr", "one of Windows"},
             {"\\\\server\\a.exr", "one of Windows"},
             {"a\\b.exr", "folders are parted by '/'"},
             {"a\\", "folders are parted by '/'"}}) {
        EXPECT_NE(fault(text).find(way), std::string::npos) << fault(text);
        EXPECT_NE(fault(text).find("'" + text + "'"), std::string::npos) << fault(text);
    }
}

class FramesOnDisk : public testing::Test {
protected:
    void SetUp() override {
        std::string name = (fs::temp_directory_path() / "keyline-XXXXXX").string();
        ASSERT_NE(::mkdtemp(name.data()), nullptr);
        folder_ = name;
    }
    void TearDown() override { fs::remove_all(folder_); }

    void touch(const std::vector<std::string>& paths) const {
        for (const std::string& path : paths) {
            fs::create_directories((folder_ / path).parent_path());
            std::ofstream(folder_ / path) << "x";
        }
    }
    std::vector<int> frames(std::string_view text) const { return FileName(text, folder_).frames_on_disk(); }

    fs::path folder_;
};

using Frames = std::vector<int>;

TEST_F(FramesOnDisk, AreThoseThatTheNameGives) {
    touch({"a.0010.exr", "a.0002.exr", "a.-0003.exr", "a.12345.exr", "a.00006.exr", "a.7.exr",
           "a.0008.exr.tmp", "b.0009.exr", "a.-0000.exr", "a.99999999999.exr", "a..exr", "a.x.exr",
           "a.0011.exr/file", ".a.0012.exr"});
    EXPECT_EQ(frames("a.####.exr"), (Frames{-3, 2, 10, 12345}));
    EXPECT_EQ(frames("a.%04d.exr"), (Frames{-3, 2, 10, 12345}));
    EXPECT_EQ(frames("a.#.exr"), (Frames{7, 12345}));
    EXPECT_EQ(frames("./a.#####.exr"), (Frames{6, 12345}));
    EXPECT_EQ(frames("none.####.exr"), Frames{});
    EXPECT_EQ(frames("absent/a.####.exr"), Frames{});
    EXPECT_EQ(frames("b.0009.exr/a.####.exr"), Frames{});
    EXPECT_EQ(frames("b.0009.exr"), Frames{});
}

TEST_F(FramesOnDisk, MayStandInFolders) {
    touch({"s/01/a.0001.exr", "s/02/a.0002.exr", "s/03/a.0004.exr", "s/05/b.exr", "s/6/a.0006.exr"});
    EXPECT_EQ(frames("s/##/a.####.exr"), (Frames{1, 2}));
    EXPECT_EQ(frames("s/%02d/b.exr"), (Frames{5}));
}

TEST_F(FramesOnDisk, MayTouchDigitsOfTheName) {
    touch({"a512.exr", "a5.exr", "3-3", "44"});
    EXPECT_EQ(frames("a#12.exr"), (Frames{5}));
    EXPECT_EQ(frames("a%d.exr"), (Frames{5, 512}));
    EXPECT_EQ(frames("#-#"), (Frames{3}));
    EXPECT_EQ(frames("##"), (Frames{44}));
    EXPECT_EQ(frames("#%d"), (Frames{4}));
}

TEST_F(FramesOnDisk, TakeTheBaseAsItIs) {
    touch({"##/%d/a.3.exr"});
    EXPECT_EQ(FileName("a.#.exr", folder_ / "##" / "%d").frames_on_disk(), (Frames{3}));
}

TEST_F(FramesOnDisk, SayWhenAFolderCantBeListed) {
    try {
        frames(std::string(300, 'x') + "/a.#.exr");
        ADD_FAILURE();
    } catch (const Failure& f) {
        EXPECT_EQ(f.error().kind, ErrorKind::kInput);
        EXPECT_TRUE(f.error().what.starts_with("can't list the folder '" + folder_.string().substr(0, 50)));
        EXPECT_TRUE(f.error().what.ends_with("File name too long"));
    }
}

}  // namespace
}  // namespace keyline
