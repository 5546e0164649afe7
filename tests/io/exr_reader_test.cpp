// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/base/error.h"
#include "engine/io/exr/layout.h"
#include "tests/io/exr_files.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfPartType.h>
#include <ImfRgbaFile.h>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstring>
#include <fmt/format.h>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
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

constexpr auto kCompressionNames = {"none",  "rle", "zips", "zip",  "piz",
                                    "pxr24", "b44", "b44a", "dwaa", "dwab"};

class EveryKind : public testing::TestWithParam<std::tuple<const char*, const char*, TestStorage>> {};

// The library's own decoding is the reference, for what is lossy as well.
TEST_P(EveryKind, DecodesAsTheLibraryDoes) {
    const TemporaryFolder folder;
    TestPart part;
    part.compression = std::get<0>(GetParam());
    part.channels = channels_of(std::get<1>(GetParam()));
    part.storage = std::get<2>(GetParam());
    part.data = {-13, 7, 100, 300};
    part.display = {0, 0, 200, 310};
    write_with_openexr(folder / "a.exr", {part});
    EXPECT_EQ(read_with_keyline(folder / "a.exr"), read_with_openexr(folder / "a.exr"));
}

std::string kind_name(const testing::TestParamInfo<EveryKind::ParamType>& kind) {
    static constexpr std::array kStorages = {"Scanline", "Tiled", "Mipmap", "Ripmap"};
    return fmt::format("{}_{}_{}", std::get<0>(kind.param), std::get<1>(kind.param),
                       kStorages.at(static_cast<std::size_t>(std::get<2>(kind.param))));
}

INSTANTIATE_TEST_SUITE_P(
    Exr, EveryKind,
    Combine(testing::ValuesIn(kCompressionNames), Values("half", "float", "uint", "mixed"),
            Values(TestStorage::kScanline, TestStorage::kTiled, TestStorage::kMipmap, TestStorage::kRipmap)),
    kind_name);

std::string failure_of(const std::filesystem::path& file, const OpenOptions& options = {}) {
    try {
        read_with_keyline(file, options);
    } catch (const Failure& failure) {
        EXPECT_EQ(failure.error().kind, ErrorKind::kInput) << failure.what();
        return failure.what();
    }
    ADD_FAILURE() << "nothing failed";
    return "";
}

std::vector<std::string> names_in(const std::filesystem::path& file, const OpenOptions& options = {}) {
    std::vector<std::string> names;
    const auto source = open_image(file, options);
    for (const ChannelGroup& group : source->header().groups)
        for (const ChannelInfo& channel : group.channels) names.push_back(channel.name);
    return names;
}

OpenOptions with_part(const std::string& part) {
    OpenOptions options;
    options.part = part;
    return options;
}

OpenOptions with_view(const std::string& view) {
    OpenOptions options;
    options.view = view;
    return options;
}

class LineOrder : public testing::TestWithParam<std::tuple<Imf::LineOrder, TestStorage, const char*>> {};

TEST_P(LineOrder, DoesNotMatter) {
    const TemporaryFolder folder;
    TestPart part;
    std::tie(part.line_order, part.storage, part.compression) = GetParam();
    write_with_openexr(folder / "a.exr", {part});
    EXPECT_EQ(read_with_keyline(folder / "a.exr"), read_with_openexr(folder / "a.exr"));
}

INSTANTIATE_TEST_SUITE_P(Exr, LineOrder,
                         Combine(Values(Imf::INCREASING_Y, Imf::DECREASING_Y), Values(TestStorage::kScanline),
                                 Values("none", "zips", "zip", "piz", "dwaa")));
INSTANTIATE_TEST_SUITE_P(ExrTiled, LineOrder,
                         Combine(Values(Imf::INCREASING_Y, Imf::DECREASING_Y, Imf::RANDOM_Y),
                                 Values(TestStorage::kTiled, TestStorage::kMipmap),
                                 Values("none", "zip", "dwab")));

class Windows : public testing::TestWithParam<Rect> {};

TEST_P(Windows, OfAnySizeAndPlaceAreRead) {
    const TemporaryFolder folder;
    for (const char* compression : {"none", "zips", "zip", "piz", "pxr24", "b44", "dwaa"})
        for (const TestStorage storage : {TestStorage::kScanline, TestStorage::kTiled}) {
            TestPart part;
            part.compression = compression;
            part.storage = storage;
            part.data = GetParam();
            write_with_openexr(folder / "a.exr", {part});
            EXPECT_EQ(read_with_keyline(folder / "a.exr"), read_with_openexr(folder / "a.exr"))
                << compression;
        }
}

