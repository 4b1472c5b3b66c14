#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# compile_alone.sh COMPILER RESIDUALS_DIR EIGEN_DIR --no-ceres|--with-ceres HEADER...
# Copies the folder to another place, and compiles each header as a program of its own. With
# --no-ceres the include path has nothing else but a link to Eigen, and what the compiler finds by
# itself must not be another library.
set -euo pipefail
compiler=$1 residuals=$2 eigen=$3 mode=$4
shift 4
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
ln -s "$eigen/Eigen" "$work/Eigen"
mkdir "$work/theirs"
cp -r "$residuals" "$work/theirs/metrics"
status=0
for header in "$@"; do
  printf '#include <metrics/%s>\nint main() { return 0; }\n' "$header" >"$work/alone.cc"
  includes=(-I "$work/theirs" -isystem "$work")
  if ! "$compiler" -std=c++17 -Wall -Wextra -Wconversion -Wshadow -Werror -fsyntax-only \
      "${includes[@]}" "$work/alone.cc"; then
    echo "FAILED: $header does not compile alone"
    status=1
  fi
  if [ "$mode" = --no-ceres ] && "$compiler" -std=c++17 -M "${includes[@]}" "$work/alone.cc" |
      grep -E '/(ceres|glog|gflags|pcl-[0-9.]+|nanoflann)/'; then
    echo "FAILED: $header includes more than Eigen and the standard library"
    status=1
  fi
done
exit $status
