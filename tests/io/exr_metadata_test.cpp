// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/base/error.h"
#include "tests/io/exr_files.h"

#include <ImfAttribute.h>
#include <ImfBoxAttribute.h>
#include <ImfChannelList.h>
#include <ImfChromaticitiesAttribute.h>
#include <ImfDoubleAttribute.h>
#include <ImfEnvmapAttribute.h>
#include <ImfFloatAttribute.h>
#include <ImfFloatVectorAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfInputFile.h>
#include <ImfIntAttribute.h>
#include <ImfKeyCodeAttribute.h>
#include <ImfMatrixAttribute.h>
#include <ImfOutputFile.h>
#include <ImfPreviewImageAttribute.h>
#include <ImfRationalAttribute.h>
#include <ImfStringAttribute.h>
#include <ImfStringVectorAttribute.h>
#include <ImfTimeCodeAttribute.h>
#include <ImfVecAttribute.h>
#include <array>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

// A type of somebody's own.
struct StudioType {
    std::array<char, 5> bytes;
};

namespace OPENEXR_IMF_INTERNAL_NAMESPACE {
template <>
const char* TypedAttribute<StudioType>::staticTypeName() {
    return "studioType";
}
template <>
void TypedAttribute<StudioType>::writeValueTo(OStream& out, int) const {
    out.write(_value.bytes.data(), static_cast<int>(_value.bytes.size()));
}
template <>
void TypedAttribute<StudioType>::readValueFrom(IStream& in, int size, int) {
    in.read(_value.bytes.data(), size);
}
}  // namespace OPENEXR_IMF_INTERNAL_NAMESPACE

