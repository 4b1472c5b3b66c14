#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws trajectory.csv: estimated trajectories and, where it is known, the truth, seen from above;
below, how far the estimate is off over the length of the path."""
import argparse
import math

from plot_style import add_format_argument, plt, read_groups, save

TRUTH, ESTIMATE = "0.55", "tab:blue"
COLUMNS = 4  # Sequences side by side.


def has_truth(sequence):
    return not math.isnan(sequence["truth_x_m"][0])


def ground_axes(sequence):
    """x and z for poses of a camera (y down), x and y for all others (z up): no road climbs as far
    as a camera's z goes."""
    def extent(axis):
        return max(sequence[axis + "_m"]) - min(sequence[axis + "_m"])
    x, y, z = (extent(axis) for axis in "xyz")
    return ("x", "z") if z > y and z > 0.15 * max(x, y, z) else ("x", "y")


def draw_positions(axes, sequence):
    first, second = ground_axes(sequence)
    lines = [("", ESTIMATE, "estimate", 1.3)]
    if has_truth(sequence):
        lines.insert(0, ("truth_", TRUTH, "ground truth", 2.6))
    for prefix, color, label, width in lines:
        axes.plot(sequence[f"{prefix}{first}_m"], sequence[f"{prefix}{second}_m"], color=color,
                  linewidth=width, label=label)
    x, y = sequence[first + "_m"], sequence[second + "_m"]
    axes.plot(x[0], y[0], "o", color="k", markerfacecolor="white", markersize=6, label="start")
    axes.plot(x[-1], y[-1], "s", color=ESTIMATE, markersize=5, label="end")
    if has_truth(sequence):
        axes.plot(sequence[f"truth_{first}_m"][-1], sequence[f"truth_{second}_m"][-1], "s",
                  color=TRUTH, markersize=5)
    axes.set_aspect("equal", adjustable="datalim")
    axes.margins(0.08)
    axes.set_xlabel(f"{first} (m)")
    axes.set_ylabel(f"{second} (m)")


def draw_error(axes, sequence):
    axes.plot(sequence["path_m"], sequence["error_m"], color=ESTIMATE, linewidth=1.2)
    axes.set_xlim(0, max(sequence["path_m"][-1], 1e-9))
    axes.set_ylim(bottom=0)
    axes.set_xlabel("path (m)")
    axes.set_ylabel("error (m)")


def draw(sequences, title):
    columns = min(COLUMNS, len(sequences))
    blocks = -(-len(sequences) // columns)
    with_errors = any(has_truth(sequence) for sequence in sequences.values())
    heights = (3, 1.1) if with_errors else (3,)
    width = 6 if columns == 1 else 3.6 * columns
    height = 0.9 + blocks * sum(heights) * 0.27 * width / columns
    figure, panels = plt.subplots(
        blocks * len(heights), columns, squeeze=False, layout="constrained",
        figsize=(width, height),
        height_ratios=heights * blocks)
    for axes in panels.flat:
        axes.grid(linewidth=0.4, color="0.9")
        axes.set_axisbelow(True)
        for side in ("top", "right"):
            axes.spines[side].set_visible(False)
    for i, (name, sequence) in enumerate(sequences.items()):
        row, column = len(heights) * (i // columns), i % columns
        draw_positions(panels[row, column], sequence)
        if len(sequences) > 1:
            panels[row, column].set_title(name, fontsize=10, parse_math=False)
        if with_errors:
            if has_truth(sequence):
                draw_error(panels[row + 1, column], sequence)
            else:
                panels[row + 1, column].set_visible(False)
    for i in range(len(sequences), blocks * columns):
        for row in range(len(heights)):
            panels[len(heights) * (i // columns) + row, i % columns].set_visible(False)
    handles, labels = panels[0, 0].get_legend_handles_labels()
    legend = figure.legend(handles, labels, title=title or None, loc="upper center", ncol=4,
                           frameon=False, fontsize=9, title_fontsize=11)
    legend.get_title().set_parse_math(False)
    figure.get_layout_engine().set(rect=(0, 0, 1, 1 - (0.3 + (0.25 + 0.15 * title.count("\n") if title else 0)) / height))
    return figure


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("trajectory", help="trajectory.csv as the programs write it")
    parser.add_argument("--out", required=True, help="path of the figures, without extension")
    parser.add_argument("--title", default="")
    add_format_argument(parser)
    arguments = parser.parse_args()
    figure = draw(read_groups(arguments.trajectory, "sequence"), arguments.title)
    save(figure, arguments.out, arguments.formats)


if __name__ == "__main__":
    main()
