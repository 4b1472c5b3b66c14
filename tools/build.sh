#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# build.sh [PRESET [TARGET]]: installs what is missing and builds the preset (default: release), or of
# it one target.
set -euo pipefail
cd "$(dirname "$0")/.."
preset=${1:-release}
tools/setup.sh
echo "build: preset $preset"
mkdir -p build
cmake --preset "$preset" -Wno-dev >build/configure.log 2>&1 || {
  cmake --preset "$preset" -Wno-dev
}
cmake --build --preset "$preset" ${2:+--target "$2"}
