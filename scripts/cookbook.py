#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Keyline Authors
# SPDX-License-Identifier: Apache-2.0
"""Makes what docs/cookbook.md shows of its tasks:

    scripts/cookbook.py pictures    # docs/images/tasks, of the graphs that the page holds (after scripts/demo.sh)
    scripts/cookbook.py times       # its table of times at 4K, of all graphs (after scripts/bench.sh)

ROUNDS in the environment: how often each is timed (3).
"""

import os
import re
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PAGE = ROOT / "docs" / "cookbook.md"
IMAGES = ROOT / "docs" / "images"
BENCH = ROOT / "build" / "bench" / "bin"
BEGIN, END = "<!-- measured: begin -->", "<!-- measured: end -->"

# By the name in a graph: the frames that are shipped, how many copies each way make it 3840 × 2160, its beauty pass.
PLATES = {
    "street": (["0001", "0002"], 8, "ViewLayer.Combined"),
    "street_passes": (["0024"], 8, "ViewLayer.Combined"),
    "garden": (["0012"], 3, "hero.Combined"),
}


@dataclass
class Task:
    title: str
    graph: str  # its text
    picture: str

    def plate(self):
        return re.search(r"plates/(\w+)\.####\.exr", self.graph).group(1)

    def frame(self):
        return PLATES[self.plate()][0][0]


def tasks():
    """Those of the page that are a graph: one of graphs/ that the text begins with, or the whole one in it."""
    found = []
    for section in PAGE.read_text().split("\n### ")[1:]:
        title, _, text = section.partition("\n")
        shown = re.search(r"!\[.*\]\(images/(.*)\)", text)
        named = re.match(r"\n\[(graphs/\w+\.json)\]", text)
        held = re.search(r"```json\n(\{\n  \"keyline\".*?)```", text, re.S)
        if held:
            graph = held.group(1)
        elif named:
            graph = (ROOT / named.group(1)).read_text()
        else:
            continue
        found.append(Task(title, graph, shown.group(1) if shown else ""))
    return found


def render(keyline, task, folder):
    (folder / "graphs" / "task.json").write_text(task.graph)
    subprocess.run([keyline, "render", folder / "graphs" / "task.json", "--frames", task.frame(), "--progress", "none",
                    "--no-provenance"], check=True, stderr=subprocess.DEVNULL)


def scratch(plates):
    """A folder laid out as the repository, with these plates."""
    folder = Path(tempfile.mkdtemp())
    (folder / "graphs").mkdir()
    (folder / "graphs" / "plates").symlink_to(plates)
    for entry in (ROOT / "graphs").iterdir():
        if entry.name != "plates":
            (folder / "graphs" / entry.name).symlink_to(entry)
    return folder


def make_pictures():
    folder = scratch(ROOT / "graphs" / "plates")
    for task in tasks():
        if not task.picture.startswith("tasks/"):
            continue
        render(ROOT / "build" / "release" / "bin" / "keyline", task, folder)
        name = Path(task.picture)
        shutil.copyfile(folder / "out" / f"{name.stem}.{task.frame()}{name.suffix}", IMAGES / name)
    shutil.rmtree(folder)


def as_exr(graph):
    """Without what PNG and WebP cost: at this size they take longer to compress than all else together."""
    return re.sub(r'\.(png|webp)"', r'.\1.exr"', graph).replace(', "depth": "uint8"', "")


def make_plates(folder):
    for name, (frames, copies, _) in PLATES.items():
        for frame in frames:
            file = f"{name}.{frame}.exr"
            subprocess.run([BENCH / "bench_mosaic", ROOT / "graphs" / "plates" / file, str(copies), folder / file], check=True)


def timed(work):
    start = time.perf_counter()
    work()
    return time.perf_counter() - start


def measure(task, folder, rounds):
    """Its seconds, and their ratio to OpenEXR's reading and writing of the same plate's beauty pass: medians of rounds, in
    each of which the two run in turn.  One that is not counted goes first, so that files are in memory."""
    plate = folder / "graphs" / "plates" / f"{task.plate()}.{task.frame()}.exr"
    copy = [BENCH / "bench_exr_copy", plate, PLATES[task.plate()][2], folder / "copy.exr", str(os.cpu_count())]
    seconds, ratios = [], []
    for number in range(rounds + 1):
        least = timed(lambda: subprocess.run(copy, check=True))
        taken = timed(lambda: render(BENCH / "keyline", Task(task.title, as_exr(task.graph), ""), folder))
        if number:
            seconds.append(taken)
            ratios.append(taken / least)
    return statistics.median(seconds), statistics.median(ratios)


def make_times():
    rounds = int(os.environ.get("ROUNDS", "3"))
    plates = Path(tempfile.mkdtemp())
    make_plates(plates)
    folder = scratch(plates)
    lines = ["| task | seconds | of OpenEXR's read and write |", "| --- | --- | --- |"]
    for task in tasks():
        seconds, ratio = measure(task, folder, rounds)
        lines.append(f"| {task.title} | {seconds:.2f} | {ratio:.2f} |")
        print(lines[-1], flush=True)
    page = PAGE.read_text()
    before, after = page[: page.index(BEGIN) + len(BEGIN)], page[page.index(END):]
    PAGE.write_text(before + "\n\n" + "\n".join(lines) + "\n\n" + after)
    shutil.rmtree(folder)
    shutil.rmtree(plates)


if __name__ == "__main__":
    modes = {"pictures": make_pictures, "times": make_times}
    if len(sys.argv) != 2 or sys.argv[1] not in modes:
        sys.exit(__doc__)
    modes[sys.argv[1]]()
