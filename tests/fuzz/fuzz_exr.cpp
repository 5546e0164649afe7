// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0

// OpenEXR files of every kind, damaged and read.

#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/read_some.h"
#include "tests/io/exr_files.h"

#include <fmt/format.h>
#include <map>

namespace keyline {
namespace {

TestPart small_part(const std::string& compression, TestStorage storage) {
    TestPart part;
    part.compression = compression;
    part.storage = storage;
    part.data = {-3, 2, 37, 42};
    part.tile = 16;
    part.channels = {{"A"}, {"Z", SampleType::kFloat}, {"id", SampleType::kUint}};
    return part;
}

std::vector<Victim> make_victims(const TemporaryFolder& folder) {
    std::map<std::string, std::vector<TestPart>> kinds;
    for (const char* compression :
         {"none", "rle", "zips", "zip", "piz", "pxr24", "b44", "b44a", "dwaa", "dwab"}) {
        for (const TestStorage storage : {TestStorage::kScanline, TestStorage::kTiled, TestStorage::kRipmap})
            kinds[fmt::format("{}-{}", compression, static_cast<int>(storage))] = {
                small_part(compression, storage)};
        TestPart half = small_part(compression, TestStorage::kScanline);
        half.channels = {{"R"}, {"G"}};
        kinds[fmt::format("{}-half", compression)] = {half};
    }
    TestPart chroma = small_part("zip", TestStorage::kScanline);
    chroma.data = {-4, 2, 36, 42};
    chroma.channels = {{"Y"}, {"RY", SampleType::kHalf, 2, 2}, {"BY", SampleType::kHalf, 2, 2}};
    kinds["chroma"] = {chroma};
    chroma.channels = {{"Y"}, {"U", SampleType::kFloat, 4, 2}};
    kinds["subsampled"] = {chroma};
    TestPart first = small_part("zip", TestStorage::kScanline),
             second = small_part("piz", TestStorage::kTiled);
    first.name = "rgba.left";
    first.view = "left";
    second.name = "b";
    kinds["parts"] = {first, second};
    std::vector<Victim> victims;
    for (const auto& [name, parts] : kinds) {
        write_with_openexr(folder / "sound.exr", parts);
        victims.push_back(make_victim(name, content(folder / "sound.exr")));
    }
    return victims;
}

}  // namespace
}  // namespace keyline

int main(int count, char** arguments) {
    const keyline::TemporaryFolder folder;
    return keyline::run_fuzz({.what = "OpenEXR files",
                              .victims = keyline::make_victims(folder),
                              .folder = folder / ".",
                              .attempt = keyline::read_some,
                              .is_fair = keyline::is_of_input,
                              .extension = "exr"},
                             count, arguments);
}
