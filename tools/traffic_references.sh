#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# traffic_references.sh SCANS_DIR FRAME OUT: curves of a pair of raw KITTI scans (FRAME to the one
# before) that have no ground truth, against two estimates of their motion: scan to scan, and scan to
# a submap of the five scans before. In traffic the two differ and neither is the truth, so that no
# claim about u* can be made.
set -euo pipefail
[ $# -eq 3 ] || { echo "traffic_references.sh: expected SCANS_DIR FRAME OUT" >&2; exit 1; }
scans=$1 frame=$((10#$2)) out=$3
bin=$(cd "$(dirname "$0")/.." && pwd)/build/release/bin
scan() { printf '%s/%010d.bin' "$scans" "$1"; }
target=$((frame - 1)) first=$((frame - 5))
for i in $(seq "$first" "$frame"); do
  if [ ! -f "$(scan "$i")" ]; then
    echo "traffic_references.sh: $(scan "$i"): no such scan; expected $frame and five before it" >&2
    exit 2
  fi
done
mkdir -p "$out"

estimate() { # NAME SOURCE TARGET [START]
  "$bin/icpscape-register" --source="$2" --target="$3" --initial="${4:-identity}" \
    --metrics=point_to_plane --max_distance_m=1 --max_iterations=100 --accept=undetermined \
    --out="$out/$1" >"$out/$1.log"
  grep -q "^converged" "$out/$1.log" || {
    echo "traffic_references.sh: $1 did not converge; see $out/$1.log" >&2
    exit 3
  }
}
estimate scan_to_scan "$(scan "$frame")" "$(scan "$target")"
# Backwards in time, each from where the one after it ended.
start=identity
for i in $(seq $((target - 1)) -1 "$first"); do
  estimate "earlier_$i" "$(scan "$i")" "$(scan "$target")" "$start"
  start=$out/earlier_$i/T_target_source.txt
done
/usr/bin/python3 - "$scans" "$out" "$first" "$target" <<'PYTHON'
import sys
import numpy as np
scans, out, first, target = sys.argv[1], sys.argv[2], int(sys.argv[3]), int(sys.argv[4])
parts = []
for i in range(first, target + 1):
    points = np.fromfile(f"{scans}/{i:010d}.bin", "<f4").reshape(-1, 4)
    if i < target:
        T = np.loadtxt(f"{out}/earlier_{i}/T_target_source.txt")
        points[:, :3] = points[:, :3] @ T[:3, :3].T + T[:3, 3]
    parts.append(points)
np.concatenate(parts).astype("<f4").tofile(f"{out}/submap.bin")
PYTHON
estimate scan_to_submap "$(scan "$frame")" "$out/submap.bin"
for reference in scan_to_scan scan_to_submap; do
  echo "== reference: $reference"
  "$bin/icpscape-landscape" --source="$(scan "$frame")" --target="$(scan "$target")" \
    --ground_truth="$out/$reference/T_target_source.txt" \
    --metrics=edge_to_line,planar_to_patch,symmetric,point_to_plane,point_to_point \
    --out="$out/curves_$reference" | grep -v -E "^(source|target):"
done
/usr/bin/python3 - "$out" <<'PYTHON'
import sys
import numpy as np
a, b = (np.loadtxt(f"{sys.argv[1]}/{name}/T_target_source.txt")
        for name in ("scan_to_scan", "scan_to_submap"))
print(f"the two estimates differ by {np.linalg.norm((np.linalg.inv(a) @ b)[:3, 3]) * 100:.1f} cm")
PYTHON