INSTANTIATE_TEST_SUITE_P(Exr, Windows,
                         Values(Rect{0, 0, 1, 1}, Rect{-1, -1, 0, 0}, Rect{-100, 50, -99, 90},
                                Rect{3, -200, 130, -199},
                                Rect{500000000, -500000000, 500000033, -499999960}));

TEST(ExrReader, StoresOnlyWhatIsWantedOfWhatIsWanted) {
    const TemporaryFolder folder;
    for (const char* compression : {"none", "zip", "piz", "dwaa"})
        for (const TestStorage storage : {TestStorage::kScanline, TestStorage::kTiled}) {
            TestPart part;
            part.compression = compression;
            part.storage = storage;
            part.channels = {{"A"}, {"B", SampleType::kFloat}, {"C"}};
            write_with_openexr(folder / "a.exr", {part});
            const Pixels whole = read_with_openexr(folder / "a.exr").at("B");
            const auto source = open_image(folder / "a.exr");
            const ChannelGroup& group = source->header().groups[0];
            const Rect wanted{11, 9, 37, 41};
            Pixels pixels(SampleType::kFloat, wanted);
            const std::vector<Plane> planes = {{}, pixels.plane(), {}};
            for (int row = 0; row < group.rows(); ++row)
                for (int column = 0; column < group.columns(); ++column)
                    source->read_chunk(0, column, row, planes);
            for (int y = wanted.y0; y < wanted.y1; ++y)
                for (int x = wanted.x0; x < wanted.x1; ++x)
                    ASSERT_EQ(std::bit_cast<uint64_t>(pixels.at(x, y)),
                              std::bit_cast<uint64_t>(whole.at(x, y)))
                        << compression << " " << x << " " << y;
        }
}

TEST(ExrReader, ManyThreadsReadTheSame) {
    const TemporaryFolder folder;
    for (const char* compression : {"zips", "piz", "dwaa"}) {
        TestPart part;
        part.compression = compression;
        part.data = {0, 0, 100, 400};
        write_with_openexr(folder / "a.exr", {part});
        const Image expected = read_with_openexr(folder / "a.exr");
        const auto source = open_image(folder / "a.exr");
        const ChannelGroup& group = source->header().groups[0];
        Image image;
        std::vector<Plane> planes;
        for (const ChannelInfo& c : group.channels)
            planes.push_back(image.emplace(c.name, Pixels(c.type, group.window)).first->second.plane());
        std::atomic<int> next = 0;
        {
            std::vector<std::jthread> threads;
            for (int t = 0; t < 4; ++t)
                threads.emplace_back([&] {
                    for (int row = next++; row < group.rows(); row = next++)
                        source->read_chunk(0, 0, row, planes);
                });
        }
        EXPECT_EQ(image, expected) << compression;
    }
}

TEST(ExrReader, NamesTheChannelsOfPartsByPart) {
    const TemporaryFolder folder;
    TestPart rgba, normal, mixed;
    rgba.name = "rgba";
    normal.name = "normal";
    normal.channels = {{"X"}, {"Y"}};
    mixed.name = "misc";
    mixed.channels = {{"Z"}, {"own.R"}};
    write_with_openexr(folder / "a.exr", {normal, rgba, mixed});
    const std::vector<std::string> all = {"normal.X", "normal.Y", "A", "B", "G", "R", "misc.Z", "own.R"};
    EXPECT_EQ(names_in(folder / "a.exr"), all);
    EXPECT_EQ(names_in(folder / "a.exr", with_part("misc")), (std::vector<std::string>{"misc.Z", "own.R"}));
    EXPECT_EQ(names_in(folder / "a.exr", with_part("1")), (std::vector<std::string>{"A", "B", "G", "R"}));
    EXPECT_THAT(failure_of(folder / "a.exr", with_part("beauty")),
                HasSubstr("no part 'beauty'; its parts are 'normal', 'rgba' and 'misc'"));
    EXPECT_THAT(failure_of(folder / "a.exr", with_part("3")), HasSubstr("no part '3'"));
}

TEST(ExrReader, OnlyTheFirstMainPartKeepsBareNames) {
    const TemporaryFolder folder;
    TestPart beauty, main;
    beauty.name = "beauty";
    main.name = "main";
    main.channels = beauty.channels = {{"R"}};
    write_with_openexr(folder / "a.exr", {beauty, main});
    EXPECT_EQ(names_in(folder / "a.exr"), (std::vector<std::string>{"R", "main.R"}));
}

