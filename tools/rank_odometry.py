#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Ranks variants of odometry on a simulated drive, as a table for docs/.

  tools/rank_odometry.py --kitti_root=DIR [--sequence=07] [--frames=0:800] [--only=NAME,...]

Simulates a drive along the poses of a KITTI sequence into out/drive (scans that are there are
kept), runs icpscape-odometry on it for every variant, and prints t_err, r_err, ATE and the median
time per scan. The last column is from landscapes of pairs of scans along the drive: the mean of
u* - 1, weighted by the length of the motion. It is a mean over the drive; single pairs vary.
"""
import argparse
import csv
import json
import math
import pathlib
import statistics
import subprocess
import sys

SCAN_TO_SCAN = ["--mode=scan_to_scan"]
# Name, flags of the landscapes and the odometry (None: no landscapes), flags of the odometry.
VARIANTS = [
    ("point_to_point", ["--metrics=point_to_point"], SCAN_TO_SCAN),
    ("point_to_plane", ["--metrics=point_to_plane"], SCAN_TO_SCAN),
    ("symmetric", ["--metrics=symmetric"], SCAN_TO_SCAN),
    ("edge_to_line", ["--metrics=edge_to_line"], SCAN_TO_SCAN),
    ("planar_to_patch (as printed)", ["--metrics=planar_to_patch"], SCAN_TO_SCAN),
    ("planar_to_plane (LOAM's)", ["--metrics=planar_to_plane"], SCAN_TO_SCAN),
    ("edge_to_line + planar_to_plane", ["--metrics=edge_to_line,planar_to_plane"], SCAN_TO_SCAN),
    ("point_to_point, reciprocal", ["--metrics=point_to_point", "--reciprocal"], SCAN_TO_SCAN),
    ("point_to_point, ego blind spot filter 5 m",
     ["--metrics=point_to_point", "--artificial_blind_spot_m=5", "--ego_filter_m=5"], SCAN_TO_SCAN),
    ("point_to_point, octree filter", ["--metrics=point_to_point", "--octree_voxel_m=0.1"],
     SCAN_TO_SCAN),
    ("point_to_plane, octree filter", ["--metrics=point_to_plane", "--octree_voxel_m=0.1"],
     SCAN_TO_SCAN),
    ("symmetric, octree filter", ["--metrics=symmetric", "--octree_voxel_m=0.1"], SCAN_TO_SCAN),
    ("point_to_plane, Huber 0.1 m", ["--metrics=point_to_plane", "--loss=huber"], SCAN_TO_SCAN),
    ("symmetric, Huber 0.1 m", ["--metrics=symmetric", "--loss=huber"], SCAN_TO_SCAN),
    ("two stages, LOAM's metrics, Huber 0.1 m", None,
     ["--mode=two_stage", "--metrics=edge_to_line,planar_to_plane", "--loss=huber"]),
    ("scan to map, point_to_plane", None, []),
    ("scan to map, symmetric", None, ["--metrics=symmetric"]),
]


def run(command):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True)
    if done.returncode not in (0, 4):  # 4: a doubtful pose, which counts like any other.
        sys.exit(f"rank_odometry.py: {' '.join(map(str, command))}: {done.stderr.strip()}")


def read_results(folder):
    return json.loads((folder / "manifest.json").read_text())["results"]


def predicted_drift(program, drive, flags, frames, out):
    """Sum of (u* - 1) |motion| over sum of |motion|, for pairs of scans; None for several metrics, and
    with a loss."""
    metrics = flags[0].split("=")[1]
    if not frames or "," in metrics or any(flag.startswith("--loss") for flag in flags):
        return None
    off_m = way_m = 0
    for frame in frames:
        run([program, *drive, f"--frame={frame}", *flags, "--u_min=0.5", "--u_max=1.5",
             "--samples=101", "--threads=1", f"--out={out}"])
        results = read_results(out)
        off_m += (results["argmin_u_" + metrics] - 1) * results["motion_m"]
        way_m += results["motion_m"]
    return off_m / way_m


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--bin", default="build/release/bin", type=pathlib.Path)
    parser.add_argument("--kitti_root", required=True)
    parser.add_argument("--sequence", default="07")
    parser.add_argument("--frames", default="0:800")
    parser.add_argument("--pairs", type=int, default=20, help="landscapes per variant")
    parser.add_argument("--only", default="", help="names of variants, separated by semicolons")
    parser.add_argument("--out", default="out/drive", type=pathlib.Path)
    flags = parser.parse_args()
    run([flags.bin / "icpscape-simulate", f"--kitti_root={flags.kitti_root}",
         f"--sequence={flags.sequence}", f"--frames={flags.frames}", f"--out={flags.out}"])
    drive = [f"--kitti_root={flags.out}", f"--sequence={flags.sequence}"]
    count = len(list((flags.out / "sequences" / flags.sequence / "velodyne").iterdir()))
    frames = [2 + (count - 3) * i // max(1, flags.pairs - 1) for i in range(flags.pairs)]
    rows = []
    for name, shared, own in VARIANTS:
        if flags.only and name not in flags.only.split(";"):
            continue
        out = flags.out / "runs" / "".join(c if c.isalnum() else "_" for c in name)
        run([flags.bin / "icpscape-odometry", *drive, *(shared or []), *own, "--threads=1",
             "--restart", "--write_map_voxel_m=0", f"--out={out}"])
        results = read_results(out)
        ate = next((value for key, value in results.items()
                    if key.startswith("ate_rmse_m_rigid")), math.nan)
        with open(out / "timings.csv", newline="") as file:
            seconds = [float(r["read_s"]) + float(r["odometry_s"]) for r in csv.DictReader(file)]
        with open(out / "frames.csv", newline="") as file:
            steps = [int(r["iterations"]) for r in csv.DictReader(file)]
        drift = shared and predicted_drift(flags.bin / "icpscape-landscape", drive, shared, frames,
                                           flags.out / "runs" / "landscape")
        # A drive of less than 100 m has no t_err and r_err.
        rows.append((results.get("t_err_percent", math.nan), name,
                     results.get("r_err_deg_per_100m", math.nan), ate,
                     results["not_registered"], statistics.mean(steps[1:]),
                     1e3 * statistics.median(seconds), drift))
        print(f"{name}: t_err {rows[-1][0]:.3f} %", file=sys.stderr, flush=True)
    print("| variant | t_err, % | r_err, deg/100 m | ATE, m | not registered | steps a scan | "
          "ms a scan | landscapes: mean u* - 1, % |")
    print("|---|---|---|---|---|---|---|---|")
    for t_err, name, r_err, ate, failures, steps, ms, drift in sorted(rows, key=lambda r: r[:2]):
        predicted = "" if drift is None else f"{100 * drift:+.2f}"
        print(f"| {name} | {t_err:.3f} | {r_err:.3f} | {ate:.2f} | {failures:.0f} | {steps:.1f} | "
              f"{ms:.0f} | {predicted} |")


if __name__ == "__main__":
    main()
