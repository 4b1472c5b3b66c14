#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws filter_bias.csv: every metric's minimum over the error of the filter's predicted pose.

On the diagonal the filter returns its predicted pose; on the horizontal axis it finds the motion.
"""
import argparse
import csv
from collections import defaultdict

from plot_style import add_format_argument, plt, save, styles_of


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("table", help="filter_bias.csv of icpscape-filter_bias")
    parser.add_argument("--out", required=True, help="path of the figures, without extension")
    parser.add_argument("--title", default="")
    add_format_argument(parser)
    arguments = parser.parse_args()
    curves = defaultdict(lambda: defaultdict(list))
    units = {}
    with open(arguments.table, newline="") as file:
        for row in csv.DictReader(file):
            units[row["sweep"]] = row["unit"]
            if row["error_of_estimate"] != "unfiltered":
                curves[row["sweep"]][row["metric"]].append(
                    (float(row["error_of_estimate"]), float(row["argmin_error"])))
    figure, panels = plt.subplots(1, len(curves), figsize=(4.2 * len(curves), 4),
                                  layout="constrained", squeeze=False)
    for axes, (sweep, metrics) in zip(panels[0], curves.items()):
        ends = [point[0] for point in next(iter(metrics.values()))]
        axes.plot([ends[0], ends[-1]], [ends[0], ends[-1]], color="0.7", linewidth=4,
                  label="the predicted pose (slope 1)")
        axes.axhline(0, color="0.4", linewidth=0.8)
        styles = styles_of(metrics)
        for metric, points in metrics.items():
            label, color, style = styles[metric]
            axes.plot(*zip(*points), style, marker="o", markersize=3, linewidth=1.3, color=color,
                      label=label)
        axes.set_xlabel(f"error of the predicted pose, {sweep.replace('_', ' ')} ({units[sweep]})")
        axes.set_ylabel(f"error of the minimum ({units[sweep]})")
    panels[0][0].legend(frameon=False, fontsize=8)
    figure.suptitle(arguments.title, fontsize=10)
    save(figure, arguments.out, arguments.formats)


if __name__ == "__main__":
    main()
