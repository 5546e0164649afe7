// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "image_io_support.h"

#include <algorithm>
#include <atomic>
#include <gtest/gtest.h>
#include <thread>

namespace keyline::test {
namespace {

// Reads one chunk into a plane for its first channel; every other channel is not wanted.
std::vector<float> first_channel(const ImageSource& source, int row) {
    const ChannelGroup& group = source.header().groups[0];
    const Rect chunk = group.chunk(0, row);
    std::vector<float> values(static_cast<std::size_t>(chunk.area()), -1);
    std::vector<Plane> planes(group.channels.size());
    planes[0] = {reinterpret_cast<std::byte*>(values.data()), std::ptrdiff_t{4} * chunk.width(),
                 SampleType::kFloat, chunk};
    source.read_chunk(0, 0, row, planes);
    return values;
}

TEST(ImageIoRead, TellsWindowsChannelsTypeAndFormat) {
    const Folder folder;
    const Pixels in = ramp(33, 9, {"R", "G", "B", "A"});
    write(folder / "a.png", in, spec_for(in, Depth::kUint16));
    const auto source = open_image(folder / "a.png");
    const ImageHeader& header = source->header();
    EXPECT_EQ(header.format, "png");
    EXPECT_EQ(header.display_window, (Rect{0, 0, 33, 9}));
    EXPECT_EQ(header.data_window, (Rect{0, 0, 33, 9}));
    ASSERT_EQ(header.groups.size(), 1U);
    const std::vector<ChannelInfo> expected = {{"R", SampleType::kFloat},
                                               {"G", SampleType::kFloat},
                                               {"B", SampleType::kFloat},
                                               {"A", SampleType::kFloat}};
    EXPECT_EQ(header.groups[0].channels, expected);
    EXPECT_EQ(header.groups[0].window, (Rect{0, 0, 33, 9}));
    EXPECT_GE(source->chunk_memory(0), 33U * 9 * 4 * 2);
}

// The content decides; the name is only asked where the content says nothing.
TEST(ImageIoRead, TheContentDecidesTheFormat) {
    const Folder folder;
    const Pixels in = ramp(5, 4, {"R", "G", "B"});
    write(folder / "a.png", in, spec_for(in));
    std::filesystem::rename(folder / "a.png", folder / "b.jpg");
    EXPECT_EQ(open_image(folder / "b.jpg")->header().format, "png");
    std::filesystem::rename(folder / "b.jpg", folder / "noextension");
    EXPECT_EQ(open_image(folder / "noextension")->header().format, "png");
}

TEST(ImageIoRead, OneThatIsFinishedIsKnown) {
    const Folder folder;
    const Pixels in = ramp(7, 70, {"R", "G", "B"});
    const auto sink = create_image(folder / "a.png", spec_for(in));
    commit_all(*sink, in);
    sink->finish();
    EXPECT_EQ(open_image(folder / "a.png")->header().data_window, (Rect{0, 0, 7, 70}));
    EXPECT_TRUE(is_finished(folder / "a.png", spec_for(in)));
}

TEST(ImageIoRead, StoresOnlyWhatIsWanted) {
    const Folder folder;
    const Pixels in = ramp(40, 30, {"R", "G", "B"});
    write(folder / "a.tif", in, spec_for(in, Depth::kFloat));
    const auto source = open_image(folder / "a.tif");
    const Rect wanted = {7, 3, 12, 25};
    std::vector<float> values(40 * 30, -1);
    std::vector<Plane> planes(3);
    planes[1] = {reinterpret_cast<std::byte*>(&values[3 * 40 + 7]), std::ptrdiff_t{4 * 40},
                 SampleType::kFloat, wanted};
    for (int row = 0; row < source->header().groups[0].rows(); ++row) source->read_chunk(0, 0, row, planes);
    for (int y = 0; y < 30; ++y)
        for (int x = 0; x < 40; ++x)
            ASSERT_EQ(values[static_cast<std::size_t>(y * 40 + x)],
                      wanted.contains(x, y) ? in.at("G", x, y) : -1);
}

TEST(ImageIoRead, IntegersAreExactFractions) {
    const Folder folder;
    Pixels in = ramp(256, 1, {"Y"});
    for (int i = 0; i < 256; ++i) in.channels[0][static_cast<std::size_t>(i)] = static_cast<float>(i) / 255;
    write(folder / "a.png", in, spec_for(in, Depth::kUint8));
    EXPECT_EQ(read(folder / "a.png").channels, in.channels);
    for (std::size_t i = 0; i < 256; ++i) in.channels[0][i] = static_cast<float>(i * 257) / 65535;
    write(folder / "b.png", in, spec_for(in, Depth::kUint16));
    EXPECT_EQ(read(folder / "b.png").channels, in.channels);
}

// A file of eight bits whose colour is not multiplied by alpha: multiplied in float, nothing is lost.
TEST(ImageIoRead, MultipliesByAlphaInFloat) {
    const Folder folder;
    Pixels in = ramp(2, 1, {"R", "G", "B", "A"});
    const float a = 3.0F / 255;
    in.channels = {{200.0F / 255 * a, 0.5F}, {7.0F / 255 * a, 0.25F}, {0, 0}, {a, 0}};
    write(folder / "a.png", in, spec_for(in, Depth::kUint8));
    const Pixels out = read(folder / "a.png");
    EXPECT_FLOAT_EQ(out.at("R", 0, 0), 200.0F / 255 * a);
    EXPECT_FLOAT_EQ(out.at("G", 0, 0), 7.0F / 255 * a);
    EXPECT_EQ(out.at("A", 0, 0), a);
    EXPECT_EQ(out.at("R", 1, 0), 0.0F);  // the file holds 0.5, seen through an alpha of 0
}

// Larger than what is kept decoded, so that going back to the top begins again.
TEST(ImageIoRead, ChunksMayBeReadInAnyOrderAndTwice) {
    const Folder folder;
    const Pixels in = ramp(701, 2003, {"Y"});
    for (const char* name : {"a.png", "a.tif", "a.tga"}) {
        write(folder / name, in, spec_for(in, std::string(name) == "a.tga" ? Depth::kUint8 : Depth::kUint16));
        const auto source = open_image(folder / name);
        const int rows = source->header().groups[0].rows();
        ASSERT_GT(rows, 1);
        const Pixels all = read(*source);
        for (int row = rows; row-- > 0;) {
            const std::vector<float> values = first_channel(*source, row);
            const Rect chunk = source->header().groups[0].chunk(0, row);
            const auto begin = all.channels[0].begin() + std::ptrdiff_t{chunk.y0} * 701;
            ASSERT_TRUE(std::equal(values.begin(), values.end(), begin)) << name << ' ' << row;
        }
    }
}

TEST(ImageIoRead, ManyThreadsReadOnePicture) {
    const Folder folder;
    const Pixels in = ramp(900, 3000, {"R", "G"});
    Pixels rgb = in;
    rgb.names = {"R", "G", "B"};
    rgb.channels.push_back(in.channels[0]);
    write(folder / "a.png", rgb, spec_for(rgb, Depth::kUint8));
    const auto source = open_image(folder / "a.png");
    const int rows = source->header().groups[0].rows();
    ASSERT_GT(rows, 4);
    std::vector<std::vector<float>> chunks(static_cast<std::size_t>(rows));
    {
        std::atomic<int> next = 0;
        std::vector<std::jthread> threads;
        for (int t = 0; t < 4; ++t)
            threads.emplace_back([&] {
                for (int row = next++; row < rows; row = next++)
                    chunks[static_cast<std::size_t>(row)] = first_channel(*source, row);
            });
    }
    std::vector<float> joined;
    for (const auto& chunk : chunks) joined.insert(joined.end(), chunk.begin(), chunk.end());
    const std::vector<float> alone = read(folder / "a.png").channels[0];
    ASSERT_EQ(joined.size(), alone.size());
    const auto difference = std::ranges::mismatch(joined, alone).in1;
    EXPECT_EQ(difference, joined.end()) << "at " << difference - joined.begin();
}

}  // namespace
}  // namespace keyline::test
