#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Prints how often the verdict is wrong, as tables for docs/: where its tolerances come from.

Runs icpscape-register with point_to_plane on simulated urban pairs, which are healthy, and on pairs
whose free directions are known (undetermined_pairs.py). Writes a row for each pair, and prints the
alarms (exit code 3 or 4), their rates at other tolerances, and how well the predicted deviation
tells the error. Deviations are the largest of an axis; in a direction that no tolerance helps
(not_observed, no_curvature) they are inf.
"""
import argparse
import concurrent.futures
import csv
import json
import math
import pathlib
import random
import statistics
import subprocess
import sys
import tempfile

import numpy as np

sys.dont_write_bytecode = True
import undetermined_pairs  # noqa: E402

TOLERANCES_M = [0.01, 0.02, 0.03, 0.05, 0.08, 0.10, 0.20]
TOLERANCES_DEG = [0.05, 0.1, 0.2, 0.3, 0.5, 1.0]
DEFAULT_M, DEFAULT_DEG = 0.05, 0.3
NUMBERS = ["off_m", "off_deg", "largest_m", "largest_deg", "norm_m", "norm_deg"]
COLUMNS = ["group", "kind", "pair", "code", "converged", "causes", "named"] + NUMBERS


def cases():
    """(group, kind, name, flags of icpscape-register or arguments of make_pair) of all pairs."""
    found = []
    for scene in ("straight_street", "right_turn"):
        for step, seeds in ((0.1794, 10), (0.4, 20), (0.8, 30)):
            found += [("healthy", scene, f"seed {seed}, {step} deg",
                       [f"--scene={scene}", f"--seed={seed}", f"--azimuth_step_deg={step}"])
                      for seed in range(11, 11 + seeds)]
    for seed, gap in ((11, 1), (12, 2)):
        found += [("healthy", "town", f"seed {seed}, {frame} to {frame - gap}",
                   ["--scene=town", f"--seed={seed}", f"--frame={frame}",
                    f"--target_frame={frame - gap}", "--azimuth_step_deg=0.8"])
                  for frame in range(4, 356, 8)]
    for kind in undetermined_pairs.FREE:
        biases = [0] if kind == "flat scan" or "scattered" in kind else [0, 0.02]
        found += [("planted", kind + (", ring errors" if bias else ""), f"seed {seed}",
                   (kind, seed, 0, bias)) for bias in biases for seed in range(11, 19)]
    for poles in (1, 2, 4, 8, 16, 32, 64):
        found += [("scale", f"corridor, {poles} poles", f"seed {seed}",
                   ("corridor", seed, poles, 0.02 * (seed % 2))) for seed in range(11, 21)]
    found += [("scale", "highway", f"seed {seed}",
               ["--scene=highway", f"--seed={seed}", "--azimuth_step_deg=0.4"])
              for seed in range(11, 31)]
    return found


def register(program, inputs, out, *more):
    """Exit code, results of the manifest, rows of verdict.csv."""
    command = [program, *inputs, "--figures=none", "--threads=1", f"--out={out}", *more]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode not in (0, 3, 4):
        sys.exit(f"verdict_rates.py: {' '.join(command)}: {done.stderr.strip()}")
    if done.returncode == 3:
        return 3, {}, []
    with open(out / "verdict.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    return done.returncode, json.loads((out / "manifest.json").read_text())["results"], rows


def judge(program, case):
    """The row of one pair."""
    group, kind, name, inputs = case
    free = []
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        if isinstance(inputs, tuple):
            source, target, T, free = undetermined_pairs.make_pair(*inputs)
            undetermined_pairs.write_ply(folder / "source.ply", source)
            undetermined_pairs.write_ply(folder / "target.ply", target)
            inputs = [f"--{cloud}={folder / cloud}.ply" for cloud in ("source", "target")]
        code, results, rows = register(program, inputs, folder / "out")
        if code != 3 and "off_m" not in results:
            found = np.loadtxt(folder / "out/T_target_source.txt")
            results["off_m"], results["off_deg"] = displacement(source, T, found)
        row = {"group": group, "kind": kind, "pair": name, "code": code,
               "converged": results.get("converged", "no")}
        beside = [r for r in rows if r["is_axis"] == "0"]
        row["causes"] = " ".join(sorted({r["status"] for r in beside})) or ("" if rows else "no_pose")
        row["named"] = sum(is_named(one, beside) for one in free) / len(free) if free else math.nan
        if "beyond_tolerance" in row["causes"]:  # A deviation is written where it is tolerated.
            rows = register(program, inputs, folder / "wide", "--tolerance_m=1e9",
                            "--tolerance_deg=180")[2]
    row.update({name: results.get(name, math.inf) for name in ("off_m", "off_deg")})
    row.update(deviations(rows))
    return row


def displacement(source, truth, found):
    """How far the pose is off: m of the source's centroid, and degrees."""
    off = np.linalg.inv(truth) @ found
    center = np.append(source.mean(axis=0), 1)
    angle = 2 * math.asin(min(1, np.linalg.norm(off[:3, :3] - np.eye(3)) / math.sqrt(8)))
    return float(np.linalg.norm((off @ center - center)[:3])), math.degrees(angle)


