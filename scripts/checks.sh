#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Keyline Authors
# SPDX-License-Identifier: Apache-2.0
# What a change is held to beside the tests of scripts/test.sh: the project's format, clang's warnings, the tests with
# assertions under the address and undefined-behaviour sanitizers, the fuzzers, and clang-tidy on what changed.  Says how
# long each took.  Takes the commit that the change starts from.
set -euo pipefail
cd "$(dirname "$0")/.."
base=${1:-HEAD~4}
most_tidied=40 # files; a change of more is looked at by giving it in parts

scripts/install-packages.sh clang clang-format clang-tidy libbenchmark-dev

step() {
  local started=$SECONDS name=$1
  shift
  echo "== $name"
  "$@"
  echo "== $name: $((SECONDS - started)) s"
}

sources() { git ls-files '*.cpp' '*.h'; }

# Sources that differ from the base; bench/ is compiled only with its own packages.
changed() { git diff --name-only --diff-filter=d "$base" -- '*.cpp' | grep -v '^bench/' || true; }

format() { sources | xargs clang-format --dry-run -Werror; }

# One build for three questions: what clang warns of, what the assertions say, and what the address and undefined-behaviour
# sanitizers find.  The benchmarks too, which nothing else compiles.  The library is a little optimised: the contract tests
# take five minutes of CPU otherwise.  Vector bodies from SSE4 on: instrumented, the portable one takes the compiler a quarter
# of the whole build; scripts/test.sh runs it.
clang_debug() {
  local flags="-O1 -g1"
  [ "$(uname -m)" != x86_64 ] || flags+=" -march=x86-64-v2 -maes -mpclmul"
  cmake --preset debug -B build/clang -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_CXX_FLAGS_DEBUG="$flags" \
    -DKEYLINE_SANITIZE="address;undefined" -DKEYLINE_TESTS=ON -DKEYLINE_BENCHMARKS=ON >/dev/null
  cmake --build build/clang
}

debug_tests() {
  LSAN_OPTIONS=suppressions=$PWD/cmake/lsan-suppressions.txt \
    ctest --test-dir build/clang --output-on-failure --parallel "$(nproc)" \
    -R 'test_(structure|errors|engine|contract|nodes|simd|io|image_io)|fuzz'
}

tidy() {
  if ! git rev-parse --quiet --verify "$base^{commit}" >/dev/null; then
    echo "there is no commit $base to compare with"
    return
  fi
  echo "$(changed | wc -l) sources changed since $base; at most $most_tidied are looked at"
  # Without precompiled headers, so that each is seen to include what it needs.
  cmake --preset debug -B build/tidy -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON >/dev/null
  changed | head -n "$most_tidied" |
    xargs --no-run-if-empty -P "$(nproc)" -n 4 clang-tidy -p build/tidy --quiet 2> >(grep -v 'warnings generated' >&2)
}

step "format" format
step "clang, debug, sanitizers: build" clang_debug
step "clang, debug, sanitizers: tests" debug_tests
step "clang-tidy on what changed" tidy
