# SPDX-FileCopyrightText: 2026 The Keyline Authors
# SPDX-License-Identifier: Apache-2.0
"""The targets: what each is, and how it stands."""

from dataclasses import dataclass, field
from statistics import median

KEYLINE, OPENEXR = "Keyline", "OpenEXR read + write"
STROKES = "contours, trace, chain, smooth, weight, draw"
HD, UHD2 = 1920.0 * 1080, 7680.0 * 4320


@dataclass
class Target:
    number: int
    what: str
    limits: list  # the last is the goal, those before are on the way; none: to compare with
    values: list = field(default_factory=list)  # of each round; empty: not measured
    at_least: bool = False
    unit: str = ""

    def value(self):
        return median(self.values)

    def _keeps(self, limit):
        return self.value() >= limit if self.at_least else self.value() <= limit

    def verdict(self):
        if not self.values:
            return "not measured"
        if not self.limits:
            return ""
        if self._keeps(self.limits[-1]):
            return "met"
        return "first step met" if self._keeps(self.limits[0]) else "**missed**"

    def row(self):
        sign = "≥" if self.at_least else "≤"
        limits = ", then ".join(f"{limit:g}" for limit in self.limits)
        value = span = "–"
        if self.values:
            digits = 0 if self.unit else 2
            value = f"{self.value():.{digits}f}{self.unit}"
            span = f"{min(self.values):.{digits}f} – {max(self.values):.{digits}f}"
        target = f"{sign} {limits}{self.unit}" if self.limits else ""
        return [str(self.number), self.what, f"**{value}**", span, target, self.verdict()]


def _ratios(runs, a, b, scale=1.0):
    return runs.ratios(a, b, scale) if runs.has(*a) and runs.has(*b) else []


def _edges(runs):
    for threads in sorted(x for _, what, x in runs.of("edges") if what == KEYLINE):
        yield Target(2, f"edges of a plane in memory, 4K, against OpenCV's of bytes, {threads:g} "
                        f"thread{'s' if threads > 1 else ''}", [1.5, 1.0],
                     _ratios(runs, ("edges", KEYLINE, threads), ("edges", "OpenCV", threads)))


def _memory(runs):
    for what, limit in ((KEYLINE, 512), (KEYLINE + " --memory 384M", 384), (KEYLINE + " --memory 256M", 256)):
        title = what.removeprefix(KEYLINE).strip()
        key = ("size", what, UHD2)
        yield Target(3, f"peak memory at 8K, {f'`{title}`' if title else 'no option given'}", [limit],
                     [runs.mib(*key)] if runs.has(*key) else [], unit=" MiB")


def _sequences(runs):
    for name in ("HD", "small"):
        frames = max((x for _, _, x in runs.of(f"sequence {name}")), default=1.0)
        yield Target(6, f"a frame of a sequence of {frames:g}, against one in its own process, {name}", [0.9],
                     _ratios(runs, (f"sequence {name}", KEYLINE, frames), (f"sequence {name}", KEYLINE, 1.0),
                             1 / frames))


def _dilations(runs):
    for name, limit in (("square", 4), ("disk", 25), ("diamond", 25)):
        for mask in ("", ", mask"):
            yield Target(8, f"dilate {name}{', a mask of two values' if mask else ''}, radius 50 against 2",
                         [4 if mask else limit],
                         _ratios(runs, ("kernel", f"dilate {name} 50{mask}", 1.0),
                                 ("kernel", f"dilate {name} 2{mask}", 1.0)))


def _strokes(runs):
    key = ("kernel", STROKES, 1.0)
    yield Target(9, f"from passes in memory to a drawing, 4K, one thread: {STROKES}", [150],
                 [1e3 * s for s in runs.all_seconds(*key)] if runs.has(*key) else [], unit=" ms")
    for threads in sorted(x for _, what, x in runs.of("toon") if what == KEYLINE):
        yield Target(10, f"the toon job with strokes at 4K, against OpenEXR's read + write, {threads:g} "
                         f"thread{'s' if threads > 1 else ''}", [0.6, 0.5],
                     _ratios(runs, ("toon", KEYLINE, threads), ("toon", OPENEXR, threads)))


def targets(runs):
    return [
        Target(1, "the job at 4K, against OpenEXR's read + write", [0.6, 0.5],
               _ratios(runs, ("job", KEYLINE, 0.0), ("job", OPENEXR, 0.0))),
        *_edges(runs),
        *_memory(runs),
        Target(4, "two threads against one, the job at 4K", [1.9],
               _ratios(runs, ("threads", KEYLINE, 1.0), ("threads", KEYLINE, 2.0)), at_least=True),
        Target(4, "what the machine gives: two processes of one thread at once, against one after the other", [],
               _ratios(runs, ("threads", KEYLINE, 1.0), ("threads", KEYLINE + ", two at once", 1.0), 2.0)),
        Target(5, "time per pixel at 8K against HD", [1.1],
               _ratios(runs, ("size", KEYLINE, UHD2), ("size", KEYLINE, HD), HD / UHD2)),
        *_sequences(runs),
        Target(7, "`keyline check` of a small graph", [30],
               [1e3 * s for s in runs.all_seconds("check", "a graph of OpenEXR files", 0.0)], unit=" ms"),
        *_dilations(runs),
        *_strokes(runs),
    ]
