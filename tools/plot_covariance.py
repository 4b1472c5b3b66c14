#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws what icpscape-covariance found by Monte-Carlo.

Per metric: the errors of all draws in two planes, with the 95 % ellipse of their own spread and
those that the estimators predict (about the errors' mean); and the NEES of each estimator.
"""
import argparse
import csv
import math
import os

import numpy as np
from plot_style import add_format_argument, plt, save

COMPONENTS = ["rx", "ry", "rz", "tx", "ty", "tz"]
UNITS = ["rad"] * 3 + ["m"] * 3
LABELS = ["roll (mdeg)", "pitch (mdeg)", "yaw (mdeg)", "x (mm)", "y (mm)", "z (mm)"]
SCALES = np.array([math.degrees(1) * 1000] * 3 + [1000] * 3)
PLANES = [(3, 4), (5, 1)]
STYLES = {"monte_carlo": ("black", "-"), "gauss_newton": ("tab:blue", "-"),
          "censi": ("tab:orange", "-"), "censi_ring_bias": ("tab:red", "--"),
          "sandwich": ("tab:cyan", "-"), "sandwich_clustered": ("tab:purple", "--"),
          "sandwich_rematched": ("tab:green", "-")}
CHI_SQUARE_2_95 = 5.991  # 95 % of two degrees of freedom.


def read(folder, name):
    with open(os.path.join(folder, name), newline="") as file:
        return list(csv.DictReader(file))


def covariance_of(row):
    matrix = np.empty((6, 6))
    for i in range(6):
        for j in range(i, 6):
            name = f"cov_{COMPONENTS[i]}_{COMPONENTS[j]}_{UNITS[i]}_{UNITS[j]}"
            matrix[i, j] = matrix[j, i] = float(row[name]) * SCALES[i] * SCALES[j]
    return matrix


def ellipse(mean, covariance):
    values, vectors = np.linalg.eigh(covariance)
    angle = np.linspace(0, 2 * math.pi, 200)
    circle = np.array([np.cos(angle), np.sin(angle)])
    return mean[:, None] + vectors @ (np.sqrt(CHI_SQUARE_2_95 * values)[:, None] * circle)


def draw_plane(axes, plane, errors, rows):
    index = list(plane)
    points = errors[:, index]
    mean = points.mean(axis=0)
    axes.plot(points[:, 0], points[:, 1], ".", color="0.65", markersize=4, zorder=1)
    axes.plot(0, 0, "+", color="tab:red", markersize=11, markeredgewidth=2, zorder=4)
    for row in rows:
        color, style = STYLES[row["estimator"]]
        curve = ellipse(mean, covariance_of(row)[np.ix_(index, index)])
        axes.plot(curve[0], curve[1], style, color=color, zorder=3,
                  linewidth=2.4 if row["estimator"] == "monte_carlo" else 1.4)
    # The draws and the spread decide about the window; what an estimator predicts may leave it.
    spread = ellipse(mean, covariance_of(rows[0])[np.ix_(index, index)])
    shown = np.vstack([points, spread.T, [[0, 0]]])
    for limit, values in zip((axes.set_xlim, axes.set_ylim), shown.T):
        margin = 0.25 * np.ptp(values)
        limit(values.min() - margin, values.max() + margin)
    axes.set_xlabel("error in " + LABELS[plane[0]])
    axes.set_ylabel("error in " + LABELS[plane[1]])


def draw_nees(axes, rows):
    rows = [row for row in rows if row["estimator"] != "monte_carlo"]
    if not rows:
        axes.set_axis_off()
        return
    for place, row in enumerate(reversed(rows)):
        color = STYLES[row["estimator"]][0]
        mean = float(row["nees_about_mean"])
        truth = float(row["nees_about_truth"])
        axes.plot([6, mean], [place, place], color=color, linewidth=5, solid_capstyle="butt")
        axes.plot(mean, place, "o", color=color, markersize=5)
        axes.plot(truth, place, "x", color="0.3", markersize=6)
        axes.annotate(f"{mean:,.0f}" if mean >= 100 else f"{mean:.1f}", (mean, place), xytext=(0, 6), textcoords="offset points",
                      ha="center", fontsize=8)
    axes.axvspan(float(rows[0]["mean_lower_95"]), float(rows[0]["mean_upper_95"]), color="0.85",
                 zorder=0)
    axes.axvline(6, color="0.4", linewidth=0.8)
    for bound in (3, 12):
        axes.axvline(bound, color="0.6", linewidth=0.8, linestyle=":")
    axes.set_xscale("log")
    ends = [3, 12] + [float(row[f"nees_about_{what}"]) for row in rows for what in ("mean", "truth")]
    axes.set_xlim(min(ends) / 2, max(ends) * 3)
    axes.set_yticks(range(len(rows)), [row["estimator"].replace("_", " ") for row in reversed(rows)])
    axes.set_ylim(-0.6, len(rows) - 0.2)
    axes.set_xlabel("NEES about the mean (dot), about the truth (x)")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", help="folder with draws.csv and calibration.csv")
    parser.add_argument("--out", required=True, help="path of the figures, without extension")
    parser.add_argument("--title", default="")
    add_format_argument(parser)
    arguments = parser.parse_args()
    draws = read(arguments.folder, "draws.csv")
    calibration = read(arguments.folder, "calibration.csv")
    metrics = list(dict.fromkeys(row["metric"] for row in draws))
    height = 3.7 * len(metrics) + 0.8
    figure, panels = plt.subplots(len(metrics), 3, figsize=(13, height), squeeze=False,
                                  layout="constrained")
    figure.get_layout_engine().set(rect=(0, 0.4 / height, 1, 1 - 0.4 / height))
    for line, metric in zip(panels, metrics):
        errors = np.array([[float(row[f"error_{name}_{unit}"])
                            for name, unit in zip(COMPONENTS, UNITS)]
                           for row in draws if row["metric"] == metric])
        errors = errors[np.isfinite(errors).all(axis=1)] * SCALES
        rows = [row for row in calibration if row["metric"] == metric]
        for axes, plane in zip(line, PLANES):
            draw_plane(axes, plane, errors, rows)
        line[0].set_title(metric.replace("_", " "), loc="left", fontsize=11)
        draw_nees(line[2], rows)
    handles = [plt.Line2D([], [], color="0.65", marker=".", linestyle="", label="a draw"),
               plt.Line2D([], [], color="tab:red", marker="+", linestyle="", markersize=10,
                          label="truth")]
    handles += [plt.Line2D([], [], color=color, linestyle=style,
                           label="spread of the draws" if name == "monte_carlo"
                           else name.replace("_", " "))
                for name, (color, style) in STYLES.items()
                if any(row["estimator"] == name for row in calibration)]
    figure.legend(handles=handles, loc="lower center", ncols=len(handles), frameon=False,
                  fontsize=8)
    figure.suptitle(arguments.title + ": errors, 95 % ellipses and NEES", fontsize=11)
    save(figure, arguments.out, arguments.formats, dpi=110)


if __name__ == "__main__":
    main()
