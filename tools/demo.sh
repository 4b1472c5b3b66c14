#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Installs what is missing, builds, draws the objective functions of a pair of scans and registers
# it. Without arguments on a simulated scene that needs no data; otherwise the arguments name the
# input: tools/demo.sh --scene=straight_street, or --kitti_root=DIR --sequence=00 --frame=95.
set -euo pipefail
cd "$(dirname "$0")/.."
tools/build.sh release
if [ $# -eq 0 ]; then
  set -- --scene=highway_overtaking
  expect="expected here: traffic pulls every minimum away from u = 1, and registration ends off the truth; see docs/experiments.md, and try: tools/demo.sh --scene=right_turn, or --scene=highway_overtaking --octree_voxel_m=0.1"
fi
echo "demo: the objective functions along the path of the motion ($*)"
build/release/bin/icpscape-landscape "$@" --out=out/demo/landscape
echo "demo: registration from the identity"
build/release/bin/icpscape-register "$@" --out=out/demo/register
if [ -n "${expect:-}" ]; then
  echo "demo: $expect"
fi
echo "demo: the picture is $PWD/out/demo/landscape/landscape.png (and .svg), the tables are beside it"
echo "demo: the aligned cloud is $PWD/out/demo/register/aligned.ply"
