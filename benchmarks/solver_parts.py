#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What each part of the solver saves: answers the reference scenes with one part after the other switched off.

    benchmarks/solver_parts.py [--program build/release/benchmarks/solver_parts] [--repeat 3] [-o docs/what-each-part-saves.md]

Needs the targets solver_parts and ray_order, rays_benchmark for the machine's rate, and the reference scenes (see validation.py)."""
import argparse
import csv
import datetime
import json
import math
import statistics
import subprocess
import tempfile
from pathlib import Path

import globe_lamps
import validation

SCENES = {"office": (0.02, 4), "atrium": (0.05, 0), "globes": (0.02, 0)}  # accuracy asked, and how often it is halved at most
FINE = 8  # times as exact is the run that stands for the reference where there is none
AS_GOOD = 1.1  # times the error that the run with all parts states
PARTS = {"all": "all of it", "clusters": "clusters", "importance": "importance", "proofs": "proven visibility"}
LONGEST_S = 900
PAGE = """# What each part of the solver saves

The reference scenes, and a room lit by four globes of 512 facets each (`benchmarks/globe_lamps.py`), each part switched off in turn, at one thread: CPU seconds of the run without what is shown of surfaces (medians of {repeat}), of
linking alone, rays, links, elements, the error that the run states, and the RMS of the sensors against the reference, of the globes against
a run at an eighth of the accuracy. This page is written by

    benchmarks/solver_parts.py

and was last written {date}, on a machine that did {rays} in that minute.

- Without **clusters** ([theory/hierarchy.md](theory/hierarchy.md)) links begin with all pairs of surfaces. Roots that look around by rays still do.
- Without **importance** all surfaces matter by their area, all together as much as they did with it. Such a run states a larger error; the row
  that follows asks for more until the error stated is as with it, or for a sixteenth of the error.
- Without **proven visibility** no shaft is tested: rays sample all pairs, and no link is mutual.

| scene, accuracy asked | without | CPU s | linking s | rays | links | elements | states | RMS |
|---|---|---|---|---|---|---|---|---|
"""
BUNDLES = """
## Rays in bundles

Rays are cast pair by pair, sensor by sensor and opening by opening, so that those that follow each other take the same way through the ray
tracer's tree. Here all rays of a run are recorded (`benchmarks/ray_order.cpp`) and cast once more by the same functions: in the order of the run, and
in random order. Bundles save what the tree's nodes cost to fetch: little where all of it is in the cache, as in the office, a third or more in the atrium.
Packets of eight (`rtcIntersect8`) were tried on the atrium at 3 % and left out: they took 10 % off the ray tracer's time in direct light and 3 % in gathering,
one or two per cent of the run; packets flagged as coherent took a fifth to a third more than single rays.

| scene, accuracy asked | phase | rays | in the order of the run s | in random order s | million a second in order |
|---|---|---|---|---|---|
"""


def study_of(scene, folder):
    """The path of a scene's study, and what is asked of it."""
    if scene == "globes":
        return globe_lamps.write(folder), "illuminance"
    study = folder / f"{scene}.toml"
    study.write_text(validation.study_text(scene))
    return study, validation.SCENES[scene][0]


def run(program, scene, accuracy, part, folder):
    study, kind = study_of(scene, folder)
    out = subprocess.run([program, study, kind, str(accuracy), part], check=True,
                         capture_output=True, text=True, timeout=LONGEST_S).stdout.splitlines()
    return json.loads(out[0]), [float(line) for line in out[1:]]


def reference_of(program, scene, folder):
    """Illuminance of each sensor [lx]."""
    if scene not in validation.SCENES:
        return run(program, scene, SCENES[scene][0] / FINE, "all", folder)[1]
    with open(validation.VALIDATION / scene / "reference.csv", newline="") as file:
        return [float(row["illuminance_lux"]) for row in csv.DictReader(file)]


def rms(reference, sensors):
    return math.sqrt(statistics.fmean((e / r - 1) ** 2 for e, r in zip(sensors, reference, strict=True)))


def row(program, scene, accuracy, part, repeat, reference, folder):
    """A line of the table, and the error that the run states; none where it takes too long."""
    words = "–" if part == "all" else PARTS[part]
    try:
        runs = [run(program, scene, accuracy, part, folder) for _ in range(repeat)]
    except subprocess.TimeoutExpired:
        return f"| {scene}, {100 * accuracy:g} % | {words} | over {LONGEST_S} | | | | | | |", None
    figures, sensors = runs[0]
    cpu = statistics.median(f["cpu_s"] for f, _ in runs)
    linking = statistics.median(f["linking_s"] for f, _ in runs)
    return (f"| {scene}, {100 * accuracy:g} % | {words} | {cpu:.2f} | {linking:.2f} | {figures['rays']:,} | {figures['links']:,} | "
            f"{figures['elements']:,} | {100 * figures['reached']:.2f} % | {100 * rms(reference, sensors):.2f} % |"), figures["reached"]


def rows(program, scene, repeat, folder):
    accuracy, most_halvings = SCENES[scene]
    reference = reference_of(program, scene, folder)
    goal = None
    for part in PARTS:
        line, reached = row(program, scene, accuracy, part, repeat, reference, folder)
        yield line
        goal = goal or AS_GOOD * reached
        for halving in range(1, most_halvings + 1):
            if reached is None or reached <= goal:
                break
            line, reached = row(program, scene, accuracy / 2**halving, part, 1, reference, folder)
            if reached is None or reached <= goal or halving == most_halvings:
                yield line


def bundles(program, scene, folder):
    """How long the rays of a run take in the order in which it casts them, and in another."""
    study, kind = study_of(scene, folder)
    accuracy = SCENES[scene][0]
    out = subprocess.run([program, study, kind, str(accuracy)], check=True, capture_output=True, text=True).stdout
    for phase in map(json.loads, out.splitlines()):
        if phase["phase"] in ("direct light", "linking", "gathering"):
            yield (f"| {scene}, {100 * accuracy:g} % | {phase['phase']} | {phase['rays']:,} | {phase['in_order_s']:.2f} | "
                   f"{phase['shuffled_s']:.2f} | {phase['rays'] / phase['in_order_s'] / 1e6:.1f} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    default = validation.ROOT / "build" / "release" / "benchmarks" / "solver_parts"
    parser.add_argument("--program", type=Path, default=default)
    parser.add_argument("--repeat", type=int, default=3, metavar="N", help="runs a row; the median time counts")
    parser.add_argument("-o", "--out", type=Path, default=validation.ROOT / "docs" / "what-each-part-saves.md")
    arguments = parser.parse_args()
    program = arguments.program.resolve()
    rays = validation.rays_per_second(program.parents[1] / "clerestory")
    text = PAGE.format(repeat=arguments.repeat, date=datetime.date.today(),
                       rays=f"{rays:.1f} million incoherent shadow rays a CPU second" if rays else "an unknown number of rays")
    with tempfile.TemporaryDirectory() as folder:
        for scene in SCENES:
            for line in rows(program, scene, arguments.repeat, Path(folder)):
                print(line, flush=True)
                text += line + "\n"
        text += BUNDLES
        for scene in SCENES:
            text += "".join(line + "\n" for line in bundles(program.with_name("ray_order"), scene, Path(folder)))
    arguments.out.write_text(text)


if __name__ == "__main__":
    main()