// Arnold, V-Ray, Karma and Nuke each call it otherwise.
TEST(ExrReader, TheFirstPartWithColourIsTheMainOneWhateverItsName) {
    const TemporaryFolder folder;
    for (const std::string name : {"RGBA", "RGB_color", "C", "rgba_main", "anything"})
        for (const bool words : {false, true}) {
            TestPart depth, colour, other;
            depth.name = "Z";
            depth.channels = {{"Z"}};
            colour.name = name;
            if (words) colour.channels = {{"red"}, {"green"}, {"blue"}, {"alpha"}};
            other.name = "diffuse";
            write_with_openexr(folder / "a.exr", {depth, colour, other});
            const std::vector<std::string> names = names_in(folder / "a.exr");
            for (const TestChannel& c : colour.channels)
                EXPECT_THAT(names, testing::Contains(c.name)) << name;
            EXPECT_THAT(names, testing::Contains("diffuse.R"));
            EXPECT_THAT(names, testing::Contains("Z.Z"));
        }
}

TEST(ExrReader, AnAlphaInAPartOfItsOwnIsTheMainOnes) {
    const TemporaryFolder folder;
    TestPart rgb, alpha, mask;
    rgb.name = "rgb";
    rgb.channels = {{"R"}, {"G"}, {"B"}};
    alpha.name = "RGBA";
    mask.name = "mask";
    alpha.channels = mask.channels = {{"A"}};
    write_with_openexr(folder / "a.exr", {mask, rgb, alpha});
    EXPECT_EQ(names_in(folder / "a.exr"), (std::vector<std::string>{"mask.A", "B", "G", "R", "A"}));
}

TEST(ExrReader, PartsHaveTheirOwnWindows) {
    const TemporaryFolder folder;
    TestPart a, b;
    a.name = "rgba";
    a.data = {0, 0, 40, 30};
    b.name = "b";
    b.data = {-20, 10, 10, 60};
    b.storage = TestStorage::kTiled;
    write_with_openexr(folder / "a.exr", {a, b});
    const auto source = open_image(folder / "a.exr");
    EXPECT_EQ(source->header().data_window, (Rect{-20, 0, 40, 60}));
    EXPECT_EQ(source->header().groups[1].window, b.data);
    const Image image = read_with_keyline(folder / "a.exr");
    EXPECT_EQ(image.at("R"), read_with_openexr(folder / "a.exr", 0).at("R"));
    EXPECT_EQ(image.at("b.G"), read_with_openexr(folder / "a.exr", 1).at("G"));
}

TEST(ExrReader, TakesOneViewOfParts) {
    const TemporaryFolder folder;
    std::vector<TestPart> parts;
    for (const std::string view : {"left", "right"})
        for (const std::string name : {"rgba", "depth"}) {
            TestPart& part = parts.emplace_back();
            part.name = name + (view == "left" ? "_" : ".") + view;
            part.view = view;
            part.channels = {{name == "rgba" ? "R" : "Z"}};
        }
    parts.emplace_back().name = "shared";
    parts.back().channels = {{"id", SampleType::kUint}};
    write_with_openexr(folder / "a.exr", parts);
    const std::vector<std::string> names = {"R", "depth.Z", "shared.id"};
    EXPECT_EQ(names_in(folder / "a.exr"), names);
    EXPECT_EQ(names_in(folder / "a.exr", with_view("right")), names);
    EXPECT_EQ(names_in(folder / "a.exr", with_part("depth.right")), (std::vector<std::string>{"depth.Z"}));
    EXPECT_EQ(read_with_keyline(folder / "a.exr", with_view("right")).at("R"),
              read_with_openexr(folder / "a.exr", 2).at("R"));
    EXPECT_THAT(failure_of(folder / "a.exr", with_view("middle")),
                HasSubstr("no view 'middle'; its views are 'left' and 'right'"));
    OpenOptions both = with_part("depth_left");
    both.view = "right";
    EXPECT_THAT(failure_of(folder / "a.exr", both), HasSubstr("is of view 'left', not 'right'"));
}

