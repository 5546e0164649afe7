#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Keyline Authors
# SPDX-License-Identifier: Apache-2.0
# Makes docs/gallery.md and its pictures: every graph of graphs/ on the plate beside them, next to the pass that
# it should be held against.  Wants Keyline built (scripts/demo.sh).
set -euo pipefail
cd "$(dirname "$0")/.."
frame=24
images=docs/images

render() {
  build/release/bin/keyline render "graphs/$1.json" --frames $frame --progress none --no-provenance \
    --var plate="$PWD/graphs/plates/street_passes.####.exr" "${@:2}"
}

about() { sed -n 's/^ *"about": "\(.*\)",$/\1/p' "graphs/$1.json" | head -n 1; }

# graph, the pass beside it, and what to look for
row() {
  echo "## $1"
  echo
  echo "$(about "$1"). [graphs/$1.json](../graphs/$1.json)"
  echo
  echo "| $1 | the pass: $2 |"
  echo "| --- | --- |"
  echo "| ![$1](images/$1.png) | ![$2](images/pass-$2.png) |"
  echo
  echo "$3"
  echo
}

# graph, and what to look for
still() {
  echo "## $1"
  echo
  echo "$(about "$1"). [graphs/$1.json](../graphs/$1.json)"
  echo
  echo "![$1](images/$1.webp)"
  echo
  echo "$2"
  echo
}

hand() {
  still "$1" "$2 Six frames of a moving shot, with lines that \`steady\` holds together:"
  echo "![$1 in motion](images/$1-frames.webp)"
  echo
}

render passes --var out="$PWD/$images/pass"
for pass in beauty albedo light normals near; do
  mv "$images/pass/$pass.00$frame.png" "$images/pass-$pass.png"
done
rmdir $images/pass
for graph in canny saito_takahashi decaudin cel_matte cel_plastic cel_metallic gooch phong brick_and_wood hatch ink; do
  render $graph --var out="$PWD/$images/$graph.png"
done
scratch=$(mktemp -d)
trap 'rm -r "$scratch"' EXIT
render lines_over_beauty --var look="$PWD/$images/lines_over_beauty.png" --var out="$scratch/lines.exr"
for graph in garden poster; do
  build/release/bin/keyline render graphs/$graph.json --frames 12 --progress none --no-provenance \
    --var out="$PWD/$images/$graph.png"
done
for graph in night cleanup brush pencil technical comic; do
  build/release/bin/keyline render "graphs/$graph.json" --frames 12 --progress none --no-provenance \
    --var out="$PWD/$images/$graph.webp"
done
render toon --var look="$PWD/$images/toon.png" --var out="$scratch/toon.exr"

{
  echo "# Gallery"
  echo
  echo "Every graph that comes with Keyline, on the plate that comes with it, beside the pass that it should be held"
  echo "against. Made by \`scripts/gallery.sh\`."
  echo
  echo "## garden"
  echo
  echo "$(about garden). [graphs/garden.json](../graphs/garden.json)"
  echo
  echo "![garden](images/garden.png)"
  echo
  echo "## poster"
  echo
  echo "$(about poster). [graphs/poster.json](../graphs/poster.json)"
  echo
  echo "![poster](images/poster.png)"
  echo
  still night "The tones, the lines and the rim of moonlight are groups: a node each."
  hand cleanup "Every line closed and of one width, as painters want it; blue is where the shadow will end."
  hand brush "The side away from the sun swells, ends lift, and what is painted dark is filled."
  hand pencil "Each line twice, by a hand that looks for it; the hatching does not move when the lines do."
  hand technical "What stands before nothing is heavy, what is inside is fine."
  hand comic "One knob makes it, 'map': lines are four times as wide in the shade as in the sun."
  row toon beauty "Shadows are where the render has them, in two flat tones; each outline is closed, and its ink takes \
after the object that it belongs to."
  row ink albedo "Strokes: each line has one width along its way, grows thin where it fades, and ends in a tip where it \
just ends."
  row lines_over_beauty beauty "The same detector on a softened picture; the lines are made bold and laid over the render."
  row canny beauty "Texture is drawn like shape, as the detector sees grey alone: the mortar, the grain of the floor, \
the rims of shadows."
  row saito_takahashi near "No line on the floor, however flat it runs away from the camera: on a plane the second \
derivative of 1/Z is zero. Where objects touch the ground the depth only bends, and the line is thin."
  row decaudin normals "A line wherever the normals turn at once; the edges of the door, which turn with the wall's, \
come from the depth."
  row cel_matte albedo "The tones meet where the surface turns from the sun."
  row cel_plastic albedo "The highlight is in the colours of the surface and the light."
  row cel_metallic albedo "The highlight is white, and smaller."
  row gooch albedo "Nothing falls to black: what faces away is cool."
  row phong beauty "The same lights, without the light that bounces and without shadows: compare the shape of the \
highlights."
  row brick_and_wood albedo "The patterns lie on the surfaces' coordinates, so they keep their perspective, and grow \
soft with the distance instead of sparkling."
  row hatch light "Strokes widen as the light fades, and cross where it is darkest."
} > docs/gallery.md
