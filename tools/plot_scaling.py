#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws how time and memory grow with points, poses and threads, from the JSON of icpscape_scaling
(one file per size), and writes the same numbers as a Markdown document.
"""
import argparse
import json
import os
import statistics

import matplotlib

matplotlib.use("Agg")
matplotlib.rcParams["svg.hashsalt"] = "icpscape"
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402

from benchmark_table import machine_lines, markdown_table, milliseconds  # noqa: E402

# Names in the JSON, in the order of the legend; what each does, and its colour.
WORK = {
    "tree": ("build the tree", "tab:gray"),
    "nearest": ("1-NN of all points", "tab:blue"),
    "nanoflann": ("1-NN, nanoflann", "tab:red"),
    "normals": ("20-neighbour normals", "tab:green"),
    "register": ("point-to-plane registration", "tab:purple"),
    "landscape": ("landscape, 10 poses, 3 metrics", "tab:orange"),
}
BYTES_PER_POINT = 2 * 6 * 4  # Two clouds of coordinates and normals.


class Size:
    """All repetitions on one pair: medians by (work, threads, poses)."""

    def __init__(self, path):
        with open(path) as file:
            results = json.load(file)
        self.context = results["context"]
        self.points = int(self.context["source_points"])
        times, memory = {}, {}
        for entry in results["benchmarks"]:
            if entry.get("run_type") == "aggregate":
                continue
            key = entry["label"], int(entry["threads"]), int(entry["poses"])
            times.setdefault(key, []).append(entry["real_time"])
            memory.setdefault(key, []).append(entry["peak_mb"])
        self.ms = {key: statistics.median(values) for key, values in times.items()}
        self.mb = {key: max(values) for key, values in memory.items()}


def key_of(work, threads):
    return work, threads, 10 if work == "landscape" else 0


def exponent(x, y):
    """p of the best y = c x^p."""
    return np.polyfit(np.log(x), np.log(y), 1)[0]


def draw(sizes, poses, path):
    figure, (over_points, over_poses, memory) = plt.subplots(
        1, 3, figsize=(12, 4.2), layout="constrained")
    x = [size.points for size in sizes]
    for work, (label, color) in WORK.items():
        for threads, style in ((1, "-"), (2, "--")):
            key = key_of(work, threads)
            if key in sizes[0].ms:
                over_points.loglog(x, [size.ms[key] for size in sizes], style, color=color,
                                   marker=".", label=label if threads == 1 else None)
        if work not in ("nanoflann", "nearest"):  # Searching takes no memory.
            memory.loglog(x, [size.mb[key_of(work, 1)] for size in sizes], color=color, marker=".")
    memory.loglog(x, [BYTES_PER_POINT * n / 1e6 for n in x], "k:", label="the two clouds")
    for threads, style in ((1, "-"), (2, "--")):
        keys = sorted(key for key in poses.ms if key[1] == threads)
        over_poses.loglog([key[2] for key in keys], [poses.ms[key] for key in keys], style,
                          color=WORK["landscape"][1], marker=".",
                          label=f"{threads} thread{'s' if threads > 1 else ''}")
    over_points.set(xlabel="points of a scan", ylabel="ms", title="one thread (two: dashed)")
    over_poses.set(xlabel="poses", ylabel="ms", title=f"landscape, {poses.points} points")
    memory.set(xlabel="points of a scan", ylabel="MB beside the clouds", title="peak memory")
    for panel in (over_points, over_poses, memory):
        low, high = panel.get_xlim()
        bottom, top = panel.get_ylim()
        panel.set_xlim(low, high)
        panel.set_ylim(bottom, top * (top / bottom) ** 0.4)  # Room for the legend.
        panel.plot([low, high], [bottom, bottom * high / low], color="0.85", zorder=0,
                   label="linear")
        panel.legend(fontsize="small", loc="upper left")
        panel.grid(alpha=0.3)
    os.makedirs(os.path.dirname(path) or ".", exist_ok=True)
    figure.savefig(path, metadata={"Date": None})


def points_table(sizes):
    lines = []
    for work, (label, _) in WORK.items():
        for threads in (1, 2):
            key = key_of(work, threads)
            if key in sizes[0].ms:
                power = exponent([size.points for size in sizes], [size.ms[key] for size in sizes])
                lines.append([f"{label}, {threads} thread{'s' if threads > 1 else ''}"]
                             + [milliseconds(size.ms[key]) for size in sizes] + [f"{power:.2f}"])
    return markdown_table(["ms"] + [f"{size.points} points" for size in sizes] + ["exponent"],
                          lines)


def memory_table(sizes):
    lines = [["the two clouds, with normals"]
             + [milliseconds(BYTES_PER_POINT * size.points / 1e6) for size in sizes]]
    for work, (label, _) in WORK.items():
        if work != "nanoflann":
            lines += [[f"{label}, {threads} thread{'s' if threads > 1 else ''}"]
                      + [milliseconds(size.mb[key_of(work, threads)]) for size in sizes]
                      for threads in (1, 2) if key_of(work, threads) in sizes[0].mb]
    return markdown_table(["MB"] + [f"{size.points} points" for size in sizes], lines)


def poses_table(poses):
    counts = sorted({key[2] for key in poses.ms})
    lines = []
    for threads in (1, 2):
        times = [poses.ms["landscape", threads, count] for count in counts]
        lines.append([f"{threads} thread{'s' if threads > 1 else ''}"]
                     + [milliseconds(time) for time in times] + [f"{exponent(counts, times):.2f}"])
    return markdown_table(["ms"] + [f"{count} poses" for count in counts] + ["exponent"], lines)


def document(sizes, poses, picture, command):
    out = ["# How do time and memory grow?", "",
           f"Written by `{command}`; do not edit. Simulated scans of the straight street, whose "
           "lidar fires more or less often. Times are medians; an exponent of 1 is linear growth.",
           ""]
    out += machine_lines(sizes[0].context)
    out += [f"- SIMD level {sizes[0].context['widest_simd']}", "", f"![Time and memory]({picture})",
            "", "## Points", ""]
    out += points_table(sizes)
    out += ["", f"## Poses, {poses.points} points, 3 closest-point metrics", ""]
    out += poses_table(poses)
    out += ["", "## Peak memory beside the clouds", ""]
    out += memory_table(sizes)
    return "\n".join(out) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("points", nargs="+", help="JSON of icpscape_scaling, one per size")
    parser.add_argument("--poses", required=True, help="JSON of landscapes of many poses")
    parser.add_argument("--picture", required=True, help="where to draw it (.svg)")
    parser.add_argument("--document", required=True, help="where to write the Markdown document")
    parser.add_argument("--command", default="tools/benchmark.sh --scaling",
                        help="the command to name in the document")
    arguments = parser.parse_args()
    sizes = sorted((Size(path) for path in arguments.points), key=lambda size: size.points)
    poses = Size(arguments.poses)
    draw(sizes, poses, arguments.picture)
    picture = os.path.relpath(arguments.picture, os.path.dirname(arguments.document))
    with open(arguments.document, "w") as file:
        file.write(document(sizes, poses, picture, arguments.command))
    print(f"written: {arguments.document}, {arguments.picture}")


if __name__ == "__main__":
    main()
