#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Keyline Authors
# SPDX-License-Identifier: Apache-2.0
# Installs what Keyline is built from and is not there yet, from Debian's packages; and those named as arguments.
set -euo pipefail

packages=(
  g++ cmake ninja-build pkg-config
  libopenexr-dev libimath-dev libopenimageio-dev libopencolorio-dev libdeflate-dev libxxhash-dev
  libtbb-dev libhwy-dev libfmt-dev nlohmann-json3-dev libcli11-dev
  libgtest-dev libgmock-dev python3 lowdown
  "$@"
)

missing=()
for package in "${packages[@]}"; do
  dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q '^install ok installed$' || missing+=("$package")
done
if [ ${#missing[@]} -eq 0 ]; then exit 0; fi

as_root=()
if [ "$(id -u)" -ne 0 ]; then as_root=(sudo); fi
echo "installing: ${missing[*]}"
"${as_root[@]}" apt-get update -qq
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
