#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Keyline Authors
# SPDX-License-Identifier: Apache-2.0
# judge.sh KEYLINE CORPUS-PROGRAM FOLDER: the schema, judged by packages of npm that are installed into FOLDER.
# Skipped, with status 77, where there is no node or the packages can't be had.
set -euo pipefail
keyline=$1 corpus=$2 folder=$3
here=$(cd "$(dirname "$0")" && pwd)

if ! command -v node >/dev/null || ! command -v npm >/dev/null; then
  echo "skipped: there is no node and npm on this machine"
  exit 77
fi
mkdir -p "$folder"
cp "$here"/{package.json,package-lock.json,judge.mjs} "$folder"
cd "$folder"
if ! cmp -s package-lock.json installed; then
  npm ci --silent --no-audit --no-fund || { echo "skipped: npm can't install the validators"; exit 77; }
  cp package-lock.json installed
fi
"$keyline" schema > schema.json
"$corpus" > corpus.jsonl
node judge.mjs schema.json corpus.jsonl "$here"/../../graphs/*.json "$here"/../../graphs/groups/*.json
