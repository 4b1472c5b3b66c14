#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Compares the results of one run by two versions, bit for bit.

  tools/compare_tables.py RUN REFERENCE CHECKOUT

RUN is a name for the run, REFERENCE and CHECKOUT are its two output folders. Compared are tables
(.csv, .txt), clouds (.ply), simulated scans (.bin, .label, .ring) and the results of manifest.json
that both have. Prints one line if all is equal, else one line per difference, and ends with 1.
Files, columns and results that only CHECKOUT has are named, and are no difference.
tools/compare_with_release.sh calls it.
"""
import csv
import fnmatch
import json
import pathlib
import struct
import sys

# Wanted differences: patterns of run, file and column, and the reason.
WANTED = []

# Files and columns with another name in an older version: name there, name now.
RENAMED = {"iterations.csv": "iterates.csv", "verdicts.csv": "degeneracy.csv"}

# Columns that are not compared, by file. Times differ from run to run; titles and claims are text.
LEFT_OUT = {
    "iterates.csv": ["time_s"],
    "timings.csv": ["read_s", "odometry_s"],
    "journal.txt": ["10", "11", "36"],  # read_s, odometry_s, and the checksum over them.
    "manifest.json": ["mean_s_per_scan"],
    "figures.csv": ["title"],
    "claims.csv": ["claim"],
    "errors.csv": ["sequence"],
    "summary.csv": ["sequence"],
    "pose_errors.csv": ["sequence"],
    "trajectory.csv": ["sequence"],
}

TABLES = [".csv", ".txt"]
BINARY = [".bin", ".label", ".ring"]
PLY_TYPES = {"char": "b", "uchar": "B", "short": "h", "ushort": "H", "int": "i", "uint": "I",
             "float": "f", "double": "d", "int8": "b", "uint8": "B", "int16": "h", "uint16": "H",
             "int32": "i", "uint32": "I", "float32": "f", "float64": "d"}


def is_number(word):
    try:
        float(word)
        return True
    except ValueError:
        return False


def same(a, b):
    """Text that reads as the same bits: 0.10 and 0.1, but not 0 and -0."""
    if isinstance(a, str) and a == b:
        return True
    if is_number(a) and is_number(b):
        return struct.pack("d", float(a)) == struct.pack("d", float(b))
    return False


def read_table(path):
    """Column names and rows. Files without a header have columns "1", "2", ..."""
    with open(path, newline="") as file:
        if path.suffix == ".csv":
            rows = list(csv.reader(file))
        else:
            rows = [line.split() for line in file]
    if path.name == "journal.txt":
        rows = rows[1:]  # Version and flags.
    elif rows and not any(is_number(word) for word in rows[0]):
        return rows[0], rows[1:]
    return [str(i + 1) for i in range(max(map(len, rows), default=0))], rows


def read_ply(path):
    """Names and rows of the vertices of a binary file."""
    data = path.read_bytes()
    header, _, body = data.partition(b"end_header\n")
    lines = [line.split() for line in header.decode().splitlines()]
    if ["format", "binary_little_endian", "1.0"] not in lines:
        raise ValueError(f"{path}: expected a binary little-endian PLY file")
    elements = [i for i, line in enumerate(lines) if line and line[0] == "element"]
    begin = elements[0]
    end = elements[1] if len(elements) > 1 else len(lines)
    count = int(lines[begin][2])
    properties = [line for line in lines[begin:end] if line and line[0] == "property"]
    row = struct.Struct("<" + "".join(PLY_TYPES[line[1]] for line in properties))
    return [line[2] for line in properties], list(row.iter_unpack(body[:count * row.size]))


def read_values(path):
    """A binary file as one column: floats of a .bin, else bytes."""
    return ["1"], list(struct.iter_unpack("<f" if path.suffix == ".bin" else "<B",
                                          path.read_bytes()))


class Comparison:
    def __init__(self, run):
        self.run = run
        self.differences = []
        self.reasons = {}
        self.new = []
        self.files = 0

    def wanted(self, file, column):
        for run, files, columns, reason in WANTED:
            if (fnmatch.fnmatchcase(self.run, run) and fnmatch.fnmatchcase(file, files)
                    and fnmatch.fnmatchcase(column, columns)):
                self.reasons[reason] = self.reasons.get(reason, 0) + 1
                return True
        return False

    def differ(self, file, column, text):
        if not self.wanted(file, column):
            self.differences.append(f"{file}: {text}")

    def compare_rows(self, file, reference, checkout):
        (columns, rows), (new_columns, new_rows) = reference, checkout
        if len(rows) != len(new_rows):
            self.differ(file, "", f"{len(rows)} rows, now {len(new_rows)}")
            return
        left_out = LEFT_OUT.get(pathlib.PurePath(file).name, [])
        names = [RENAMED.get(column, column) for column in columns]
        self.new += [f"{file}:{name}" for name in new_columns if name not in names]
        differing = []
        for at, name in enumerate(names):
            if name in left_out or columns[at] in left_out:
                continue
            if name not in new_columns:
                self.differ(file, name, f"column {name} is missing")
                continue
            new_at = new_columns.index(name)
            for number, (row, new_row) in enumerate(zip(rows, new_rows), 1):
                was = row[at] if at < len(row) else "nothing"
                now = new_row[new_at] if new_at < len(new_row) else "nothing"
                if not same(was, now) and not self.wanted(file, name):
                    differing.append((number, name, was, now))
        if differing:
            number, name, was, now = min(differing, key=lambda cell: cell[0])
            more = f" (and {len(differing) - 1} more cells)" if len(differing) > 1 else ""
            self.differences.append(
                f"{file}: row {number}, column {name}: {was}, now {now}{more}")

    def compare_results(self, reference, checkout):
        """The numbers that both manifests have; which there are may change."""
        was, now = (json.loads((folder / "manifest.json").read_text())["results"]
                    if (folder / "manifest.json").exists() else {}
                    for folder in (reference, checkout))
        self.new += [f"manifest.json:{name}" for name in now if name not in was]
        for name in was:
            if (name in now and name not in LEFT_OUT["manifest.json"] and was[name] != now[name]
                    and repr(was[name]) != repr(now[name])):
                self.differ("manifest.json", name, f"{name}: {was[name]}, now {now[name]}")

    def compare_file(self, name, reference, checkout):
        self.files += 1
        if reference.read_bytes() == checkout.read_bytes():
            return
        if reference.suffix in TABLES:
            read = read_table
        else:
            read = read_ply if reference.suffix == ".ply" else read_values
        self.compare_rows(name, read(reference), read(checkout))

    def compare(self, reference, checkout):
        is_data = lambda path: path.suffix in [*TABLES, *BINARY, ".ply"]
        files = {str(path.relative_to(reference)): path
                 for path in sorted(reference.rglob("*")) if is_data(path)}
        now = {str(path.relative_to(checkout)): path
               for path in sorted(checkout.rglob("*")) if is_data(path)}
        names = {RENAMED.get(name, name): name for name in files}
        self.new += [name for name in now if name not in names]
        for name, name_then in names.items():
            if name in now:
                self.compare_file(name, files[name_then], now[name])
            else:
                self.differ(name, "", "is missing")
        self.compare_results(reference, checkout)


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    comparison = Comparison(sys.argv[1])
    comparison.compare(pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3]))
    new = ", ".join(comparison.new[:8]) + (", ..." if len(comparison.new) > 8 else "")
    notes = [f"wanted: {reason} ({times}x)" for reason, times in comparison.reasons.items()]
    notes += [f"new: {new}"] if new else []
    if comparison.files == 0:
        comparison.differences.append("no tables at all")
    for difference in comparison.differences:
        print(f"{comparison.run}: differs: {difference}")
    if not comparison.differences:
        print(f"{comparison.run}: equal, {comparison.files} files" +
              "".join(f"; {note}" for note in notes))
    sys.exit(1 if comparison.differences else 0)


if __name__ == "__main__":
    main()
