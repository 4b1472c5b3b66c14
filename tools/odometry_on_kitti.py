#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs icpscape-odometry on short KITTI drives, on one thread, and prints a table for docs/.

  tools/odometry_on_kitti.py --kitti_root=DIR [--raw=DRIVE ...] [flags of icpscape-odometry]

07/0-4 has a good truth, against which the end is held. 00/0-15 has a poor one and raw drives have
none: they are driven forwards and backwards, and should end where they began.
"""
import argparse
import csv
import json
import math
import pathlib
import statistics
import subprocess
import sys


def drive(flags, more, out):
    command = [flags.odometry, *flags.input, *more, "--threads=1", "--restart", f"--out={out}"]
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True)
    if done.returncode not in (0, 4):  # 4: a doubtful pose, which counts like any other.
        sys.exit(f"odometry_on_kitti.py: {' '.join(map(str, command))}: {done.stderr.strip()}")
    with open(out / "timings.csv", newline="") as file:
        seconds = [float(row["read_s"]) + float(row["odometry_s"]) for row in csv.DictReader(file)]
    results = json.loads((out / "manifest.json").read_text())["results"]
    return {"scans": len(seconds), "ms": 1e3 * statistics.median(seconds), **results}


def last_pose(out):
    """Rotation and translation of the last row, relative to the first scan."""
    row = [float(word) for word in (out / "trajectory_kitti.txt").read_text().split()[-12:]]
    return [row[0:3], row[4:7], row[8:11]], [row[3], row[7], row[11]]


def closure(forwards, backwards):
    """How far the drive there and back again is off the identity: metres and degrees."""
    (R, t), (S, s) = last_pose(forwards), last_pose(backwards)
    off = [sum(R[i][k] * s[k] for k in range(3)) + t[i] for i in range(3)]
    trace = sum(R[i][k] * S[k][i] for i in range(3) for k in range(3))
    return math.hypot(*off), math.degrees(math.acos(max(-1, min(1, (trace - 1) / 2))))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--odometry", default="build/release/bin/icpscape-odometry")
    parser.add_argument("--kitti_root", required=True)
    parser.add_argument("--raw", action="append", default=[],
                        help="a raw drive: a folder with velodyne_points/; may be repeated")
    parser.add_argument("--out", default="out/odometry_on_kitti", type=pathlib.Path)
    flags, more = parser.parse_known_args()
    print("| drive | scans | ms a scan, median | not registered | result |")
    print("|---|---|---|---|---|")

    def row(name, result, text):
        print(f"| {name} | {result['scans']} | {result['ms']:.0f} | "
              f"{result['not_registered']:.0f} | {text} |", flush=True)

    def there_and_back(name, inputs):
        flags.input = inputs
        result = drive(flags, more, flags.out / "forwards")
        drive(flags, [*more, "--reverse"], flags.out / "backwards")
        metres, degrees = closure(flags.out / "forwards", flags.out / "backwards")
        row(name, result, f"{math.hypot(*last_pose(flags.out / 'forwards')[1]):.1f} m away; there "
                          f"and back again meet within {100 * metres:.1f} cm, {degrees:.2f} deg")

    flags.input = [f"--kitti_root={flags.kitti_root}", "--sequence=07", "--frames=0:4"]
    result = drive(flags, more, flags.out / "07")
    row("07, 0 to 4", result, f"ends {100 * result['end_off_m']:.1f} cm, "
                              f"{result['end_off_deg']:.2f} deg off the ground truth")
    there_and_back("00, 0 to 15",
                   [f"--kitti_root={flags.kitti_root}", "--sequence=00", "--frames=0:15"])
    for raw in flags.raw:
        there_and_back(pathlib.Path(raw).name, [f"--scans={raw}"])


if __name__ == "__main__":
    main()
