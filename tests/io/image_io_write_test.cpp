// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "image_io_support.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <sys/stat.h>

namespace keyline::test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(ImageIoWrite, AppearsOnlyWhenItIsFinished) {
    const Folder folder;
    const Pixels in = ramp(10, 100, {"R", "G", "B"});
    const auto file = folder / "a.png";
    put_bytes(file, "older");
    {
        const auto sink = create_image(file, spec_for(in));
        commit_all(*sink, in);
        EXPECT_EQ(bytes_of(file), "older");
        sink->finish();
        EXPECT_THAT(folder.files(), ElementsAre("a.png"));
    }
    EXPECT_NE(bytes_of(file), "older");
    EXPECT_EQ(read(file).width, 10);
}

TEST(ImageIoWrite, LeavesNothingWhenItIsGivenUp) {
    const Folder folder;
    const Pixels in = ramp(40, 100, {"R", "G", "B"});
    for (const char* name : {"a.png", "a.tif", "a.jpg", "a.tga", "a.webp", "a.jp2", "a.hdr", "a.dpx"}) {
        auto sink = create_image(folder / name, spec_for(in));
        std::vector<float> values(40 * 64, 0.5F);  // the first of two chunks
        const Plane plane{
            reinterpret_cast<std::byte*>(values.data()), 160, SampleType::kFloat, {0, 0, 40, 64}};
        sink->commit(sink->encode(0, std::vector<Plane>(3, plane)));
        EXPECT_EQ(error_of([&] { sink->finish(); }).kind, ErrorKind::kInternal) << name;
        testing::internal::CaptureStderr();
        sink.reset();
        EXPECT_EQ(testing::internal::GetCapturedStderr(), "") << name;
    }
    EXPECT_THAT(folder.files(), IsEmpty());
}

TEST(ImageIoWrite, MakesFoldersAndFollowsTheUmask) {
    const Folder folder;
    const Pixels in = ramp(3, 2, {"Y"});
    const auto file = folder / "deep" / "er" / "a.png";
    const mode_t before = umask(027);
    write(file, in, spec_for(in));
    umask(before);
    struct stat status = {};
    ASSERT_EQ(stat(file.c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 0777U, 0640U);
}

TEST(ImageIoWrite, HoldsTheDisplayWindowFromItsCornerOn) {
    const Folder folder;
    const Pixels in = ramp(20, 50, {"R", "G", "B"});
    SinkSpec spec = spec_for(in, Depth::kFloat);
    spec.display_window = {-7, 30, 13, 80};
    spec.data_window = {0, 0, 5, 40};
    const auto sink = create_image(folder / "a.tif", spec);
    EXPECT_EQ(sink->region(), spec.display_window);
    commit_all(*sink, in);
    sink->finish();
    const auto source = open_image(folder / "a.tif");
    EXPECT_EQ(source->header().display_window, (Rect{0, 0, 20, 50}));
    EXPECT_EQ(source->header().data_window, (Rect{0, 0, 20, 50}));
    EXPECT_EQ(read(*source).channels, in.channels);
}

TEST(ImageIoWrite, PutsChannelsInTheOrderOfTheFormat) {
    const Folder folder;
    const Pixels in = ramp(4, 3, {"A", "B", "G", "R", "Z"});
    write(folder / "a.tif", in, spec_for(in, Depth::kFloat));
    const Pixels out = read(folder / "a.tif");
    EXPECT_THAT(out.names, ElementsAre("R", "G", "B", "A", "channel4"));
    EXPECT_EQ(out.at("R", 2, 1), in.at("R", 2, 1));
    EXPECT_EQ(out.at("A", 2, 1), in.at("A", 2, 1));
    EXPECT_EQ(out.at("channel4", 2, 1), in.at("Z", 2, 1));
}

TEST(ImageIoWrite, AnySingleChannelIsGrey) {
    const Folder folder;
    const Pixels in = ramp(4, 3, {"edge"});
    write(folder / "a.png", in, spec_for(in));
    EXPECT_THAT(read(folder / "a.png").names, ElementsAre("Y"));
}

TEST(ImageIoWrite, RoundsLimitsAndTakesNoNumberForZero) {
    const Folder folder;
    const float inf = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
    Pixels in = ramp(8, 1, {"Y"});
    in.channels[0] = {-1, -inf, nan, 0.5F / 255 - 1e-6F, 0.5F / 255 + 1e-6F, 254.6F / 255, 2, inf};
    write(folder / "a.png", in, spec_for(in, Depth::kUint8));
    EXPECT_THAT(read(folder / "a.png").channels[0], ElementsAre(0, 0, 0, 0, 1.0F / 255, 1, 1, 1));
}

TEST(ImageIoWrite, AutoIsTheBestDepthThatTheFormatHolds) {
    const Folder folder;
    Pixels in = ramp(2, 1, {"R", "G", "B"});
    for (auto& channel : in.channels) channel = {0.30001F, 0.4F};
    const auto lost = [&](const char* name) {
        write(folder / name, in, spec_for(in));
        return std::abs(read(folder / name).at("R", 0, 0) - 0.30001F);
    };
    EXPECT_EQ(lost("a.tif"), 0);
    EXPECT_LT(lost("a.png"), 1e-5);
    EXPECT_GT(lost("a.png"), 0);
    EXPECT_GT(lost("a.bmp"), 1e-5);
}

TEST(ImageIoWrite, CarriesMetadata) {
    const Folder folder;
    const Pixels in = ramp(2, 2, {"R", "G", "B"});
    SinkSpec spec = spec_for(in);
    spec.metadata.set({"owner", "string", std::string("Studio")});
    spec.metadata.set({"capDate", "string", std::string("2026:03:04 05:06:07")});
    spec.metadata.set({"comments", "string", std::string("shot 12")});
    spec.metadata.set({"pixelAspectRatio", "float", std::vector<float>{2}});
    spec.metadata.set({"a name with spaces", "string", std::string("not for PNG")});
    spec.metadata.set({"chromaticities", "chromaticities", std::vector<float>{1, 2, 3, 4, 5, 6, 7, 8}});
    spec.metadata.set({"opaque", "preview", std::vector<std::byte>(7)});
    for (const char* name : {"a.png", "a.tif", "a.jpg"}) {
        write(folder / name, in, spec);
        const Metadata out = open_image(folder / name)->header().metadata;
        ASSERT_NE(out.find("owner"), nullptr) << name;
        EXPECT_EQ(std::get<std::string>(out.find("owner")->value), "Studio");
        ASSERT_NE(out.find("capDate"), nullptr) << name;
        EXPECT_EQ(std::get<std::string>(out.find("capDate")->value), "2026:03:04 05:06:07");
        ASSERT_NE(out.find("comments"), nullptr) << name;
        EXPECT_EQ(std::get<std::string>(out.find("comments")->value), "shot 12");
        EXPECT_EQ(out.find("compression"), nullptr) << name;
        EXPECT_EQ(out.find("Compression"), nullptr) << name;
        for (const Attribute& a : out.attributes()) EXPECT_FALSE(a.name.starts_with("oiio:")) << a.name;
    }
}

}  // namespace
}  // namespace keyline::test
