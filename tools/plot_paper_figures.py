#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws the paper's result figures from a folder of icpscape-paper_figures, as SVG and PNG.

Reads figures.csv (which curves, in which colour and line style) and data/*.txt. Axes, ticks and
legends are the paper's; curves that the paper lacks are thin and grey.
"""
import argparse
import csv
import os
from collections import defaultdict

from plot_style import add_format_argument, plt, save

COLORS = {"orange": "#ff8000", "green": "#00ff00", "cyan": "#00ffff", "violet": "#800080",
          "blue": "#0000ff", "gray": "0.6"}  # As xcolor mixes them.
STYLES = {"solid": "-", "dashed": "--", "dashdotted": "-."}
MILLIMETRE = 1 / 25.4


def read_table(path):
    with open(path) as file:
        rows = [line.split() for line in file][1:]
    return [float(row[0]) for row in rows], [float(row[1]) for row in rows]


def draw(folder, curves):
    figure, axes = plt.subplots(figsize=(119 * MILLIMETRE, 100 * MILLIMETRE), layout="constrained")
    for curve in curves:
        u, rmse = read_table(os.path.join(folder, "data", curve["file"] + ".txt"))
        axes.plot(u, rmse, STYLES[curve["style"]], color=COLORS[curve["color"]],
                  linewidth=0.9 if curve["in_paper"] == "1" else 0.5, label=curve["legend"])
    axes.set_xlim(-1, 2)
    axes.set_xticks([-1, 0, 1, 2])
    axes.set_xticks([-0.5, 0.5, 1.5], minor=True)
    axes.grid(axis="x", which="major", linestyle="--", linewidth=0.5)
    if curves[0]["y_min"]:
        axes.set_ylim(float(curves[0]["y_min"]), float(curves[0]["y_max"]))
    axes.tick_params(direction="in", which="both", top=True, right=True, labelsize=8)
    axes.set_xlabel("Interpolation parameter $u$", fontsize=8)
    axes.set_ylabel(r"RMSE($\epsilon$)", fontsize=8)
    axes.set_title(curves[0]["title"].replace(";", ","), fontsize=8)
    # Below the axes, not within as in the paper: there it hides curves.
    axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.16), ncol=2, fontsize=7, frameon=False)
    return figure


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", help="the --out of icpscape-paper_figures")
    parser.add_argument("--out", help="folder for the figures; that of the tables by default")
    add_format_argument(parser)
    arguments = parser.parse_args()
    folder = arguments.folder
    out = arguments.out or folder
    figures = defaultdict(list)
    with open(os.path.join(folder, "figures.csv"), newline="") as file:
        for row in csv.DictReader(file):
            figures[row["figure"]].append(row)
    for name, curves in figures.items():
        figure = draw(folder, curves)
        save(figure, os.path.join(out, name), arguments.formats)
        plt.close(figure)


if __name__ == "__main__":
    main()
