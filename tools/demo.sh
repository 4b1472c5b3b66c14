#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Installs what is missing, builds, draws the objective functions of a pair of scans and registers
# it. Without arguments it takes a simulated scene, which needs no data. Arguments name another
# input: tools/demo.sh --scene=straight_street, or --kitti_root=DIR --sequence=00 --frame=95.
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)  # The caller's folder stays: inputs may be relative to it.
"$root/tools/build.sh" release programs
if [ $# -eq 0 ]; then
  set -- --scene=highway_overtaking
  accept=--accept=undetermined
  expect="expected here: traffic pulls every minimum away from u = 1, and registration ends off the truth, and the verdict says so. Try also: tools/demo.sh --scene=right_turn, or --scene=highway_overtaking --octree_voxel_m=0.1"
fi
echo "demo: the objective functions along the path of the motion ($*)"
"$root/build/release/bin/icpscape-landscape" "$@" --out="$root/out/demo/landscape"
echo "demo: registration from the identity"
"$root/build/release/bin/icpscape-register" "$@" ${accept:+"$accept"} --out="$root/out/demo/register"
if [ -n "${expect:-}" ]; then
  echo "demo: $expect"
fi
echo "demo: the picture is $root/out/demo/landscape/landscape.png (and .svg), the tables are beside it"
echo "demo: the aligned cloud is $root/out/demo/register/aligned.ply"
echo "demo: docs/first_landscape.md explains the picture"
