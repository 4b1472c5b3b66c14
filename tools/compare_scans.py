#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Statistics of two scan pairs side by side, as a Markdown table and a figure.

  tools/compare_scans.py --reference KITTI_ROOT:00:15 --simulated OUT:straight_street:2 \
      --figure docs/images/compare_street.png

A scan is named ROOT:SEQUENCE:FRAME in KITTI's layout; the frame before it and the true motion give
the residuals. The table goes to stdout; values that differ by more than a third are marked.
"""
import argparse
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

try:
    from scipy.spatial import cKDTree
except ImportError:
    sys.exit("compare_scans.py: needs scipy; expected tools/setup.sh --with-comparison to have run.")

RANGE_EDGES = np.array([0, 5, 10, 15, 20, 30, 40, 60, 120.0])
NEIGHBOURS = 20


def read_points(root, sequence, frame):
    path = root / "sequences" / sequence / "velodyne" / f"{frame:06d}.bin"
    return np.fromfile(path, "<f4").reshape(-1, 4)[:, :3].astype(float)


def read_motion(root, sequence, frame):
    """T(frame - 1 <- frame) of the lidar."""
    rows = np.loadtxt(root / "poses" / f"{sequence}.txt", ndmin=2)
    matrix = lambda row: np.vstack([np.reshape(row, (3, 4)), [0, 0, 0, 1]])
    for line in open(root / "sequences" / sequence / "calib.txt"):
        if line.startswith("Tr"):
            calibration = matrix(np.array(line.split(":")[1].split(), float))
    relative = np.linalg.inv(matrix(rows[frame - 1])) @ matrix(rows[frame])
    return np.linalg.inv(calibration) @ relative @ calibration


def normals(points, tree):
    out = np.empty_like(points)
    for begin in range(0, len(points), 20000):
        chunk = slice(begin, begin + 20000)
        _, index = tree.query(points[chunk], NEIGHBOURS)
        centred = points[index] - points[index].mean(1, keepdims=True)
        out[chunk] = np.linalg.eigh(np.einsum("nij,nik->njk", centred, centred))[1][:, :, 0]
    return out


class Scan:
    """The statistics of one scan, and of its residuals to the scan before it at the truth."""

    def __init__(self, name):
        root, sequence, frame = name.rsplit(":", 2)
        root, frame = pathlib.Path(root), int(frame)
        self.name = f"{sequence}/{frame}"
        p = self.points = read_points(root, sequence, frame)
        self.range = np.linalg.norm(p, axis=1)
        tree = cKDTree(p)
        self.spacing = tree.query(p, 2)[0][:, 1]
        self.normal = normals(p, tree)
        up = np.abs(self.normal[:, 2])
        self.ground = (up > 0.9) & (p[:, 2] > -2.3) & (p[:, 2] < -1.2)
        # The beam whose elevation a point has, as src/simulation/lidar.cc measured the beams.
        ring = np.arange(64)
        upper = ring < 32
        elevation = np.where(upper, 1.94 - 0.3435 * ring, -9.03 - 0.515 * (ring - 32))
        height = np.where(upper, 0.206 - 0.00026 * ring, 0.135 - 0.0003 * ring)
        level = np.hypot(p[:, 0], p[:, 1])[:, None]
        seen = np.degrees(np.arctan((p[:, 2:] - height) / level))
        self.ring = np.argmin(np.abs(seen - elevation), axis=1)
        self.per_ring = np.bincount(self.ring, minlength=64)[:64]
        target = read_points(root, sequence, frame - 1)
        target_tree = cKDTree(target)
        motion = read_motion(root, sequence, frame)
        moved = p @ motion[:3, :3].T + motion[:3, 3]
        distance, index = target_tree.query(moved)
        n = normals(target, target_tree)[index]
        plane = np.einsum("ij,ij->i", moved - target[index], n)
        self.residual = {"point": distance, "plane": np.abs(plane)}

    def rows(self):
        yield "points per scan", "", float(len(self.points))
        for q in (25, 50, 75):
            yield f"range, {q} % of the points within", "m", np.percentile(self.range, q)
        share = np.histogram(self.range, RANGE_EDGES)[0] / len(self.range)
        for low, high, value in zip(RANGE_EDGES, RANGE_EDGES[1:], share):
            yield f"share at {low:g} to {high:g} m", "%", 100 * value
        for first, last in ((0, 15), (16, 31), (32, 47), (48, 63)):
            value = self.per_ring[first : last + 1].mean()
            yield f"points per ring, rings {first} to {last}", "", value
        for low, high in ((0, 5), (5, 10), (10, 20), (20, 40)):
            chosen = (self.range >= low) & (self.range < high)
            value = 1000 * np.median(self.spacing[chosen])
            yield f"distance to nearest point, {low} to {high} m", "mm", value
        yield "share of ground", "%", 100 * self.ground.mean()
        up = np.abs(self.normal[:, 2])
        yield "normals within 25 deg of vertical", "%", 100 * (up > np.cos(np.radians(25))).mean()
        yield "normals within 25 deg of level", "%", 100 * (up < np.sin(np.radians(25))).mean()
        yield "other normals", "%", 100 * ((up <= 0.906) & (up >= 0.423)).mean()
        for kind in ("point", "plane"):
            r = self.residual[kind]
            yield f"point-to-{kind} at the truth, RMS", "mm", 1000 * np.sqrt(np.mean(r**2))
            yield f"point-to-{kind} at the truth, median", "mm", 1000 * np.median(r)
            yield f"point-to-{kind} at the truth, 90 %", "mm", 1000 * np.percentile(r, 90)


def print_table(a, b):
    print(f"| Quantity | KITTI {a.name} | simulated {b.name} | ratio |\n|---|---|---|---|")
    for (name, unit, x), (_, _, y) in zip(a.rows(), b.rows()):
        ratio = y / x if x else np.inf
        mark = " (!)" if abs(np.log(max(ratio, 1e-9))) > np.log(4 / 3) else ""
        digits = 0 if max(x, y) >= 100 else 1
        print(f"| {name}{' (' + unit + ')' if unit else ''} | {x:.{digits}f} | {y:.{digits}f} "
              f"| {ratio:.2f}{mark} |")


def draw(a, b, path):
    figure, axes = plt.subplots(2, 3, figsize=(11, 6))
    style = ((a, f"KITTI {a.name}", "black", "-"), (b, f"simulated {b.name}", "tab:blue", "--"))
    plots = axes.ravel()
    for s, label, colour, line in style:
        look = {"label": label, "color": colour, "linestyle": line}
        plots[0].hist(s.range, np.arange(0, 82, 2), histtype="step", density=True, **look)
        plots[1].plot(s.per_ring, **look)
        centres = np.arange(4, 50, 2)
        median = [np.median(s.spacing[np.abs(s.range - c) < 1]) for c in centres]
        plots[2].plot(centres, 1000 * np.array(median), **look)
        plots[3].hist(np.abs(s.normal[:, 2]), 40, histtype="step", density=True, **look)
        for plot, kind in ((plots[4], "point"), (plots[5], "plane")):
            r = np.sort(1000 * s.residual[kind])
            plot.plot(r[::50], np.linspace(0, 1, len(r))[::50], **look)
    plots[1].set_ylim(bottom=0)
    for plot in plots[4:]:
        plot.set_xscale("log")
        plot.set_xlim(1, 3000)
    titles = (("range (m)", "density"), ("ring, 0 uppermost", "points"),
              ("range (m)", "median distance to nearest point (mm)"),
              ("|z| of the normal", "density"),
              ("point-to-point residual at the truth (mm)", "share of points below"),
              ("point-to-plane residual at the truth (mm)", "share of points below"))
    for plot, (x, y) in zip(plots, titles):
        plot.set_xlabel(x)
        plot.set_ylabel(y)
        plot.grid(alpha=0.3)
    plots[0].legend(frameon=False)
    figure.tight_layout()
    figure.savefig(path, dpi=110)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--reference", required=True, metavar="ROOT:SEQUENCE:FRAME")
    parser.add_argument("--simulated", required=True, metavar="ROOT:SEQUENCE:FRAME")
    parser.add_argument("--figure", help="picture to write")
    arguments = parser.parse_args()
    a, b = Scan(arguments.reference), Scan(arguments.simulated)
    print_table(a, b)
    if arguments.figure:
        draw(a, b, arguments.figure)


if __name__ == "__main__":
    main()
