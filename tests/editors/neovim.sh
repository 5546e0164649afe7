#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Keyline Authors
# SPDX-License-Identifier: Apache-2.0
# Neovim with editors/neovim.lua on a graph that is half typed: its diagnostics, and the layers and objects of the file
# that the graph reads among its completions.  Takes the program and the sources' folder; status 77 where there is no
# Neovim.
set -euo pipefail
program=$1 sources=$2

if ! command -v nvim >/dev/null; then
  echo "left out, not installed: Neovim"
  exit 77
fi
folder=$(mktemp -d)
trap 'rm -r "$folder"' EXIT
sed "s|PLATES|$sources/graphs/plates|" "$sources/tests/editors/half_typed.json" >"$folder/graph.json"
echo '{ "name": "other" }' >"$folder/other.json"
shown=$(XDG_CONFIG_HOME=$folder XDG_DATA_HOME=$folder XDG_STATE_HOME=$folder KEYLINE=$program GRAPH=$folder/graph.json \
  OTHER=$folder/other.json nvim --headless --clean -u "$sources/editors/neovim.lua" -c "filetype on" \
  -c "luafile $sources/tests/editors/probe.lua" 2>&1)
echo "$shown"
for wanted in "told: 5: no layer or channel 'hero.Com'" "told: 6: there is no node type 'gausian'" \
  "offered: r:hero.Combined" "offered: robot.hat" "clients of other JSON: 0"; do
  grep -qF "$wanted" <<<"$shown" || { echo "missing: $wanted"; exit 1; }
done
if grep -qF "offered: robot.blush" <<<"$shown"; then
  echo "offered a material among the objects"
  exit 1
fi
