// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/io/helper/helper.h"

#include "engine/base/error.h"
#include "engine/io/exr/helper_tasks.h"
#include "engine/io/helper/message.h"
#include "tests/support/failure.h"

#include <csignal>
#include <fstream>
#include <gmock/gmock.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

namespace keyline {
namespace {

// What a helper says of bytes that are no file.
Error error_of_nonsense(Helper& helper) {
    const std::vector<std::byte> nonsense(100, std::byte{7});
    HelperRequest request = {};
    request.task = static_cast<uint32_t>(exr::HelperTask::kUnpack);
    return error_of([&] { helper.run(request, exr::bounds_of(100, 100), nonsense); });
}

void kill_children() {
    std::ifstream in("/proc/self/task/" + std::to_string(getpid()) + "/children");
    for (pid_t child = 0; in >> child;) {
        kill(child, SIGKILL);
        siginfo_t ended = {};
        waitid(P_PID, static_cast<id_t>(child), &ended, WEXITED | WNOWAIT);
    }
}

TEST(Helper, TellsWhatTheLibrarySays) {
    Helper helper(exr::kHelperProgram);
    const Error e = error_of_nonsense(helper);
    EXPECT_EQ(e.kind, ErrorKind::kInput);
    EXPECT_THAT(e.what, testing::HasSubstr("not an image file"));
    EXPECT_EQ(error_of_nonsense(helper).what, e.what);
}

TEST(Helper, IsStartedAgainWhereItWasKilled) {
    Helper helper(exr::kHelperProgram);
    const Error e = error_of_nonsense(helper);
    EXPECT_TRUE(helper_is_running(exr::kHelperProgram));
    kill_children();
    EXPECT_EQ(error_of_nonsense(helper).what, e.what);
}

TEST(Helper, ThatIsNotThereIsNoFaultOfTheFile) {
    const HelperProgram program{"keyline-no-helper", "nobody's library"};
    Helper helper(program);
    const Error e = error_of_nonsense(helper);
    EXPECT_EQ(e.kind, ErrorKind::kInternal);
    EXPECT_THAT(e.what, testing::HasSubstr("keyline-no-helper can't be started: No such file or directory"));
}

TEST(Helper, SharesMemory) {
    Helper helper(exr::kHelperProgram);
    EXPECT_GE(helper.shared(100).size(), 100U);
    const std::span<std::byte> more = helper.shared(1 << 20);
    ASSERT_GE(more.size(), std::size_t{1} << 20);
    more.back() = std::byte{1};
}

TEST(Message, ComesBackAsItWasPut) {
    const auto bytes = MessageWriter().put(7).put_text("abc").put(std::vector<double>{1, 2}).bytes();
    MessageReader in(bytes);
    EXPECT_EQ(in.get<int>(), 7);
    EXPECT_EQ(in.get_text(), "abc");
    EXPECT_EQ(in.get_all<double>(), (std::vector<double>{1, 2}));
    EXPECT_THROW(in.get<char>(), std::runtime_error);
}

TEST(Message, ALengthThatIsMadeUpIsRefused) {
    const auto bytes = MessageWriter().put(uint64_t{1} << 62).bytes();
    EXPECT_THROW(MessageReader(bytes).get_all<double>(), std::runtime_error);
}

}  // namespace
}  // namespace keyline
