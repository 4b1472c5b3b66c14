# SPDX-License-Identifier: BSD-3-Clause
"""What the plots share: how tables are read and files written, colours, line styles, labels."""
import csv
import itertools
import os
from collections import defaultdict

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

# The paper's colours and line styles; further metrics take the other colours in turn.
STYLES = {
    "edge_to_line": ("edge point to edge line", "tab:orange", "--"),
    "planar_to_patch": ("planar point to planar patch", "tab:green", "-"),
    "point_to_point": ("point-to-point", "tab:blue", "-"),
    "point_to_plane": ("point-to-plane", "tab:purple", "--"),
    "symmetric": ("symmetric objective function", "tab:cyan", "-."),
}
OTHER_COLORS = ("tab:red", "tab:brown", "tab:pink", "tab:olive", "tab:gray")

LABELS = {
    "rmse": r"RMSE($\epsilon$)",
    "rms_residual": r"$\sqrt{\Sigma |r|^2 / n}$",
    "rmse_fixed_n": r"$\sqrt{\epsilon / n(u=1)}$",
    "epsilon": r"$\epsilon$",
    "cost": r"cost $\frac{1}{2} \Sigma \rho(|r|^2)$",
    "inlier_ratio": "inlier ratio",
}


def read_groups(path, group):
    """The table's numbers by the value in the column `group`, and then by column: lists of floats.
    Without that column all rows are one group, "".
    """
    groups = defaultdict(lambda: defaultdict(list))
    with open(path, newline="") as file:
        for row in csv.DictReader(file):
            columns = groups[row.pop(group, "")]
            for column, value in row.items():
                columns[column].append(float(value))
    return groups


def styles_of(metrics):
    """Label, colour and line style of each."""
    others = itertools.cycle(OTHER_COLORS)
    return {metric: STYLES.get(metric) or (metric.replace("_", " "), next(others), "-")
            for metric in metrics}


def add_format_argument(parser):
    parser.add_argument("--formats", default="all", choices=("svg", "png", "all"))


def save(figure, path, formats, dpi=150):
    """PATH.svg, PATH.png or both ("all"), each beside its place and then renamed to it."""
    plt.rcParams["svg.hashsalt"] = "icpscape"  # The same picture is the same file.
    for extension, options in ((".svg", {"metadata": {"Date": None}}), (".png", {"dpi": dpi})):
        if formats not in ("all", extension[1:]):
            continue
        part = path + ".part" + extension
        figure.savefig(part, **options)
        os.replace(part, path + extension)
