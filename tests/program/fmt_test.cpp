// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/program/program.h"

#include <gmock/gmock.h>

namespace keyline::test {

namespace {

using testing::HasSubstr;
using testing::IsEmpty;

constexpr const char* kLoose = "{\"keyline\":1,\"nodes\":{}}";
constexpr const char* kLaidOut = "{\n  \"keyline\": 1,\n  \"nodes\": {}\n}\n";

class Fmt : public ProgramTest {};

TEST_F(Fmt, LaysFilesOutInPlace) {
    write("a.json", kLoose);
    write("b.json", kLaidOut);
    const auto before = fs::last_write_time(folder() / "b.json");
    const Outcome run = keyline({"fmt", "a.json", "b.json"});
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_THAT(run.out + run.err, IsEmpty());
    EXPECT_EQ(read(folder() / "a.json"), kLaidOut);
    EXPECT_EQ(fs::last_write_time(folder() / "b.json"), before) << "what is as it should be is not written";
}

TEST_F(Fmt, CheckChangesNothingAndTellsWhatItWould) {
    write("a.json", kLoose);
    write("b.json", kLaidOut);
    const Outcome run = keyline({"fmt", "--check", "a.json", "b.json"});
    EXPECT_EQ(run.status, 1);
    EXPECT_EQ(run.err, "a.json: not in the layout that 'keyline fmt' gives it\n");
    EXPECT_EQ(read(folder() / "a.json"), kLoose);
    EXPECT_EQ(keyline({"fmt", "--check", "b.json"}).status, 0);
}

TEST_F(Fmt, TakesStandardInput) {
    const Outcome run = keyline({"fmt", "-"}, {.in = write("in", kLoose)});
    EXPECT_EQ(run.status, 0);
    EXPECT_EQ(run.out, kLaidOut);
}

TEST_F(Fmt, LeavesWhatIsNotJsonAloneAndGoesOn) {
    write("a.json", "{\"keyline\" 1}");
    write("b.json", kLoose);
    const Outcome run = keyline({"fmt", "a.json", "nowhere.json", "b.json"});
    EXPECT_EQ(run.status, 2);
    EXPECT_THAT(run.err, HasSubstr("a.json:1:12: error: expected ':' after a key"));
    EXPECT_THAT(run.err, HasSubstr("cannot read the graph 'nowhere.json'"));
    EXPECT_EQ(read(folder() / "a.json"), "{\"keyline\" 1}");
    EXPECT_EQ(read(folder() / "b.json"), kLaidOut);
}

TEST_F(Fmt, ChangesNoShippedGraph) {
    std::vector<std::string> arguments{"fmt", "--check"};
    for (const char* below : {".", "groups"})
        for (const auto& entry : fs::directory_iterator(plates().parent_path() / below))
            if (entry.path().extension() == ".json") arguments.push_back(entry.path().string());
    ASSERT_GT(arguments.size(), 15U);
    const Outcome run = keyline(arguments);
    EXPECT_EQ(run.status, 0) << run.err;
}

TEST_F(Fmt, ChangesNoGraphOfTheReadme) {
    const std::string readme = read(fs::path(KEYLINE_DOCS).parent_path() / "README.md");
    const std::size_t begin = readme.find("```json\n") + 8;
    const Outcome run =
        keyline({"fmt", "-"}, {.in = write("in", readme.substr(begin, readme.find("```", begin) - begin))});
    EXPECT_EQ(run.out, read(folder() / "in"));
}

}  // namespace

}  // namespace keyline::test
