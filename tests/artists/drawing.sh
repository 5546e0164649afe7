# SPDX-FileCopyrightText: 2026 The Keyline Authors
# SPDX-License-Identifier: Apache-2.0
# For the tests beside it, which set `keyline` and `sources` and stand in an empty folder: the lines of the garden as
# object.svg in layers by object, split.svg in layers by kind with one width a path, and page.png as
# `draw` has them, as light as the paper that is left, as these programs mix.  Takes more options for `keyline render`.

draw_the_garden() {
  cat >garden.json <<END
{
  "keyline": 1,
  "nodes": {
    "render": { "type": "read", "file": "$sources/graphs/plates/garden.0012.exr" },
    "lines":  { "type": "strokes_of_passes", "passes": "render" },
    "pens":   { "type": "weight", "in": "lines", "width": 4, "by_kind": { "crease": 0.4 } },
    "tips":   { "type": "taper", "in": "pens", "start": 20, "end": 40 },
    "object": { "type": "svg", "in": "tips", "file": "object.svg", "layers": "object" },
    "split":  { "type": "svg", "in": "tips", "file": "split.svg", "width": "split" },
    "ink":    { "type": "draw", "in": "tips" },
    "paper":  { "type": "constant", "color": [1, 1, 1, 1], "like": "render" },
    "page":   { "type": "over", "fg": "ink", "bg": "paper" },
    "png":    { "type": "write", "in": "page", "file": "page.png", "depth": "uint8" }
  }
}
END
  "$keyline" render garden.json --progress none "$@"
}

fail() {
  echo "FAILED: $*"
  exit 1
}