def is_named(free, rows):
    """Whether nine tenths of a unit vector lie in what the rows of directions span."""
    if not rows:
        return False
    span = np.array([[float(row[f"direction_{c}"]) for c in ("rx", "ry", "rz", "tx", "ty", "tz")]
                     for row in rows]).T
    u, values, _ = np.linalg.svd(span, full_matrices=False)
    return bool(np.linalg.norm(u[:, values > 0.1].T @ free) > 0.9)


def deviations(rows):
    """Largest and root of the sum of squares over the axes; inf where one has none."""
    found = {}
    for unit, suffix, factor in (("m", "m", 1), ("rad", "deg", 180 / math.pi)):
        values = [factor * float(row["deviation"]) for row in rows
                  if row["is_axis"] == "1" and row["unit"] == unit]
        values = [math.inf if math.isnan(value) else value for value in values] or [math.inf]
        found[f"largest_{suffix}"] = max(values)
        found[f"norm_{suffix}"] = math.hypot(*values)
    return found


def wilson(hits, count, z=1.96):
    """Bounds of the share hits / count at 95 % (Wilson 1927)."""
    if count == 0:
        return 0.0, 1.0
    share, spread = hits / count, z * z / count
    center = (share + spread / 2) / (1 + spread)
    half = z / (1 + spread) * math.sqrt(share * (1 - share) / count + spread / count / 4)
    return max(center - half, 0.0), min(center + half, 1.0)


def percent(hits, count):
    low, high = wilson(hits, count)
    return f"{100 * hits / count:.1f} ({100 * low:.1f} to {100 * high:.1f})" if count else "-"


def roc(planted, healthy, tolerances):
    """(tolerance, alarms among planted, alarms among healthy) from the largest deviations."""
    return [(tolerance, sum(value > tolerance for value in planted),
             sum(value > tolerance for value in healthy)) for tolerance in tolerances]


def within(rows, factor, unit):
    """How many errors are at most so many predicted deviations, roots of sums of squares both."""
    return sum(row[f"off_{unit}"] <= factor * row[f"norm_{unit}"] for row in rows)


def is_off(row):
    return row["off_m"] > DEFAULT_M or row["off_deg"] > DEFAULT_DEG


def print_kinds(rows):
    print("| group | kind | pairs | code 0 | of these off by more than 0.05 m or 0.3 deg | "
          "code 3 or 4 | all free directions named | not converged | "
          "largest predicted deviation, median (m, deg) | error, median (m, deg) |")
    print("|---|" + "---|" * 9)
    for group, kind in dict.fromkeys((row["group"], row["kind"]) for row in rows):
        own = [row for row in rows if row["kind"] == kind]
        good = [row for row in own if row["code"] == 0]
        middle = {name: statistics.median(row[name] for row in own) for name in NUMBERS}
        named = sum(row["named"] == 1 for row in own) if group == "planted" else ""
        print(f"| {group} | {kind} | {len(own)} | {len(good)} | {sum(map(is_off, good))} | "
              f"{len(own) - len(good)} | {named} | {sum(r['converged'] != 'yes' for r in own)} | "
              f"{middle['largest_m']:.3f}, {middle['largest_deg']:.3f} | "
              f"{middle['off_m']:.3f}, {middle['off_deg']:.3f} |")