namespace keyline {
namespace {

using Floats = std::vector<float>;
using Ints = std::vector<int32_t>;
using Doubles = std::vector<double>;

// Of every type that OpenEXR defines, and of one that it does not.
void add_attributes(Imf::Header& h) {
    h.insert("a_int", Imf::IntAttribute(-7));
    h.insert("a_float", Imf::FloatAttribute(0.1F));
    h.insert("a_double", Imf::DoubleAttribute(0.1));
    h.insert("a_string", Imf::StringAttribute(std::string("ü\0\n", 4)));
    h.insert("a_strings", Imf::StringVectorAttribute({"one", "", "three"}));
    h.insert("a_floats", Imf::FloatVectorAttribute({1, 2, -3}));
    h.insert("a_v2i", Imf::V2iAttribute({1, -2}));
    h.insert("a_v2f", Imf::V2fAttribute({1, 2.5F}));
    h.insert("a_v2d", Imf::V2dAttribute({1, 0.1}));
    h.insert("a_v3i", Imf::V3iAttribute({1, 2, 3}));
    h.insert("a_v3f", Imf::V3fAttribute({1, 2, 3}));
    h.insert("a_v3d", Imf::V3dAttribute({1, 2, 3}));
    h.insert("a_box2i", Imf::Box2iAttribute({{1, 2}, {3, 4}}));
    h.insert("a_box2f", Imf::Box2fAttribute({{1, 2}, {3, 4}}));
    h.insert("a_m33f", Imf::M33fAttribute({1, 2, 3, 4, 5, 6, 7, 8, 9}));
    h.insert("a_m33d", Imf::M33dAttribute({1, 2, 3, 4, 5, 6, 7, 8, 9}));
    h.insert("a_m44f", Imf::M44fAttribute({1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16}));
    h.insert("a_m44d", Imf::M44dAttribute({1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16}));
    h.insert("a_rational", Imf::RationalAttribute({24000, 1001}));
    h.insert("a_timecode", Imf::TimeCodeAttribute({1, 2, 3, 4}));
    h.insert("a_keycode", Imf::KeyCodeAttribute({1, 2, 3, 4, 5, 6, 20}));
    h.insert("a_envmap", Imf::EnvmapAttribute(Imf::ENVMAP_CUBE));
    h.insert("chromaticities", Imf::ChromaticitiesAttribute(Imf::Chromaticities()));
    h.insert("a_name_that_is_longer_than_31_bytes", Imf::IntAttribute(3));
    h.insert("a_preview", Imf::PreviewImageAttribute(Imf::PreviewImage(2, 2)));
    h.insert("a_custom", Imf::TypedAttribute<StudioType>(StudioType{{1, 0, 2, -1, 5}}));
    h.pixelAspectRatio() = 2;
    h.screenWindowCenter() = {0.25F, -1};
    h.screenWindowWidth() = 3;
}

void write_with_attributes(const std::filesystem::path& file) {
    Imf::Header header(4, 4);
    add_attributes(header);
    header.channels().insert("R", Imf::Channel(Imf::HALF));
    header.setPreviewImage(Imf::PreviewImage(1, 1));
    Imf::OutputFile out(file.c_str(), header);
    std::array<char, 32> zeros = {};
    Imf::FrameBuffer buffer;
    buffer.insert("R", Imf::Slice(Imf::HALF, zeros.data(), 2, 8));
    out.setFrameBuffer(buffer);
    out.writePixels(4);
}

// What the library makes of an attribute, as the bytes that it would write.
std::map<std::string, std::string> attributes_by_library(const std::filesystem::path& file) {
    class Text final : public Imf::OStream {
    public:
        Text() : OStream("") {}
        void write(const char* bytes, int n) override { text.append(bytes, static_cast<std::size_t>(n)); }
        uint64_t tellp() override { return text.size(); }
        void seekp(uint64_t) override {}
        std::string text;
    };
    const Imf::InputFile in(file.c_str());
    std::map<std::string, std::string> attributes;
    for (auto a = in.header().begin(); a != in.header().end(); ++a) {
        Text text;
        a.attribute().writeValueTo(text, 2);
        attributes[a.name()] = std::string(a.attribute().typeName()) + ":" + text.text;
    }
    return attributes;
}

TEST(Metadata, HoldsTheValuesOfEveryType) {
    const TemporaryFolder folder;
    write_with_attributes(folder / "a.exr");
    const auto source = open_image(folder / "a.exr");
    const Metadata& metadata = source->header().metadata;
    const auto expect = [&](const char* name, const char* type, const Attribute::Value& value) {
        const Attribute* attribute = metadata.find(name);
        ASSERT_NE(attribute, nullptr) << name;
        EXPECT_EQ(attribute->type, type) << name;
        EXPECT_EQ(attribute->value, value) << name;
    };
    expect("a_int", "int", Ints{-7});
    expect("a_double", "double", Doubles{0.1});
    expect("a_string", "string", std::string("ü\0\n", 4));
    expect("a_strings", "stringvector", std::vector<std::string>{"one", "", "three"});
    expect("a_floats", "floatvector", Floats{1, 2, -3});
    expect("a_v2f", "v2f", Floats{1, 2.5F});
    expect("a_v2d", "v2d", Doubles{1, 0.1});
    expect("a_box2i", "box2i", Ints{1, 2, 3, 4});
    expect("a_rational", "rational", Ints{24000, 1001});
    expect("a_m33f", "m33f", Floats{1, 2, 3, 4, 5, 6, 7, 8, 9});
    expect("a_keycode", "keycode", Ints{1, 2, 3, 4, 5, 6, 20});
    expect("a_envmap", "envmap", std::vector<std::byte>{std::byte{1}});
    expect("a_custom", "studioType",
           std::vector<std::byte>{std::byte{1}, std::byte{0}, std::byte{2}, std::byte{255}, std::byte{5}});
    expect("pixelAspectRatio", "float", Floats{2});
    expect("screenWindowCenter", "v2f", Floats{0.25F, -1});
    expect("screenWindowWidth", "float", Floats{3});
    for (const char* name :
         {"channels", "compression", "dataWindow", "displayWindow", "lineOrder", "preview", "type"})
        EXPECT_EQ(metadata.find(name), nullptr) << name;
}

TEST(Metadata, IsWrittenBackAsTheLibraryReadsIt) {
    const TemporaryFolder folder;
    write_with_attributes(folder / "a.exr");
    const auto source = open_image(folder / "a.exr");
    SinkSpec spec;
    spec.display_window = spec.data_window = {0, 0, 4, 4};
    spec.metadata = source->header().metadata;
    write_with_keyline(folder / "b.exr", read_with_keyline(folder / "a.exr"), spec);
    EXPECT_EQ(open_image(folder / "b.exr")->header().metadata.attributes().size(),
              spec.metadata.attributes().size());
    auto before = attributes_by_library(folder / "a.exr"), after = attributes_by_library(folder / "b.exr");
    for (const char* name : {"preview", "type"}) before.erase(name), after.erase(name);
    EXPECT_EQ(after, before);
}

TEST(Metadata, OfSeveralPartsIsUnited) {
    const TemporaryFolder folder;
    TestPart a, b;
    a.name = "rgba";
    b.name = "crypto";
    write_with_openexr(folder / "a.exr", {a, b});
    const auto source = open_image(folder / "a.exr");
    EXPECT_EQ(source->header().metadata.attributes().size(), 3U);  // aspect, center, width: those of both
}

TEST(Metadata, StorageAttributesAreNotTakenFromTheMetadata) {
    const TemporaryFolder folder;
    SinkSpec spec;
    spec.display_window = spec.data_window = {0, 0, 4, 4};
    spec.metadata.set({"compression", "compression", std::vector<std::byte>{std::byte{99}}});
    spec.metadata.set({"chunkCount", "int", Ints{77}});
    spec.metadata.set({"pixelAspectRatio", "string", std::string("not a float")});
    write_with_keyline(folder / "a.exr", {{"R", Pixels(SampleType::kHalf, spec.data_window)}}, spec);
    EXPECT_EQ(read_with_openexr(folder / "a.exr").size(), 1U);
    EXPECT_EQ(open_image(folder / "a.exr")->header().metadata.find("pixelAspectRatio")->value,
              Attribute::Value(Floats{1}));
}

TEST(Metadata, ValuesThatTheirTypeCannotHaveAreRefused) {
    const TemporaryFolder folder;
    SinkSpec spec;
    spec.display_window = spec.data_window = {0, 0, 4, 4};
    spec.channels = {{"R"}};
    for (const Attribute& bad :
         {Attribute{"a", "v2f", Floats{1, 2, 3}}, Attribute{"a", "string", Ints{1}},
          Attribute{"a", "m44f", std::vector<std::byte>(64)}, Attribute{"", "int", Ints{1}},
          Attribute{"a", std::string(300, 't'), Ints{1}}}) {
        Metadata metadata;
        metadata.set(bad);
        spec.metadata = metadata;
        EXPECT_THROW(create_image(folder / "a.exr", spec), Failure) << bad.type;
    }
    EXPECT_TRUE(folder.entries().empty());
}

// One attribute more than any sane header: refused at once, not after Core has sorted them all.
TEST(Metadata, ManyAttributesAreRefusedQuickly) {
    const TemporaryFolder folder;
    std::ofstream out(folder / "a.exr", std::ios::binary);
    out.write("\x76\x2f\x31\x01\x02\0\0\0", 8);
    for (int i = 0; i < 300000; ++i) {
        const std::string name = std::to_string(i);
        out.write((name + '\0').c_str(), static_cast<std::streamsize>(name.size() + 1));
        out.write("int\0\x04\0\0\0\0\0\0\0", 12);
    }
    out.put('\0');
    out.close();
    EXPECT_THROW(open_image(folder / "a.exr"), Failure);
}

}  // namespace
}  // namespace keyline
