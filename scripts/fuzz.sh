#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Keyline Authors
# SPDX-License-Identifier: Apache-2.0
# Installs what is missing, builds with address and undefined-behaviour sanitizers, and reads 10,000 damaged OpenEXR
# files, 3,000 damaged pictures of other formats and 10,000 damaged graphs.  Takes a seed.  Ends with 0 where each was
# read or refused with an error that says so; what was not is named.
set -euo pipefail
cd "$(dirname "$0")/.."
seed=${1:-1}

scripts/install-packages.sh
cmake --preset asan -B build/fuzz -DKEYLINE_SANITIZE="address;undefined" -DKEYLINE_TESTS=ON >/dev/null
cmake --build build/fuzz --target fuzz_exr fuzz_pictures fuzz_graphs
export LSAN_OPTIONS="suppressions=$PWD/cmake/lsan-suppressions.txt" UBSAN_OPTIONS=print_stacktrace=1
status=0
build/fuzz/bin/fuzz_exr 10000 "$seed" || status=1
build/fuzz/bin/fuzz_pictures 3000 "$seed" || status=1
build/fuzz/bin/fuzz_graphs 10000 "$seed" || status=1
exit $status
