// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/plan/session.h"

#include "tests/io/exr_files.h"
#include "tests/support/render_files.h"

#include <fstream>
#include <gmock/gmock.h>

namespace keyline::testing {
namespace {

using ::testing::IsEmpty;

constexpr const char* kConfig = R"(ocio_profile_version: 1
roles: {scene_linear: lin}
displays: {screen: [!<View> {name: plain, colorspace: lin}]}
colorspaces:
  - !<ColorSpace> {name: lin}
  - !<ColorSpace>
    name: dark
    to_reference: !<MatrixTransform> {matrix: [GAIN, 0, 0, 0, 0, GAIN, 0, 0, 0, 0, GAIN, 0, 0, 0, 0, 1]}
)";

class SessionOfARun : public ::testing::Test {
protected:
    SessionOfARun() {
        write_config(2);
        write_exr(folder_ / "paper.exr", noise({0, 0, 20, 10}, {"R", "G", "B"}, 9));
        for (int f = 1; f <= 4; ++f)
            write_exr(file("a.000" + std::to_string(f) + ".exr"),
                      noise({0, 0, 20, 10}, {"R", "G", "B", "A"}, static_cast<unsigned>(f)));
    }
    std::string file(const std::string& name) const { return folder_ / name; }

    void write_config(int gain) const {
        std::string text = kConfig;
        for (std::size_t at = 0; (at = text.find("GAIN")) != std::string::npos;)
            text.replace(at, 4, std::to_string(gain));
        std::ofstream(folder_ / "show.ocio") << text;
    }

    Session::Counts render_frames(std::vector<int> frames) {
        const Json nodes{{"in", {{"type", "read"}, {"file", file("a.####.exr")}, {"colorspace", "dark"}}},
                         {"paper", {{"type", "read"}, {"file", file("paper.exr")}}},
                         {"comp", {{"type", "over"}, {"fg", "in"}, {"bg", "paper"}}},
                         {"out", {{"type", "write"}, {"in", "comp"}, {"file", file("out.####.exr")}}}};
        RenderOptions options;
        options.frames = std::move(frames);
        options.ocio = folder_ / "show.ocio";
        options.session = session_;
        const Rendered out = render_files(nodes, options);
        EXPECT_THAT(out.errors, IsEmpty());
        return session_->counts();
    }

    const TemporaryFolder folder_;
    std::shared_ptr<Session> session_ = std::make_shared<Session>();
};

TEST_F(SessionOfARun, AConfigIsLoadedOnce) { EXPECT_EQ(render_frames({1, 2, 3, 4}).configs_loaded, 1); }

TEST_F(SessionOfARun, AnImageIsOpenedOnceHoweverManyFramesUseIt) {
    EXPECT_EQ(render_frames({1, 2, 3, 4}).images_opened, 5);
    EXPECT_EQ(render_frames({1, 2}).images_opened, 5) << "nor by another run";
}

TEST_F(SessionOfARun, AConfigThatChangedIsLoadedAgain) {
    render_frames({1});
    const Image before = read_exr(file("out.0001.exr"));
    const auto time = std::filesystem::last_write_time(folder_ / "show.ocio");
    write_config(3);
    std::filesystem::last_write_time(folder_ / "show.ocio", time + std::chrono::seconds(1));
    EXPECT_EQ(render_frames({1}).configs_loaded, 2);
    EXPECT_FALSE(same(read_exr(file("out.0001.exr")), before));
}

TEST_F(SessionOfARun, AnImageThatChangedIsOpenedAgain) {
    render_frames({1});
    const auto time = std::filesystem::last_write_time(file("paper.exr"));
    write_exr(file("paper.exr"), noise({0, 0, 20, 10}, {"R", "G", "B"}, 10));
    std::filesystem::last_write_time(file("paper.exr"), time + std::chrono::seconds(1));
    render_frames({1});
    const Image by_the_same = read_exr(file("out.0001.exr"));
    session_ = std::make_shared<Session>();
    render_frames({1});
    EXPECT_IMAGE(by_the_same, read_exr(file("out.0001.exr")));
}

TEST_F(SessionOfARun, KeepsNoMoreThanItsBounds) {
    Session session;
    for (int i = 0; i < 40; ++i) {
        const std::string name = file("copy" + std::to_string(i) + ".exr");
        std::filesystem::copy_file(file("paper.exr"), name);
        session.open(name, {});
        session.remember(Digester("x").add(i).digest(), typeid(int), Session::kBytes / 10,
                         [] { return std::make_shared<const int>(1); });
    }
    EXPECT_EQ(session.images_kept(), Session::kImages);
    EXPECT_LE(session.bytes_kept(), Session::kBytes);
    EXPECT_GE(session.bytes_kept(), Session::kBytes / 2);
    session.remember(Digester("large").digest(), typeid(int), 2 * Session::kBytes,
                     [] { return std::make_shared<const int>(1); });
    EXPECT_LE(session.bytes_kept(), Session::kBytes);
}

TEST_F(SessionOfARun, WhatFollowsFromAKeyIsMadeOnce) {
    Session session;
    const auto get = [&](const Digest& key) {
        return session.remember(key, typeid(int), 4, [] { return std::make_shared<const int>(1); });
    };
    const Digest key = Digester("key").digest();
    EXPECT_EQ(get(key), get(key));
    EXPECT_EQ(session.counts().values_made, 1);
    get({});
    get({});
    EXPECT_EQ(session.counts().values_made, 3) << "of what nothing is known nothing is kept";
}

}  // namespace
}  // namespace keyline::testing
