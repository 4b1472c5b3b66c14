#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# clang-tidy on the sources that the last commit changed (at most eight: it needs 20 s a file).
set -euo pipefail
cd "$(dirname "$0")/.."
base=$(git rev-parse --verify --quiet HEAD~1) || exit 0
mapfile -t files < <(git diff --name-only --diff-filter=d "$base" -- 'src/*.cc' 'apps/*.cc' | head -n 8)
[ ${#files[@]} -eq 0 ] && exit 0
echo "tidy: ${files[*]}"
clang-tidy -p build/release --quiet --warnings-as-errors='*' "${files[@]}" 2>/dev/null
