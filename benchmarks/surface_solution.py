#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""How good the surface solution itself is, and what it costs: the floor of lamp-room in surfaces.vtp at several accuracies against the
program's own run at 0.05 %.

    benchmarks/surface_solution.py [--program build/release/clerestory] [--repeat 5]

The RMS is of the relative differences at points of the floor, spread evenly, between the two meshes' point data, linear in each triangle.
The solve phase is linking with the iterations in it; direct light is what finds out what matters to the sensors before."""
import argparse
import json
import math
import re
import statistics
import struct
import subprocess
import tempfile
import zlib
from pathlib import Path

import validation

REFERENCE = "0.05%"
ACCURACIES = ("10%", "5%", "3%", "2%", "1%", "0.5%", "0.3%")
PLACES = 40  # each way
ON_FLOOR_M = 1e-6
TYPES = {"Float32": "f", "Float64": "d", "Int64": "q"}


def values_of(vtp, section, name):
    """An array of a .vtp file with appended raw data in zlib blocks and 64-bit headers, as we write it."""
    head, data = vtp.split(b'<AppendedData encoding="raw">', 1)
    part = re.search(rb"<%b[ >].*?</%b>" % (section, section), head, re.DOTALL).group()
    tag = re.search(rb'<DataArray type="(\w+)" Name="%b"[^>]*offset="(\d+)"' % name, part)
    at = data.index(b"_") + 1 + int(tag.group(2))
    (blocks,) = struct.unpack_from("<Q", data, at)
    sizes = struct.unpack_from(f"<{blocks}Q", data, at + 24)
    at += 24 + 8 * blocks
    raw = b""
    for size in sizes:
        raw += zlib.decompress(data[at:at + size])
        at += size
    code = TYPES[tag.group(1).decode()]
    return struct.unpack(f"<{len(raw) // struct.calcsize(code)}{code}", raw)


def floor_triangles(vtp):
    """Of the floor's upper side: three corners (x, y) and their illuminances [lux] each; larger cells are cut into fans."""
    xyz = values_of(vtp, b"Points", b"Points")
    lux = values_of(vtp, b"PointData", b"illuminance_lux")
    normal = values_of(vtp, b"PointData", b"normal")
    corners = values_of(vtp, b"Polys", b"connectivity")
    begin = 0
    for end in values_of(vtp, b"Polys", b"offsets"):
        cell = corners[begin:end]
        begin = end
        if all(abs(xyz[3 * p + 2]) < ON_FLOOR_M and normal[3 * p + 2] > 0.5 for p in cell):
            for k in range(1, len(cell) - 1):
                yield [(xyz[3 * p], xyz[3 * p + 1], lux[p]) for p in (cell[0], cell[k], cell[k + 1])]


def floor_values(vtp, width, depth):
    """At PLACES x PLACES points."""
    found = [None] * PLACES**2
    for a, b, c in floor_triangles(vtp):
        twice = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
        if twice == 0.0:
            continue
        xs, ys = sorted(p[0] for p in (a, b, c)), sorted(p[1] for p in (a, b, c))
        for i in range(max(0, math.floor(xs[0] / width * PLACES - 0.5)), min(PLACES, math.ceil(xs[2] / width * PLACES + 0.5))):
            for j in range(max(0, math.floor(ys[0] / depth * PLACES - 0.5)), min(PLACES, math.ceil(ys[2] / depth * PLACES + 0.5))):
                x, y = (i + 0.5) * width / PLACES, (j + 0.5) * depth / PLACES
                v = ((x - a[0]) * (c[1] - a[1]) - (y - a[1]) * (c[0] - a[0])) / twice
                w = ((b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0])) / twice
                if min(v, w, 1.0 - v - w) >= -1e-9:
                    found[i * PLACES + j] = (1.0 - v - w) * a[2] + v * b[2] + w * c[2]
    return found


def extent(vtp):
    xyz = values_of(vtp, b"Points", b"Points")
    return max(xyz[0::3]), max(xyz[1::3])


def run(program, study, accuracy, folder):
    subprocess.run([program, "illuminance", study, "-o", folder, "--accuracy", accuracy, "--threads", "1", "--quiet"], check=True,
                   stdout=subprocess.DEVNULL)
    return json.loads((folder / "summary.json").read_text())["cpu_seconds"], (folder / "surfaces.vtp").read_bytes()


def rms(values, reference):
    pairs = [(v, r) for v, r in zip(values, reference) if v is not None and r is not None]
    return math.sqrt(statistics.fmean((v / r - 1.0) ** 2 for v, r in pairs)), len(pairs)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--program", type=Path, default=validation.ROOT / "build" / "release" / "clerestory")
    parser.add_argument("--repeat", type=int, default=5, metavar="N", help="runs an accuracy; the median time counts")
    arguments = parser.parse_args()
    program = arguments.program.resolve()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        study = folder / "lamp-room.toml"
        study.write_text(validation.study_text("lamp-room"))
        _, finest = run(program, study, REFERENCE, folder / "results")
        size = extent(finest)
        reference = floor_values(finest, *size)
        rays = validation.rays_per_second(program)
        print("rays a CPU second: " + (f"{rays:.1f} million" if rays else "unknown (build the target benchmarks)"))
        print("| accuracy asked | RMS of the floor | places | solve, CPU s | direct light, CPU s |\n|---|---|---|---|---|")
        for accuracy in ACCURACIES:
            runs = [run(program, study, accuracy, folder / "results") for _ in range(arguments.repeat)]
            error, places = rms(floor_values(runs[0][1], *size), reference)
            linking, direct = (statistics.median(cpu[phase] for cpu, _ in runs) for phase in ("linking", "direct light"))
            print(f"| {accuracy} | {100 * error:.2f} % | {places} | {linking:.3f} | {direct:.3f} |", flush=True)


if __name__ == "__main__":
    main()
