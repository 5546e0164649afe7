#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Keyline Authors
# SPDX-License-Identifier: Apache-2.0
# Formats the pages of the manual without a warning, and finds in them what they are made of.
set -euo pipefail
folder=$1 document=$2 keyline=$3
command -v mandoc >/dev/null || exit 77

pages=("$folder/man1/keyline.1" "$folder/man5/keyline-graph.5")
mandoc -T lint -W warning "${pages[@]}"

text() { mandoc -T utf8 -O width=500 "$1" | sed $'s/.\b//g'; }
expect() {
  grep -qF -- "$2" <<<"$3" || { echo "$1 has no: $2"; exit 1; }
}

language=$(text "${pages[1]}")
expect keyline-graph.5 "keyline-graph - the language of Keyline's graph files" "$language"
while read -r heading; do expect keyline-graph.5 "$heading" "$language"; done < <(sed -n 's/^##* //p' "$document")

commands=$(text "${pages[0]}")
while read -r command; do expect keyline.1 "keyline $command" "$commands"; done \
  < <("$keyline" --help | sed -n '/^Commands:/,/^$/s/^  \([a-z]*\) .*/\1/p')
while read -r option; do expect keyline.1 "$option" "$commands"; done \
  < <("$keyline" render --help | grep -o -- '--[a-z-]*' | sort -u)
