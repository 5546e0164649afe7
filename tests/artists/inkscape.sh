#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Keyline Authors
# SPDX-License-Identifier: Apache-2.0
# inkscape.sh KEYLINE SOURCES: what Inkscape has of a drawing: layers by name, every stroke in its place, the same picture.
# Status 77 where there is no Inkscape.
set -euo pipefail
keyline=$(realpath "$1") sources=$2

if ! command -v inkscape >/dev/null; then
  echo "left out, not installed: Inkscape"
  exit 77
fi
. "$(dirname "$0")/drawing.sh"
folder=$(mktemp -d)
trap 'rm -r "$folder"' EXIT
cd "$folder"
export HOME=$folder
draw_the_garden

# What it takes for layers, and what it calls them when it has saved them.
inkscape --actions="select-all:layers;select-list" object.svg >layers.txt 2>inkscape.log || fail "$(cat inkscape.log)"
inkscape --export-filename=saved.svg object.svg 2>inkscape.log || fail "$(cat inkscape.log)"
python3 - <<'END' || fail "layers"
import re, xml.etree.ElementTree as tree
svg, inkscape = "{http://www.w3.org/2000/svg}", "{http://www.inkscape.org/namespaces/inkscape}"
written = [g for g in tree.parse("object.svg").getroot().findall(svg + "g")]
saved = tree.parse("saved.svg").getroot().findall(svg + "g")
taken = [line.split(" cloned:")[0] for line in open("layers.txt") if " cloned:" in line]
assert taken == [g.get("id") for g in written], taken
labels = [g.get(inkscape + "label") for g in saved]
assert labels == [g.get(inkscape + "label") for g in written], labels
for name in "robot.hat", "cat.whiskers", "bunting.flag.07":
    assert name in labels, name
paths = lambda layers: sum(len(g.findall(svg + "path")) for g in layers)
assert paths(saved) == paths(written) > 300, (paths(saved), paths(written))
print(len(labels), "layers,", paths(saved), "strokes")
END

# Where it has each of them, whole or split.
for file in object split; do
  inkscape --query-all "$file.svg" >"$file.txt" 2>inkscape.log || fail "$(cat inkscape.log)"
done
python3 - <<'END' || fail "places"
def strokes(file):
    rows = (line.rstrip().rsplit(",", 4) for line in open(file))
    return {row[0]: [float(d) for d in row[1:]] for row in rows if row[0].startswith("stroke") and "." not in row[0]}
whole, split = strokes("object.txt"), strokes("split.txt")
assert whole and set(split) <= set(whole)
for id, (x, y, w, h) in split.items():
    for a, b in zip((x, y, x + w, y + h), (whole[id][0], whole[id][1], whole[id][0] + whole[id][2], whole[id][1] + whole[id][3])):
        assert abs(a - b) < 1.5, (id, split[id], whole[id])
print(len(whole), "and", len(split), "strokes where they should be")
END

# What it shows, beside what Keyline draws.  Of shapes each has one opacity; what lies over each other mixes otherwise.
for file in object split; do
  inkscape --export-type=png --export-area-page --export-background=white -o "$file.png" "$file.svg" 2>inkscape.log ||
    fail "$(cat inkscape.log)"
  "$keyline" diff page.png "$file.png" --layer R --json >diff.json || true
  python3 - "$file" <<'END' || fail "pictures"
import json, sys
told, = json.load(open("diff.json"))["pictures"][0]["channels"]
assert told["mean"] < 0.01 and told["p99"] < 0.2, told
print(sys.argv[1] + ".svg looks as it is drawn, but for", round(told["mean"], 4))
END
done
