#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# clang-tidy on the sources that were changed since $CI_BASE (default: the last commit), the most
# changed first. A file takes 20 s or more: what is not done after 4 minutes is named and left.
set -uo pipefail
cd "$(dirname "$0")/.."
base=$(git rev-parse --verify --quiet "${CI_BASE:-HEAD~1}^{commit}") || {
  echo "tidy: no commit ${CI_BASE:-HEAD~1} to compare with"
  exit ${CI_BASE:+1}  # Without CI_BASE, a history of one commit has nothing to check.
}
mapfile -t files < <(git diff --numstat --no-renames --diff-filter=d "$base" -- '*.cc' |
  sort -k1,1nr | cut -f3)
deadline=$((SECONDS + 240))
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# check FILE NUMBER: the findings go to $work/NUMBER, and the outcome to $work/NUMBER.code.
check() {
  local seconds=$((deadline > SECONDS ? deadline - SECONDS : 1))
  timeout "$seconds" clang-tidy -p build/release --quiet --warnings-as-errors='*' \
    "$1" >"$work/$2" 2>&1
  echo $? >"$work/$2.code"
}

skipped=()
for i in "${!files[@]}"; do
  if ! grep -qF "/${files[$i]}\"" build/release/compile_commands.json; then
    skipped+=("${files[$i]}")
    continue
  fi
  while [ "$(jobs -rp | wc -l)" -ge "$(nproc)" ]; do
    wait -n
  done
  [ $SECONDS -lt $deadline ] || break
  check "${files[$i]}" "$i" &
done
wait

status=0
left=()
for i in "${!files[@]}"; do
  [[ " ${skipped[*]} " == *" ${files[$i]} "* ]] && continue
  case "$(cat "$work/$i.code" 2>/dev/null || echo 124)" in
    0) echo "tidy: ${files[$i]}: clean" ;;
    124) left+=("${files[$i]}") ;;  # timeout's code.
    *)
      echo "tidy: ${files[$i]}:"
      grep -vE '^([0-9]+ warnings? .*generated|Suppressed |Use -header-filter)' "$work/$i"
      status=1
      ;;
  esac
done
[ ${#skipped[@]} -eq 0 ] || echo "tidy: not part of build/release: ${skipped[*]}"
[ ${#left[@]} -eq 0 ] || echo "tidy: left after 4 minutes: ${left[*]}"
exit $status
