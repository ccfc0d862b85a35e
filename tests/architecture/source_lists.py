#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Fails where a .cpp file is not listed in the CMakeLists.txt of its folder, or a list is out of order."""
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
FOLDERS = ["mesh", "lighting", "io", "tools", "tests", "benchmarks"]


def lists_of(cmake_file):
    """The runs of lines that hold one .cpp file each."""
    runs = [[]]
    for line in cmake_file.read_text(encoding="utf-8").splitlines():
        match = re.fullmatch(r"\s+([\w./-]+\.cpp)", line)
        if match:
            runs[-1].append(match.group(1))
        elif runs[-1]:
            runs.append([])
    return [run for run in runs if run]


def complaints(cmake_file):
    folder = cmake_file.parent
    name = folder.relative_to(ROOT)
    text = cmake_file.read_text(encoding="utf-8")
    for run in lists_of(cmake_file):
        if run != sorted(run):
            yield f"{name}/CMakeLists.txt: not in alphabetical order: {', '.join(run)}"
    for source in folder.rglob("*.cpp"):
        nearest = next(p for p in source.parents if (p / "CMakeLists.txt").is_file())
        relative = source.relative_to(folder).as_posix()
        if nearest == folder and not re.search(rf"(^|[\s(]){re.escape(relative)}($|[\s)])", text):
            yield f"{name}/{relative} is not listed in {name}/CMakeLists.txt"


def main():
    cmake_files = [f for folder in FOLDERS for f in sorted((ROOT / folder).rglob("CMakeLists.txt"))]
    found = [c for f in cmake_files for c in complaints(f)]
    print("\n".join(found))
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
