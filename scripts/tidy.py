#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""scripts/tidy.py BUILD: checks the names in our sources with clang-tidy (.clang-tidy has the rules).

BUILD is a configured build folder. All headers are checked in one go. Sources that name a heavy library, and the tests
themselves, are left out: clang would spend its time in the headers of others.
"""
import json
import os
import re
import shutil
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
FOLDERS = ["mesh", "lighting", "io", "tools", "tests/support"]
HEAVY = re.compile(r'#\s*include\s*<(CGAL/|assimp/|ifcpp/|vtk|toml|nlohmann/|CLI/)')


def light_files(suffix):
    files = sorted(p for folder in FOLDERS for p in (ROOT / folder).rglob(f"*{suffix}"))
    return [p for p in files if not HEAVY.search(p.read_text(encoding="utf-8"))]


def all_headers(folder):
    """A source file that includes every header, with a compile command of its own."""
    folder.mkdir(parents=True, exist_ok=True)
    source = folder / "all_headers.cpp"
    source.write_text("".join(f'#include "{h.relative_to(ROOT).as_posix()}"\n' for h in light_files(".h")))
    command = {"directory": str(folder), "file": str(source), "command": f"c++ -std=c++20 -I{ROOT} -c {source}"}
    (folder / "compile_commands.json").write_text(json.dumps([command]))
    return folder, source


def check(tidy, build, source):
    headers = re.escape(str(ROOT)) + "/(" + "|".join(FOLDERS) + ")/.*"
    run = subprocess.run([tidy, "--quiet", "--checks=-*,readability-identifier-naming", "--warnings-as-errors=*",
                          "--extra-arg=-Wno-unknown-warning-option", "--extra-arg=-w",  # g++'s own flags
                          f"--header-filter={headers}", "-p", str(build), str(source)],
                         capture_output=True, text=True)
    return "" if run.returncode == 0 else run.stdout + run.stderr


def main():
    build = Path(sys.argv[1]).resolve()
    tidy = shutil.which("clang-tidy-14") or shutil.which("clang-tidy")
    if not tidy:
        sys.exit("clang-tidy is missing; scripts/setup.sh --ci installs it")
    compiled = {c["file"] for c in json.loads((build / "compile_commands.json").read_text())}
    work = [all_headers(build / "tidy")] + [(build, s) for s in light_files(".cpp") if str(s) in compiled]
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        complaints = [c for c in pool.map(lambda w: check(tidy, *w), work) if c]
    print("\n".join(complaints), end="")
    print(f"clang-tidy: the names in {len(work) - 1} sources and all headers: {len(complaints)} with complaints")
    return 1 if complaints else 0


if __name__ == "__main__":
    sys.exit(main())
