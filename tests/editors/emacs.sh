#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Keyline Authors
# SPDX-License-Identifier: Apache-2.0
# Emacs with editors/emacs.el on a graph that is half typed: its diagnostics by Eglot and Flymake.  Takes the program and
# the sources' folder; status 77 where there is no Emacs with Eglot.
set -euo pipefail
program=$1 sources=$2

if ! command -v emacs >/dev/null || ! emacs --batch --eval "(progn (package-initialize) (require 'eglot))" 2>/dev/null; then
  echo "left out, not installed: Emacs with Eglot"
  exit 77
fi
folder=$(mktemp -d)
trap 'rm -r "$folder"' EXIT
sed "s|PLATES|$sources/graphs/plates|" "$sources/tests/editors/half_typed.json" >"$folder/graph.json"
echo '{ "name": "other" }' >"$folder/other.json"
shown=$(HOME=$folder KEYLINE=$program GRAPH=$folder/graph.json OTHER=$folder/other.json emacs --batch \
  --eval "(package-initialize)" -l "$sources/editors/emacs.el" -l "$sources/tests/editors/probe.el" 2>&1)
echo "$shown"
for wanted in "mode: keyline-mode" "told: 5: .*no layer or channel 'hero.Com'" \
  "told: 6: .*there is no node type 'gausian'" "other: js-mode"; do
  grep -q "$wanted" <<<"$shown" || { echo "missing: $wanted"; exit 1; }
done
