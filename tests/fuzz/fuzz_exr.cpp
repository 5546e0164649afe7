// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0

// fuzz_exr [ITERATIONS [SEED [KIND]]]: damages OpenEXR files of every kind, or of those whose name holds
// KIND, and reads them.  Each must be read or refused with a Failure that says so; the same arguments do the
// same.  A crash, another exception, or more memory than the limit is a fault; the seed and the damaged file
// are named.

#include "engine/error.h"
#include "engine/io/image_source.h"
#include "tests/fuzz/mutate.h"
#include "tests/io/exr_files.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <exception>
#include <fmt/format.h>
#include <fstream>
#include <map>
#include <span>
#include <stdexcept>
#include <string>
#include <sys/resource.h>

namespace keyline {
namespace {

constexpr int kMostChunks = 40;  // of a group that are read
constexpr rlim_t kMostMemory = rlim_t{1} << 30;

TestPart small_part(const std::string& compression, TestStorage storage) {
    TestPart part;
    part.compression = compression;
    part.storage = storage;
    part.data = {-3, 2, 37, 42};
    part.tile = 16;
    part.channels = {{"A"}, {"Z", SampleType::kFloat}, {"id", SampleType::kUint}};
    return part;
}

Bytes content(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    const auto* bytes = reinterpret_cast<const std::byte*>(text.data());
    return {bytes, bytes + text.size()};
}

std::vector<Victim> make_victims(const TemporaryFolder& folder, const std::string& kind) {
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
        if (name.find(kind) == std::string::npos) continue;
        write_with_openexr(folder / "sound.exr", parts);
        victims.push_back(make_victim(name, content(folder / "sound.exr")));
    }
    return victims;
}

// Some chunks of every group, into memory of the chunk's own size.
void read_some(const std::filesystem::path& file) {
    const auto source = open_image(file);
    for (std::size_t g = 0; g < source->header().groups.size(); ++g) {
        const ChannelGroup& group = source->header().groups[g];
        const int64_t chunks = int64_t{group.columns()} * group.rows();
        for (int64_t i = 0; i < std::min<int64_t>(chunks, kMostChunks); ++i) {
            const auto column = static_cast<int>(i % group.columns()),
                       row = static_cast<int>(i / group.columns());
            std::vector<Pixels> pixels;
            std::vector<Plane> planes;
            for (const ChannelInfo& c : group.channels) {
                Rect rect = group.chunk(column, row);
                rect.x1 = std::min(rect.x1, rect.x0 + 1000);
                planes.push_back(pixels.emplace_back(c.type, rect).plane());
            }
            source->read_chunk(g, column, row, planes);
        }
    }
}

struct Outcomes {
    int read = 0, refused = 0, faults = 0;
    double slowest = 0;
};

void run_one(const std::filesystem::path& file, const std::string& what, Outcomes& outcomes) {
    const auto start = std::chrono::steady_clock::now();
    try {
        read_some(file);
        ++outcomes.read;
    } catch (const Failure& failure) {
        const bool fits = failure.error().kind == ErrorKind::kInput &&
                          failure.error().what.find(file.string()) != std::string::npos;
        ++(fits ? outcomes.refused : outcomes.faults);
        if (!fits) fmt::print("{}: {}\n", what, failure.what());
    } catch (const std::exception& error) {
        ++outcomes.faults;
        fmt::print("{}: {}\n", what, error.what());
    }
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    if (took.count() > outcomes.slowest) {
        outcomes.slowest = took.count();
        if (took.count() > 2) fmt::print("{}: took {:.1f} s\n", what, took.count());
    }
}

int run(int iterations, uint64_t seed, const std::string& kind) {
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
    const rlimit limit{kMostMemory, kMostMemory};
    setrlimit(RLIMIT_AS, &limit);
#endif
    const TemporaryFolder folder;
    const std::vector<Victim> victims = make_victims(folder, kind);
    if (victims.empty()) throw std::invalid_argument("no kind of file is named so");
    const std::filesystem::path file = folder / "damaged.exr";
    Outcomes outcomes;
    for (int i = 0; i < iterations; ++i) {
        Random random(seed * 1000003 + static_cast<uint64_t>(i));
        const Victim& victim = victims[random() % victims.size()];
        const Bytes bytes = damaged(victim, victims[random() % victims.size()], random);
        std::ofstream(file, std::ios::binary)
            .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
        run_one(file, fmt::format("iteration {} of seed {} ({})", i, seed, victim.name), outcomes);
    }
    rusage used = {};
    getrusage(RUSAGE_SELF, &used);
    fmt::print("{} damaged files: {} read, {} refused, {} faults; slowest {:.2f} s, peak memory {} MiB\n",
               iterations, outcomes.read, outcomes.refused, outcomes.faults, outcomes.slowest,
               used.ru_maxrss / 1024);
    return outcomes.faults == 0 ? 0 : 1;
}

}  // namespace
}  // namespace keyline

int main(int count, char** arguments) {
    const std::span<char*> given(arguments, static_cast<std::size_t>(count));
    return keyline::run(given.size() > 1 ? std::stoi(given[1]) : 2000,
                        given.size() > 2 ? std::stoull(given[2]) : 1, given.size() > 3 ? given[3] : "");
}
