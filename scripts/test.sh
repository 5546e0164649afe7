#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Keyline Authors
# SPDX-License-Identifier: Apache-2.0
# Installs what is missing, builds Keyline with its tests and runs them.  Takes the name of a preset; without
# one it is the release build.
set -euo pipefail
cd "$(dirname "$0")/.."
preset=${1:-release}

scripts/install-packages.sh graphviz neovim mandoc
cmake --preset "$preset" -DKEYLINE_TESTS=ON >/dev/null
cmake --build --preset "$preset"
ctest --preset "$preset" --parallel "$(nproc)"