def print_alarms(healthy):
    alarms = [row for row in healthy if row["code"] != 0]
    print(f"\nFalse alarms: {len(alarms)} of {len(healthy)} healthy pairs, "
          f"{percent(len(alarms), len(healthy))} %")
    for row in alarms:
        reason = row["causes"] or "not converged"
        print(f"- {row['kind']}, {row['pair']}: {reason}, predicted {row['largest_m']:.3f} m and "
              f"{row['largest_deg']:.3f} deg, off by {row['off_m']:.3f} m, {row['off_deg']:.3f} deg")


def print_roc(rows, unit, tolerances):
    axes = ("x", "y", "z") if unit == "m" else ("roll", "pitch", "yaw")
    free = undetermined_pairs.FREE
    healthy = [row[f"largest_{unit}"] for row in rows if row["group"] == "healthy"]
    planted = [row for row in rows if row["group"] == "planted" and
               set(axes) & set(free[row["kind"].removesuffix(", ring errors")])]
    ringed = [row[f"largest_{unit}"] for row in planted if "ring errors" in row["kind"]]
    plain = [row[f"largest_{unit}"] for row in planted if "ring errors" not in row["kind"]]
    print(f"\n| tolerance ({unit}) | alarms on planted, % of {len(plain)} | with ring errors, "
          f"% of {len(ringed)} | on healthy, % of {len(healthy)} |\n|---|---|---|---|")
    for (tolerance, hits, false), (_, more, _) in zip(roc(plain, healthy, tolerances),
                                                     roc(ringed, healthy, tolerances)):
        print(f"| {tolerance:g} | {percent(hits, len(plain))} | {percent(more, len(ringed))} | "
              f"{percent(false, len(healthy))} |")


def print_within(healthy):
    by_kind = {"all healthy pairs": healthy}
    for row in healthy:
        by_kind.setdefault(row["kind"], []).append(row)
    print("\n| error within | " + " | ".join(f"{kind}, %" for kind in by_kind) + " |")
    print("|---|" + "---|" * len(by_kind))
    for factor in (2, 3):
        for unit, what in (("m", "position"), ("deg", "angle")):
            print(f"| {factor} deviations, {what} | " + " | ".join(
                percent(within(own, factor, unit), len(own)) for own in by_kind.values()) + " |")


def run(program, jobs, every, path):
    """Writes a row for each pair that the file does not have, as it comes, in mixed order."""
    there = {key(row) for row in read(path)} if path.exists() else None
    chosen = [case for case in cases()[::every] if case[1:3] not in (there or ())]
    random.Random(1).shuffle(chosen)
    path.parent.mkdir(parents=True, exist_ok=True)
    with open(path, "a", newline="") as file, concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        writer = csv.DictWriter(file, COLUMNS)
        if there is None:
            writer.writeheader()
        for row in pool.map(lambda case: judge(program, case), chosen):
            writer.writerow(row)
            file.flush()


def key(row):
    return row["kind"], row["pair"]


def read(path):
    with open(path, newline="") as file:
        rows = [{**row, "code": int(row["code"]), "named": float(row["named"]),
                 **{name: float(row[name]) for name in NUMBERS}} for row in csv.DictReader(file)]
    places = {case[1:3]: place for place, case in enumerate(cases())}
    return sorted(rows, key=lambda row: places[key(row)])


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--register", default="build/release/bin/icpscape-register")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--every", type=int, default=1, help="take each n-th pair only")
    parser.add_argument("--pairs", default="out/verdict_rates.csv",
                        help="file of the pairs' rows; pairs that are there are not run again")
    parser.add_argument("--read", action="store_true", help="run no more pairs")
    flags = parser.parse_args()
    path = pathlib.Path(flags.pairs)
    if not flags.read:
        run(flags.register, flags.jobs, flags.every, path)
    rows = read(path)
    healthy = [row for row in rows if row["group"] == "healthy"]
    print_kinds(rows)
    print_alarms(healthy)
    print_roc(rows, "m", TOLERANCES_M)
    print_roc(rows, "deg", TOLERANCES_DEG)
    print_within(healthy)


if __name__ == "__main__":
    main()
