#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Keyline Authors
# SPDX-License-Identifier: Apache-2.0
"""How good lines are that are found in three ways, as Markdown for docs/lines.md: by Canny on the picture, by masks of ids,
normals and depth, and as strokes; on scenes whose lines are known, on the street, and on the garden against the lines of its
meshes.

    scripts/line_table.py [GARDEN_SHOT STREET_SHOT]

The shots are too large to come with Keyline: say where their frames lie, as FOLDER/garden.####.exr and
FOLDER/street.####.exr.  Without them there are no rows over frames.  Wants Keyline built with its tests.  KEYLINE and
KEYLINE_SCENES name the programs where they are not in build/release/bin.
"""

import glob
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
KEYLINE = os.environ.get("KEYLINE", ROOT / "build/release/bin/keyline")
SCENES = os.environ.get("KEYLINE_SCENES", ROOT / "build/release/bin/keyline_scenes")
WAYS = ["canny", "masks", "strokes"]

# Masks are pixels: lines along their crests make them comparable.
CREST = {"type": "trace", "in": "mask", "mode": "ridge", "sigma": 0.7, "low": 0.04, "high": 0.12, "kind": "outline"}


def canny(grey):
    return {
        "grey": grey,
        "mask": {"type": "canny", "in": "grey", "sigma": 1.8, "low": 0.02, "high": 0.07},
        "crest": CREST,
        "lines": {"type": "chain", "in": ["crest"], "min_length": 7},
    }


GREY = {"type": "ycolor", "in": "render:Combined", "clamp": True, "gamma": 2.2}

MASKS = {
    "objects": {"type": "idedge", "in": "render", "layer": "CryptoObject", "depth": "render:Depth"},
    "turn": {"type": "gradient", "in": "render:Normal", "operator": "sobel"},
    "creases": {"type": "threshold", "in": "turn:magnitude", "low": 0.34, "high": 0.62},
    "folds": {"type": "depth_lines", "depth": "render:Depth", "low": 0.012, "high": 0.028},
    "inner": {"type": "math", "in": "creases", "op": "max", "b": "folds"},
    "mask": {"type": "math", "in": "inner", "op": "max", "b": "objects:edge"},
    "crest": CREST,
    "lines": {"type": "chain", "in": ["crest"], "min_length": 7},
}

# Of scenes without materials only outlines are known.
OUTLINES = {
    "objects": {"type": "contours", "in": "render", "layer": "CryptoObject", "depth": "render:Depth"},
    "lines": {"type": "smooth", "in": "objects"},
}
OUTLINE_MASKS = {
    "objects": MASKS["objects"],
    "mask": {"type": "math", "in": "objects:edge", "op": "max", "value": 0},
    "crest": CREST,
    "lines": MASKS["lines"],
}


def strokes(graph):
    """The lines of a shipped graph, called `calm`, before it weighs them."""
    nodes = json.loads(without_comments((ROOT / "graphs" / graph).read_text()))["nodes"]
    return {name: nodes[name] for name in needed(nodes, "calm") - {"render"}}


def without_comments(text):
    return "\n".join(line for line in text.split("\n") if not line.lstrip().startswith("//"))


def needed(nodes, name):
    found, open_ = set(), [name]
    while open_:
        one = open_.pop()
        if one in found or one not in nodes:
            continue
        found.add(one)
        for value in nodes[one].values():
            values = value if isinstance(value, list) else [value]
            open_ += [v.split(":")[0] for v in values if isinstance(v, str)]
    return found


def run(*command):
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True, check=False)
    if done.returncode:
        sys.exit(f"{' '.join(map(str, command))}\n{done.stdout}{done.stderr}")
    return done.stdout


# Strokes as an even line; masks are pixels already.
AS_INK = {
    "wide": {"type": "weight", "width": 2, "units": "px", "min": 1, "smooth": 0},
    "drawn": {"type": "draw", "in": "wide"},
}


def find(folder, name, plate, nodes, frames, last="lines", missing=False):
    """Renders the lines of some frames to FOLDER/NAME.####.json, and how they are drawn to .exr."""
    read = {"type": "read", "file": str(plate)} | ({"missing": "black"} if missing else {})
    out = {"type": "strokes_write", "in": last, "file": f"{folder}/{name}.####.json"}
    drawn = {} if "mask" in nodes else {"wide": AS_INK["wide"] | {"in": last}, "drawn": AS_INK["drawn"]}
    mask = "mask" if "mask" in nodes else "drawn:A"
    picture = {"type": "write", "in": mask, "file": f"{folder}/{name}.####.exr"}
    graph = {"keyline": 1, "nodes": {"render": read} | nodes | drawn | {"out": out, "picture": picture}}
    (folder / f"{name}.json").write_text(json.dumps(graph))
    run(KEYLINE, "render", folder / f"{name}.json", "--frames", frames, "--progress", "none")


def measure(*arguments):
    return json.loads(run(KEYLINE, "measure", *arguments, "--json"))


def number(value, digits):
    return f"{value:.{digits}f}"


def percent(value, digits=0):
    return f"{100 * value:.{digits}f} %"


def table(title, rows, wanted):
    print(f"| {title} | Canny | masks | strokes | wanted |\n| --- | --- | --- | --- | --- |")
    for name, cells in rows:
        print(f"| {name} | {' | '.join(cells)} | {wanted.get(name, '')} |")
    print()


