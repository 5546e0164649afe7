#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Keyline Authors
# SPDX-License-Identifier: Apache-2.0
# Installs what is missing, builds Keyline, makes the drawing of the garden in graphs/plates and says where it is.
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/install-packages.sh
cmake --preset release -DKEYLINE_TESTS=OFF >/dev/null
cmake --build --preset release
build/release/bin/keyline render graphs/garden.json --frames 12
echo "the picture: $PWD/out/garden.0012.png"