TEST(ExrReader, TakesOneViewOfChannels) {
    const TemporaryFolder folder;
    TestPart part;
    part.multi_view = {"left", "right"};
    part.channels = {{"R"}, {"right.R"}, {"spec.left.R"}, {"spec.right.R"}, {"mask.A"}};
    write_with_openexr(folder / "a.exr", {part});
    EXPECT_EQ(names_in(folder / "a.exr"), (std::vector<std::string>{"R", "mask.A", "spec.R"}));
    EXPECT_EQ(names_in(folder / "a.exr", with_view("right")),
              (std::vector<std::string>{"mask.A", "R", "spec.R"}));
    const Image expected = read_with_openexr(folder / "a.exr");
    const Image image = read_with_keyline(folder / "a.exr", with_view("right"));
    EXPECT_EQ(image.at("R"), expected.at("right.R"));
    EXPECT_EQ(image.at("spec.R"), expected.at("spec.right.R"));
}

// Nuke puts the view first: R depth.Z, right.R right.depth.Z.
TEST(ExrReader, ALayerThatAViewHasForItselfIsNotTheOthers) {
    const TemporaryFolder folder;
    TestPart part;
    part.multi_view = {"left", "right"};
    part.channels = {{"R"}, {"depth.Z"}, {"mask.A"}, {"right.R"}, {"right.depth.Z"}};
    write_with_openexr(folder / "a.exr", {part});
    EXPECT_EQ(names_in(folder / "a.exr"), (std::vector<std::string>{"R", "depth.Z", "mask.A"}));
    EXPECT_EQ(names_in(folder / "a.exr", with_view("right")),
              (std::vector<std::string>{"mask.A", "R", "depth.Z"}));
    const Image expected = read_with_openexr(folder / "a.exr");
    EXPECT_EQ(read_with_keyline(folder / "a.exr").at("depth.Z"), expected.at("depth.Z"));
    EXPECT_EQ(read_with_keyline(folder / "a.exr", with_view("right")).at("depth.Z"),
              expected.at("right.depth.Z"));
}

TEST(ExrReader, RefusesTwoChannelsOfOneName) {
    const TemporaryFolder folder;
    TestPart a, b;
    a.name = "a";
    b.name = "b";
    a.channels = b.channels = {{"x.R"}};
    write_with_openexr(folder / "a.exr", {a, b});
    EXPECT_THAT(failure_of(folder / "a.exr"), HasSubstr("channel 'x.R' is in part 'a' and in part 'b'"));
    EXPECT_EQ(names_in(folder / "a.exr", with_part("b")), (std::vector<std::string>{"x.R"}));
}

void write_deep_beside_flat(const std::filesystem::path& file) {
    std::vector<Imf::Header> headers(2, Imf::Header(4, 4));
    headers[0].setName("flat");
    headers[0].setType(Imf::SCANLINEIMAGE);
    headers[0].channels().insert("R", Imf::Channel(Imf::HALF));
    headers[1].setName("deep");
    headers[1].setType(Imf::DEEPSCANLINE);
    headers[1].setVersion(1);
    headers[1].compression() = Imf::ZIPS_COMPRESSION;
    headers[1].channels().insert("R", Imf::Channel(Imf::HALF));
    Imf::MultiPartOutputFile out(file.c_str(), headers.data(), 2);
    std::vector<char> zeros(64);
    Imf::FrameBuffer buffer;
    buffer.insert("R", Imf::Slice(Imf::HALF, zeros.data(), 2, 8));
    Imf::OutputPart flat(out, 0);
    flat.setFrameBuffer(buffer);
    flat.writePixels(4);
}

TEST(ExrReader, RefusesDeepPartsUnlessAFlatOneIsTaken) {
    const TemporaryFolder folder;
    write_deep_beside_flat(folder / "a.exr");
    EXPECT_THAT(failure_of(folder / "a.exr"), HasSubstr("part 'deep' is deep"));
    EXPECT_EQ(names_in(folder / "a.exr", with_part("flat")), (std::vector<std::string>{"flat.R"}));
}

class Chroma : public testing::TestWithParam<std::tuple<Imf::Compression, Imf::RgbaChannels>> {};

