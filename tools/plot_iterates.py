#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws the objective over the index of the iteration, and below it the length of the steps.

Reads iterates.csv of icpscape-landscape (one line a metric) or icpscape-register.
"""
import argparse

from matplotlib.ticker import MaxNLocator
from plot_style import LABELS, add_format_argument, plt, read_groups, save, styles_of


def draw(runs, column, title):
    figure, (top, bottom) = plt.subplots(2, 1, sharex=True, figsize=(7.2, 5.4),
                                         height_ratios=(3, 1.6), layout="constrained")
    for metric, (label, color, style) in styles_of(runs).items():
        run = runs[metric]
        top.plot(run["iteration"], run[column], style, color=color, linewidth=1.4, label=label,
                 marker="o", markersize=3)
        # The first has no step behind it; one of length 0 has no place on a logarithmic axis.
        steps = [(i, step) for i, step in zip(run["iteration"], run["step_m"]) if step > 0]
        bottom.plot([i for i, _ in steps], [step for _, step in steps], style, color=color,
                    linewidth=1.4, marker="o", markersize=3)
    for axes in (top, bottom):
        axes.grid(linewidth=0.4, color="0.9")
        axes.set_axisbelow(True)
        for side in ("top", "right"):
            axes.spines[side].set_visible(False)
    top.set_title(title, fontsize=11, parse_math=False)
    top.set_ylabel(LABELS[column])
    top.set_ylim(0, top.get_ylim()[1] * (1.04 + 0.08 * ((len(runs) + 1) // 2)))  # And a legend.
    if any(step > 0 for run in runs.values() for step in run["step_m"]):
        bottom.set_yscale("log")
    bottom.set_ylabel("step (m)")
    bottom.set_xlabel("iteration")
    bottom.xaxis.set_major_locator(MaxNLocator(integer=True))
    if "" not in runs:
        top.legend(frameon=False, fontsize=9, ncol=2, loc="upper center")
    return figure


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("table", help="iterates.csv as icpscape-landscape or icpscape-register writes it")
    parser.add_argument("--out", required=True, help="path of the figures, without extension")
    parser.add_argument("--column", default="rmse", choices=("cost", "rmse"))
    parser.add_argument("--title", default="")
    add_format_argument(parser)
    arguments = parser.parse_args()
    figure = draw(read_groups(arguments.table, "metric"), arguments.column, arguments.title)
    save(figure, arguments.out, arguments.formats)


if __name__ == "__main__":
    main()
