#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Keyline Authors
# SPDX-License-Identifier: Apache-2.0
# vscode.sh PROGRAM SOURCES FOLDER: VS Code's protocol library against `keyline lsp`, with packages of npm that are installed
# into FOLDER.  Status 77 where there is no node or the packages can't be had.
set -euo pipefail
program=$1 sources=$2 folder=$3
here=$sources/tests/editors/vscode

if ! command -v node >/dev/null || ! command -v npm >/dev/null; then
  echo "skipped: there is no node and npm on this machine"
  exit 77
fi
mkdir -p "$folder"
cp "$here"/{package.json,package-lock.json,probe.mjs} "$folder"
cd "$folder"
if ! cmp -s package-lock.json installed; then
  npm ci --silent --no-audit --no-fund || { echo "skipped: npm can't install the client"; exit 77; }
  cp package-lock.json installed
fi
sed "s|PLATES|$sources/graphs/plates|" "$sources/tests/editors/half_typed.json" >graph.json
shown=$(node probe.mjs "$program" graph.json)
echo "$shown"
for wanted in "told: 5: no layer or channel 'hero.Com'" "told: 6: there is no node type 'gausian'" \
  "offered: r:hero.Combined" "offered: robot.hat"; do
  grep -qF "$wanted" <<<"$shown" || { echo "missing: $wanted"; exit 1; }
done
