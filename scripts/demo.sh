#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Keyline Authors
# SPDX-License-Identifier: Apache-2.0
# Installs what is missing, builds Keyline, makes the toon picture of the plate in graphs/plates and says where
# it is.
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/install-packages.sh
cmake --preset release -DKEYLINE_TESTS=OFF >/dev/null
cmake --build --preset release
build/release/bin/keyline render graphs/toon.json --frames 24
echo "the picture: $PWD/out/toon.0024.png"