// RGB as the library's RGBA interface gives it, whatever rows are read at once.
TEST_P(Chroma, BecomesRgb) {
    const TemporaryFolder folder;
    const std::string file = (folder / "a.exr").string();
    const auto [compression, channels] = GetParam();
    const Rect window{-10, 4, 90, 404};
    const auto width = static_cast<std::size_t>(window.width());
    std::vector<Imf::Rgba> pixels(width * static_cast<std::size_t>(window.height()));
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        const auto x = static_cast<float>(i % width), y = static_cast<float>(i / width);
        pixels[i] = {half(x / 50), half(std::sin(y / 3) + 1), half(std::fmod(x * y, 7.0F)), half(y / 400)};
    }
    const Imath::Box2i box({window.x0, window.y0}, {window.x1 - 1, window.y1 - 1});
    const std::ptrdiff_t origin = -window.x0 - window.y0 * window.width();
    {
        Imf::RgbaOutputFile out(file.c_str(), box, box, channels, 1, {0, 0}, 1, Imf::INCREASING_Y,
                                compression);
        out.setFrameBuffer(pixels.data() + origin, 1, width);
        out.writePixels(window.height());
    }
    Imf::RgbaInputFile in(file.c_str());
    in.setFrameBuffer(pixels.data() + origin, 1, width);
    in.readPixels(window.y0, window.y1 - 1);

    const Image image = read_with_keyline(file);
    EXPECT_EQ(image.size(), channels == Imf::WRITE_YCA ? 4U : 3U);
    const std::map<std::string, half Imf::Rgba::*> members = {
        {"R", &Imf::Rgba::r}, {"G", &Imf::Rgba::g}, {"B", &Imf::Rgba::b}, {"A", &Imf::Rgba::a}};
    for (const auto& [name, channel] : image)
        for (std::size_t i = 0; i < pixels.size(); ++i) {
            const half expected = pixels[i].*members.at(name);
            ASSERT_EQ(std::memcmp(channel.bytes.data() + 2 * i, &expected, 2), 0) << name << " " << i;
        }
}

INSTANTIATE_TEST_SUITE_P(Exr, Chroma,
                         Combine(Values(Imf::NO_COMPRESSION, Imf::ZIPS_COMPRESSION, Imf::ZIP_COMPRESSION,
                                        Imf::PIZ_COMPRESSION, Imf::DWAB_COMPRESSION),
                                 Values(Imf::WRITE_YC, Imf::WRITE_YCA)));

TEST(ExrReader, RepeatsSamplesOfSubsampledChannels) {
    const TemporaryFolder folder;
    for (const char* compression : {"none", "zips", "zip", "piz", "dwaa"}) {
        TestPart part;
        part.compression = compression;
        part.data = {-6, 12, 54, 132};
        part.channels = {{"R"},
                         {"half", SampleType::kFloat, 2, 2},
                         {"mixed", SampleType::kHalf, 1, 3},
                         {"wide", SampleType::kUint, 6, 1}};
        write_with_openexr(folder / "a.exr", {part});
        const Image image = read_with_keyline(folder / "a.exr");
        const bool lossless = std::string(compression) != "dwaa";
        for (const TestChannel& c : part.channels) {
            if (!lossless && c.type != SampleType::kUint) continue;
            const Pixels full = test_pixels(c, part.data);
            for (int y = 12; y < 132; ++y)
                for (int x = -6; x < 54; ++x) {
                    const int sx = -6 + (x + 6) / c.x_sampling * c.x_sampling;
                    const int sy = 12 + (y - 12) / c.y_sampling * c.y_sampling;
                    ASSERT_EQ(std::bit_cast<uint64_t>(image.at(c.name).at(x, y)),
                              std::bit_cast<uint64_t>(full.at(sx, sy)))
                        << compression << " " << c.name << " " << x << " " << y;
                }
        }
    }
}

TEST(ExrReader, SaysWhatIsNotThereOrNotAnImage) {
    const TemporaryFolder folder;
    const auto write = [&](const std::string& name, const std::string& text) {
        std::ofstream(folder / name) << text;
    };
    EXPECT_THAT(failure_of(folder / "none.exr"), HasSubstr("none.exr: No such file or directory"));
    EXPECT_THAT(failure_of(folder.path()), HasSubstr("Is a directory"));
    write("empty.exr", "");
    EXPECT_THAT(failure_of(folder / "empty.exr"), HasSubstr("empty.exr: the file is empty"));
    write("text.EXR", "a text");
    EXPECT_THAT(failure_of(folder / "text.EXR"), HasSubstr("text.EXR: not an OpenEXR file"));
    write("magic.exr", "\x76\x2f\x31\x01");
    EXPECT_THAT(failure_of(folder / "magic.exr"),
                HasSubstr("magic.exr: the file is not finished: its header does not end"));
    ASSERT_EQ(mkfifo((folder / "pipe.exr").c_str(), 0600), 0);
    EXPECT_THAT(failure_of(folder / "pipe.exr"), HasSubstr("not a regular file"));
}

