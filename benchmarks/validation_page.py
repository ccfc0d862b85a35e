#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the validation tests and the reference scenes, and writes docs/validation.md from what they print.

    benchmarks/validation_page.py [--build build/release] [--repeat 5] [-o docs/validation.md]

Needs the targets clerestory, clerestory_validation_tests and benchmarks (for the machine's rays a CPU second), and the reference scenes
(see validation.py). Ends with status 1 where a test fails; the page says which."""
import argparse
import datetime
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import validation

RUNS = [  # scene, accuracy asked, what it must show
    ("office", 0.02, "mean within 1 %, RMS ≤ 3 %, p95 ≤ 6 %, 95 % covered, 6 CPU s"),
    ("office", 0.01, "95 % covered"),
    ("lamp-room", 0.01, "RMS ≤ 1 %"),
    ("atrium", 0.05, "reported"),
]
EMPTY_ROOM_BOUND = 1e-4  # energy balance and closure, whatever the accuracy
HEAD = """# Validation

Measured figures of every case that the program is judged by. This page is written by

    benchmarks/validation_page.py

from what the validation tests and the program print; do not edit it. Last written {date}, on a machine that did {rays} in that minute.
Limits on CPU time hold for 9 million. What the cases are, and why their bounds are what they are, stands in the tests
(`tests/validation`); what an accuracy means, in [theory/accuracy.md](theory/accuracy.md).
"""
SCENES = """
## Reference scenes

Against converged results of independent programs, as `benchmarks/validation.py` runs them: the whole command at one thread, user and system
time, the median of {repeat} (runs a scene). The references' own noise is in the figures (office: 1.1 % a sensor).

| scene | accuracy asked | CPU s | against the reference | must show |
|---|---|---|---|---|
"""
CONVERGENCE = """
## Convergence

Cube of CIE 171:2006 case 5.8, reflectance 0.5, point source in the centre; 400 points of the floor against a reference good to 0.05 %;
mean of three seeds.

| accuracy asked | true RMS | elements | links | links an element | rays |
|---|---|---|---|---|---|
"""
UNMET = """
## Bounds that are not met

Tests hold the program to what it reaches; this list, to what it should.

"""
CASES = """
## Cases

One line a test; figures as the tests print them.

| test | result | figures |
|---|---|---|
"""
CONVERGENCE_LINE = re.compile(
    r"accuracy (\d+) %, seed \d+: rms ([\d.]+) %, rms\(z\) [\d.]+, (\d+) elements, (\d+) links, (\d+) rays")
BALANCE_LINE = re.compile(r"lamp-room at (\d+) %: balance (\S+), reciprocity \S+, closure (\S+)")
FURNACE_LINE = re.compile(r"box: radiosity mean \S+ rms (\S+), largest (\S+);")


def run_tests(program):
    """By test, in the order of running: its result, and the figures that it printed."""
    out = subprocess.run([program], check=False, capture_output=True, text=True).stdout
    results = {}
    name = None
    for line in out.splitlines():
        if found := re.match(r"\[ RUN      \] (\S+)", line):
            name = found[1]
            results[name] = ["did not end", []]
        elif found := re.match(r"\[ FIGURES  \]\s+(.*)", line):
            results[name][1].append(found[1])
        elif found := re.match(r"\[ +(OK|FAILED|SKIPPED) +\] " + re.escape(name or "-") + r"\b.* \(\d+ ms\)", line):
            results[name][0] = {"OK": "passes", "FAILED": "**fails**", "SKIPPED": "skipped"}[found[1]]
    return results


def convergence_rows(figures):
    runs = {}
    for figure in figures:
        if found := CONVERGENCE_LINE.match(figure):
            runs.setdefault(int(found[1]), []).append([float(x) for x in found.groups()[1:]])
    for accuracy, seeds in runs.items():
        rms, elements, links, rays = (sum(values) / len(seeds) for values in zip(*seeds))
        yield f"| {accuracy} % | {rms:.2f} % | {elements:.0f} | {links:.0f} | {links / elements:.1f} | {rays:,.0f} |\n"


def case_rows(results):
    for name, (result, figures) in results.items():
        shown = "<br>".join(f for f in figures if not CONVERGENCE_LINE.match(f))
        yield f"| `{name}` | {result} | {shown.replace('|', chr(92) + '|')} |\n"


def unmet_by_tests(results):
    """Lines on what the figures miss of the bounds for empty convex rooms."""
    elements = 0.0
    for figure in (f for _, figures in results.values() for f in figures):
        if found := BALANCE_LINE.match(figure):
            balance, closure = abs(float(found[2])), float(found[3])
            if max(balance, closure) > EMPTY_ROOM_BOUND:
                yield (f"- Empty convex room (lamp-room) at {found[1]} %: energy balance {balance:.1e}, closure {closure:.1e}; "
                       f"bound {EMPTY_ROOM_BOUND:g}.\n")
        elif found := FURNACE_LINE.match(figure):
            elements = max(elements, float(found[2]))
    if elements > EMPTY_ROOM_BOUND:
        yield (f"- Furnace in a convex box, single elements: up to {elements:.1e} off; bound {EMPTY_ROOM_BOUND:g}. Means and, at a "
               "fine accuracy, sensors keep it.\n")
    for name, (result, _) in results.items():
        if result not in ("passes", "skipped"):
            yield f"- `{name}` {result}.\n"


def run_scenes(program, repeat):
    """Rows of the scenes' table, and lines on what they miss."""
    rows, unmet = "", ""
    with tempfile.TemporaryDirectory() as folder:
        for name, accuracy, limit in RUNS:
            s = validation.run_scene(program, name, repeat, Path(folder), accuracy)
            figures = s.comparison.replace("|", "\\|")
            rows += f"| {name} | {100 * accuracy:g} % | {s.cpu_s:.2f} | {figures} | {limit} |\n"
            covered = re.search(r"covered (\d+) %", s.comparison)
            if covered and int(covered[1]) < 95:
                unmet += (f"- {name} at {100 * accuracy:g} %: {covered[1]} % of sensors within twice the stated error; "
                          "95 % should be.\n")
            if not s.met:
                unmet += f"- {name} at {100 * accuracy:g} %: the accuracy asked is not reached (the run says so, status 4).\n"
    return rows, unmet


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--build", type=Path, default=validation.ROOT / "build" / "release")
    parser.add_argument("--repeat", type=int, default=5, metavar="N", help="runs a scene; the median time counts")
    parser.add_argument("-o", "--out", type=Path, default=validation.ROOT / "docs" / "validation.md")
    arguments = parser.parse_args()
    if not validation.VALIDATION.is_dir():
        sys.exit(f"no reference scenes in {validation.VALIDATION}; set CLERESTORY_VALIDATION_DIR")
    build = arguments.build.resolve()
    program = build / "clerestory"
    rays = validation.rays_per_second(program)
    said = f"{rays:.1f} million incoherent shadow rays a CPU second" if rays else "an unknown number of rays"
    page = HEAD.format(date=datetime.date.today().isoformat(), rays=said)
    rows, unmet = run_scenes(program, arguments.repeat)
    results = run_tests(build / "tests" / "clerestory_validation_tests")
    page += SCENES.format(repeat=arguments.repeat) + rows
    page += CONVERGENCE + "".join(row for _, figures in results.values() for row in convergence_rows(figures))
    page += UNMET + (unmet + "".join(unmet_by_tests(results)) or "None.\n")
    page += CASES + "".join(case_rows(results))
    arguments.out.write_text(page)
    sys.exit(1 if any(result not in ("passes", "skipped") for result, _ in results.values()) else 0)


if __name__ == "__main__":
    main()
