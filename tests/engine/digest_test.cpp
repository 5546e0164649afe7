// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/base/digest.h"

#include "engine/plan/resolve.h"
#include "tests/engine/test_nodes.h"
#include "tests/io/exr_files.h"
#include "tests/support/image.h"
#include "tests/support/json.h"

#include <algorithm>
#include <chrono>
#include <gtest/gtest.h>

namespace keyline::testing {
namespace {

TEST(Digest, IsTheSameOnEveryMachine) {
    EXPECT_EQ(to_string(Digester("a").digest()), "ea7daf8b8b8e0899adea399fbae36cb2");
    EXPECT_EQ(to_string(Digester("node").add(-1).add(0.5).add("sigma").add(Digest{1, 2}).digest()),
              "8312627d58dece6f6ffe4aff67440228");
}

TEST(Digest, TellsWhereItsPartsEnd) {
    EXPECT_NE(Digester("").add("ab").add("c").digest(), Digester("").add("a").add("bc").digest());
    EXPECT_NE(Digester("").add("").digest(), Digester("").digest());
}

TEST(Digest, OfWhatIsPartlyUnknownIsUnknown) {
    EXPECT_FALSE(Digester("a").add(Digest{}).digest().known());
    EXPECT_EQ(to_string(Digest{}), "unknown");
}

class OpDigest : public ::testing::Test {
protected:
    OpDigest() {
        write_exr(folder_ / "a.exr", noise({0, 0, 20, 10}, {"R", "G", "B", "Z"}, 1));
        write_exr(folder_ / "s.0001.exr", noise({0, 0, 20, 10}, {"R", "G", "B", "Z"}, 2));
        write_exr(folder_ / "s.0002.exr", noise({0, 0, 20, 10}, {"R", "G", "B", "Z"}, 3));
    }

    // Of what a node of a graph makes, by its last channel.
    Digest of(const std::string& graph, const std::string& id, int frame = 1) const {
        Diagnostics diagnostics;
        const auto loaded = Graph::parse(graph, "test.json", folder_.path(), {}, diagnostics);
        for (const Error& e : diagnostics.errors()) ADD_FAILURE() << e.text();
        if (!loaded) return {};
        ResolveOptions options;
        options.every_node = true;
        const auto resolved = resolve(*loaded, frame, options, diagnostics);
        for (const Error& e : diagnostics.errors()) ADD_FAILURE() << e.text();
        if (!resolved) return {};
        const auto it = std::ranges::find(resolved->streams, loaded->index_of(id), &NodeStream::node);
        const ValueRef value = it->stream.channels.back().value;
        return resolved->ops[static_cast<std::size_t>(value.op)].digest;
    }
    Digest of(const Json& nodes, const std::string& id, int frame = 1) const {
        Json all = nodes;
        all.set("out", {{"type", "write"}, {"in", id}, {"file", "out.exr"}});
        return of(Json{{"keyline", 1}, {"nodes", all}}.text(), id, frame);
    }

    const TemporaryFolder folder_;
};

Json soft(const Json& more = {}, const std::string& file = "a.exr", const std::string& in = "in:Z") {
    Json blur = more;
    blur.set("type", "gaussian").set("in", in);
    return {{"in", {{"type", "read"}, {"file", file}}}, {"soft", blur}};
}

TEST_F(OpDigest, IsTheSameHoweverAGraphIsWritten) {
    const Digest digest = of(soft({{"sigma", 2}}), "soft");
    EXPECT_TRUE(digest.known());
    EXPECT_EQ(of(soft({{"sigma", 2}}), "soft"), digest);
    EXPECT_EQ(of(R"({"keyline": 1, "about": "other", "variables": {"s": 2.0}, "nodes": {
        "w": {"type": "write", "in": "blur", "file": "else/where.png", "channels": ["Z"]},
        "blur": {"sigma": ["${s}", 2], "in": "p:Z", "about": "soft", "type": "gaussian"},
        "p": {"type": "read", "view": "", "file": ")" +
                     (folder_ / "./a.exr").string() + R"(", "nan": "mend", "missing": "error"}}})",
                 "blur"),
              digest);
}

