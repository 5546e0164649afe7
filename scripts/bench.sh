#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Keyline Authors
# SPDX-License-Identifier: Apache-2.0
# Installs what Keyline is compared with, builds the benchmarks, runs them all, prints the tables and puts them
# into docs/performance.md.  Takes an HD plate with a layer ViewLayer.Combined; without one it makes one of
# graphs/plates.  ROUNDS in the environment: how often each is run (5).
set -euo pipefail
plate=${1:+$(realpath "$1")}
cd "$(dirname "$0")/.."
rounds=${ROUNDS:-5}
build=build/bench
results=$build/results

scripts/install-packages.sh libbenchmark-dev gnuplot-nox python3
for peer in libopencv-imgproc-dev blender libvips-tools openimageio-tools; do
  scripts/install-packages.sh $peer || echo "left out, can't be installed: $peer"
done

cmake --preset release -B $build -DKEYLINE_TESTS=OFF -DKEYLINE_BENCHMARKS=ON >/dev/null
cmake --build $build

small=graphs/plates/street.0001.exr
rm -rf $results
mkdir -p $results docs/images
if [ -z "$plate" ]; then
  plate=$results/street-4x4.exr
  $build/bin/bench_mosaic $small 4 "$plate"
fi
$build/bin/bench_jobs "$plate" $small $results $results/runs.csv "$rounds"
large=$results/plate-2x2-of-$(basename "$plate" .exr).exr  # that bench_jobs made
if [ -x $build/bin/bench_opencv ]; then
  $build/bin/bench_opencv $large $results/runs.csv $((4 * rounds + 1))
else
  echo "left out, not installed: OpenCV"
fi
$build/bin/bench_kernels $large --benchmark_min_time=0.1 --benchmark_repetitions="$rounds" \
  --benchmark_enable_random_interleaving=true --benchmark_out=$results/kernels.json >/dev/null

python3 bench/report.py $results/runs.csv $results/kernels.json $build/bin/keyline "$plate"
gnuplot bench/plots.gp
rm -f $results/*.exr $results/*.v
