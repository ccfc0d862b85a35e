#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the command clerestory once, in a scratch folder, and checks what it promised. See cli_test in cmake/tests.cmake."""
import argparse
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

SKIPPED = 77


def parse_arguments():
    parser = argparse.ArgumentParser()
    parser.add_argument("--program", type=Path, required=True)
    parser.add_argument("--source", type=Path, required=True)
    parser.add_argument("--scratch", type=Path, required=True)
    parser.add_argument("--exit", type=int, required=True)
    parser.add_argument("--stderr-lines", type=int)
    parser.add_argument("--leaves-nothing", action="store_true")
    for name in ("input", "stdout", "stderr", "file", "absent"):
        parser.add_argument(f"--{name}", action="append", default=[])
    parser.add_argument("arguments", nargs="*")
    return parser.parse_args()


def validation_dir(source):
    return Path(os.environ.get("CLERESTORY_VALIDATION_DIR") or source.parent / "shared" / "validation").resolve()


def fill_in(text, source):
    """The text with @SAMPLES@, @SOURCE@ and @VALIDATION@ replaced; skips the test where the reference data are missing."""
    if "@VALIDATION@" in text and not validation_dir(source).is_dir():
        print(f"skipped: no reference data in {validation_dir(source)}")
        sys.exit(SKIPPED)
    places = {"SAMPLES": source / "samples", "SOURCE": source, "VALIDATION": validation_dir(source)}
    for name, place in places.items():
        text = text.replace(f"@{name}@", str(place))
    return text


def prepare(scratch, inputs, source):
    """An empty scratch folder with copies of the inputs."""
    shutil.rmtree(scratch, ignore_errors=True)
    scratch.mkdir(parents=True)
    for name in inputs:
        place = source / "tests" / "cli" / "inputs" / fill_in(name, source)
        if place.is_dir():
            shutil.copytree(place, scratch / place.name, ignore=shutil.ignore_patterns("*-results"))
        else:
            shutil.copy(place, scratch)


def contents(folder):
    """Path → bytes, of every file below the folder; None for a folder."""
    return {str(p.relative_to(folder)): p.read_bytes() if p.is_file() else None for p in sorted(folder.rglob("*"))}


def complaints(options, run, before, after):
    """One line for each promise that was not kept."""
    if run.returncode != options.exit:
        yield f"exit status is {run.returncode}, not {options.exit}"
    for stream in ("stdout", "stderr"):
        for pattern in getattr(options, stream):
            if not re.search(pattern, getattr(run, stream), re.MULTILINE):
                yield f"{stream} does not match {pattern!r}"
    lines = len(run.stderr.splitlines())
    if options.stderr_lines is not None and lines != options.stderr_lines:
        yield f"stderr has {lines} lines, not {options.stderr_lines}"
    for pattern in options.file:
        if not any(p.is_file() and p.stat().st_size > 0 for p in options.scratch.glob(pattern)):
            yield f"no file {pattern}, or an empty one"
    for pattern in options.absent:
        yield from (f"there is {p.relative_to(options.scratch)}" for p in options.scratch.glob(pattern))
    if options.leaves_nothing:
        changed = [p for p in before.keys() | after.keys() if before.get(p, "") != after.get(p, "")]
        yield from (f"{p} was added, changed or removed" for p in sorted(changed))


def main():
    options = parse_arguments()
    arguments = [fill_in(a, options.source) for a in options.arguments]
    options.file = [fill_in(f, options.source) for f in options.file]
    prepare(options.scratch, options.input, options.source)
    before = contents(options.scratch)
    run = subprocess.run([options.program, *arguments], cwd=options.scratch, stdin=subprocess.DEVNULL,
                         capture_output=True, text=True, errors="replace")
    broken = list(complaints(options, run, before, contents(options.scratch)))
    if broken:
        print("clerestory", *arguments)
        print(f"--- stdout\n{run.stdout}--- stderr\n{run.stderr}---")
        print("\n".join(broken))
    return 1 if broken else 0


if __name__ == "__main__":
    sys.exit(main())
