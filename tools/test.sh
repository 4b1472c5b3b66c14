#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Installs what is missing, builds, and runs all tests. Tests on real scans need KITTI data: set
# ICPSCAPE_KITTI_ROOT, or have ../shared/data/kitti beside the checkout; they are skipped otherwise.
set -euo pipefail
cd "$(dirname "$0")/.."
tools/build.sh release
echo "test: running all tests"
ctest --preset release -j2
