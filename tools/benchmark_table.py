#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Turns the results of icpscape_benchmarks (Google Benchmark's JSON, one file per pair of scans and
SIMD level) into tables of ratios: as text, and as a Markdown document.
"""
import argparse
import json
import subprocess
import sys

PACKAGES = {"PCL": "libpcl-dev", "nanoflann": "libnanoflann-dev", "Open3D": "libopen3d-dev",
            "Ceres": "libceres-dev", "Eigen": "libeigen3-dev", "oneTBB": "libtbb-dev"}


class Row:
    """One comparison on one pair of scans."""

    def __init__(self, entry, simd):  # simd: "", or the level if it is not the widest.
        self.name = entry["name"].split("/iterations:")[0]
        self.error = entry.get("error_message", "")
        self.simd = simd
        title, _, self.peer = entry.get("label", self.name + "|").partition("|")
        self.title = f"{title}, {simd}" if simd else title
        self.ours_ms = entry.get("ours_ms")
        self.peer_ms = entry.get("peer_ms")
        self.ratio = entry.get("ratio")
        self.quartiles = entry.get("ratio_q1"), entry.get("ratio_q3")
        self.is_main = entry.get("is_main", 0) or self.error

    def key(self):
        return self.name, self.simd

    def ratio_text(self):
        return "**answers differ**" if self.error else number(self.ratio)

    def cells(self):
        spread = "{:.2f} to {:.2f}".format(*self.quartiles) if self.ratio else ""
        return [self.title, milliseconds(self.ours_ms), self.peer, milliseconds(self.peer_ms),
                self.ratio_text(), spread]


HEADER = ["work", "icpscape, ms", "peer", "peer, ms", "ratio", "quartiles"]


class Pair:
    """All comparisons on one pair of scans."""

    def __init__(self, context):
        self.title = context["pair"]
        self.points = f"{context['source_points']} and {context['target_points']} points"
        self.context = context
        self.rows = []

    def short_title(self):
        return self.title.split(",")[0] if self.title.startswith("simulated") else self.title


def milliseconds(value):
    return "" if value is None else f"{value:.1f}" if value < 100 else f"{value:.0f}"


def number(value):
    return "" if value is None else f"{value:.2f}" if value < 10 else f"{value:.1f}"


def read(paths):
    pairs = {}
    for path in paths:
        with open(path) as file:
            results = json.load(file)
        context = results["context"]
        pair = pairs.setdefault(context["pair"], Pair(context))
        simd = "" if context["simd"] == context["widest_simd"] else context["simd"]
        pair.rows += [Row(entry, simd) for entry in results["benchmarks"]]
    for pair in pairs.values():
        pair.rows.sort(key=lambda row: row.simd)  # Stable: the widest level first.
    return list(pairs.values())


def print_text(pairs):
    for pair in pairs:
        print(f"\n{pair.title} ({pair.points})")
        table = [HEADER] + [row.cells() for row in pair.rows]
        widths = [max(len(line[i]) for line in table) for i in range(len(HEADER))]
        for line in table:
            print("  " + "  ".join(text.ljust(width) for text, width in zip(line, widths)).rstrip())
        for row in pair.rows:
            if row.error:
                print(f"  {row.name}: {row.error}")


def markdown_table(header, lines):
    out = ["| " + " | ".join(header) + " |", "|" + "---|" * len(header)]
    out += ["| " + " | ".join(line) + " |" for line in lines]
    return out


def main_table(pairs):
    """One line per main row, one column per pair."""
    lines = {}
    for i, pair in enumerate(pairs):
        for row in pair.rows:
            if row.is_main:
                line = lines.setdefault(row.key(), [row.title, row.peer] + [""] * len(pairs))
                line[2 + i] = row.ratio_text()
    return markdown_table(["work", "peer"] + [pair.short_title() for pair in pairs],
                          lines.values())


def processor():
    with open("/proc/cpuinfo") as file:
        for line in file:
            if line.startswith("model name"):
                return line.partition(":")[2].strip()
    return "unknown processor"


def package_version(package):
    result = subprocess.run(["dpkg-query", "-W", "-f", "${Version}", package],
                            capture_output=True, text=True, check=False)
    return result.stdout.strip() or "not installed"


def machine_lines(context):
    """What the results depend on besides the code."""
    caches = [f"L{cache['level']} {cache['type'].lower()} {cache['size'] // 1024} KiB"
              for cache in context["caches"]]
    versions = [f"{name} {package_version(package)}" for name, package in PACKAGES.items()]
    return [f"- Machine: {processor()}, {context['num_cpus']} cores; {', '.join(caches)}",
            f"- Compiler: {context['compiler']}, Release, no -march flags",
            f"- Debian packages: {', '.join(versions)}",
            f"- icpscape {context['icpscape']}"]


def document(pairs, command):
    context = pairs[0].context
    out = ["# Benchmarks", "",
           f"Written by `{command}`; do not edit. A ratio is the time of the peer divided by the "
           "time of icpscape, on the same data: above 1 icpscape is faster. Both sides must give "
           "the same answer; if they differ, the run fails.", ""]
    out += machine_lines(context)
    out += ["",
            f"The two sides of a row run in turn, {context['rounds']} times. Times are medians; the "
            "ratio is the median of the ratios of the rounds, with its quartiles. Trust the ratios "
            f"rather than the times. icpscape runs at {context['widest_simd']}, the widest SIMD "
            "level of the machine, unless the row names another.", "",
            "## The main ratios", ""]
    out += main_table(pairs)
    for pair in pairs:
        out += ["", f"## {pair.title}", "", f"{pair.points}.", ""]
        out += markdown_table(HEADER, [row.cells() for row in pair.rows])
    return "\n".join(out) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("results", nargs="+", help="JSON of icpscape_benchmarks")
    parser.add_argument("--document", help="where to write the Markdown document")
    parser.add_argument("--command", default="tools/benchmark.sh",
                        help="the command to name in the document")
    arguments = parser.parse_args()
    pairs = read(arguments.results)
    print_text(pairs)
    if arguments.document:
        with open(arguments.document, "w") as file:
            file.write(document(pairs, arguments.command))
        print(f"\nwritten: {arguments.document}")
    return 3 if any(row.error for pair in pairs for row in pair.rows) else 0


if __name__ == "__main__":
    sys.exit(main())
