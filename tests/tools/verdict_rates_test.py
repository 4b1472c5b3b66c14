#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests of tools/verdict_rates.py and undetermined_pairs.py: the arithmetic, and the planted pairs."""
import csv
import math
import pathlib
import sys
import tempfile
import unittest

import numpy as np

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "tools"))
import undetermined_pairs  # noqa: E402
import verdict_rates  # noqa: E402


def row_of(direction, unit, deviation="nan", is_axis="1", components=(0, 0, 0, 0, 0, 0)):
    names = ("rx", "ry", "rz", "tx", "ty", "tz")
    return {"is_axis": is_axis, "direction": direction, "unit": unit, "deviation": deviation,
            **{f"direction_{name}": str(value) for name, value in zip(names, components)}}


class Arithmetic(unittest.TestCase):
    def test_wilson_solves_its_quadratic(self):
        # The bounds p are where (share - p)^2 = z^2 p (1 - p) / n.
        for hits, count in ((0, 20), (3, 17), (17, 17), (120, 200)):
            for bound in verdict_rates.wilson(hits, count):
                self.assertAlmostEqual((hits / count - bound) ** 2,
                                       1.96**2 * bound * (1 - bound) / count, places=12)
        low, high = verdict_rates.wilson(8, 10)  # As printed for this example in textbooks.
        self.assertAlmostEqual(low, 0.490, places=3)
        self.assertAlmostEqual(high, 0.943, places=3)
        self.assertEqual(verdict_rates.wilson(0, 0), (0, 1))

    def test_roc_counts_what_is_beyond_a_tolerance(self):
        planted, healthy = [0.04, math.inf, 0.3], [0.001, 0.02, 0.05, 0.06]
        self.assertEqual(verdict_rates.roc(planted, healthy, [0.01, 0.05, 0.5]),
                         [(0.01, 3, 3), (0.05, 2, 1), (0.5, 1, 0)])

    def test_deviations(self):
        rows = [row_of("roll", "rad", "0.003"), row_of("pitch", "rad", "0.004"),
                row_of("yaw", "rad", "0"), row_of("x", "m", "nan"), row_of("y", "m", "0.25"),
                row_of("z", "m", "0.5"), row_of("along x", "none", "nan", "0")]
        found = verdict_rates.deviations(rows)
        self.assertAlmostEqual(found["largest_deg"], math.degrees(0.004))
        self.assertAlmostEqual(found["norm_deg"], math.degrees(0.005))
        self.assertEqual((found["largest_m"], found["norm_m"]), (math.inf, math.inf))
        self.assertEqual(verdict_rates.deviations([])["norm_m"], math.inf)

    def test_displacement_is_that_of_the_centroid(self):
        source = np.array([[3, 0, 1], [5, 0, 1]])  # Centroid at (4, 0, 1).
        truth = undetermined_pairs.turn(2, 0.7)
        truth[:3, 3] = 1, 2, 3
        quarter = undetermined_pairs.turn(2, math.pi / 2)  # Takes it to (0, 4, 1).
        off_m, off_deg = verdict_rates.displacement(source, truth, truth @ quarter)
        self.assertAlmostEqual(off_m, math.sqrt(32))
        self.assertAlmostEqual(off_deg, 90)

    def test_errors_within_deviations(self):
        rows = [{"off_m": 0.02, "norm_m": 0.01}, {"off_m": 0.025, "norm_m": 0.01},
                {"off_m": 5, "norm_m": math.inf}]
        self.assertEqual(verdict_rates.within(rows, 2, "m"), 2)
        self.assertEqual(verdict_rates.within(rows, 3, "m"), 3)

    def test_a_direction_is_named_by_a_span(self):
        half = math.sqrt(0.5)
        span = [row_of("a", "none", "nan", "0", (0, 0, 0, half, half, 0)),
                row_of("b", "none", "nan", "0", (0, 0, 0, half, -half, 0))]
        x = np.eye(6)[3]
        self.assertTrue(verdict_rates.is_named(x, span))
        self.assertFalse(verdict_rates.is_named(x, span[:1]))
        self.assertFalse(verdict_rates.is_named(np.eye(6)[0], span))
        self.assertFalse(verdict_rates.is_named(x, []))


class PlantedPairs(unittest.TestCase):
    def test_surfaces_are_the_same_in_both_scans(self):
        """All points of both scans, brought into the world, lie on its surfaces."""
        for kind in ("corridor", "corridor, scattered points", "plane", "tunnel"):
            source, target, T, _ = undetermined_pairs.make_pair(kind, 3)
            for cloud, to_world in ((target, np.eye(4)), (source, T)):
                points = cloud @ to_world[:3, :3].T + to_world[:3, 3]
                if kind == "tunnel":
                    radius = np.hypot(points[:, 1], points[:, 2])
                    off = radius - np.median(radius)
                else:
                    off = points[:, 2] + undetermined_pairs.FLOOR_M
                    if kind.startswith("corridor"):
                        wall = np.median(np.abs(target[np.abs(target[:, 2]) < 0.1, 1]))
                        off = np.minimum(np.abs(off), np.abs(np.abs(points[:, 1]) - wall))
                self.assertLess(np.abs(off).max(), 0.15, kind)
                self.assertGreater(len(points), 10000, kind)
            self.assertGreater(np.linalg.norm(T[:3, 3]), 0.25)

    def test_free_directions_are_along_the_world(self):
        for kind in ("corridor", "corridor, turned"):
            _, target, T, (free,) = undetermined_pairs.make_pair(kind, 4)
            along = T[:3, :3] @ free[3:]
            self.assertAlmostEqual(np.linalg.norm(along), 1)
            # Points far along it are there, points far across are not.
            across = np.cross([0, 0, 1], along)
            self.assertGreater(np.abs(target @ along).max(), 50)
            self.assertLess(np.abs(target @ across).max(), 7)
        self.assertEqual(len(undetermined_pairs.make_pair("plane", 4)[3]), 3)

    def test_poles_are_seen(self):
        _, bare, _, _ = undetermined_pairs.make_pair("corridor", 5)
        _, target, _, free = undetermined_pairs.make_pair("corridor", 5, 32)
        self.assertEqual(free, [])
        clear = lambda points: (np.abs(np.abs(points[:, 1]) - np.abs(points[:, 1]).max()) > 0.2) & (
            points[:, 2] > -1)
        self.assertEqual(clear(bare).sum(), 0)
        self.assertGreater(clear(target).sum(), 100)

    def test_ply_is_read_back(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "a.ply")
            undetermined_pairs.write_ply(path, np.array([[1, 2, 3.5], [4, 5, 6]]))
            header, data = path.read_bytes().split(b"end_header\n")
            self.assertIn(b"element vertex 2", header)
            self.assertEqual(np.frombuffer(data, "<f4").tolist(), [1, 2, 3.5, 4, 5, 6])

    def test_rows_are_read_in_the_order_of_the_cases(self):
        cases = verdict_rates.cases()
        self.assertEqual(len({case[1:3] for case in cases}), len(cases))
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "pairs.csv")
            rows = [{"group": group, "kind": kind, "pair": pair, "code": 4, "converged": "yes",
                     "causes": "", "named": 0.5, **dict.fromkeys(verdict_rates.NUMBERS, math.inf)}
                    for group, kind, pair, _ in (cases[0], cases[5], cases[-1])]
            with open(path, "w", newline="") as file:
                writer = csv.DictWriter(file, verdict_rates.COLUMNS)
                writer.writeheader()
                writer.writerows(reversed(rows))
            self.assertEqual(verdict_rates.read(path), rows)


if __name__ == "__main__":
    unittest.main()
