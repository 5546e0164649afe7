// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

// Runs a program and prints the most memory that it held, in bytes, as the last line of standard output.  The
// kernel counts to a process what its parent held when it started it; so a test, which may be larger than the
// program, must not start what it measures.  This is smaller than anything it is asked to run.
int main(int count, char** arguments) {
    if (count < 2) return 127;
    const pid_t child = fork();
    if (child < 0) return 127;
    if (child == 0) {
        execv(arguments[1], arguments + 1);
        _exit(127);
    }
    int status = 0;
    rusage usage = {};
    if (wait4(child, &status, 0, &usage) != child) return 127;
    std::printf("%lld\n", static_cast<long long>(usage.ru_maxrss) << 10);
    return WIFSIGNALED(status) ? 126 : WEXITSTATUS(status);
}
