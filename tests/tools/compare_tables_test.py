#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests of tools/compare_tables.py: what is a difference, and what is none."""
import pathlib
import struct
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "tools"))
import compare_tables  # noqa: E402


def ply(points):
    header = ("ply\nformat binary_little_endian 1.0\n"
              f"element vertex {len(points)}\nproperty float x\nproperty float y\n"
              "element camera 1\nproperty float view_px\nend_header\n")
    return header.encode() + b"".join(struct.pack("<2f", *p) for p in points) + bytes(4)


class CompareTables(unittest.TestCase):
    def compare(self, reference, checkout, run="run"):
        """Each side is a map from file name to content."""
        with tempfile.TemporaryDirectory() as folder:
            for side, files in (("reference", reference), ("checkout", checkout)):
                for name, content in files.items():
                    path = pathlib.Path(folder, side, name)
                    path.parent.mkdir(parents=True, exist_ok=True)
                    data = content if isinstance(content, bytes) else content.encode()
                    path.write_bytes(data)
            comparison = compare_tables.Comparison(run)
            comparison.compare(pathlib.Path(folder, "reference"), pathlib.Path(folder, "checkout"))
            return comparison

    def differences(self, *sides):
        return self.compare(*sides).differences

    def test_one_bit_of_a_cell(self):
        table = "metric,u,rmse\na,0,0.1\na,1,{}\n"
        self.assertEqual(
            self.differences({"t.csv": table.format("0.2")},
                             {"t.csv": table.format("0.20000000000000004")}),
            ["t.csv: row 2, column rmse: 0.2, now 0.20000000000000004"])
        self.assertEqual(len(self.differences({"t.csv": table.format("0")},
                                              {"t.csv": table.format("-0")})), 1)
        self.assertEqual(len(self.differences({"t.csv": table.format("nan")},
                                              {"t.csv": table.format("0.2")})), 1)

    def test_same_bits_in_other_words(self):
        self.assertEqual(self.differences({"t.csv": "u\n0.1\n1e-05\nnan\n"},
                                          {"t.csv": "u\n0.10\n0.00001\nnan\n"}), [])

    def test_times_and_titles_are_left_out(self):
        self.assertEqual(self.differences({"iterations.csv": "cost,time_s\n1,0.1\n"},
                                          {"iterates.csv": "cost,time_s\n1,0.2\n"}), [])
        # Here it is the time of a scan.
        self.assertEqual(len(self.differences({"frames.csv": "cost,time_s\n1,0.1\n"},
                                              {"frames.csv": "cost,time_s\n1,0.2\n"})), 1)

    def test_new_files_and_columns_are_no_difference(self):
        result = self.compare({"t.csv": "a,b\n1,2\n"}, {"t.csv": "b,new,a\n2,3,1\n", "n.csv": "c\n"})
        self.assertEqual((result.differences, result.new), ([], ["n.csv", "t.csv:new"]))

    def test_missing_files_columns_and_rows(self):
        self.assertEqual(self.differences({"sub/t.csv": "a\n"}, {}), ["sub/t.csv: is missing"])
        self.assertEqual(self.differences({"t.csv": "a,b\n1,2\n"}, {"t.csv": "a\n1\n"}),
                         ["t.csv: column b is missing"])
        self.assertEqual(self.differences({"t.csv": "a\n1\n2\n"}, {"t.csv": "a\n1\n"}),
                         ["t.csv: 2 rows, now 1"])
        self.assertEqual(self.differences({"pose.txt": "1 0 0 0\n"}, {"pose.txt": "1 0 0\n"}),
                         ["pose.txt: column 4 is missing"])

    def test_poses(self):
        pose = "1 0 0 {}\n0 1 0 0\n0 0 1 0\n0 0 0 1\n"
        self.assertEqual(self.differences({"T.txt": pose.format(0.5)}, {"T.txt": pose.format(0.25)}),
                         ["T.txt: row 1, column 4: 0.5, now 0.25"])

    def test_journal_has_data_times_and_checksums(self):
        words = ["hash"] + [str(i) for i in range(2, 36)] + ["checksum"]
        line = " ".join(words)
        times = line.replace(" 10 11 ", " 12 13 ").replace("checksum", "other")
        header = "icpscape-odometry; version={} checksum\n"
        self.assertEqual(self.differences({"journal.txt": header.format(1) + line},
                                          {"journal.txt": header.format(2) + times}), [])
        self.assertEqual(self.differences({"journal.txt": header.format(1) + line},
                                          {"journal.txt": header.format(1) + line.replace(
                                              " 35 ", " 36 ")}),
                         ["journal.txt: row 1, column 35: 35, now 36"])

    def test_clouds(self):
        points = [(0, 1), (2, 3), (4, 5)]
        self.assertEqual(self.differences({"a.ply": ply(points)},
                                          {"a.ply": ply(points).replace(b"view_px", b"other")}), [])
        self.assertEqual(self.differences({"a.ply": ply(points)},
                                          {"a.ply": ply([(0, 1), (2, 6), (4, 5)])}),
                         ["a.ply: row 2, column y: 3.0, now 6.0"])

    def test_scans(self):
        self.assertEqual(self.differences({"0.bin": struct.pack("<3f", 1, 2, 3)},
                                          {"0.bin": struct.pack("<3f", 1, 2, 4)}),
                         ["0.bin: row 3, column 1: 3.0, now 4.0"])
        self.assertEqual(self.differences({"0.ring": b"\0\1"}, {"0.ring": b"\0"}),
                         ["0.ring: 2 rows, now 1"])

    def test_results_that_both_manifests_have(self):
        manifest = '{{"version": {0}, "results": {1}}}'
        self.assertEqual(
            self.differences({"manifest.json": manifest.format(1, '{"a": 1.0, "b": 2, "c": 3}')},
                             {"manifest.json": manifest.format(2, '{"a": 1.5, "c": 3, "d": 4}')}),
            ["manifest.json: a: 1.0, now 1.5"])

    def test_wanted_differences_have_a_reason(self):
        compare_tables.WANTED.append(("wanted*", "t.csv", "b", "mended"))
        try:
            sides = ({"t.csv": "a,b\n1,2\n"}, {"t.csv": "a,b\n1,3\n"})
            self.assertEqual(self.compare(*sides, run="wanted run").reasons, {"mended": 1})
            self.assertEqual(self.compare(*sides, run="wanted run").differences, [])
            self.assertEqual(len(self.compare(*sides, run="other run").differences), 1)
        finally:
            compare_tables.WANTED.pop()


if __name__ == "__main__":
    unittest.main()
