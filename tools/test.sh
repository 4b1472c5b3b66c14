#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Installs what is missing, builds, and runs all tests. Tests on real scans need KITTI data in the
# folder that the environment variable ICPSCAPE_KITTI_ROOT names; else they are skipped.
set -euo pipefail
cd "$(dirname "$0")/.."
tools/build.sh release
echo "test: running all tests"
ctest --preset release -j2
