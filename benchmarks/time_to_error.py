#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Error against CPU time: answers the reference scenes at several accuracies, beside a path tracer's figures.

    benchmarks/time_to_error.py [--program build/release/clerestory] [--repeat 3] [--write docs] [SCENE ...]

Runs each scene as validation.py does (the whole command at one thread, the median CPU time of --repeat runs) and takes the RMS error at
the sensors from the comparison with the reference. The path tracer's figures are those that the README beside each scene states. Prints a
table; --write puts page, plot and figures into time-to-error.md, .svg and .json of that folder, where scenes not asked for keep the
figures that they have."""
import argparse
import datetime
import json
import math
import re
import sys
import tempfile
from pathlib import Path

import validation

ACCURACIES = {"lamp-room": [0.04, 0.02, 0.01, 0.005, 0.003, 0.001],
              "office": [0.08, 0.05, 0.03, 0.02, 0.01],
              "atrium": [0.1, 0.05, 0.03]}
PEER = re.compile(r"([\d.]+)(?: CPU)? s (?:→|for) ([\d.]+) %")
PAGE = """# Error against CPU time

The reference scenes at several accuracies: RMS error at the sensors against the CPU time of the whole command (one thread, user and system, start and
files included; median of {repeat} runs). The path tracer is the independent program that the references come from, at smaller sample counts,
and with its irradiance cache where figures for that are known, as the README beside each scene states them. The reference's own noise is in all errors (office:
1.13 %, atrium 0.98 %). Written by `benchmarks/time_to_error.py`; the figures are in [time-to-error.json](time-to-error.json).

