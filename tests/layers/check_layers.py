#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Checks what the files of the tree include.

  check_layers.py SOURCE_DIR TARGET=FOLDER,FOLDER... ...

A file includes files of its own folder, or of folders below. The folders of a target, which are
those of src/, include folders and libraries that the target may use alone. Each folder of src/
belongs to one target. No text or comment of src/ and residuals/ names a flag: flags belong to apps/.
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
src/monte_carlo
src/resumable
src/api
src/explain
src/odometry
src/verdict
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

# What the files of a target may use beside the standard library and its own folders: other targets,
# and libraries, by the first part of the names of their headers.
TARGETS = {
    "residuals": ([], ["Eigen"]),
    "adapters": (["residuals"], ["Eigen", "ceres"]),
    "core": (["residuals", "adapters"], ["Eigen", "ceres", "glog", "oneapi", "boost"]),
    "io": (["residuals", "core"], ["Eigen", "nlohmann", "openssl"]),
    "simulation": (["residuals", "core"], ["Eigen", "oneapi", "embree3"]),
}
SYSTEM = ["sys"]  # Headers in folders that are of no library.

# Folders whose files must be in a layer.
TREES = ["tests", "examples", "apps", "src", "residuals"]
OWN = [*TREES, "icpscape"]  # How the names of our own headers begin.
# --flag in a string or a comment; outside of them it is a decrement.
FLAG = re.compile(r'"(?:[^"\\]|\\.)*?(--[a-z]\w*)(?:[^"\\]|\\.)*"|//.*?(--[a-z]\w*)')
INCLUDE = re.compile(r'^\s*#\s*include\s+(["<])([^">]+)[">]')


def layer_of(path):
    """Position of the nearest folder in LAYERS, or None."""
    for folder in path.parents:
        if str(folder) in LAYERS:
            return LAYERS.index(str(folder))
    return None


def included_file(root, includer, name):
    """The file of the tree that an #include names, if it is one of the tree."""
    parts = name.split("/")
    if parts[0] == "icpscape" and len(parts) > 1:  # As the links of CMakeLists.txt have it.
        folder = {"residuals": "residuals", "testing": "tests/testing"}.get(
            parts[1], "src/" + parts[1])
        candidates = [pathlib.Path(folder, *parts[2:])]
    else:
        candidates = [includer.parent / name]
        if parts[0] in ("tests", "apps"):
            candidates.append(pathlib.Path(name))
    for candidate in candidates:
        if (root / candidate).is_file():
            return pathlib.Path(os.path.normpath(candidate))
    return None


def target_of(path, folders):
    """The target of a file of residuals/ or src/, else None."""
    if path.parts[0] == "residuals":
        return "adapters" if path.parts[1] == "adapters" else "residuals"
    return folders.get(path.parts[1]) if path.parts[0] == "src" else None


def misuse(file, name, included, folders):
    """What is wrong with a target's file including this, or None."""
    target = target_of(file, folders)
    if target is None:
        return None
    targets, libraries = TARGETS[target]
    if included is not None:
        other = target_of(included, folders)
        if other is not None and other != target and other not in targets:
            return f"includes {included} of {other}, which {target} does not use"
        return None
    library = name.split("/")[0]
    if "/" in name and library not in libraries + SYSTEM + OWN:
        return f"includes {name}, which {target} does not use"
    return None


def check(root, folders):
    """Errors of the tree; `folders` has the target of each folder of src/."""
    errors = []
    for folder in sorted((root / "src").iterdir()):
        if folder.is_dir() and folder.name not in folders:
            errors.append(f"src/{folder.name}: is in no target; expected it in src/CMakeLists.txt")
    files = [path.relative_to(root) for tree in TREES for path in sorted((root / tree).rglob("*"))
             if path.suffix in (".h", ".cc", ".inc")]
    includes = 0
    for file in files:
        layer = layer_of(file)
        if layer is None:
            errors.append(f"{file}: its folder is in no layer; expected a line in {__file__}")
            continue
        for number, line in enumerate((root / file).read_text().splitlines(), 1):
            flag = FLAG.search(line) if file.parts[0] in ("src", "residuals") else None
            if flag:
                errors.append(f"{file}:{number}: names the flag {flag[1] or flag[2]}; expected the "
                              "quantity, which every caller knows")
            match = INCLUDE.match(line)
            if not match:
                continue
            included = included_file(root, file, match[2])
            wrong = misuse(file, match[2], included, folders)
            if wrong:
                errors.append(f"{file}:{number}: {wrong}")
            if included is None:
                if match[2].split("/")[0] in OWN:
                    errors.append(f"{file}:{number}: {match[2]} is not in the tree; expected "
                                  "icpscape/FOLDER/NAME.h, or a path below apps/ or tests/")
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
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    folders = {}
    for argument in sys.argv[2:]:
        target, names = argument.split("=")
        for name in names.split(","):
            if name in folders:
                sys.exit(f"src/{name}: is in {folders[name]} and in {target}; expected one target")
            folders[name] = target
    errors = check(pathlib.Path(sys.argv[1]).resolve(), folders)
    print("\n".join(errors) or "all includes go down, and to what the targets use")
    sys.exit(1 if errors else 0)


if __name__ == "__main__":
    main()
