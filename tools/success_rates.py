#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Prints how often registration succeeds from random starts, as a table for docs/.

Runs icpscape-register --starts on every simulated scene, and on KITTI's 00/15, 00/95 and 07/2 where
--kitti_root is given, for every metric and way to re-associate that is asked for. With one way to
re-associate the table has a column for each metric.
"""
import argparse
import csv
import json
import pathlib
import subprocess
import sys
import tempfile

SCENES = ["straight_street", "right_turn", "highway", "highway_overtaking"]
KITTI = [("00", 15), ("00", 95), ("07", 2)]


def run(register, inputs, metric, reassociation, starts):
    with tempfile.TemporaryDirectory() as out:
        command = [register, *inputs, f"--metrics={metric}", f"--reassociation={reassociation}",
                   f"--starts={starts}", "--figures=none", f"--out={out}"]
        done = subprocess.run(command, capture_output=True, text=True)
        if done.returncode not in (0, 4):  # 4: a doubtful pose, which counts like any other.
            sys.exit(f"success_rates.py: {' '.join(command)}: {done.stderr.strip()}")
        manifest = json.loads((pathlib.Path(out) / "manifest.json").read_text())
        with open(pathlib.Path(out) / "starts.csv", newline="") as file:
            rows = list(csv.DictReader(file))
    iterations = sum(int(row["iterations"]) for row in rows) / len(rows)
    return (manifest["results"]["success_percent"], iterations,
            1000 * manifest["timings_s"]["starts"] / len(rows))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--register", default="build/release/bin/icpscape-register")
    parser.add_argument("--kitti_root")
    parser.add_argument("--starts", type=int, default=100)
    parser.add_argument("--metrics", default="point_to_plane,symmetric")
    parser.add_argument("--reassociation", default="every_step,every_evaluation")
    flags = parser.parse_args()
    inputs = [(scene, [f"--scene={scene}"]) for scene in SCENES]
    if flags.kitti_root:
        inputs += [(f"KITTI {s}/{f}", [f"--kitti_root={flags.kitti_root}", f"--sequence={s}",
                                       f"--frame={f}"]) for s, f in KITTI]
    metrics, modes = flags.metrics.split(","), flags.reassociation.split(",")
    if len(modes) == 1:
        print_rates(flags, inputs, metrics, modes[0])
    else:
        print_comparison(flags, inputs, metrics, modes)


def print_rates(flags, inputs, metrics, mode):
    """Pairs down, metrics across: success in percent, and the mean number of steps."""
    print("| Pair | " + " | ".join(metrics) + " |")
    print("|---|" + "---|" * len(metrics))
    for name, arguments in inputs:
        cells = []
        for metric in metrics:
            percent, steps, _ = run(flags.register, arguments, metric, mode, flags.starts)
            cells.append(f"{percent:.1f} ({steps:.1f})")
        print(f"| {name} | " + " | ".join(cells) + " |", flush=True)


def print_comparison(flags, inputs, metrics, modes):
    print("| Pair | Metric | Re-association | Success, % | Steps, mean | ms a start |")
    print("|---|---|---|---|---|---|")
    for name, arguments in inputs:
        for metric in metrics:
            for mode in modes:
                percent, steps, ms = run(flags.register, arguments, metric, mode, flags.starts)
                print(f"| {name} | {metric} | {mode} | {percent:.1f} | {steps:.1f} | {ms:.0f} |",
                      flush=True)


if __name__ == "__main__":
    main()
