#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Measures KITTI's lidar on its scans: where the simulated lidar's constants come from.

  tools/measure_lidar.py KITTI_ROOT

Beams, azimuth step, noise, gaps and the lasers' own errors come from 07/000000, where the car stands;
the car's own shadow from all scans below KITTI_ROOT.
"""
import argparse
import pathlib
import sys

import numpy as np

try:
    from scipy.spatial import cKDTree
except ImportError:
    sys.exit("measure_lidar.py: needs scipy; expected tools/setup.sh --with-comparison to have run.")

RING = np.arange(64)
ELEVATION_DEG = np.where(RING < 32, 1.94 - 0.3435 * RING, -9.03 - 0.515 * (RING - 32))
HEIGHT_M = np.where(RING < 32, 0.206 - 0.00026 * RING, 0.135 - 0.0003 * RING)


def read(path):
    return np.fromfile(path, "<f4").reshape(-1, 4)[:, :3].astype(float)


def nearest_beam(p):
    level = np.hypot(p[:, 0], p[:, 1])[:, None]
    seen = np.degrees(np.arctan((p[:, 2:] - HEIGHT_M) / level))
    return np.argmin(np.abs(seen - ELEVATION_DEG), axis=1)


def measure_beams(p):
    level, azimuth = np.hypot(p[:, 0], p[:, 1]), np.arctan2(p[:, 1], p[:, 0])
    # The file goes ring by ring; a ring ends where the azimuth turns from - to +.
    ring = np.cumsum(np.r_[0, (azimuth[1:] >= 0) & (azimuth[:-1] < 0)])
    print("ring  elevation (deg)  height (m)  residual (deg, median)")
    for k in (0, 8, 16, 24, 31, 32, 40, 48, 56, 63):
        chosen = (ring == k) & (level > 3)
        A = np.c_[np.ones(chosen.sum()), 1 / level[chosen]]
        b = p[chosen, 2] / level[chosen]
        weight = np.ones(len(b))
        for _ in range(20):
            x = np.linalg.lstsq(A * weight[:, None], b * weight, rcond=None)[0]
            weight = 1 / np.sqrt(1 + ((b - A @ x) / 0.0005) ** 2)
        residual = np.degrees(np.median(np.abs(b - A @ x)))
        print(f"{k:4d} {np.degrees(np.arctan(x[0])):16.2f} {x[1]:11.3f} {residual:12.4f}")
    return ring, azimuth


def measure_ranges(p, ring, azimuth):
    distance = np.linalg.norm(p, axis=1)
    step = np.degrees(np.diff(azimuth))
    smooth = (np.diff(ring) == 0) & (np.abs(np.diff(distance)) < 0.3) & (step > 0) & (step < 2)
    median = np.median(step[smooth])
    steps = np.round(step[smooth] / median)
    print(f"azimuth step: {median:.4f} deg; single gaps: {100 * (steps == 2).mean():.2f} % of steps")
    # Third differences of consecutive ranges cancel smooth surfaces; their variance is 20 times
    # that of one range.
    third = distance[:-3] - 3 * distance[1:-2] + 3 * distance[2:-1] - distance[3:]
    run = smooth[:-2] & smooth[1:-1] & smooth[2:]
    for low, high in ((4, 8), (8, 15), (15, 30)):
        chosen = run & (p[:-3, 2] < -1.4) & (distance[:-3] > low) & (distance[:-3] < high)
        sigma = 1.4826 * np.median(np.abs(third[chosen])) / np.sqrt(20)
        print(f"range noise on the road at {low} to {high} m: {1000 * sigma:.1f} mm")


def measure_ring_errors(p):
    """Median distance of each ring's points from planes fitted to all rings."""
    distance = np.linalg.norm(p, axis=1)
    chosen = np.flatnonzero(distance < 20)[::3]
    index = cKDTree(p).query(p[chosen], 60)[1]
    mean = p[index].mean(1)
    centred = p[index] - mean[:, None]
    value, vector = np.linalg.eigh(np.einsum("nij,nik->njk", centred, centred) / 60)
    normal = vector[:, :, 0]
    cosine = np.einsum("ni,ni->n", normal, p[chosen] / distance[chosen][:, None])
    good = (value[:, 0] < 0.03**2) & (np.abs(cosine) > 0.6) & (value[:, 1] > 0.01)
    error = np.einsum("ni,ni->n", p[chosen] - mean, normal) / cosine
    ring = nearest_beam(p[chosen])
    medians = [np.median(error[good & (ring == k)]) for k in RING if (good & (ring == k)).sum() > 30]
    print(f"the lasers' own errors: {1000 * np.std(medians):.0f} mm over {len(medians)} rings")


def measure_shadow(paths):
    count = np.zeros((36, 64))
    for path in paths:
        p = read(path)
        azimuth = np.abs(np.degrees(np.arctan2(p[:, 1], p[:, 0])))
        np.add.at(count, (np.minimum(azimuth // 5, 35).astype(int), nearest_beam(p)), 1)
    share = count / (len(paths) * 2 * 5 / 0.1794)
    last = [int(np.flatnonzero(row > 0.4).max()) for row in share]
    print(f"last ring past the car, by |azimuth| in steps of 5 deg, {len(paths)} scans:\n{last}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("root", type=pathlib.Path, help="KITTI_ROOT with sequences/07")
    root = parser.parse_args().root
    standing = read(root / "sequences" / "07" / "velodyne" / "000000.bin")
    ring, azimuth = measure_beams(standing)
    measure_ranges(standing, ring, azimuth)
    measure_ring_errors(standing)
    measure_shadow(sorted(root.rglob("*.bin")))


if __name__ == "__main__":
    main()
