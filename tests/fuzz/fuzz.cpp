// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/fuzz.h"

#include "engine/base/sanitized.h"

#include <chrono>
#include <cstdio>
#include <exception>
#include <fmt/format.h>
#include <fstream>
#include <iterator>
#include <span>
#include <sys/resource.h>

namespace keyline {

namespace {

constexpr rlim_t kMostMemory = rlim_t{1} << 30;

struct Outcomes {
    int done = 0, refused = 0, faults = 0;
    double slowest = 0;
};

void run_one(const Fuzz& fuzz, const std::filesystem::path& file, const std::string& what,
             Outcomes& outcomes) {
    const auto start = std::chrono::steady_clock::now();
    try {
        fuzz.attempt(file);
        ++outcomes.done;
    } catch (const Failure& failure) {
        const bool fair = fuzz.is_fair(failure.error());
        ++(fair ? outcomes.refused : outcomes.faults);
        if (!fair) fmt::print("{}: {}\n", what, failure.what());
    } catch (const std::exception& error) {
        ++outcomes.faults;
        fmt::print("{}: {}\n", what, error.what());
    }
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    if (took.count() <= outcomes.slowest) return;
    outcomes.slowest = took.count();
    if (took.count() > 2) fmt::print("{}: took {:.1f} s\n", what, took.count());
}

// The damaged file number `i` of a seed.
std::string put_damaged(const Fuzz& fuzz, uint64_t seed, int i, std::filesystem::path& file) {
    Random random(seed * 1000003 + static_cast<uint64_t>(i));
    const Victim& victim = fuzz.victims[random() % fuzz.victims.size()];
    const Bytes bytes = fuzz.damage(victim, fuzz.victims[random() % fuzz.victims.size()], random);
    const std::string extension =
        fuzz.extension.empty() ? victim.name.substr(0, victim.name.find('-')) : fuzz.extension;
    file = fuzz.folder / ("damaged." + extension);
    std::ofstream(file, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    return fmt::format("iteration {} of seed {} ({})", i, seed, victim.name);
}

}  // namespace

int run_fuzz(Fuzz fuzz, int count, char** arguments) {
    const std::span<char*> given(arguments, static_cast<std::size_t>(count));
    const int iterations = given.size() > 1 ? std::stoi(given[1]) : 2000;
    const uint64_t seed = given.size() > 2 ? std::stoull(given[2]) : 1;
    const std::string kind = given.size() > 3 ? given[3] : "";
    std::erase_if(fuzz.victims, [&](const Victim& v) { return v.name.find(kind) == std::string::npos; });
    if (fuzz.victims.empty()) return fmt::print("no kind is named so\n"), 1;
    const rlimit limit{kMostMemory, kMostMemory};
    if (!kIsSanitized) setrlimit(RLIMIT_AS, &limit);
    Outcomes outcomes;
    for (int i = 0; i < iterations; ++i) {
        std::filesystem::path file;
        const std::string what = put_damaged(fuzz, seed, i, file);
        run_one(fuzz, file, what, outcomes);
    }
    rusage used = {};
    getrusage(RUSAGE_SELF, &used);
    fmt::print("{} damaged {}: {} sound, {} refused, {} faults; slowest {:.2f} s, peak memory {} MiB\n",
               iterations, fuzz.what, outcomes.done, outcomes.refused, outcomes.faults, outcomes.slowest,
               used.ru_maxrss / 1024);
    return outcomes.faults == 0 ? 0 : 1;
}

Bytes content(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    const auto* bytes = reinterpret_cast<const std::byte*>(text.data());
    return {bytes, bytes + text.size()};
}

}  // namespace keyline
