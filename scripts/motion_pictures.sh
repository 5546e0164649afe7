#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Keyline Authors
# SPDX-License-Identifier: Apache-2.0
# Makes the pictures of lines in motion for docs: six frames of each hand on one sheet, and one of them as an animation.
# The sequence is too large to come with Keyline: say where its frames lie, as garden.####.exr.
#     scripts/motion_pictures.sh FOLDER/garden.####.exr
# Wants Keyline built (scripts/demo.sh), and img2webp (Debian: webp) for the animation.
set -euo pipefail
sequence=${1:?where are the frames of the sequence?}
cd "$(dirname "$0")/.."
keyline=${KEYLINE:-build/release/bin/keyline}
images=$PWD/docs/images
scratch=$(mktemp -d)
trap 'rm -r "$scratch"' EXIT

# GRAPH OPTION…: what it says is shown where it fails
keyline() {
  "$keyline" render "$@" --progress none --no-provenance 2> "$scratch/log" || (cat "$scratch/log" && false)
}

# HAND: all frames, to $scratch/HAND.####.png, with lines that hold together
render() {
  keyline "graphs/$1.json" --frames 1-24 --var around=2 --var plate="$sequence" --var out="$scratch/$1.####.png"
}

# HAND: six frames, two thirds as large, three beside each other
sheet() {
  local nodes="" below="page" i=0 row
  for frame in 01 05 09 13 17 21; do
    row=$((i / 3))
    nodes+="\"f$i\": { \"type\": \"read\", \"file\": \"$1.00$frame.png\" },
            \"m$i\": { \"type\": \"transform\", \"in\": \"f$i\", \"scale\": 0.6666667, \"center\": [0, 0],
                       \"translate\": [$((i % 3 * 322)), $((row * 182))] },
            \"o$i\": { \"type\": \"over\", \"fg\": \"m$i\", \"bg\": \"$below\" }, "
    below="o$i"
    i=$((i + 1))
  done
  cat > "$scratch/sheet.json" <<EOF
{ "keyline": 1, "nodes": {
  "page": { "type": "constant", "color": [1, 1, 1], "size": [964, 362] }, $nodes
  "out":  { "type": "write", "in": "$below", "file": "$images/$1-frames.webp", "channels": ["R", "G", "B"] } } }
EOF
  keyline "$scratch/sheet.json"
}

for hand in cleanup brush pencil technical comic; do
  render $hand
  sheet $hand
done
img2webp -loop 0 -lossy -q 60 -m 6 -d 83 "$scratch"/brush.*.png -o "$images/motion.webp"