TEST_F(OpDigest, ChangesWithParametersInputsAndChannels) {
    const Digest digest = of(soft({{"sigma", 2}}), "soft");
    EXPECT_NE(of(soft({{"sigma", 2.5}}), "soft"), digest);
    EXPECT_NE(of(soft({{"sigma", 2}}, "s.0001.exr"), "soft"), digest);
    EXPECT_NE(of(soft({{"sigma", 2}}, "a.exr", "in:B"), "soft"), digest);
    Json keeping = soft({{"sigma", 2}});
    keeping.set("in", {{"type", "read"}, {"file", "a.exr"}, {"nan", "keep"}});
    EXPECT_NE(of(keeping, "soft"), digest);
    Json cut = soft({{"sigma", 2}}, "a.exr", "part:Z");
    cut.set("part", {{"type", "crop"}, {"in", "in"}, {"region", {0, 0, 19, 10}}});
    EXPECT_NE(of(cut, "soft"), digest);
}

TEST_F(OpDigest, ChangesWithTheFile) {
    const auto file = folder_ / "a.exr";
    const auto written = std::filesystem::last_write_time(file);
    const Digest digest = of(soft(), "soft");
    std::filesystem::last_write_time(file, written + std::chrono::nanoseconds(1));
    EXPECT_NE(of(soft(), "soft"), digest) << "written again";
    std::filesystem::last_write_time(file, written);
    EXPECT_EQ(of(soft(), "soft"), digest);
    // Another file of the same name, size and time.
    std::filesystem::copy_file(file, folder_ / "b.exr");
    std::filesystem::rename(folder_ / "b.exr", file);
    std::filesystem::last_write_time(file, written);
    EXPECT_NE(of(soft(), "soft"), digest) << "replaced";
}

TEST_F(OpDigest, IsTheSameInAllFramesThatSeeTheSame) {
    EXPECT_EQ(of(soft(), "soft", 1), of(soft(), "soft", 2)) << "one file for all frames";
    const Json sequence = soft({}, "s.####.exr");
    EXPECT_NE(of(sequence, "soft", 1), of(sequence, "soft", 2));
    Json earlier = sequence;
    earlier.set("in", {{"type", "read"}, {"file", "s.####.exr"}, {"frame", "-1"}});
    EXPECT_EQ(of(sequence, "soft", 1), of(earlier, "soft", 2)) << "one file in two frames";
    const Json numbered = soft({{"sigma", "${frame}"}});
    EXPECT_NE(of(numbered, "soft", 1), of(numbered, "soft", 2));
}

// It may compute with the number, which no parameter tells.
TEST_F(OpDigest, ChangesWithTheFrameThatANodeAsksFor) {
    register_test_nodes<Change>();
    Json nodes = soft();
    nodes.set("change", {{"type", "change"}, {"in", "soft"}});
    EXPECT_NE(of(nodes, "change", 1), of(nodes, "change", 2));
}

// What a node looks up in metadata is in no link.
TEST_F(OpDigest, ChangesWithTheMetadataThatANodeSees) {
    Image image = noise({0, 0, 4, 4}, {"R", "G", "B"}, 1);
    write_exr(folder_ / "m.exr", image);
    const auto time = std::filesystem::last_write_time(folder_ / "m.exr");
    const auto other = [&](const std::string& name) {
        Json nodes{{"a", {{"type", "read"}, {"file", "a.exr"}}},
                   {"m", {{"type", "read"}, {"file", name}}},
                   {"both", {{"type", "pack"}, {"layers", {{"m", "m"}, {"z", "a:Z"}}}}},
                   {"soft", {{"type", "gaussian"}, {"in", "both:z"}}}};
        return of(nodes, "soft");
    };
    const Digest before = other("m.exr");
    image.metadata.set({"artist", "string", std::string("someone")});
    write_exr(folder_ / "m.exr", image);
    std::filesystem::last_write_time(folder_ / "m.exr", time);
    EXPECT_NE(other("m.exr"), before);
}

}  // namespace
}  // namespace keyline::testing
