#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Compares icpscape with PCL, nanoflann, Open3D and loops by hand, and prints the ratios of times:
#   tools/benchmark.sh [--kitti_root=DIR]             on simulated scenes and KITTI 00/95 and 07/4;
#                                                     writes docs/benchmarks.md
#   tools/benchmark.sh [--kitti_root=DIR] --quick     the same roughly, only into out/benchmarks
#   tools/benchmark.sh --scaling [--quick]            cost over points, poses and threads; writes
#                                                     docs/scaling.md and its picture
# Exit code 3: two sides computed different answers.
set -euo pipefail

kitti_root='' quick='' scaling=''
for option in "$@"; do
  case "$option" in
    --kitti_root=*) kitti_root=$(realpath "${option#*=}") ;;
    --quick) quick=yes ;;
    --scaling) scaling=yes ;;
    *)
      echo "benchmark.sh: unknown option $option; expected --kitti_root=DIR, --quick or --scaling" >&2
      exit 1
      ;;
  esac
done
cd "$(dirname "$0")/.."
tools/setup.sh --with-benchmarks
tools/build.sh benchmarks benchmarks
bin=build/benchmarks/bin
out=out/benchmarks${quick:+/quick}
if [ -n "$scaling" ]; then
  exec tools/benchmark_scaling.sh "$bin" "$out/scaling" ${quick:+--quick}
fi

rm -rf "$out/pairs"
mkdir -p "$out/pairs"
settings=(--rounds=5)
levels=()  # Those below the one that runs by itself.
grep -qw avx2 /proc/cpuinfo && levels+=(baseline)
grep -qw avx512vl /proc/cpuinfo && levels+=(avx2)
[ -n "$quick" ] && settings=(--rounds=2 --naive_poses=1 --by_hand_poses=4)

status=0
run() { # NAME FLAGS...: all rows, and at the lower SIMD levels those that depend on them most.
  local name=$1 level
  shift
  echo "benchmark: $*"
  measure "$out/pairs/$name.json" "$@"
  for level in "${levels[@]}"; do
    ICPSCAPE_SIMD=$level measure "$out/pairs/$name.$level.json" "$@" \
      '--benchmark_filter=nearest/(identity|true)/t1/(nanoflann|pcl)/|normals/t1/'
  done
}
measure() { # FILE FLAGS...
  local file=$1 code=0
  shift
  "$bin/icpscape_benchmarks" "$@" "${settings[@]}" --benchmark_out="$file" \
    --benchmark_out_format=json >"${file%.json}.log" 2>&1 || code=$?
  if [ "$code" -ne 0 ]; then
    tail -n 3 "${file%.json}.log" >&2
    [ "$code" -eq 3 ] || exit "$code"
    status=3
  fi
}

run 1_highway --scene=highway
if [ -z "$quick" ]; then
  run 2_straight_street --scene=straight_street
  run 3_right_turn --scene=right_turn
fi
if [ -n "$kitti_root" ]; then
  run 4_kitti_00_95 --kitti_root="$kitti_root" --sequence=00 --frame=95
  [ -n "$quick" ] ||
    run 5_kitti_07_4 --kitti_root="$kitti_root" --sequence=07 --frame=4 --target_frame=0
fi

document=docs/benchmarks.md
[ -n "$quick" ] && document=$out/benchmarks.md
tools/benchmark_table.py "$out"/pairs/*.json --document "$document" \
  --command "tools/benchmark.sh${kitti_root:+ --kitti_root=DIR}${quick:+ --quick}" || status=$?
exit "$status"
