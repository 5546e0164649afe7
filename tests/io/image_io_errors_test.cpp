// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "image_io_support.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace keyline::test {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

std::string picture(const std::string& extension) {
    const Folder folder;
    const Pixels in = ramp(64, 64, {"R", "G", "B"});
    const auto file = folder / ("a." + extension);
    write(file, in, spec_for(in));
    return bytes_of(file);
}

// The error of opening and reading all of a file, with nothing on standard error.
Error error_of_reading(const std::filesystem::path& file) {
    testing::internal::CaptureStderr();
    const Error e = error_of([&] { read(file); });
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "") << file;
    EXPECT_EQ(e.what.find('\n'), std::string::npos) << e.what;
    return e;
}

TEST(ImageIoErrors, AFileThatIsNotThere) {
    const Error e = error_of_reading("/nowhere/a.png");
    EXPECT_EQ(e.kind, ErrorKind::kInput);
    EXPECT_EQ(e.what, "/nowhere/a.png: No such file or directory");
    EXPECT_EQ(error_of_reading("/tmp").what, "/tmp: Is a directory");
}

TEST(ImageIoErrors, WhatIsNoImage) {
    const Folder folder;
    put_bytes(folder / "a.png", "hello, I am a text");
    const Error e = error_of_reading(folder / "a.png");
    EXPECT_EQ(e.kind, ErrorKind::kInput);
    EXPECT_EQ(e.what, (folder / "a.png").string() + ": its content is of no known image format");
    EXPECT_THAT(e.hint, StartsWith("known are "));
    EXPECT_THAT(e.hint, HasSubstr(" png "));
    EXPECT_THAT(e.hint, HasSubstr(" exr "));
    put_bytes(folder / "empty.png", "");
    EXPECT_EQ(error_of_reading(folder / "empty.png").what,
              (folder / "empty.png").string() + ": the file is empty");
    put_bytes(folder / "x.null", "x");  // OpenImageIO would make a picture of it
    EXPECT_THAT(error_of_reading(folder / "x.null").what, HasSubstr("no known image format"));
}

TEST(ImageIoErrors, FilesThatEndTooEarly) {
    const Folder folder;
    for (const char* extension : {"png", "jpg", "tif", "tga", "hdr", "bmp", "sgi", "dpx", "ppm", "webp",
                                  "jp2", "iff", "rla", "fits", "zfile"}) {
        const bool single = std::string(extension) == "fits" || std::string(extension) == "zfile";
        if (single) continue;
        const std::string whole = picture(extension);
        const auto file = folder / (std::string("a.") + extension);
        for (const std::size_t part : {6U, 3U}) {
            put_bytes(file, whole.substr(0, whole.size() * part / 10));
            const Error e = error_of_reading(file);
            EXPECT_EQ(e.kind, ErrorKind::kInput) << extension << ": " << e.what;
            EXPECT_THAT(e.what, StartsWith(file.string() + ": ")) << extension;
        }
    }
}

TEST(ImageIoErrors, AFlippedBitInAPng) {
    const Folder folder;
    const std::string whole = picture("png");
    for (const std::size_t at : {std::size_t{10}, std::size_t{19}, std::size_t{30}, whole.size() / 2}) {
        std::string bytes = whole;
        bytes[at] = static_cast<char>(bytes[at] ^ 8);
        put_bytes(folder / "a.png", bytes);
        const Error e = error_of_reading(folder / "a.png");
        EXPECT_EQ(e.kind, ErrorKind::kInput);
        EXPECT_THAT(e.what, HasSubstr(": damaged")) << at;
    }
}

TEST(ImageIoErrors, PartsAndViews) {
    const Folder folder;
    const Pixels in = ramp(2, 2, {"R", "G", "B"});
    write(folder / "a.tif", in, spec_for(in));
    OpenOptions options;
    options.part = "3";
    const Error part = error_of([&] { open_image(folder / "a.tif", options); });
    EXPECT_EQ(part.kind, ErrorKind::kInput);
    EXPECT_EQ(part.what, (folder / "a.tif").string() + ": no part '3'");
    EXPECT_EQ(part.hint, "its parts are '0'");
    options.part = "0";
    EXPECT_EQ(open_image(folder / "a.tif", options)->header().format, "tiff");
    options.view = "left";
    EXPECT_EQ(error_of([&] { open_image(folder / "a.tif", options); }).hint, "it has no views");
}

TEST(ImageIoErrors, AChunkLargerThanAllowed) {
    const Folder folder;
    const Pixels in = ramp(2000, 2, {"R", "G", "B"});
    write(folder / "a.tif", in, spec_for(in));
    OpenOptions options;
    options.max_chunk_bytes = 10000;
    const Error e = error_of([&] { open_image(folder / "a.tif", options); });
    EXPECT_EQ(e.kind, ErrorKind::kInput);
    EXPECT_THAT(e.what, HasSubstr("2000 x 1 pixels of 3 channels, which is more than the 10000 bytes"));
}

