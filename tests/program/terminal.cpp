// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

// Runs a program whose standard error is a terminal, and prints on its own what that terminal was told.  With
// $ANSWERS in the environment standard input is that terminal too, on which somebody types them.
int main(int count, char** arguments) {
    const int terminal = posix_openpt(O_RDWR | O_NOCTTY);
    if (count < 2 || terminal < 0 || grantpt(terminal) != 0 || unlockpt(terminal) != 0) return 127;
    const int side = open(ptsname(terminal), O_RDWR | O_NOCTTY);
    const char* answers = std::getenv("ANSWERS");
    const pid_t child = fork();
    if (side < 0 || child < 0) return 127;
    if (child == 0) {
        dup2(side, STDERR_FILENO);
        if (answers != nullptr) dup2(side, STDIN_FILENO);
        execv(arguments[1], arguments + 1);
        _exit(127);
    }
    close(side);
    if (answers != nullptr && write(terminal, answers, std::strlen(answers)) < 0) return 127;
    std::array<char, 4096> buffer = {};
    for (ssize_t n = 0; (n = read(terminal, buffer.data(), buffer.size())) > 0;)
        if (write(STDERR_FILENO, buffer.data(), static_cast<std::size_t>(n)) != n) return 127;
    int status = 0;
    if (waitpid(child, &status, 0) != child) return 127;
    return WIFSIGNALED(status) ? 126 : WEXITSTATUS(status);
}
