#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Keyline Authors
# SPDX-License-Identifier: Apache-2.0
# What a change is held to beside the tests of scripts/test.sh: the project's format, clang's warnings and the tests with
# assertions in clang's debug build, clang-tidy on what changed, and the engine, contract and fuzz tests under the
# address and undefined-behaviour sanitizers.  Says how long each took.  Takes the commit that the change starts from.
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

# The benchmarks too, which nothing else compiles.  Without precompiled headers, so that each source is seen to include
# what it needs.  A little optimised: the contract tests take five minutes of CPU otherwise.
clang_debug() {
  cmake --preset debug -B build/clang -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_CXX_FLAGS_DEBUG="-O1 -g1" -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON \
    -DKEYLINE_TESTS=ON -DKEYLINE_BENCHMARKS=ON >/dev/null
  cmake --build build/clang
  ctest --test-dir build/clang --output-on-failure --parallel "$(nproc)" \
    -R 'test_(structure|errors|engine|contract|nodes|simd|io|image_io)'
}

tidy() {
  if ! git rev-parse --quiet --verify "$base^{commit}" >/dev/null; then
    echo "there is no commit $base to compare with"
    return
  fi
  echo "$(changed | wc -l) sources changed since $base; at most $most_tidied are looked at"
  changed | head -n "$most_tidied" |
    xargs --no-run-if-empty -P "$(nproc)" -n 4 clang-tidy -p build/clang --quiet 2> >(grep -v 'warnings generated' >&2)
}

sanitizers() {
  cmake --preset asan -B build/sanitize -DKEYLINE_SANITIZE="address;undefined" -DKEYLINE_TESTS=ON >/dev/null
  cmake --build build/sanitize --target test_engine test_contract fuzz_exr fuzz_pictures fuzz_graphs
  LSAN_OPTIONS=suppressions=$PWD/cmake/lsan-suppressions.txt \
    ctest --test-dir build/sanitize --output-on-failure --parallel "$(nproc)" -R 'test_engine|test_contract|fuzz'
}

step "format" format
step "clang, debug" clang_debug
step "clang-tidy on what changed" tidy
step "address and undefined-behaviour sanitizers" sanitizers
