#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws metrics as the paper prints them against their originals, on the same axes.

Reads curves.csv of
  icpscape-landscape --metrics=planar_to_patch,planar_to_plane,symmetric,symmetric_rotated,symmetric_split,point_to_plane
"""
import argparse
import csv
from collections import defaultdict

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

# Per panel: metric, factor, label, colour, line style, width.
PATCH = [
    ("planar_to_patch", 1, "as printed: distance of the points over |n|", "tab:red", "-", 1.6),
    ("planar_to_plane", 1, "as in LOAM: distance from the plane (m)", "tab:green", "-", 1.6),
]
SYMMETRIC = [
    ("symmetric", 1, "as printed (m)", "tab:red", "-", 1.6),
    ("symmetric_rotated", 0.5, "normals turned, over 2 (m)", "tab:orange", "-", 3.4),
    ("symmetric_split", 0.5, "rotation split, over 2 (m)", "tab:green", "--", 2.2),
    ("symmetric", 0.5, "as printed, over 2 (m)", "tab:blue", "-", 0.9),
    ("point_to_plane", 1, "point-to-plane (m)", "tab:purple", ":", 1.4),
]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("curves", help="curves.csv as icpscape-landscape writes it")
    parser.add_argument("--out", required=True, help="the PNG")
    parser.add_argument("--title", default="")
    arguments = parser.parse_args()
    curves = defaultdict(lambda: ([], []))
    with open(arguments.curves, newline="") as file:
        for row in csv.DictReader(file):
            curves[row["metric"]][0].append(float(row["u"]))
            curves[row["metric"]][1].append(float(row["rmse"]))
    figure, panels = plt.subplots(1, 2, figsize=(10, 4), layout="constrained")
    for axes, lines, title in zip(panels, (PATCH, SYMMETRIC), ("patch", "symmetric")):
        for metric, factor, label, color, style, width in lines:
            u, rmse = curves[metric]
            rmse = [factor * value for value in rmse]
            axes.plot(u, rmse, style, color=color, linewidth=width, label=label)
            best = min(range(len(u)), key=rmse.__getitem__)
            axes.plot(u[best], rmse[best], "o", color=color, markerfacecolor="white")
        axes.set_title(title, fontsize=10)
        axes.set_xlim(-1, 2)
        axes.set_ylim(bottom=0)
        axes.set_xticks([-1, 0, 1, 2])
        axes.grid(axis="x", linestyle="--", linewidth=0.6)
        axes.set_xlabel("Interpolation parameter u")
        axes.set_ylabel(r"RMSE($\epsilon$)")
        axes.legend(frameon=False, fontsize=8)
    figure.suptitle(arguments.title, fontsize=10)
    figure.savefig(arguments.out, dpi=90)


if __name__ == "__main__":
    main()
