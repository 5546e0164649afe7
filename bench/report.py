#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Keyline Authors
# SPDX-License-Identifier: Apache-2.0
"""Prints what was measured as Markdown and puts it into docs/performance.md, between its two markers:

    report.py RUNS.csv KERNELS.json KEYLINE PLATE.exr
"""

import os
import platform
import re
import subprocess
import sys
from pathlib import Path

from runs import Runs
from targets import KEYLINE, OPENEXR, targets

DOCS = Path(__file__).resolve().parent.parent / "docs"
BEGIN, END = "<!-- measured: begin -->", "<!-- measured: end -->"
PEERS = ["blender", "libopencv-imgproc406", "libvips42", "openimageio-tools"]


def output(*command):
    try:
        return subprocess.run(command, capture_output=True, text=True, check=True).stdout.strip()
    except (OSError, subprocess.CalledProcessError):
        return ""


def value_in(file, key):
    return re.search(rf"^{key}\s*[:=]\s*\"?([^\"\n]*)", Path(file).read_text(), re.M).group(1).strip()


def circumstances(keyline, plate):
    versions = [line.split() for line in output(keyline, "--version").splitlines()]
    peers = [f"{name} {version}" for name in PEERS
             if (version := output("dpkg-query", "-W", "-f", "${source:Upstream-Version}", name))]
    memory = int(value_in("/proc/meminfo", "MemTotal").split()[0]) / 2**20
    return [
        f"- {value_in('/proc/cpuinfo', 'model name')}, {os.cpu_count()} cores, {memory:.0f} GiB, "
        f"{value_in('/etc/os-release', 'PRETTY_NAME')}, Linux {platform.release()}",
        f"- {output('c++', '--version').splitlines()[0]}; " + ", ".join(" ".join(v) for v in versions),
        "- compared with " + ", ".join(peers) if peers else "- no other program is installed",
        f"- the HD plate: {Path(plate).name}, {Path(plate).stat().st_size / 1e6:.0f} MB; 4K and 8K are mosaics of it",
    ]


def table(head, rows):
    lines = [head, ["---"] * len(head), *rows]
    return ["| " + " | ".join(line) + " |" for line in lines]


def seconds(s):
    return f"{s:.2f} s" if s >= 1 else f"{1e3 * s:.0f} ms" if s >= 0.1 else f"{1e3 * s:.1f} ms"


def job_table(runs):
    base = runs.seconds("job", OPENEXR, 0.0)
    return table(["the job at 4K, whole processes", "time", "against OpenEXR", "peak memory"],
                 [[what, seconds(s := runs.seconds(*key)), f"{s / base:.2f}", f"{runs.mib(*key):.0f} MiB"]
                  for key in runs.of("job") for what in [key[1]]])


def toon_table(runs):
    return table(["the toon job at 4K, threads", "Keyline", "peak memory", OPENEXR, "peak memory"],
                 [[f"{x:g}", *(text for what in (KEYLINE, OPENEXR)
                               for text in (seconds(runs.seconds("toon", what, x)),
                                            f"{runs.mib('toon', what, x):.0f} MiB"))]
                  for x in sorted({x for _, _, x in runs.of("toon")})])


def size_table(runs):
    sizes = sorted({x for _, _, x in runs.of("size")})
    names = list(dict.fromkeys(what for _, what, _ in runs.of("size")))
    return table(["pixels"] + names,
                 [[f"{x / 1e6:.2f} M"] + [f"{seconds(runs.seconds('size', n, x))}, {runs.mib('size', n, x):.0f} MiB"
                                          for n in names] for x in sizes])


def threads_table(runs):
    return table(["threads, 4K", "Keyline", "peak memory", OPENEXR],
                 [[f"{x:g}", seconds(runs.seconds("threads", KEYLINE, x)),
                   f"{runs.mib('threads', KEYLINE, x):.0f} MiB", seconds(runs.seconds("threads", OPENEXR, x))]
                  for x in sorted({x for _, what, x in runs.of("threads") if what == OPENEXR})])


def sigma_table(runs):
    keys = runs.of("sigma")
    return table(["sigma of the blur, 4K"] + [f"{x:g}" for _, _, x in keys],
                 [["the job"] + [seconds(runs.seconds(*key)) for key in keys]])


def small_table(runs):
    keys = [key for name in ("check", "sequence HD", "sequence small") for key in runs.of(name)]
    return table(["whole process", "frames", "time", "peak memory"],
                 [[f"`keyline check`: {what}" if name == "check" else name, f"{x:g}",
                   seconds(runs.seconds(name, what, x)), f"{runs.mib(name, what, x):.0f} MiB"]
                  for name, what, x in keys])


def kernel_table(runs):
    threads = sorted({x for _, _, x in runs.of("kernel")})
    names = list(dict.fromkeys(what for _, what, _ in runs.of("kernel")))
    return table(["nodes on a picture in memory, 4K"] + [f"{t:g} thread{'s' if t > 1 else ''}" for t in threads],
                 [[name] + [seconds(runs.seconds("kernel", name, t)) if runs.has("kernel", name, t) else "–"
                            for t in threads] for name in names])


def report(runs, keyline, plate):
    parts = [circumstances(keyline, plate),
             table(["#", "what", "measured", "least – most", "target", ""], [t.row() for t in targets(runs)]),
             job_table(runs), toon_table(runs), threads_table(runs), size_table(runs), sigma_table(runs), small_table(runs),
             kernel_table(runs)]
    return "\n\n".join("\n".join(part) for part in parts)


def replace_measured(file, text):
    page = file.read_text()
    if page.count(BEGIN) != 1 or page.count(END) != 1:
        sys.exit(f"{file}: must have the lines {BEGIN} and {END} once each")
    before, rest = page.split(BEGIN)
    file.write_text(f"{before}{BEGIN}\n\n{text}\n\n{END}{rest.split(END)[1]}")


def main(runs_csv, kernels_json, keyline, plate):
    runs = Runs(runs_csv, kernels_json)
    runs.write_medians(DOCS / "performance.csv")
    text = report(runs, keyline, plate)
    replace_measured(DOCS / "performance.md", text)
    print(text)


if __name__ == "__main__":
    main(*sys.argv[1:])
