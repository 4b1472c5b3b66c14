#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Are the results those of an earlier version, bit for bit? Builds that version beside this one, runs
# both on the same inputs and compares all tables, poses and clouds (tools/compare_tables.py, which
# has the wanted differences). Prints a line per run and ends with 1 if one differs.
#
#   tools/compare_with_release.sh [COMMIT] [--quick] [--only=TEXT] [--kitti_root=DIR] [--reference=DIR]
#
# COMMIT is the first release unless given. Its programs and results stay in build/compare, for the
# next time. --quick: a subset, in about a minute. --only: the runs with TEXT in their names.
# --reference: a checkout of COMMIT that is already built. Runs on real scans need KITTI data:
# --kitti_root, or the environment variable ICPSCAPE_KITTI_ROOT.
set -euo pipefail

# Flags that were renamed: now, and then. The old name is used where a program lacks the new one.
declare -A old_name=()

commit=638f9f9 quick=false only='' reference=''
kitti=${ICPSCAPE_KITTI_ROOT:-}
for argument in "$@"; do
  case "$argument" in
    --quick) quick=true ;;
    --only=*) only=${argument#*=} ;;
    --kitti_root=*) kitti=${argument#*=} ;;
    --reference=*) reference=$(realpath "${argument#*=}") ;;
    -*)
      echo "compare_with_release.sh: unknown option $argument; expected --quick, --only=TEXT," \
        "--kitti_root=DIR or --reference=DIR" >&2
      exit 1
      ;;
    *) commit=$argument ;;
  esac
done
[ -d "$kitti" ] && kitti=$(realpath "$kitti") || kitti=''
cd "$(dirname "$0")/.."

# Only the programs, from what is installed.
build() {
  mkdir -p "$1/build"
  (cd "$1" && cmake --preset release -Wno-dev "${@:2}" >build/configure.log 2>&1) ||
    { cat "$1/build/configure.log" >&2; exit 1; }
  cmake --build "$1/build/release" -j2 --target programs
}

commit=$(git rev-parse --short=7 --verify "$commit^{commit}")
work=$PWD/build/compare/$commit
mkdir -p "$work"
if [ -z "$reference" ]; then
  reference=$work/source
  [ -d "$reference" ] || git clone --quiet --shared --no-checkout . "$reference"
  git -C "$reference" checkout --quiet --detach "$commit"
  build "$reference" -DICPSCAPE_BUILD_TESTS=OFF
elif [ "$(git -C "$reference" rev-parse --short=7 HEAD)" != "$commit" ]; then
  echo "compare_with_release.sh: $reference is not a checkout of $commit" >&2
  exit 1
fi
build .

# produce SIDE BIN NAME PROGRAM FLAG...: the results of one side, in $work/SIDE/NAME, and the exit
# code. Without Python there are no figures; the programs warn and go on.
produce() {
  local side=$1 program=$2/icpscape-$4 out=$work/$1/$3 flag name
  local words=()
  for flag in "${@:5}"; do
    name=${flag%%=*}
    if [ -n "${old_name[$name]:-}" ] && ! "$program" --help | grep -q -- "^ *$name "; then
      flag=${old_name[$name]}${flag#"$name"}
    fi
    words+=("$flag")
  done
  local made_by
  made_by="$(sha256sum <"$program") ${words[*]}"
  if [ "$side" = reference ] && [ -f "$out.code" ] && [ "$(cat "$out.made_by")" = "$made_by" ]; then
    return
  fi
  rm -rf "$out" "$out.code"
  mkdir -p "$(dirname "$out")"
  local code=0
  PYTHONHOME=/dev/null "$program" "${words[@]}" --out="$out" >"$out.log" 2>&1 || code=$?
  echo "$made_by" >"$out.made_by"
  echo "$code" >"$out.code"
}

runs=0
differing=0
# run NAME PROGRAM FLAG...
run() {
  [[ $1 == *"$only"* ]] || return 0
  local then=$work/reference/$1 now=$work/checkout/$1 side
  runs=$((runs + 1))
  produce reference "$reference/build/release/bin" "$@"
  produce checkout "$PWD/build/release/bin" "$@"
  for side in "$then" "$now"; do
    case "$(cat "$side.code")" in
      0 | 3) ;;  # 3: no answer, which must be so on both sides.
      *)
        echo "$1: fails: $(tail -n 1 "$side.log") ($side.log)"
        differing=$((differing + 1))
        return
        ;;
    esac
  done
  if [ "$(cat "$then.code")" != "$(cat "$now.code")" ]; then
    echo "$1: differs: exit code $(cat "$then.code"), now $(cat "$now.code") ($now.log)"
    differing=$((differing + 1))
  elif [ "$(cat "$then.code")" = 3 ]; then
    echo "$1: equal, no answer: $(tail -n 1 "$now.log")"
  else
    tools/compare_tables.py "$1" "$then" "$now" || differing=$((differing + 1))
  fi
}

