#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws curves.csv: one column of every metric over u, and below it the slope, as SVG and PNG.

The slope panel shows both the objective's own derivative (line) and the differences of the plotted
samples (dots): where they part, pairs are changing from one pose to the next. Iterates of the
solver, if given, stand at their nearest u with their own values; a panel shows how far off the path
they are.
"""
import argparse

from plot_style import LABELS, add_format_argument, plt, read_groups, save, styles_of


def draw_values(axes, curves, column, styles):
    for metric, curve in curves.items():
        label, color, style = styles[metric]
        axes.plot(curve["u"], curve[column], style, color=color, label=label, linewidth=1.6)
        best = min(range(len(curve["u"])), key=lambda i: curve[column][i])
        axes.plot(curve["u"][best], curve[column][best], "o", color=color, markersize=6,
                  markerfacecolor="white")
    axes.axvline(1, color="0.4", linewidth=0.8)
    axes.set_ylabel(LABELS[column])


def draw_slopes(axes, curves, iterates, styles):
    for metric, curve in curves.items():
        _, color, style = styles[metric]
        axes.plot(curve["u"], curve["slope_analytic"], style, color=color, linewidth=1.2)
        axes.plot(curve["u"], curve["slope_numeric"], ".", color=color, markersize=3)
    axes.axhline(0, color="0.4", linewidth=0.8)
    axes.set_ylabel("dRMSE/du")
    for metric, steps in iterates.items():  # Where the gradient is to be zero.
        draw_end(axes, steps["u"][-1], 0, styles[metric][1])
    axes.plot([], [], "k-", linewidth=1.2, label="from the gradient")
    axes.plot([], [], "k.", markersize=3, label="from the samples")
    axes.legend(frameon=False, fontsize=8, ncol=2, loc="upper left")


def draw_iterates(axes, iterates, values_of, styles):
    """A dot each, joined by a line; the last one is a diamond."""
    for metric, steps in iterates.items():
        _, color, _ = styles[metric]
        values = values_of(steps)
        axes.plot(steps["u"], values, "-o", color=color, linewidth=0.7, markersize=3.5,
                  markeredgecolor="black", markeredgewidth=0.3, zorder=3)
        draw_end(axes, steps["u"][-1], values[-1], color)


def draw_end(axes, u, value, color):
    axes.plot(u, value, "D", color=color, markersize=7, markeredgecolor="black",
              markeredgewidth=0.9, zorder=4)


def draw(curves, iterates, column, title):
    # The slopes are those of the RMSE.
    heights = [3] + [1.4] * (bool(iterates) + (column == "rmse"))
    figure, panels = plt.subplots(
        len(heights), 1, sharex=True, squeeze=False, height_ratios=heights, layout="constrained",
        figsize=(7.2, 2.2 + 2.1 * len(heights)))
    panels = list(panels[:, 0])
    top = panels[0]
    styles = styles_of(curves)
    draw_values(top, curves, column, styles)
    if iterates:
        draw_iterates(top, iterates, lambda steps: steps[column], styles)
        draw_iterates(panels[1], iterates, lambda steps: [100 * d for d in steps["off_path_m"]],
                      styles)
        panels[1].axvline(1, color="0.4", linewidth=0.8)
        panels[1].set_ylim(bottom=-0.05 * panels[1].get_ylim()[1])  # The start is at 0: room for it.
        panels[1].set_ylabel("iterates: off path (cm)")
    if column == "rmse":
        draw_slopes(panels[-1], curves, iterates, styles)
    low, high = min(c["u"][0] for c in curves.values()), max(c["u"][-1] for c in curves.values())
    for axes in panels:
        axes.set_xlim(low, high)
        axes.grid(axis="x", linestyle="--", linewidth=0.6)
        for side in ("top", "right"):
            axes.spines[side].set_visible(False)
    top.set_title(title, fontsize=11, parse_math=False)
    figure.align_ylabels()
    panels[-1].set_xlabel("Interpolation parameter u  (0: start, 1: reference)")
    if iterates:
        top.plot([], [], "-o", color="0.5", linewidth=0.7, markersize=3.5, label="iterates")
        top.plot([], [], "D", color="0.5", markersize=7, markeredgecolor="black", label="the last")
    # Room for the legend above the curves.
    entries = len(curves) + (2 if iterates else 0)
    low, high = top.get_ylim()
    top.set_ylim(low, high + (0.06 + 0.06 * ((entries + 1) // 2)) * (high - low))
    top.legend(frameon=False, fontsize=9, ncol=2, loc="upper center")
    return figure


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("curves", help="curves.csv as icpscape-landscape writes it")
    parser.add_argument("--out", required=True, help="path of the figures, without extension")
    parser.add_argument("--iterates", help="iterates.csv of the same run, to draw as well")
    parser.add_argument("--column", default="rmse", choices=sorted(LABELS))
    parser.add_argument("--title", default="")
    add_format_argument(parser)
    arguments = parser.parse_args()
    iterates = read_groups(arguments.iterates, "metric") if arguments.iterates else {}
    figure = draw(read_groups(arguments.curves, "metric"), iterates, arguments.column,
                  arguments.title)
    save(figure, arguments.out, arguments.formats)


if __name__ == "__main__":
    main()