// The error of starting an output, which leaves no trace.
Error error_of_writing(const std::string& name, const std::vector<std::string>& channels,
                       Depth depth = Depth::kAuto, const std::string& compression = "zip") {
    const Folder folder;
    const Pixels in = ramp(4, 4, channels);
    Error e = error_of([&] { create_image(folder / name, spec_for(in, depth, compression)); });
    EXPECT_THAT(folder.files(), IsEmpty());
    EXPECT_THAT(e.what, StartsWith((folder / name).string() + ": "));
    e.what.erase(0, (folder / name).string().size() + 2);
    return e;
}

TEST(ImageIoErrors, ChannelsThatTheFormatLacks) {
    const Error z = error_of_writing("a.png", {"R", "G", "B", "A", "Z", "Normal.X"});
    EXPECT_EQ(z.kind, ErrorKind::kGraph);
    EXPECT_EQ(z.what,
              "png can't hold 'Z' and 'Normal.X'; it holds 'one channel of any name', 'Y A', 'R G B' and 'R "
              "G B A'");
    EXPECT_EQ(z.hint,
              "leave channels out with 'channels', or take one: NODE:NAME, also in --output NODE:NAME=FILE");
    EXPECT_EQ(error_of_writing("a.jpg", {"R", "G", "B", "A"}).what,
              "jpeg can't hold 'A'; it holds 'one channel of any name' and 'R G B'");
    EXPECT_EQ(
        error_of_writing("a.png", {"dx", "dy", "magnitude"}).what,
        "png can't hold 'dx', 'dy' and 'magnitude'; it holds 'one channel of any name', 'Y A', 'R G B' and "
        "'R G B A'");
    EXPECT_EQ(error_of_writing("a.hdr", {"Y"}).what, "hdr can't hold 'Y'; it holds 'R G B'");
    EXPECT_EQ(error_of_writing("a.dpx", {"R", "G"}).kind, ErrorKind::kGraph);  // OpenImageIO aborts on it
}

TEST(ImageIoErrors, DepthsThatTheFormatLacks) {
    const Error e = error_of_writing("a.png", {"R", "G", "B"}, Depth::kHalf);
    EXPECT_EQ(e.kind, ErrorKind::kGraph);
    EXPECT_EQ(e.what, "png has no depth 'half'; it has 'uint16' and 'uint8'");
    EXPECT_EQ(error_of_writing("a.jpg", {"R", "G", "B"}, Depth::kUint16).what,
              "jpeg has no depth 'uint16'; it has 'uint8'");
    EXPECT_EQ(error_of_writing("a.hdr", {"R", "G", "B"}, Depth::kUint8).what,
              "hdr has no depth 'uint8'; it has 'float'");
    EXPECT_EQ(error_of_writing("a.tif", {"R", "G", "B"}, Depth::kHalf).what,
              "tiff has no depth 'half'; it has 'float', 'uint16' and 'uint8'");
}

TEST(ImageIoErrors, CompressionsThatTheFormatLacks) {
    const Error e = error_of_writing("a.tif", {"Y"}, Depth::kAuto, "lzv");
    EXPECT_EQ(e.kind, ErrorKind::kGraph);
    EXPECT_EQ(e.what, "tiff has no compression 'lzv'; it has 'zip', 'lzw', 'packbits' and 'none'");
    EXPECT_EQ(e.hint, "did you mean 'lzw'?");
    EXPECT_EQ(error_of_writing("a.jpg", {"Y"}, Depth::kAuto, "jpeg:101").what,
              "jpeg has no compression 'jpeg:101'; it has 'jpeg' ('jpeg:90' with a quality of 1 to 100)");
    EXPECT_EQ(error_of_writing("a.bmp", {"Y"}, Depth::kAuto, "rle").what,
              "bmp has no compression 'rle'; there is no choice");
    EXPECT_EQ(error_of_writing("a.tif", {"Y"}, Depth::kAuto, "piz").hint, "");
}

TEST(ImageIoErrors, ExtensionsThatAreNotWritten) {
    const Error e = error_of_writing("a.xyz", {"Y"});
    EXPECT_EQ(e.kind, ErrorKind::kGraph);
    EXPECT_EQ(e.what, "no format is written as '.xyz'");
    EXPECT_THAT(e.hint, StartsWith("use one of bmp "));
    EXPECT_THAT(e.hint, HasSubstr(" exr "));
    EXPECT_EQ(error_of_writing("a.null", {"Y"}).what, "no format is written as '.null'");
    EXPECT_EQ(error_of_writing("plain", {"Y"}).what, "the name has no extension to tell the format");
}

TEST(ImageIoErrors, AFolderThatCanNotBeMade) {
    const Pixels in = ramp(2, 2, {"Y"});
    const Error e = error_of([&] { create_image("/proc/none/a.png", spec_for(in)); });
    EXPECT_EQ(e.kind, ErrorKind::kOutput);
    EXPECT_THAT(e.what, StartsWith("/proc/none/a.png: can't be written: "));
}

}  // namespace
}  // namespace keyline::test
