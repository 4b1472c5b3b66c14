#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Checks the order of the folders: a file includes files of its own folder, or of folders below.

  check_layers.py SOURCE_DIR

Also: no file under src/ or residuals/ includes gflags.
"""
import os.path
import pathlib
import re
import sys

# Top to bottom. A folder without a line belongs to the folder that it is in.
LAYERS = """
tests
examples
apps
apps/flags
apps/reports
apps/run
src/explain
src/odometry
src/covariance
src/prediction
src/paper
src/minimizer
src/landscape
src/simulation
src/objective
src/preparation
src/matching
src/filtering
src/io
src/cloud
src/neighbors
src/simd
src/common
residuals/adapters
residuals
""".split()

# Folders whose files must stand in a layer.
TREES = ["tests", "examples", "apps", "src", "residuals"]
INCLUDE = re.compile(r'^\s*#\s*include\s+(["<])([^">]+)[">]')


def layer_of(path):
    """Position of the nearest folder in LAYERS, or None."""
    for folder in path.parents:
        if str(folder) in LAYERS:
            return LAYERS.index(str(folder))
    return None


def included_file(root, includer, name):
    """The file of the tree that an #include names, if it is one of the tree."""
    name = name.removeprefix("icpscape/")
    for candidate in (includer.parent / name, pathlib.Path(name), pathlib.Path("src") / name):
        if (root / candidate).is_file():
            return pathlib.Path(os.path.normpath(candidate))
    return None


def check(root):
    errors = []
    files = [path.relative_to(root) for tree in TREES for path in sorted((root / tree).rglob("*"))
             if path.suffix in (".h", ".cc", ".inc")]
    includes = 0
    for file in files:
        layer = layer_of(file)
        if layer is None:
            errors.append(f"{file}: its folder is in no layer; expected a line in {__file__}")
            continue
        for number, line in enumerate((root / file).read_text().splitlines(), 1):
            match = INCLUDE.match(line)
            if not match:
                continue
            if file.parts[0] in ("src", "residuals") and match[2].startswith("gflags/"):
                errors.append(f"{file}:{number}: includes gflags, which belongs to apps/")
            included = included_file(root, file, match[2])
            if included is None:
                if match[2].split("/")[0] in (*TREES, "icpscape"):
                    errors.append(f"{file}:{number}: {match[2]} is not in the tree")
                continue
            includes += 1
            below = layer_of(included)
            if below is not None and below < layer:
                errors.append(f"{file}:{number}: includes {included}, of the layer "
                              f"{LAYERS[below]}, which is above {LAYERS[layer]}")
    if includes == 0:
        errors.append(f"{root}: no file includes another; expected the source tree")
    return errors


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    errors = check(pathlib.Path(sys.argv[1]).resolve())
    print("\n".join(errors) or "all includes go down")
    sys.exit(1 if errors else 0)


if __name__ == "__main__":
    main()