if $quick; then
  samples=16
  metrics=(point_to_plane symmetric edge_to_line)
  scenes=(right_turn)
  frames=()
else
  samples=100
  mapfile -t metrics < <("$reference/build/release/bin/icpscape-list_metrics" |
    awk 'NR > 1 && NF == 0 { exit } NR > 1 { print $1 }')
  scenes=(straight_street right_turn highway highway_overtaking)
  frames=(15 95)
fi
all=$(IFS=,; echo "${metrics[*]}")
declare -A input=()
for scene in "${scenes[@]}"; do
  input[$scene]=--scene=$scene
done
if [ -n "$kitti" ]; then
  for frame in "${frames[@]}"; do
    input[kitti_00_$frame]="--kitti_root=$kitti --sequence=00 --frame=$frame"
  done
else
  echo "no KITTI data: only simulated scans"
fi

mapfile -t names < <(printf '%s\n' "${!input[@]}" | sort)
for name in "${names[@]}"; do
  read -r -a pair <<<"${input[$name]}"
  run "landscape/$name" landscape "${pair[@]}" --metrics="$all" --samples="$samples"
  for metric in "${metrics[@]}"; do
    run "register/$name/$metric" register "${pair[@]}" --metrics="$metric"
  done
done

# A real pair where there is one; scenes have labels, and can be drawn anew.
read -r -a pair <<<"${input[kitti_00_95]:---scene=right_turn}"
run landscape/iterates landscape "${pair[@]}" --metrics="$all" --samples=5 --iterates \
  --initial=previous_motion --path=geodesic
run landscape/filters landscape "${pair[@]}" --samples=5 --artificial_blind_spot_m=5 \
  --ego_filter_m=3 --octree_voxel_m=0.1 --reciprocal --reverse
run landscape/rejection landscape "${pair[@]}" --samples=5 --voxel_m=0.25 --max_distance_m=2 \
  --max_normal_angle_deg=45 --max_median_factor=3 --kept_fraction=0.9 --region_size_m=10
run register/weights register "${pair[@]}" --metrics=point_to_plane,edge_to_line --weights=1,0.3 \
  --loss=huber --dof=planar
run register/starts register --scene=right_turn --starts=4
if ! $quick; then
  run paper_figures paper_figures --samples=16
  [ -z "$kitti" ] || run paper_figures/kitti paper_figures --samples=16 --straight_frame=15 \
    --turn_frame=95 --kitti_root="$kitti"
  run filter_bias/highway_overtaking filter_bias --scene=highway_overtaking --steps=2 --samples=5
  run filter_bias/real filter_bias "${pair[@]}" --steps=2 --samples=5
  run covariance/straight_street covariance --scene=straight_street --draws=5
  run covariance/real covariance "${pair[@]}" --metrics="$all"
  run simulate/scenes simulate --scene=all --azimuth_step_deg=1 --ply
fi

# Odometry on the real drive, or else on the first scans of the simulated one.
run simulate/town simulate --scene=town --frames=0:4
drive=("--kitti_root=$kitti" --sequence=07 --frames=0:4)
[ -n "$kitti" ] || drive=("--kitti_root=$work/reference/simulate/town" --sequence=town)
run odometry/scan_to_map odometry "${drive[@]}"
run odometry/scan_to_scan odometry "${drive[@]}" --mode=scan_to_scan --metrics=symmetric
run odometry/two_stage odometry "${drive[@]}" --mode=two_stage --map_every=2 \
  --metrics=edge_to_line,planar_to_plane
run odometry/evaluated evaluate "${drive[@]/#--sequence=/--sequences=}" \
  --estimate="$work/reference/odometry/scan_to_map/trajectory_kitti.txt"

if [ "$runs" -eq 0 ]; then
  echo "compare_with_release.sh: no run has \"$only\" in its name" >&2
  exit 1
fi
if [ "$differing" -gt 0 ]; then
  echo "$differing of $runs runs differ from $commit"
  exit 1
fi
echo "all $runs runs are equal to those of $commit"
