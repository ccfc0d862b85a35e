#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""How cost grows with the model: city blocks of furnished offices from a thousand to a million triangles, with sensors in one room, and one
building that is only tessellated finer.

    benchmarks/scaling.py [--program build/release/clerestory] [--most 1000000] [-o docs/scaling.md]

CPU seconds at one thread, daylight at 5 %; exponents are slopes of log-log fits. The solve is all that follows the clean-up: meshing to shadows."""
import argparse
import datetime
import json
import math
import subprocess
import sys
import tempfile
from pathlib import Path

import validation

SIZES = (1_000, 3_000, 10_000, 30_000, 100_000, 300_000, 1_000_000)
FINER = (1, 2, 3, 4)  # pieces of an edge: 8 k to 128 k triangles
BUILDING = 8_000
LONGEST_S = 1800
NOT_OF_THE_SOLVE = ("reading", "cleaning the model", "writing", "total")
STUDY = """[model]
file = "{model}"
units = "m"
[materials.glass]
glazing = {{ transmittance = 0.70 }}
[[grids]]
name = "workplane"
points = "{points}"
"""
PAGE = """# How cost grows with the model

City blocks of furnished offices (`benchmarks/city_block.py`), daylight at 5 % with 56 sensors in one room, at one thread. CPU seconds; the solve is all
that follows the clean-up, from meshing to the shadows on surfaces, without writing. This page is written by

    benchmarks/scaling.py

and was last written {date}, on a machine that did {rays} in that minute.
"""
TABLE = """
| triangles | clean-up s | solve s | whole run s | elements | links | rays | peak MB | accuracy reached |
|---|---|---|---|---|---|---|---|---|
"""


def exponent(x, y):
    """Slope of the line through (log x, log y)."""
    lx, ly = [math.log(v) for v in x], [math.log(v) for v in y]
    mx, my = sum(lx) / len(lx), sum(ly) / len(ly)
    return sum((a - mx) * (b - my) for a, b in zip(lx, ly)) / sum((a - mx) ** 2 for a in lx)


def write_sensors(path):
    """7 x 8 sensors above the desk's height, none inside of furniture or in the plane of one of its faces."""
    lines = (f"{0.75 + 0.45 * i} {0.55 + 0.5 * j} 0.8 0 0 1\n" for i in range(7) for j in range(8))
    path.write_text("".join(lines))


def tessellate(source, target, pieces):
    """Parts each triangle of an OBJ file into pieces² of its shape. New points are not shared: the clean-up welds them."""
    points, out = [], ["mtllib block.mtl\n"]
    count = 0
    for line in source.read_text().splitlines():
        words = line.split()
        if words[:1] == ["v"]:
            points.append([float(w) for w in words[1:]])
        elif words[:1] == ["f"]:
            a, b, c = (points[int(w) - 1] for w in words[1:])
            at = lambda i, j: [a[k] + (i * (b[k] - a[k]) + j * (c[k] - a[k])) / pieces for k in range(3)]
            for i in range(pieces):
                for j in range(pieces - i):
                    corners = [[at(i, j), at(i + 1, j), at(i, j + 1)]]
                    if i + j + 2 <= pieces:
                        corners.append([at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)])
                    for triangle in corners:
                        out += [f"v {x:.6f} {y:.6f} {z:.6f}\n" for x, y, z in triangle]
                        out.append("f -3 -2 -1\n")
                        count += 1
        elif words[:1] in (["g"], ["usemtl"]):
            out.append(line + "\n")
    target.write_text("".join(out))
    return count


def run(program, model, folder):
    study = folder / "block.toml"
    study.write_text(STUDY.format(model=model, points=folder / "sensors.pts"))
    results = folder / "results"
    done = subprocess.run([program, "daylight", study, "-o", results, "--accuracy", "5%", "--threads", "1", "--quiet"],
                          timeout=LONGEST_S, capture_output=True, text=True)
    if done.returncode not in (0, 4):
        sys.exit(f"{model}: exit status {done.returncode}\n{done.stderr}")
    return json.loads((results / "summary.json").read_text())


def row(triangles, summary):
    cpu, counts = summary["cpu_seconds"], summary["counts"]
    solve = sum(s for phase, s in cpu.items() if phase not in NOT_OF_THE_SOLVE)
    line = (f"| {triangles:,} | {cpu['cleaning the model']:.2f} | {solve:.2f} | {cpu['total']:.2f} | {counts['elements']:,} | "
            f"{counts['links']:,} | {counts['rays']:,} | {summary['peak_memory_mb']:.0f} | {100 * summary['accuracy']['reached']:.1f} % |")
    print(line, flush=True)
    return {"line": line, "triangles": triangles, "solve": solve, "elements": counts["elements"], "links": counts["links"]}


def table(rows):
    text = TABLE + "".join(r["line"] + "\n" for r in rows)
    if len(rows) > 1:
        column = lambda name: [r[name] for r in rows]
        text += f"\nThe solve grows with exponent {exponent(column('triangles'), column('solve')):.2f} in triangles"
        if len(set(column("elements"))) > 1 and rows[-1]["elements"] > 2 * rows[0]["elements"]:
            text += f", links with exponent {exponent(column('elements'), column('links')):.2f} in elements"
        text += ".\n"
    return text


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--program", type=Path, default=validation.ROOT / "build" / "release" / "clerestory")
    parser.add_argument("--most", type=int, default=SIZES[-1], metavar="N", help="triangles of the largest block")
    parser.add_argument("-o", "--out", type=Path, default=validation.ROOT / "docs" / "scaling.md")
    arguments = parser.parse_args()
    program = arguments.program.resolve()
    rays = validation.rays_per_second(program)
    text = PAGE.format(date=datetime.date.today(),
                       rays=f"{rays:.1f} million incoherent shadow rays a CPU second" if rays else "an unknown number of rays")
    generator = Path(__file__).with_name("city_block.py")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        write_sensors(folder / "sensors.pts")
        block = folder / "block.obj"
        generate = lambda n: subprocess.run([sys.executable, generator, str(n), "-o", block], check=True)
        blocks = []
        for size in (s for s in SIZES if s <= arguments.most):
            generate(size)
            blocks.append(row(size, run(program, block, folder)))
        text += table(blocks)
        if arguments.most < SIZES[-1]:
            text += f"\nLarger blocks, up to {SIZES[-1]:,} triangles, were left out of this run (`--most {arguments.most}`).\n"
        text += f"\n## One building, tessellated finer\n\nThe block of {BUILDING:,} triangles, each cut into 4, 9 and 16.\n"
        generate(BUILDING)
        finer = folder / "finer.obj"
        text += table([row(tessellate(block, finer, pieces), run(program, finer, folder)) for pieces in FINER])
    arguments.out.write_text(text)


if __name__ == "__main__":
    main()
