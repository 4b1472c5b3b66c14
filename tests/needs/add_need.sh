#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# add_need.sh SOURCE_DIR BUILD_DIR: what it costs to carry something new with a pair. A copy of the tree
# gets a covariance of source points and a metric that needs it, by source_covariance.patch. At most six
# files may change besides the metric's header, the registry and the metric's test. The metric passes the
# suite of all metrics, and what follows from the list of quantities compiles: the preparation, pairs in
# lanes, and automatic derivatives.
set -euo pipefail
source=$1 build=$2
patch=$source/tests/needs/source_covariance.patch
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

files=$(sed -n 's/^+++ \([^[:space:]]*\).*/\1/p' "$patch" |
  grep -vxE 'residuals/(weighted_point|registry)\.h|tests/residuals/weighted_point_test\.cc')
echo "a need touches:" $files
[ "$(wc -l <<<"$files")" -le 6 ] || { echo "FAILED: expected at most six files"; exit 1; }

cp -r "$source"/{residuals,src,tests} "$work"
patch -p0 -s -d "$work" <"$patch"
mkdir -p "$work/include/icpscape"
ln -s "$work"/src/* "$work/residuals" "$work/tests/testing" "$work/include/icpscape"

# As the build compiles the tests, with the copy's headers before those of the tree.
object=tests/CMakeFiles/residuals_test.dir/residuals/point_to_plane_test.cc.o
line=$(ninja -C "$build" -t commands "$object" | tail -1)
line=${line%% -MD *}
compile="${line/ -I/ -I$work -I$work/include -I} -O0"
for file in preparation/prepared_scan cloud/normals objective/block_kernels_baseline \
  covariance/pair_derivatives; do
  eval "$compile -fsyntax-only $work/src/$file.cc"
done
eval "$compile $work/tests/residuals/weighted_point_test.cc -o $work/test -lgmock -lgtest -lgtest_main -lceres -lglog"
"$work/test" --gtest_brief=1
