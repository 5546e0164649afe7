#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Keyline Authors
# SPDX-License-Identifier: Apache-2.0
# Makes the pictures of docs/lines.md: pieces of graphs/garden.json, four times as large, with one thing changed.
# Wants Keyline built (scripts/demo.sh).
set -euo pipefail
cd "$(dirname "$0")/.."
keyline=${KEYLINE:-build/release/bin/keyline}
images=$PWD/docs/images/lines
scratch=$(mktemp -d)
trap 'rm -r "$scratch"' EXIT
mkdir -p "$images"

render() { "$keyline" render "$1" --frames 12 --progress none "${@:2}" 2>/dev/null; }

# NAME X Y: 80 × 60 pixels of $scratch/whole.png from there on
piece() {
  cat > "$scratch/piece.json" <<EOF
{ "keyline": 1, "nodes": {
  "whole": { "type": "read", "file": "whole.png" },
  "page":  { "type": "constant", "color": [1, 1, 1], "size": [320, 240] },
  "piece": { "type": "transform", "in": "whole", "scale": 4, "center": [0, 0], "filter": "nearest",
             "translate": [$((-4 * $2)), $((-4 * $3))] },
  "comp":  { "type": "over", "fg": "piece", "bg": "page" },
  "out":   { "type": "write", "in": "comp", "file": "$images/$1.png", "depth": "uint8", "channels": ["R", "G", "B"] } } }
EOF
  "$keyline" render "$scratch/piece.json" --no-provenance --progress none 2>/dev/null
}

# NAME X Y OPTION…: a piece of the garden
garden() {
  render graphs/garden.json --var out="$scratch/whole.png" "${@:4}"
  piece "$@"
}

# What other ways make of the same passes.
cat > "$scratch/masks.json" <<EOF
{ "keyline": 1, "variables": { "out": "whole.png" }, "nodes": {
  "render":  { "type": "read", "file": "$PWD/graphs/plates/garden.####.exr" },
  "objects": { "type": "idedge", "in": "render", "layer": "CryptoObject", "depth": "render:Depth" },
  "turn":    { "type": "gradient", "in": "render:Normal", "operator": "sobel" },
  "creases": { "type": "threshold", "in": "turn:magnitude", "low": 0.34, "high": 0.62 },
  "folds":   { "type": "$PWD/graphs/groups/depth_lines.json", "depth": "render:Depth", "low": 0.012, "high": 0.028 },
  "inner":   { "type": "math", "in": "creases", "op": "max", "b": "folds" },
  "lines":   { "type": "math", "in": "inner", "op": "max", "b": "objects:edge" },
  "ink":     { "type": "ink", "in": "lines" },
  "paper":   { "type": "constant", "color": [1, 1, 1], "like": "render" },
  "page":    { "type": "over", "fg": "ink", "bg": "paper" },
  "show":    { "type": "display", "in": "page", "view": "Un-tone-mapped" },
  "png":     { "type": "write", "in": "show", "file": "\${out}", "depth": "uint8" } } }
EOF
for way in canny masks strokes; do
  case $way in
    canny) render graphs/canny.json --var plate="$PWD/graphs/plates/garden.####.exr" --var out="$scratch/whole.png" ;;
    masks) render "$scratch/masks.json" --var out="$scratch/whole.png" ;;
    strokes) render graphs/cleanup.json --var out="$scratch/whole.png" --set marked.fg=black ;;
  esac
  piece $way-eye 400 262
  piece $way-cat 806 440
  piece $way-roof 770 270
done

garden found-objects 480 400 --set 'sure.in=["objects"]' --set 'lines.in=["objects"]'
garden found-paints 480 400 --set 'lines.in=["sure"]'
garden found-all 480 400
garden thin-outlines 790 436 --set objects.thin=0 --set paints.thin=0
garden thin-middles 790 436
garden weight-angle 415 425 --set wide.normal=render:Normal --set 'wide.by_angle=[0.4,2]' --set 'wide.by_kind={}'
garden smooth-none 800 570 --set calm.tolerance=0
garden smooth-auto 800 570
garden smooth-abstract 800 570 --set calm.abstract=5
garden weight-even 415 425 --set 'wide.by_depth={"reference":7,"power":0}' --set 'wide.by_kind={}' --set wide.width=4
garden weight-kinds 415 425
garden weight-light 415 425 --set wide.map=sunny --set 'wide.by_map=[1.6,0.5]'
garden taper-none 850 560 --set tipped.start=0 --set tipped.end=0
garden taper-tips 850 560 --set tipped.start=20 --set tipped.end=30
garden taper-past 850 560 --set tipped.start=0 --set tipped.end=0 --set tipped.overshoot=10
render graphs/pencil.json --var out="$scratch/whole.png" --set first.amount=0 --set second.amount=0
piece wobble-none 830 420
render graphs/pencil.json --var out="$scratch/whole.png"
piece wobble-pencil 830 420
render graphs/pencil.json --var out="$scratch/whole.png" --set first.amount=2.5 --set second.amount=5
piece wobble-wild 830 420
