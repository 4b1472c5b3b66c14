#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws curves.csv: one column of every metric over u, and below it the slope, as SVG and PNG.

The slope panel shows both the objective's own derivative (line) and the differences of the plotted
samples (dots): where they part, pairs are changing from one pose to the next.
"""
import argparse
import csv
from collections import defaultdict

from plot_style import LABELS, plt, save, styles_of


def read_curves(path):
    curves = defaultdict(lambda: defaultdict(list))
    with open(path, newline="") as file:
        for row in csv.DictReader(file):
            for column, value in row.items():
                if column != "metric":
                    curves[row["metric"]][column].append(float(value))
    return curves


def draw(curves, column, title):
    # The slopes are those of the RMSE.
    rows = 2 if column == "rmse" else 1
    figure, panels = plt.subplots(
        rows, 1, sharex=True, squeeze=False, figsize=(7.2, 2.2 + 2.1 * rows),
        height_ratios=(3, 1.4)[:rows], layout="constrained")
    top, bottom = panels[0, 0], panels[-1, 0]
    styles = styles_of(curves)
    for metric, curve in curves.items():
        label, color, style = styles[metric]
        (line,) = top.plot(curve["u"], curve[column], style, color=color, label=label, linewidth=1.6)
        best = min(range(len(curve["u"])), key=lambda i: curve[column][i])
        top.plot(curve["u"][best], curve[column][best], "o", color=line.get_color(), markersize=6,
                 markerfacecolor="white")
        if rows == 1:
            continue
        bottom.plot(curve["u"], curve["slope_analytic"], style, color=line.get_color(),
                    linewidth=1.2)
        bottom.plot(curve["u"], curve["slope_numeric"], ".", color=line.get_color(), markersize=3)
    low, high = min(c["u"][0] for c in curves.values()), max(c["u"][-1] for c in curves.values())
    for axes in panels[:, 0]:
        axes.set_xlim(low, high)
        axes.grid(axis="x", linestyle="--", linewidth=0.6)
        for side in ("top", "right"):
            axes.spines[side].set_visible(False)
    top.axvline(1, color="0.4", linewidth=0.8)
    top.set_title(title, fontsize=11, parse_math=False)
    top.set_ylabel(LABELS[column])
    bottom.set_xlabel("Interpolation parameter u  (0: start, 1: reference)")
    # Room for the legend above the curves.
    low, high = top.get_ylim()
    top.set_ylim(low, high + (0.06 + 0.06 * ((len(curves) + 1) // 2)) * (high - low))
    top.legend(frameon=False, fontsize=9, ncol=2, loc="upper center")
    if rows == 1:
        return figure
    bottom.axhline(0, color="0.4", linewidth=0.8)
    bottom.set_ylabel("dRMSE/du")
    bottom.plot([], [], "k-", linewidth=1.2, label="from the gradient")
    bottom.plot([], [], "k.", markersize=3, label="from the samples")
    bottom.legend(frameon=False, fontsize=8, ncol=2, loc="upper left")
    return figure


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("curves", help="curves.csv as icpscape-landscape writes it")
    parser.add_argument("--out", required=True, help="path of the figures, without extension")
    parser.add_argument("--column", default="rmse", choices=sorted(LABELS))
    parser.add_argument("--title", default="")
    arguments = parser.parse_args()
    figure = draw(read_curves(arguments.curves), arguments.column, arguments.title)
    save(figure, arguments.out)


if __name__ == "__main__":
    main()
