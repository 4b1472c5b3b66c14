#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Installs what is missing, builds, draws the objective functions of a pair of scans and registers
# it. Usage: tools/demo.sh --kitti_root=DIR [--sequence=00 --frame=95]
set -euo pipefail
cd "$(dirname "$0")/.."
tools/build.sh release
if [ $# -eq 0 ]; then
  echo "demo: pass --kitti_root=DIR (the KITTI odometry data, with sequences/ and poses/), for example: tools/demo.sh --kitti_root=/data/kitti --frame=95"
  exit 0
fi
build/release/bin/icpscape-landscape --sequence=00 --frame=95 "$@" --out=out/demo/landscape
build/release/bin/icpscape-register --sequence=00 --frame=95 "$@" --out=out/demo/register
echo "demo: the picture is $PWD/out/demo/landscape/landscape.png (and .svg)"
echo "demo: the aligned cloud is $PWD/out/demo/register/aligned.ply"
