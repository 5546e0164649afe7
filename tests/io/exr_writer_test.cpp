// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/base/error.h"
#include "tests/io/exr_files.h"

#include <ImfInputFile.h>
#include <atomic>
#include <fmt/format.h>
#include <functional>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <thread>
#include <tuple>

namespace keyline {
namespace {

using testing::Combine;
using testing::HasSubstr;
using testing::Values;

std::vector<TestChannel> channels_of(const std::string& types) {
    if (types == "half") return {{"R"}, {"G"}, {"B"}, {"A"}, {"deep.layer.X"}};
    if (types == "float") return {{"R", SampleType::kFloat}, {"Z", SampleType::kFloat}};
    if (types == "uint") return {{"id", SampleType::kUint}, {"n.id", SampleType::kUint}};
    return {{"A"}, {"Z", SampleType::kFloat}, {"id", SampleType::kUint}, {"R"}, {"u", SampleType::kFloat}};
}

Image test_image(const std::vector<TestChannel>& channels, const Rect& window) {
    Image image;
    for (const TestChannel& channel : channels) image[channel.name] = test_pixels(channel, window);
    return image;
}

SinkSpec spec_for(const Rect& data, const Rect& display, const std::string& compression = "zip") {
    SinkSpec spec;
    spec.data_window = data;
    spec.display_window = display;
    spec.compression = compression;
    return spec;
}

std::string failure_of(const std::function<void()>& action, ErrorKind kind) {
    try {
        action();
    } catch (const Failure& failure) {
        EXPECT_EQ(static_cast<int>(failure.error().kind), static_cast<int>(kind)) << failure.what();
        return failure.what();
    }
    ADD_FAILURE() << "nothing failed";
    return "";
}

class EveryCompression : public testing::TestWithParam<std::tuple<const char*, const char*, Rect>> {};

// What the library reads from our file is what it reads from its own: for lossless compressions the samples
// themselves, for the others what they make of them.
TEST_P(EveryCompression, IsWrittenAsTheLibraryWritesIt) {
    const TemporaryFolder folder;
    const auto [compression, types, data] = GetParam();
    TestPart part;
    part.compression = compression;
    part.channels = channels_of(types);
    part.data = data;
    write_with_openexr(folder / "theirs.exr", {part});
    const Image image = test_image(part.channels, data);
    write_with_keyline(folder / "ours.exr", image, spec_for(data, part.display, compression));
    EXPECT_EQ(read_with_openexr(folder / "ours.exr"), read_with_openexr(folder / "theirs.exr"));
    EXPECT_EQ(folder.entries(), (std::vector<std::string>{"ours.exr", "theirs.exr"}));
}

std::string case_name(const testing::TestParamInfo<EveryCompression::ParamType>& kind) {
    const Rect data = std::get<2>(kind.param);
    return fmt::format("{}_{}_{}x{}", std::get<0>(kind.param), std::get<1>(kind.param), data.width(),
                       data.height());
}

INSTANTIATE_TEST_SUITE_P(
    Exr, EveryCompression,
    Combine(Values("none", "rle", "zips", "zip", "piz", "pxr24", "b44", "b44a", "dwaa", "dwab"),
            Values("half", "float", "uint", "mixed"), Values(Rect{-9, 5, 61, 275}, Rect{3, -4, 4, -3})),
    case_name);

TEST(ExrWriter, KeepsWindowsFarFromTheOrigin) {
    const TemporaryFolder folder;
    const int most = kMaxCoordinate;
    for (const Rect& data : {Rect{most - 40, most - 20, most, most},
                             Rect{-most, -most, -most + 7, -most + 33}, Rect{-5, -5, 6, 6}}) {
        const Rect display{-10, 20, 30, 50};
        const Image image = test_image(channels_of("mixed"), data);
        write_with_keyline(folder / "a.exr", image, spec_for(data, display));
        EXPECT_EQ(read_with_keyline(folder / "a.exr"), image);
        EXPECT_EQ(open_image(folder / "a.exr")->header().display_window, display);
        EXPECT_EQ(open_image(folder / "a.exr")->header().data_window, data);
    }
}

TEST(ExrWriter, StoresAnEmptyWindowAsOneZeroPixel) {
    const TemporaryFolder folder;
    SinkSpec spec = spec_for({}, {7, -3, 20, 10});
    spec.channels = {{"R"}, {"Z", SampleType::kFloat}};
    const auto sink = create_image(folder / "a.exr", spec);
    EXPECT_EQ(sink->region(), (Rect{7, -3, 8, -2}));
    sink->commit(sink->encode(0, {}));
    sink->finish();
    const Image image = read_with_openexr(folder / "a.exr");
    EXPECT_EQ(image.at("R"), Pixels(SampleType::kHalf, {7, -3, 8, -2}));
    EXPECT_EQ(image.at("Z"), Pixels(SampleType::kFloat, {7, -3, 8, -2}));
}

TEST(ExrWriter, TakesChannelsInAnyOrderAndWithLongNames) {
    const TemporaryFolder folder;
    const std::string name(200, 'n');
    SinkSpec spec = spec_for({0, 0, 20, 20}, {0, 0, 20, 20});
    spec.channels = {{"Z", SampleType::kFloat}, {name}, {"A"}};
    std::vector<Pixels> pixels;
    for (const ChannelInfo& c : spec.channels)
        pixels.push_back(test_pixels({c.name, c.type}, spec.data_window));
    std::vector<Plane> planes;
    for (Pixels& p : pixels) planes.push_back(p.plane());
    const auto sink = create_image(folder / "a.exr", spec);
    EXPECT_EQ(sink->channels(), spec.channels);
    for (int i = 0; i < 2; ++i) sink->commit(sink->encode(i, planes));
    sink->finish();
    EXPECT_EQ(read_with_openexr(folder / "a.exr"),
              (Image{{"Z", pixels[0]}, {name, pixels[1]}, {"A", pixels[2]}}));
}

TEST(ExrWriter, DepthDecidesTheTypes) {
    const TemporaryFolder folder;
    SinkSpec spec = spec_for({0, 0, 4, 4}, {0, 0, 4, 4});
    spec.channels = {{"A"}, {"Z", SampleType::kFloat}, {"id", SampleType::kUint}};
    const auto expect_all = [&](Depth depth, SampleType type) {
        spec.depth = depth;
        const auto sink = create_image(folder / "a.exr", spec);
        for (const ChannelInfo& c : sink->channels()) EXPECT_EQ(c.type, type) << c.name;
    };
    expect_all(Depth::kFloat, SampleType::kFloat);
    expect_all(Depth::kHalf, SampleType::kHalf);
    spec.depth = Depth::kAuto;
    EXPECT_EQ(create_image(folder / "a.exr", spec)->channels(), spec.channels);
}

TEST(ExrWriter, RefusesWhatTheFormatCannotHold) {
    const TemporaryFolder folder;
    SinkSpec spec = spec_for({0, 0, 4, 4}, {0, 0, 4, 4});
    const auto create = [&] { create_image(folder / "a.exr", spec); };
    EXPECT_THAT(failure_of(create, ErrorKind::kGraph), HasSubstr("there are none"));
    spec.channels = {{"R"}, {"R"}};
    EXPECT_THAT(failure_of(create, ErrorKind::kGraph), HasSubstr("'R'"));
    spec.channels = {{"R"}};
    spec.depth = Depth::kUint8;
    EXPECT_THAT(failure_of(create, ErrorKind::kGraph),
                HasSubstr("depth 'uint8'; it can have 'half' and 'float'"));
    spec.depth = Depth::kAuto;
    spec.compression = "zib";
    EXPECT_THAT(failure_of(create, ErrorKind::kGraph), HasSubstr("did you mean 'zip'?"));
    spec.compression = "zip";
    spec.channels = {{std::string(256, 'n')}};
    EXPECT_THAT(failure_of(create, ErrorKind::kGraph), HasSubstr("255 bytes"));
    EXPECT_TRUE(folder.entries().empty());
}

TEST(ExrWriter, DoesNotFinishWithChunksMissingOrOutOfOrder) {
    const TemporaryFolder folder;
    SinkSpec spec = spec_for({0, 0, 4, 40}, {0, 0, 4, 40});
    spec.channels = {{"R"}};
    Pixels pixels(SampleType::kHalf, spec.data_window);
    const std::vector<Plane> planes = {pixels.plane()};
    const auto sink = create_image(folder / "a.exr", spec);
    failure_of([&] { sink->commit(sink->encode(1, planes)); }, ErrorKind::kInternal);
    sink->commit(sink->encode(0, planes));
    EXPECT_THAT(failure_of([&] { sink->finish(); }, ErrorKind::kInternal), HasSubstr("1 chunks of 3"));
    EXPECT_TRUE(folder.entries().empty());
}

TEST(ExrWriter, ManyThreadsEncodeTheSame) {
    const TemporaryFolder folder;
    const Rect window{0, 0, 60, 400};
    Image image = test_image(channels_of("mixed"), window);
    for (const char* compression : {"none", "rle", "zip", "piz", "pxr24", "dwaa"}) {
        SinkSpec spec = spec_for(window, window, compression);
        std::vector<Plane> planes;
        for (auto& [name, pixels] : image) {
            spec.channels.push_back({name, pixels.type});
            planes.push_back(pixels.plane());
        }
        const auto sink = create_image(folder / "a.exr", spec);
        const int chunks = (window.height() + sink->chunk_height() - 1) / sink->chunk_height();
        std::vector<EncodedChunk> parallel(static_cast<std::size_t>(chunks));
        std::atomic<int> next = 0;
        {
            std::vector<std::jthread> threads;
            for (int t = 0; t < 4; ++t)
                threads.emplace_back([&] {
                    for (int i = next++; i < chunks; i = next++)
                        parallel[static_cast<std::size_t>(i)] = sink->encode(i, planes);
                });
        }
        for (int i = 0; i < chunks; ++i)
            ASSERT_EQ(parallel[static_cast<std::size_t>(i)].bytes, sink->encode(i, planes).bytes)
                << compression << " " << i;
    }
}

TEST(ExrWriter, PlanesThatDoNotFitAreAnInternalError) {
    const TemporaryFolder folder;
    SinkSpec spec = spec_for({0, 0, 20, 20}, {0, 0, 20, 20});
    spec.channels = {{"R"}};
    const auto sink = create_image(folder / "a.exr", spec);
    Pixels fits(SampleType::kHalf, {0, 0, 20, 16}), small(SampleType::kHalf, {0, 0, 19, 20}),
        other(SampleType::kFloat, {0, 0, 20, 20});
    const auto encode = [&](int index, std::vector<Plane> planes) { sink->encode(index, planes); };
    EXPECT_NO_THROW(encode(0, {fits.plane()}));
    failure_of([&] { encode(1, {fits.plane()}); }, ErrorKind::kInternal);
    failure_of([&] { encode(0, {small.plane()}); }, ErrorKind::kInternal);
    failure_of([&] { encode(0, {other.plane()}); }, ErrorKind::kInternal);
    failure_of([&] { encode(0, {}); }, ErrorKind::kInternal);
    failure_of([&] { encode(2, {fits.plane()}); }, ErrorKind::kInternal);
}

TEST(IsFinished, LooksAtWindowsAndChannels) {
    const TemporaryFolder folder;
    const Rect data{2, 2, 30, 30}, display{0, 0, 40, 40};
    const Image image = test_image({{"R"}, {"Z", SampleType::kFloat}}, data);
    write_with_keyline(folder / "a.exr", image, spec_for(data, display));
    SinkSpec spec = spec_for(data, display);
    spec.channels = {{"Z", SampleType::kFloat}, {"R"}};
    EXPECT_TRUE(is_finished(folder / "a.exr", spec));
    EXPECT_FALSE(is_finished(folder / "b.exr", spec));
    spec.depth = Depth::kHalf;
    EXPECT_FALSE(is_finished(folder / "a.exr", spec));
    spec.depth = Depth::kAuto;
    spec.data_window.x0 = 1;
    EXPECT_FALSE(is_finished(folder / "a.exr", spec));
    spec.data_window = data;
    spec.channels.pop_back();
    EXPECT_FALSE(is_finished(folder / "a.exr", spec));
}

}  // namespace
}  // namespace keyline
