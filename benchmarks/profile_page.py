#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Where the CPU time of a run goes: the reference scene `office` at 2 % under perf, by library and by function.

    benchmarks/profile_page.py [--program build/release/clerestory] [-o docs/profile.md]

Needs perf (Debian: linux-perf) and the reference scenes (see validation.py). One thread; rays by phase are those of the run's own summary."""
import argparse
import datetime
import json
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import validation

SCENE, ACCURACY = "office", 0.02
FREQUENCY_HZ = 1999
LEAST_SHARE = 0.7  # per cent, of a function in the table
PAGE = """# Where the time goes

The reference scene `{scene}` at {accuracy:g} %, the whole command at one thread, sampled {frequency} times a CPU second by perf ({samples} samples: a share of 5 % is
good to {noise:.1f} %). This page is written by

    benchmarks/profile_page.py

and was last written {date}, on a machine that did {rays} in that minute.
"""
RAYS = """
## Rays

As the run's own `summary.json` tells them. `solve` is direct light and linking; the share of time is about what is spent in the ray tracer, which
by itself does so many rays a second as the last column says: the rest of a phase's time is what chooses rays and what is made of them.

| phase | CPU s | rays | million a CPU second | share of time in the ray tracer | million a second there |
|---|---|---|---|---|---|
"""
LIBRARIES = """
## By library

| library | share of CPU time |
|---|---|
"""
FUNCTIONS = """
## By function

Each by its own instructions, without what it calls; inlined functions count to those that they are inlined in. Functions of libraries without
symbols stand in the table of libraries alone.

| function | library | share of CPU time |
|---|---|---|
"""


def report(data, fields):
    """Rows of a perf report: share [%], then the fields."""
    out = subprocess.run(["perf", "report", "-i", data, "--stdio", "-t", "|", "--sort", fields], check=True,
                         stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True).stdout
    for line in out.splitlines():
        if found := re.match(r"\s*([\d.]+)%\s*\|(.*)", line):
            yield float(found[1]), [field.strip() for field in found[2].split("|")]


def readable(symbol):
    """A function without its arguments, templates and anonymous namespaces."""
    name = re.sub(r"^\[[.k]\] ", "", symbol).replace("(anonymous namespace)::", "").replace("clerestory::", "")
    while (shorter := re.sub(r"<[^<>]*>", "", name)) != name:
        name = shorter
    return re.sub(r"\(.*", "", name) or symbol


def profile(program, folder):
    study = folder / f"{SCENE}.toml"
    study.write_text(validation.study_text(SCENE))
    data = folder / "perf.data"
    command = [program, validation.SCENES[SCENE][0], study, "-o", folder / "results", "--accuracy", str(ACCURACY), "--threads", "1", "--quiet"]
    subprocess.run(["perf", "record", "-q", "-F", str(FREQUENCY_HZ), "-o", data, *command], check=True)
    return data, json.loads((folder / "results" / "summary.json").read_text())


def ray_rows(summary):
    cpu = summary["cpu_seconds"]
    for phase, r in summary["rays"].items():
        seconds = cpu["direct light"] + cpu["linking"] if phase == "solve" else cpu[phase]
        alone = f"{r['per_cpu_second'] / r['share_of_time'] / 1e6:.1f}" if r["share_of_time"] > 0 else ""
        yield (f"| {phase} | {seconds:.2f} | {r['count']:,} | {r['per_cpu_second'] / 1e6:.1f} | "
               f"{100 * r['share_of_time']:.0f} % | {alone} |\n")


def page(data, summary, rays):
    samples = round(summary["cpu_seconds"]["total"] * FREQUENCY_HZ)
    said = f"{rays:.1f} million incoherent shadow rays a CPU second" if rays else "an unknown number of rays"
    text = PAGE.format(scene=SCENE, accuracy=100 * ACCURACY, frequency=FREQUENCY_HZ, samples=samples,
                       noise=100 * (0.05 * 0.95 / samples) ** 0.5, date=datetime.date.today().isoformat(), rays=said)
    text += RAYS + "".join(ray_rows(summary))
    text += LIBRARIES + "".join(f"| {name} | {share:.1f} % |\n" for share, (name, *_) in report(data, "dso") if share >= LEAST_SHARE)
    functions = [(share, of) for share, of in report(data, "dso,symbol") if share >= LEAST_SHARE and " 0x" not in of[1]]
    return text + FUNCTIONS + "".join(f"| `{readable(of[1])}` | {of[0]} | {share:.1f} % |\n" for share, of in functions)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--program", type=Path, default=validation.ROOT / "build" / "release" / "clerestory")
    parser.add_argument("-o", "--out", type=Path, default=validation.ROOT / "docs" / "profile.md")
    arguments = parser.parse_args()
    if not validation.VALIDATION.is_dir():
        sys.exit(f"no reference scenes in {validation.VALIDATION}; set CLERESTORY_VALIDATION_DIR")
    program = arguments.program.resolve()
    rays = validation.rays_per_second(program)
    with tempfile.TemporaryDirectory() as folder:
        arguments.out.write_text(page(*profile(program, Path(folder)), rays))


if __name__ == "__main__":
    main()
