#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# benchmark_scaling.sh BIN OUT [--quick]: what tools/benchmark.sh --scaling does once it has built.
# Simulates one pair of scans per size, the lidar firing more or less often, and times each on its
# own, so that its memory is its own; then landscapes of more and more poses on the smallest.
set -euo pipefail
bin=$1 out=$2 quick=${3:-}
cd "$(dirname "$0")/.."
scene=straight_street
steps=(2.1 0.665 0.21 0.0665 0.021)  # Degrees: about 1e4, 3e4, 1e5, 3e5 and 1e6 points.
poses=10,30,100,300,1000,3000,10000
repetitions=3
document=docs/scaling.md picture=docs/images/scaling.svg
if [ -n "$quick" ]; then
  steps=(2.1 0.21) poses=10,100 repetitions=1
  document=$out/scaling.md picture=$out/scaling.svg
fi
rm -rf "$out"
mkdir -p "$out"

measure() { # STEP NAME FLAGS...
  local step=$1 name=$2
  shift 2
  "$bin/icpscape_scaling" --kitti_root="$out/scans_$step" --sequence="$scene" --frame=2 "$@" \
    --benchmark_repetitions="$repetitions" --benchmark_min_time=0.01 \
    --benchmark_out="$out/$name.json" --benchmark_out_format=json >"$out/$name.log" 2>&1 ||
    { code=$?; tail -n 3 "$out/$name.log" >&2; exit "$code"; }
}
for step in "${steps[@]}"; do
  echo "benchmark: $scene, a firing every $step degrees"
  "$bin/icpscape-simulate" --scene="$scene" --azimuth_step_deg="$step" --out="$out/scans_$step" \
    >"$out/simulate.log"
  measure "$step" "points_$step"
done
echo "benchmark: $poses poses"
measure "${steps[0]}" poses --poses="$poses" '--benchmark_filter=landscape'
rm -r "$out"/scans_*

tools/plot_scaling.py "$out"/points_*.json --poses "$out/poses.json" --picture "$picture" \
  --document "$document" --command "tools/benchmark.sh --scaling${quick:+ --quick}"