![RMS error against CPU time](time-to-error.svg)
"""
WIDTH, HEIGHT, LEFT, TOP, GAP = 280, 260, 62, 40, 60  # of the plot's panels


def peer_figures(scene):
    """CPU seconds and RMS of the path tracer, and of it with its cache."""
    text = " ".join((validation.VALIDATION / scene / "README.md").read_text().split())
    plain, _, cached = text.partition("cache")
    return {name: [(float(s), round(float(rms) / 100, 6)) for s, rms in PEER.findall(part)]
            for name, part in (("path tracer", plain), ("path tracer with cache", cached))}


def measure(program, scene, repeat, folder):
    runs = []
    for accuracy in ACCURACIES[scene]:
        run = validation.run_scene(program, scene, repeat, folder, accuracy)
        rms = float(re.search(r"rms ([\d.]+) %", run.comparison)[1]) / 100
        covered = float(re.search(r"covered (\d+) %", run.comparison)[1]) / 100
        runs.append({"accuracy": accuracy, "cpu_s": run.cpu_s, "rms": rms, "covered": covered, "met": run.met})
        print(f"{scene:10} {100 * accuracy:5.2f} %{run.cpu_s:8.2f} s   rms {100 * rms:.2f} %", flush=True)
    rays = validation.rays_per_second(program)
    return {"runs": runs, "million_rays_per_cpu_second": rays, "repeat": repeat, "date": datetime.date.today().isoformat(),
            **peer_figures(scene)}


def table(scene, figures):
    rays = figures["million_rays_per_cpu_second"]
    said = f"{rays:.1f} million incoherent shadow rays a CPU second" if rays else "an unknown number of rays a CPU second"
    text = f"\n## {scene}\n\nMeasured {figures['date']}; the machine did {said} in that minute.\n\n"
    text += "| | asked | CPU s | RMS | within twice the stated error |\n|---|---|---|---|---|\n"
    for r in figures["runs"]:
        note = "" if r["met"] else " (not reached)"
        text += f"| Clerestory | {100 * r['accuracy']:g} %{note} | {r['cpu_s']:.2f} | {100 * r['rms']:.2f} % | {100 * r['covered']:.0f} % |\n"
    for name in ("path tracer", "path tracer with cache"):
        text += "".join(f"| {name} | | {s:g} | {100 * rms:g} % | |\n" for s, rms in figures[name])
    return text


def series_of(figures):
    """Name, colour, dash and points of what is drawn."""
    ours = [(r["cpu_s"], r["rms"]) for r in figures["runs"]]
    return [("Clerestory", "#1a5fb4", "", ours), ("path tracer", "#c0392b", "", figures["path tracer"]),
            ("path tracer with cache", "#c0392b", "5 3", figures["path tracer with cache"])]


def ticks(low, high):
    """1, 2 and 5 times powers of ten within bounds, which are logarithms."""
    values = [m * 10.0 ** e for e in range(math.floor(low), math.ceil(high) + 1) for m in (1, 2, 5)]
    return [v for v in values if low <= math.log10(v) <= high]


def panel(scene, figures, x0):
    series = series_of(figures)
    points = [(math.log10(s), math.log10(rms)) for *_, of in series for s, rms in of]
    low_t, high_t = min(t for t, _ in points) - 0.1, max(t for t, _ in points) + 0.1
    low_e, high_e = min(e for _, e in points) - 0.1, max(e for _, e in points) + 0.1
    x = lambda t: x0 + WIDTH * (t - low_t) / (high_t - low_t)
    y = lambda e: TOP + HEIGHT * (high_e - e) / (high_e - low_e)
    svg = [f'<text x="{x0}" y="{TOP - 14}" font-weight="bold">{scene}</text>',
           f'<rect x="{x0}" y="{TOP}" width="{WIDTH}" height="{HEIGHT}" fill="none" stroke="#888"/>']
    for seconds in ticks(low_t, high_t):
        at = x(math.log10(seconds))
        svg.append(f'<line x1="{at:.1f}" x2="{at:.1f}" y1="{TOP}" y2="{TOP + HEIGHT}" stroke="#eee"/>')
        if f"{seconds:e}"[0] != "5":  # as many labels as there is room for
            svg.append(f'<text x="{at:.1f}" y="{TOP + HEIGHT + 16}" text-anchor="middle">{seconds:g} s</text>')
    for rms in ticks(low_e, high_e):
        at = y(math.log10(rms))
        svg.append(f'<line x1="{x0}" x2="{x0 + WIDTH}" y1="{at:.1f}" y2="{at:.1f}" stroke="#eee"/>')
        svg.append(f'<text x="{x0 - 6}" y="{at + 4:.1f}" text-anchor="end">{100 * rms:g} %</text>')
    for _, colour, dash, of in series:
        spots = [(x(math.log10(s)), y(math.log10(rms))) for s, rms in of]
        path = " ".join(f"{a:.1f},{b:.1f}" for a, b in spots)
        svg.append(f'<polyline points="{path}" fill="none" stroke="{colour}" stroke-width="2" stroke-dasharray="{dash}"/>')
        svg += [f'<circle cx="{a:.1f}" cy="{b:.1f}" r="3" fill="{colour}"/>' for a, b in spots]
    return svg


def plot(scenes):
    """RMS against CPU time, both logarithmic: a panel a scene."""
    svg = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{LEFT + len(scenes) * (WIDTH + GAP)}" height="{TOP + HEIGHT + 60}" '
           'font-family="sans-serif" font-size="12">', '<rect width="100%" height="100%" fill="white"/>']
    for number, (scene, figures) in enumerate(scenes.items()):
        svg += panel(scene, figures, LEFT + number * (WIDTH + GAP))
    svg.append(f'<text x="{LEFT}" y="{TOP + HEIGHT + 44}">RMS error at the sensors against CPU time; blue: Clerestory, red: path tracer, '
               'dashed: with its cache</text></svg>')
    return "\n".join(svg) + "\n"


def write(folder, measured):
    file = folder / "time-to-error.json"
    known = json.loads(file.read_text()) if file.is_file() else {}
    scenes = {name: measured.get(name) or known[name] for name in ACCURACIES if name in measured or name in known}
    file.write_text(json.dumps(scenes, indent=1) + "\n")
    (folder / "time-to-error.svg").write_text(plot(scenes))
    repeats = sorted({figures["repeat"] for figures in scenes.values()})
    page = PAGE.format(repeat=" or ".join(map(str, repeats))) + "".join(table(name, of) for name, of in scenes.items())
    (folder / "time-to-error.md").write_text(page)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--program", type=Path, default=validation.ROOT / "build" / "release" / "clerestory")
    parser.add_argument("--repeat", type=int, default=3, metavar="N", help="runs an accuracy; the median time counts")
    parser.add_argument("--write", type=Path, metavar="DIR", help="folder for time-to-error.md, .svg and .json")
    parser.add_argument("scenes", nargs="*", metavar="SCENE", help=", ".join(ACCURACIES))
    arguments = parser.parse_args()
    unknown = [name for name in arguments.scenes if name not in ACCURACIES]
    if unknown:
        parser.error(f"no scene {unknown[0]}; there are {', '.join(ACCURACIES)}")
    if not validation.VALIDATION.is_dir():
        sys.exit(f"no reference scenes in {validation.VALIDATION}; set CLERESTORY_VALIDATION_DIR")
    measured = {}
    with tempfile.TemporaryDirectory() as folder:
        for name in arguments.scenes or ACCURACIES:
            measured[name] = measure(arguments.program.resolve(), name, arguments.repeat, Path(folder))
            print(table(name, measured[name]), flush=True)
    if arguments.write:
        write(arguments.write, measured)


if __name__ == "__main__":
    main()
