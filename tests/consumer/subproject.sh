#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# subproject.sh SOURCE_DIR COMPILER: configures a parent project of icpscape, from which the packages
# of io and simulation and of the tests are hidden, and builds of it what needs no long time.
set -euo pipefail
source_dir=$1 compiler=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
hidden=()
for package in PCL embree OpenSSL nlohmann_json liblzf GTest nanoflann; do
  hidden+=("-DCMAKE_DISABLE_FIND_PACKAGE_$package=ON")
done
cmake -G Ninja -S "$(dirname "$0")/subproject" -B "$work" -DICPSCAPE_SOURCE_DIR="$source_dir" \
  "${hidden[@]}" -DCMAKE_CXX_COMPILER="$compiler" -Wno-dev >"$work/configure.log" 2>&1 ||
  { cat "$work/configure.log"; exit 1; }
cmake --build "$work" --target own_solver registers
"$work/own_solver"
# The parent's standard reaches its own files, and those of the library.
! ninja -C "$work" -t commands registers icpscape_core | grep -E 'pcl|embree|std=(c|gnu)\+\+17'
