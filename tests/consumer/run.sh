#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# run.sh BUILD_DIR COMPILER: installs the build and lets two small projects find, link and run it:
# the residuals with Eigen alone or with Ceres, and the whole library.
set -euo pipefail
build=$1 compiler=$2
here=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cmake --install "$build" --prefix "$work/prefix" >"$work/install.log"
for core in OFF ON; do
  cmake -S "$here" -B "$work/build-$core" -DCMAKE_PREFIX_PATH="$work/prefix" -DWITH_CORE=$core \
    -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_BUILD_TYPE=Release -Wno-dev >"$work/configure.log" 2>&1 ||
    { cat "$work/configure.log"; exit 1; }
  cmake --build "$work/build-$core"
done
"$work/build-OFF/own_solver"
"$work/build-OFF/ceres_problem"
"$work/build-ON/register_two_clouds"
"$work/prefix/bin/icpscape-list_metrics"