PLACE, TRUE, DRAWN = "off the true line, robust / rms", "of what is drawn is true", "of the true lines are drawn"
CLOSED, DOUBLES, LOOSE = "closed outlines", "doubles", "loose ends in 1000 pixels"
RIPPLE, EVEN, CURVES = "ripple, in pixels", "drawn width spreads by", "curves in 100 pixels"
SWIM, DRIFT, POPS, LOST = "swim, in pixels", "drift from frame to frame, in pixels", "pops", "ink lost from frame to frame"
SHOT = "drift from the first frame to the last"
FLICKER = "pixels that flicker"
WANTED = {
    CLOSED: "98 %",
    DOUBLES: "1 %",
    LOOSE: "2",
    RIPPLE: "0.05",
    EVEN: "8 % at 640, 4 % at HD",
    CURVES: "2",
    SWIM: "0.05, `steady` 0.03",
    DRIFT: "0.15",
    POPS: "0.3 %",
    LOST: "0.7 %",
}


def accuracy_rows(of):
    return [
        (PLACE, [f"{number(m['robust'], 2)} / {number(m['rms'], 2)}" for m in of]),
        (TRUE, [percent(m["precision"]) for m in of]),
        (DRAWN, [percent(m["recall"]) for m in of]),
    ]


def form_rows(of):
    def closed(f):
        return f"{f['closed']} of {f['objects']}" if f["objects"] else "–"

    return [
        (CLOSED, [closed(f) for f in of]),
        (DOUBLES, [percent(f["doubles"], 1) for f in of]),
        (LOOSE, [number(1000 * f["looseEnds"] / f["pixels"], 1) for f in of]),
        (RIPPLE, [number(f["ripple"], 3) for f in of]),
        (EVEN, [percent(f["drawnWidthSpread"], 1) if f["drawnWidthPixels"] else "–" for f in of]),
        (CURVES, [number(100 * f["curves"] / f["pixels"], 1) for f in of]),
    ]


def motion_rows(of):
    return [
        (SWIM, [number(m["swim"], 3) for m in of]),
        (DRIFT, [number(m["drift"], 3) for m in of]),
        (SHOT, [number(m["shotDrift"], 3) for m in of]),
        (POPS, [percent(m["pops"], 2) for m in of]),
        (LOST, [percent(m["lostInk"], 1) for m in of]),
        (FLICKER, [percent(m["flicker"]) for m in of]),
    ]


def scenes(folder):
    run(SCENES, folder)
    for name in ("shapes", "balls", "wires"):
        ways = {
            "canny": canny({"type": "math", "in": "render:Combined", "op": "power", "value": 0.4545}),
            "masks": OUTLINE_MASKS,
            "strokes": OUTLINES,
        }
        found = []
        for way, nodes in ways.items():
            find(folder, f"{name}-{way}", folder / f"{name}.exr", nodes, "1")
            drawn = folder / f"{name}-{way}.0001.exr"
            found.append(measure(folder / f"{name}-{way}.0001.json", folder / f"{name}.json", "--drawn", drawn))
        table(
            f"{name}, 64 samples",
            accuracy_rows([m["accuracy"] for m in found]) + form_rows([m["form"] for m in found]),
            WANTED | {PLACE: "– / 0.05"},
        )


def plate(folder, name, file, frame, graph, truth, shot):
    ways = {"canny": canny(GREY), "masks": MASKS, "strokes": strokes(graph)}
    last = {"canny": "lines", "masks": "lines", "strokes": "calm"}
    found, moving = [], []
    for way, nodes in ways.items():
        find(folder, f"{name}-{way}", file, nodes, frame, last[way])
        drawing = folder / f"{name}-{way}.{int(frame):04d}.json"
        found.append(measure(drawing, *([truth] if truth else []), "--drawn", drawing.with_suffix(".exr")))
    rows = accuracy_rows([m["accuracy"] for m in found]) if truth else []
    wanted = WANTED | {PLACE: "0.03 / 0.08, outlines", TRUE: "95 %"}
    table(name, rows + form_rows([m["form"] for m in found]), wanted)
    if not shot:
        return
    frames = f"1-{len(glob.glob(shot.replace('####', '[0-9][0-9][0-9][0-9]')))}"
    for way, nodes in (ways | {"steady": ways["strokes"]}).items():
        before = last.get(way, "still")
        still = {"still": {"type": "steady", "in": "calm", "vector": "render:Vector"}} if way == "steady" else {}
        find(folder, f"{name}-shot-{way}", shot, nodes | still, frames, before, missing=way == "steady")
        files = f"{folder}/{name}-shot-{way}.####"
        moving.append(
            measure(f"{files}.json", "--frames", frames, "--vector", f"{shot}:Vector", "--drawn", f"{files}.exr")
        )
    print(f"| {name}, frames {frames} | Canny | masks | strokes | strokes, `steady` | wanted |")
    print("| --- | --- | --- | --- | --- | --- |")
    for row, cells in motion_rows(moving):
        print(f"| {row} | {' | '.join(cells)} | {WANTED.get(row, '')} |")
    print()


def main():
    shots = sys.argv[1:]
    if len(shots) not in (0, 2):
        sys.exit(__doc__)
    garden, street = (os.path.abspath(s) for s in shots) if shots else (None, None)
    plates = ROOT / "graphs/plates"
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch)
        scenes(folder)
        plate(folder, "street", plates / "street_passes.####.exr", "24", "ink.json", None, street)
        plate(folder, "garden", plates / "garden.####.exr", "12", "garden.json", plates / "garden_lines.0012.json", garden)


main()
