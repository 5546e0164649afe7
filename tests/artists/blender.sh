#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Keyline Authors
# SPDX-License-Identifier: Apache-2.0
# blender.sh KEYLINE SOURCES: what Blender's Grease Pencil has of a drawing whose widths are split: layers by name, each
# path as one line with its width and colour, where it should be.  Status 77 where there is no Blender.
set -euo pipefail
keyline=$(realpath "$1") sources=$2

if ! command -v blender >/dev/null; then
  echo "left out, not installed: Blender"
  exit 77
fi
here=$(cd "$(dirname "$0")" && pwd)
. "$here/drawing.sh"
folder=$(mktemp -d)
trap 'rm -r "$folder"' EXIT
cd "$folder"
export HOME=$folder
draw_the_garden --set 'split.color="#204080"'
blender --background --factory-startup --python-exit-code 1 --python "$here/imported.py" -- split.svg >blender.log 2>&1 ||
  fail "$(cat blender.log)"
grep "lines where they should be" blender.log
