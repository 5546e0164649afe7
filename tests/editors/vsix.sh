#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Keyline Authors
# SPDX-License-Identifier: Apache-2.0
# vsix.sh SOURCES FOLDER: packages the extension for VS Code in FOLDER, and looks for what belongs into it.  Status 77 where
# there is no node or the packages can't be had.
set -euo pipefail
sources=$1 folder=$2

if ! command -v node >/dev/null || ! command -v npm >/dev/null; then
  echo "skipped: there is no node and npm on this machine"
  exit 77
fi
mkdir -p "$folder"
cp "$sources"/editors/vscode/{package.json,package-lock.json,extension.js,README.md,.vscodeignore} "$folder"
cd "$folder"
node --check extension.js
if ! cmp -s package-lock.json installed; then
  npm ci --silent --no-audit --no-fund || { echo "skipped: npm can't install the packager"; exit 77; }
  cp package-lock.json installed
fi
rm -f ./*.vsix
npm run --silent package >/dev/null
held=$(python3 -m zipfile -l ./*.vsix)
for wanted in extension/extension.js extension/package.json node_modules/vscode-languageclient/node.js; do
  grep -qF "$wanted" <<<"$held" || { echo "missing: $wanted"; exit 1; }
done
if grep -qF "node_modules/@vscode/vsce" <<<"$held"; then
  echo "the packager is in the package"
  exit 1
fi
