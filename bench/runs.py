# SPDX-FileCopyrightText: 2026 The Keyline Authors
# SPDX-License-Identifier: Apache-2.0
"""What was measured, read and summed up: medians, and ratios of runs that were made in turn."""

import csv
import json
import re
from statistics import median


class Runs:
    """The runs of bench_jobs and bench_opencv, and the repetitions of bench_kernels as an experiment `kernel`,
    whose x is the number of threads."""

    def __init__(self, runs_csv, kernels_json):
        self.series = {}  # (experiment, what, x) → {round: (seconds, MiB)}
        with open(runs_csv, newline="") as file:
            for row in csv.DictReader(file):
                self._add(row["experiment"], row["what"], float(row["x"]), int(row["round"]),
                          float(row["seconds"]), float(row["mib"]))
        with open(kernels_json) as file:
            repetitions = [b for b in json.load(file)["benchmarks"] if b["run_type"] == "iteration"]
        for b in sorted(repetitions, key=lambda b: (b["family_index"], b["per_family_instance_index"])):
            what, threads = re.match(r"(.*)/threads:(\d+)/", b["name"]).groups()
            self._add("kernel", what, float(threads), b["repetition_index"], b["real_time"] / 1e3, 0.0)

    def _add(self, experiment, what, x, index, seconds, mib):
        self.series.setdefault((experiment, what, x), {})[index] = (seconds, mib)

    def of(self, experiment):
        """Its series in the order in which they were measured."""
        return [key for key in self.series if key[0] == experiment]

    def has(self, *key):
        return key in self.series

    def all_seconds(self, *key):
        return [seconds for seconds, _ in self.series[key].values()]

    def seconds(self, *key):
        return median(self.all_seconds(*key))

    def mib(self, *key):
        return max(m for _, m in self.series[key].values())

    def ratios(self, a, b, scale=1.0):
        """a's time over b's, times scale, of each round."""
        one, other = self.series[a], self.series[b]
        return [scale * one[i][0] / other[i][0] for i in sorted(one.keys() & other.keys())]

    def write_medians(self, file):
        with open(file, "w", newline="") as out:
            writer = csv.writer(out, lineterminator="\n")
            writer.writerow(["experiment", "what", "x", "seconds", "mib"])
            for key in self.series:
                experiment, what, x = key
                writer.writerow([experiment, what, f"{x:g}" if x < 1e5 else f"{x:.0f}",
                                 f"{self.seconds(*key):.5f}", f"{self.mib(*key):.0f}"])
