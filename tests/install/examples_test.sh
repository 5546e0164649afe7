#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Keyline Authors
# SPDX-License-Identifier: Apache-2.0
# Compiles the C++ examples of the README as they stand there.  Takes a compiler, the project's folder and a folder for
# the examples.
set -euo pipefail
compiler=$1 project=$2 folder=$3

rm -rf "$folder"
mkdir -p "$folder"
awk -v folder="$folder" '
  /^```cpp$/ { n++; inside = 1; next }
  /^```$/ { inside = 0 }
  inside { print > (folder "/example_" n ".cpp") }' "$project/README.md"

examples=("$folder"/example_*.cpp)
[ ${#examples[@]} -ge 2 ] || { echo "the README has lost its examples"; exit 1; }
for example in "${examples[@]}"; do
  "$compiler" -std=c++20 -fsyntax-only -Wall -Wextra -Werror -I "$project" "$example"
done