TEST(ExrReader, TheContentDecidesNotTheName) {
    const TemporaryFolder folder;
    write_with_openexr(folder / "a.png", {TestPart()});
    EXPECT_EQ(read_with_keyline(folder / "a.png"), read_with_openexr(folder / "a.png"));
}

TEST(ExrReader, NamesTheRowsThatAreMissing) {
    const TemporaryFolder folder;
    TestPart part;
    part.name = "rgba";
    write_with_openexr(folder / "a.exr", {part});
    std::filesystem::resize_file(folder / "a.exr", std::filesystem::file_size(folder / "a.exr") - 100);
    EXPECT_THAT(failure_of(folder / "a.exr"), HasSubstr("a.exr: rows 32 to 44 can't be read: "));
    part.storage = TestStorage::kTiled;
    write_with_openexr(folder / "b.exr", {part});
    std::filesystem::resize_file(folder / "b.exr", std::filesystem::file_size(folder / "b.exr") - 100);
    EXPECT_THAT(failure_of(folder / "b.exr"), HasSubstr("rows 32 to 44, columns 64 to 69, can't be read: "));
}

TEST(ExrReader, RowsThatAreThereCanBeReadOfAFileThatWasNotFinished) {
    const TemporaryFolder folder;
    {
        Imf::Header header(50, 64);
        header.channels().insert("R", Imf::Channel(Imf::HALF));
        Imf::OutputFile out((folder / "a.exr").c_str(), header);
        std::vector<char> zeros(100);
        Imf::FrameBuffer buffer;
        buffer.insert("R", Imf::Slice(Imf::HALF, zeros.data(), 2, 0));
        out.setFrameBuffer(buffer);
        out.writePixels(32);
    }
    const auto source = open_image(folder / "a.exr");
    Pixels pixels(SampleType::kHalf, {0, 0, 50, 64});
    const std::vector<Plane> planes = {pixels.plane()};
    EXPECT_NO_THROW(source->read_chunk(0, 0, 1, planes));
    EXPECT_THROW(source->read_chunk(0, 0, 2, planes), Failure);
}

// Declares far more than so few bytes can unpack to, or than one chunk may.
TEST(ExrReader, RefusesWhatIsOutOfProportion) {
    const TemporaryFolder folder;
    const auto declare = [&](const std::string& name, int width, int height) {
        exr::Layout layout;
        layout.display_window = layout.data_window = {0, 0, width, height};
        layout.compression = exr::Compression::kZip;
        layout.channels = {{"R", SampleType::kFloat}};
        std::vector<std::byte> bytes = layout.header();
        bytes.resize(bytes.size() + static_cast<std::size_t>(layout.chunks()) * 8);
        std::ofstream(folder / name)
            .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    };
    declare("wide.exr", 400000000, 8);
    EXPECT_THAT(failure_of(folder / "wide.exr"), HasSubstr("above the limit of 536870912"));
    declare("big.exr", 1000000, 100);
    EXPECT_THAT(failure_of(folder / "big.exr"), HasSubstr("which a file of"));
    TestPart part;
    write_with_openexr(folder / "a.exr", {part});
    OpenOptions options;
    options.max_chunk_bytes = 70 * 16 * 8 - 1;
    EXPECT_THAT(failure_of(folder / "a.exr", options), HasSubstr("above the limit of 8959"));
    options.max_chunk_bytes += 1;
    EXPECT_NO_THROW(read_with_keyline(folder / "a.exr", options));
}

TEST(ExrReader, ReadsConstantImagesOfEveryCompression) {
    const TemporaryFolder folder;
    for (int compression = 0; compression < 10; ++compression) {
        Imf::Header header(3000, 1000);
        header.compression() = static_cast<Imf::Compression>(compression);
        header.channels().insert("R", Imf::Channel(Imf::FLOAT));
        {
            Imf::OutputFile out((folder / "a.exr").c_str(), header);
            std::vector<char> zeros(12000);
            Imf::FrameBuffer buffer;
            buffer.insert("R", Imf::Slice(Imf::FLOAT, zeros.data(), 4, 0));
            out.setFrameBuffer(buffer);
            out.writePixels(1000);
        }
        EXPECT_EQ(read_with_keyline(folder / "a.exr").at("R"),
                  Pixels(SampleType::kFloat, {0, 0, 3000, 1000}));
    }
}

}  // namespace
}  // namespace keyline
