#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws a simulated scan, coloured by label: seen from above, and from behind the car.

  tools/plot_scan.py SEQUENCE_FOLDER --scan 2 --out scan.png
"""
import argparse
import io
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from PIL import Image

# SemanticKITTI's classes (src/cloud/label.h).
CLASSES = {
    40: ("road", "#b9b4be"),
    48: ("pavement", "#8d7fa6"),
    72: ("terrain", "#c9b98a"),
    70: ("vegetation", "#5a9e4b"),
    71: ("trunk", "#7a4e2a"),
    50: ("building", "#d9a441"),
    51: ("fence, guard rail", "#c9602b"),
    80: ("pole", "#222222"),
    81: ("traffic sign", "#e31a8d"),
    10: ("parked car", "#3b6fd4"),
    99: ("other object", "#1fb5c4"),
    252: ("moving car", "#e3170d"),
    258: ("moving lorry", "#7d0c9c"),
}


def read(folder, scan):
    points = np.fromfile(folder / "velodyne" / f"{scan:06d}.bin", "<f4").reshape(-1, 4)
    labels = np.fromfile(folder / "labels" / f"{scan:06d}.label", "<u4") & 0xFFFF
    if len(labels) != len(points):
        sys.exit(f"{folder}: {len(points)} points but {len(labels)} labels; expected as many.")
    return points[:, :3].astype(float), labels


def view_from_above(axes, points, labels, extent):
    for number, (_, colour) in CLASSES.items():
        chosen = labels == number
        axes.scatter(points[chosen, 0], points[chosen, 1], s=0.12, c=colour, linewidths=0)
    axes.plot(0, 0, marker="^", color="black", markersize=5)
    axes.set_xlim(-extent, extent)
    axes.set_ylim(-extent * 0.5, extent * 0.5)
    axes.set_aspect("equal")
    axes.set_xlabel("x, forward (m)")
    axes.set_ylabel("y, left (m)")


def perspective(axes, points, labels):
    """A pinhole camera 12 m behind the lidar and 7 m above it, looking ahead and down."""
    pitch = np.radians(20)
    p = points - np.array([-12.0, 0.0, 7.0])
    depth = np.cos(pitch) * p[:, 0] - np.sin(pitch) * p[:, 2]
    up = np.sin(pitch) * p[:, 0] + np.cos(pitch) * p[:, 2]
    seen = depth > 2
    x, y = -p[seen, 1] / depth[seen], up[seen] / depth[seen]
    order = np.argsort(-depth[seen])
    colour = np.array([CLASSES.get(l, ("", "#ff00ff"))[1] for l in labels[seen]])
    size = np.clip(14 / depth[seen], 0.15, 2.0)
    axes.scatter(x[order], y[order], s=size[order], c=colour[order], linewidths=0)
    axes.set_xlim(-0.95, 0.95)
    axes.set_ylim(-0.42, 0.42)
    axes.set_aspect("equal")
    axes.set_axis_off()


def save_with_palette(figure, path, dpi):
    """Writes a small PNG: the classes' colours and greys, in a few shades towards white."""
    buffer = io.BytesIO()
    figure.savefig(buffer, dpi=dpi, format="png")
    colours = [colour for _, colour in CLASSES.values()] + ["#000000"]
    shades = [np.array(matplotlib.colors.to_rgb(c)) * t + 1 - t
              for c in colours for t in (1, 0.75, 0.5, 0.25)] + [np.ones(3)]
    palette = Image.new("P", (1, 1))
    palette.putpalette(np.round(255 * np.array(shades)).astype(np.uint8).ravel().tolist())
    image = Image.open(buffer).convert("RGB")
    image.quantize(palette=palette, dither=Image.Dither.NONE).save(path, optimize=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=pathlib.Path, help="ROOT/sequences/NAME")
    parser.add_argument("--scan", type=int, default=2)
    parser.add_argument("--out", default="scan.png", help="picture to write (PNG)")
    parser.add_argument("--extent", type=float, default=60, help="half-width of the plan (m)")
    parser.add_argument("--dpi", type=int, default=105)
    arguments = parser.parse_args()
    points, labels = read(arguments.folder, arguments.scan)
    figure, (above, behind) = plt.subplots(2, 1, figsize=(8, 7.6),
                                           gridspec_kw={"height_ratios": [1.1, 1]})
    view_from_above(above, points, labels, arguments.extent)
    perspective(behind, points, labels)
    present = [v for k, v in CLASSES.items() if (labels == k).any()]
    handles = [plt.Line2D([], [], marker="o", linestyle="", color=c, label=n) for n, c in present]
    figure.legend(handles=handles, ncol=6, loc="lower center", frameon=False, fontsize=8)
    above.set_title(f"{arguments.folder.name}, scan {arguments.scan}: {len(points)} points")
    figure.tight_layout(rect=(0, 0.05, 1, 1))
    save_with_palette(figure, arguments.out, arguments.dpi)


if __name__ == "__main__":
    main()
