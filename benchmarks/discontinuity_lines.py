#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What shadow lines are worth: errors of surfaces.vtp near shadow edges against CPU time, with and without lines.

    benchmarks/discontinuity_lines.py [--program build/release/clerestory] [--samples 150] [--repeat 3] [--write docs]

Three scenes: samples/office, the reference scene `office`, and a room with a table below a lamp. Each is answered at several accuracies
with [mesh] discontinuities = "auto" and "off". Near lines that `clerestory mesh` finds (0.3 m), places are chosen at random, the same for all runs, evenly
by area; there what the corners of a run's cells give by interpolation is compared with sensors in one run of 0.2 %, which computes direct light at each
point. So are the values of cells near the lines, chosen by area, with the means of nine sensors spread over each.

Errors are shares of the illuminance, or of 5 % of the mean of all places where it is darker than that, as the accuracy has it. Prints a table; --write
puts table and plot into shadow-lines.md and .svg of that folder. Needs VTK's Python modules (python3-vtk9) and NumPy."""
import argparse
import csv
import subprocess
import tempfile
from pathlib import Path

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

import validation

ROOT = Path(__file__).resolve().parents[1]
NEAR_M = 0.3
CELL_CUTS = 3  # parts of a side
REFERENCE = "0.2%"
ACCURACIES = ["8%", "4%", "2%", "1%"]
PAGE = """# What shadow lines are worth

Errors of `surfaces.vtp` within 0.3 m of shadow edges against the CPU time of the whole run (one thread), with `[mesh] discontinuities = "auto"` and
`"off"`, at 8, 4, 2 and 1 % asked. At {places} places chosen at random, the same for all runs and evenly by area, what the points of `surfaces.vtp` give by
interpolation is compared with sensors in a run of 0.2 % asked, which computes direct light at each point; so are the values of {samples} cells of each run,
which are means, with nine sensors over each. Errors are shares of the illuminance
there, or of 5 % of the mean of all places where it is darker than that. Written by `benchmarks/discontinuity_lines.py`; how lines are found and
used stands in [theory/discontinuities.md](theory/discontinuities.md). Sensors are the same with lines and without, to the bit.

![Largest errors against CPU time](shadow-lines.svg)
"""
STUDY_OF_LAMP = """[model]
file = "blocked-lamp.obj"
units = "m"
[materials.floor]
reflectance = 0.2
[materials.ceiling]
reflectance = 0.7
[materials.wall]
reflectance = 0.5
[materials.wood]
reflectance = 0.4
[materials.lamp]
reflectance = 0.0
emission = { flux_lm = 4000.0 }
[sky]
type = "none"
[[grids]]
name = "workplane"
surface = "floor"
height = 0.8
"""
SIDES = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]


def box_obj(lines, first, name, materials, low, high, inward=False):
    """A box of six quads, fronts outward or inward; returns the number of the next vertex."""
    lines.append(f"o {name}")
    lines += ["v %g %g %g" % tuple((low, high)[i >> axis & 1][axis] for axis in range(3)) for i in range(8)]
    for side, material in zip(SIDES, materials):
        corners = side[::-1] if inward else side
        lines += [f"usemtl {material}", "f " + " ".join(str(first + c) for c in corners)]
    return first + 8


def write_lamp_room(folder):
    """A room of 5 × 4 × 2.8 m, a lamp of 1.2 × 0.3 m under its ceiling, and a table top below it."""
    lines = []
    first = box_obj(lines, 1, "room", ["floor", "ceiling"] + 4 * ["wall"], (0, 0, 0), (5, 4, 2.8), inward=True)
    first = box_obj(lines, first, "table", 6 * ["wood"], (2.2, 1.4, 0.72), (3.6, 2.2, 0.75))
    lines += ["o lamp", "usemtl lamp", "v 1.6 1.85 2.7", "v 1.6 2.15 2.7", "v 2.8 2.15 2.7", "v 2.8 1.85 2.7",
              f"f {first} {first + 1} {first + 2} {first + 3}"]
    (folder / "blocked-lamp.obj").write_text("\n".join(lines) + "\n")
    (folder / "blocked-lamp.toml").write_text(STUDY_OF_LAMP)
    return folder / "blocked-lamp.toml"


def read_polydata(file):
    """Points, cells as rows of point numbers, point data, cell data."""
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(str(file))
    reader.Update()
    data = reader.GetOutput()
    cells = data.GetPolys() if data.GetNumberOfPolys() else data.GetLines()
    rows = vtk_to_numpy(cells.GetConnectivityArray()).reshape(cells.GetNumberOfCells(), -1)
    arrays = [{of.GetArrayName(i): vtk_to_numpy(of.GetArray(i)) for i in range(of.GetNumberOfArrays())}
              for of in (data.GetPointData(), data.GetCellData())]
    return vtk_to_numpy(data.GetPoints().GetData()).astype(float), rows, *arrays


def run(program, subcommand, study, out, *options):
    command = [str(program), subcommand, str(study), "-o", str(out), "--threads", "1", "--quiet", *options]
    return validation.cpu_seconds(command)[0]


def distance_to_lines(points, normals, lines):
    """To the nearest of the lines that lie in the plane of each point [m]."""
    best = np.full(len(points), np.inf)
    for a, b in lines:
        along = b - a
        t = np.clip((points - a) @ along / (along @ along), 0, 1)
        distance = np.linalg.norm(points - a - t[:, None] * along, axis=1)
        in_plane = np.abs(((points - a) * normals).sum(axis=1)) < 1e-3
        best = np.where(in_plane, np.minimum(best, distance), best)
    return best


class Surfaces:
    """The triangles of a run's surfaces.vtp."""

    def __init__(self, folder):
        points, self.cells, point_data, cell_data = read_polydata(folder / "surfaces.vtp")
        self.triangles = points[self.cells]
        self.corner_values = point_data["illuminance_lux"][self.cells]
        self.values = cell_data["illuminance_lux"]
        normals = np.cross(self.triangles[:, 1] - self.triangles[:, 0], self.triangles[:, 2] - self.triangles[:, 0])
        self.areas = 0.5 * np.linalg.norm(normals, axis=1)
        self.normals = normals / np.linalg.norm(normals, axis=1)[:, None]

    def places_near(self, lines, count):
        """Places on the surfaces, evenly by area, that are near a line: rows of position and normal."""
        random = np.random.default_rng(1)
        found = []
        while sum(map(len, found)) < count:
            chosen = random.choice(len(self.areas), 20 * count, p=self.areas / self.areas.sum())
            s, t = random.random((2, len(chosen)))
            s, t = np.where(s + t > 1, 1 - s, s), np.where(s + t > 1, 1 - t, t)
            corners = self.triangles[chosen]
            at = corners[:, 0] + s[:, None] * (corners[:, 1] - corners[:, 0]) + t[:, None] * (corners[:, 2] - corners[:, 0])
            near = distance_to_lines(at, self.normals[chosen], lines) < NEAR_M
            found.append(np.hstack([at, self.normals[chosen]])[near])
        return np.vstack(found)[:count]

    def at(self, place):
        """The value at a place by interpolation between corners; NaN where no triangle holds it."""
        point, normal = place[:3], place[3:]
        shares = np.stack([((np.cross(self.triangles[:, (k + 2) % 3] - self.triangles[:, (k + 1) % 3],
                                      point - self.triangles[:, (k + 1) % 3])) * self.normals).sum(axis=1)
                           for k in range(3)], axis=1) / (2 * self.areas[:, None])
        height = np.abs(((point - self.triangles[:, 0]) * self.normals).sum(axis=1))
        inside = np.where((height < 1e-4) & (self.normals @ normal > 0.999), shares.min(axis=1), -1)
        best = int(inside.argmax())
        return float(shares[best] @ self.corner_values[best]) if inside[best] > -1e-3 else np.nan

    def cells_near(self, lines, count):
        """Cells near lines, chosen by area: their values, and sensors evenly over each."""
        distances = [distance_to_lines(p, self.normals, lines)
                     for p in (self.triangles.mean(axis=1), *(self.triangles[:, k] for k in range(3)))]
        near = np.flatnonzero(np.min(distances, axis=0) < NEAR_M)
        shares = self.areas[near] / self.areas[near].sum()
        chosen = np.random.default_rng(1).choice(near, min(count, len(near)), replace=False, p=shares)
        sensors = [np.hstack([inside(self.triangles[i]), np.tile(self.normals[i], (CELL_CUTS ** 2, 1))])
                   for i in chosen]
        return self.values[chosen], sensors


def inside(triangle):
    """The middles of the parts of a triangle that is cut evenly."""
    n = CELL_CUTS
    shares = [((x + 1 / 3) / n, (y + 1 / 3) / n) for x in range(n) for y in range(n - x)]
    shares += [((x + 2 / 3) / n, (y + 2 / 3) / n) for x in range(n) for y in range(n - x - 1)]
    return np.array([triangle[0] + s * (triangle[1] - triangle[0]) + t * (triangle[2] - triangle[0])
                     for s, t in shares])


def reference_of(program, subcommand, study, folder, sensors):
    """Illuminances of sensors by a run at the reference's accuracy; NaN for those left out."""
    points = folder / "reference.pts"
    points.write_text("".join("%.6f %.6f %.6f %.6f %.6f %.6f\n" % tuple(s) for s in sensors))
    text = study.read_text()
    start = text.index("[[grids]]")
    end = text.find("\n[", start + 3)
    text = text[:start] + (text[end:] if end > 0 else "")
    file = study.parent / "reference-of-shadow-lines.toml"
    file.write_text(text + f"\n[[grids]]\nname = \"reference\"\npoints = '{points}'\n")
    try:
        run(program, subcommand, file, folder / "reference", "--accuracy", REFERENCE, "--set", "mesh.discontinuities=off")
    finally:
        file.unlink()
    values = np.full(len(sensors), np.nan)
    with open(folder / "reference" / "reference.csv", newline="", encoding="utf-8") as lines:
        for row in csv.DictReader(lines):
            values[int(row["id"])] = float(row["illuminance_lux"])
    return values


def judge(program, subcommand, study, folder, count, repeat):
    """One row a run: asked, lines, CPU seconds, and largest and RMS errors of corners and cells."""
    folder.mkdir()
    run_mesh = [str(program), "mesh", str(study), "-o", str(folder / "lines"), "--lines"]
    subprocess.run(run_mesh, check=True, stdout=subprocess.DEVNULL)
    points, cells, _, _ = read_polydata(folder / "lines" / "discontinuities.vtp")
    lines = points[cells]
    runs = []
    for accuracy in ACCURACIES:
        for switch in ("off", "auto"):
            out = folder / f"{switch}-{accuracy}"
            options = ["--accuracy", accuracy, "--set", f"mesh.discontinuities={switch}"]
            cpu_s = sorted(run(program, subcommand, study, out, *options) for _ in range(repeat))[repeat // 2]
            runs.append((accuracy, switch, cpu_s, Surfaces(out)))
    places = runs[-1][3].places_near(lines, 10 * count)
    near = [surfaces.cells_near(lines, count) for _, _, _, surfaces in runs]
    sensors = np.vstack([places] + [s for _, of_run in near for s in of_run])
    reference = reference_of(program, subcommand, study, folder, sensors)
    dark = 0.05 * np.nanmean(reference[:len(places)])
    next_cell = len(places)
    rows = []
    for (accuracy, switch, cpu_s, surfaces), (values, _) in zip(runs, near):
        of_cells = reference[next_cell:next_cell + len(values) * CELL_CUTS ** 2].reshape(len(values), -1).mean(axis=1)
        next_cell += of_cells.size * CELL_CUTS ** 2
        rows.append({"accuracy": accuracy, "lines": switch, "cpu_s": cpu_s})
        at_places = np.array([surfaces.at(place) for place in places])
        for kind, value, true in (("point", at_places, reference[:len(places)]), ("cell", values, of_cells)):
            error = np.abs(value - true) / np.maximum(true, dark)
            error = error[np.isfinite(error)]
            rows[-1] |= {f"{kind}_max": error.max(), f"{kind}_p95": np.quantile(error, 0.95),
                         f"{kind}_rms": np.sqrt(np.mean(error ** 2))}
    return rows


def table(rows):
    text = ("| asked | lines | CPU time [s] | points: largest | 95 % below | RMS | cells: largest | 95 % below | RMS |\n"
            "|---|---|---|---|---|---|---|---|---|\n")
    for r in rows:
        figures = [f"{100 * r[f'{kind}_{what}']:.1f} %" for kind in ("point", "cell") for what in ("max", "p95", "rms")]
        text += f"| {r['accuracy'][:-1]} % | {r['lines']} | {r['cpu_s']:.2f} | " + " | ".join(figures) + " |\n"
    return text


def plot(results):
    """Largest errors against CPU time, both logarithmic: a panel a scene."""
    width, height, left, top = 300, 220, 62, 40
    svg = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{left + 3 * (width + 50)}" height="{top + height + 60}" '
           'font-family="sans-serif" font-size="12">', '<rect width="100%" height="100%" fill="white"/>']
    for panel, (scene, rows) in enumerate(results.items()):
        x0 = left + panel * (width + 50)
        times = np.log10([r["cpu_s"] for r in rows])
        low_t, high_t = times.min() - 0.1, times.max() + 0.1
        low_e, high_e = -2.0, 0.5  # shares: 1 % to 316 %
        place = lambda t, e: (x0 + width * (t - low_t) / (high_t - low_t),
                              top + height * (high_e - np.clip(np.log10(e), low_e, high_e)) / (high_e - low_e))
        svg.append(f'<text x="{x0}" y="{top - 14}" font-weight="bold">{scene}</text>')
        svg.append(f'<rect x="{x0}" y="{top}" width="{width}" height="{height}" fill="none" stroke="#888"/>')
        for percent in (1, 10, 100):
            y = place(low_t, percent / 100)[1]
            svg.append(f'<line x1="{x0}" x2="{x0 + width}" y1="{y:.1f}" y2="{y:.1f}" stroke="#ddd"/>')
            svg.append(f'<text x="{x0 - 6}" y="{y + 4:.1f}" text-anchor="end">{percent} %</text>')
        for seconds in (0.25, 0.5, 1, 2, 4, 8):
            if low_t < np.log10(seconds) < high_t:
                x = place(np.log10(seconds), 1)[0]
                svg.append(f'<text x="{x:.1f}" y="{top + height + 16}" text-anchor="middle">{seconds:g} s</text>')
        for lines, colour in (("off", "#c0392b"), ("auto", "#1a5fb4")):
            for kind, dash in (("point", ""), ("cell", ' stroke-dasharray="5 3"')):
                spots = [place(np.log10(r["cpu_s"]), r[f"{kind}_max"]) for r in rows if r["lines"] == lines]
                path = " ".join(f"{x:.1f},{y:.1f}" for x, y in spots)
                svg.append(f'<polyline points="{path}" fill="none" stroke="{colour}" stroke-width="2"{dash}/>')
    svg.append(f'<text x="{left}" y="{top + height + 44}">largest error near shadow edges against CPU time; '
               'red: without lines, blue: with; whole: points, dashed: cells</text></svg>')
    return "\n".join(svg) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", type=Path, default=ROOT / "build" / "release" / "clerestory")
    parser.add_argument("--samples", type=int, default=150, help="cells of each run that are compared; ten times as many places")
    parser.add_argument("--repeat", type=int, default=3, help="runs of which the median CPU time counts")
    parser.add_argument("--write", type=Path, help="folder for shadow-lines.md and .svg")
    options = parser.parse_args()
    program = options.program.resolve()
    results = {}
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch)
        for name in ("office.obj", "office.mtl", "office.toml"):
            (folder / name).write_bytes((ROOT / "samples" / "office" / name).read_bytes())
        scenes = {"samples/office": ("daylight", folder / "office.toml"),
                  "blocked lamp": ("illuminance", write_lamp_room(folder))}
        if (validation.VALIDATION / "office").is_dir():
            (folder / "reference-office.toml").write_text(validation.study_text("office"))
            scenes["reference office"] = ("daylight", folder / "reference-office.toml")
        for number, (scene, (subcommand, study)) in enumerate(scenes.items()):
            results[scene] = judge(program, subcommand, study, folder / str(number), options.samples,
                                   options.repeat)
            print(f"## {scene}\n\n{table(results[scene])}", flush=True)
    if options.write:
        tables = "\n".join(f"## {scene}\n\n{table(rows)}" for scene, rows in results.items())
        (options.write / "shadow-lines.md").write_text(PAGE.format(samples=options.samples, places=10 * options.samples) + "\n" + tables)
        (options.write / "shadow-lines.svg").write_text(plot(results))


if __name__ == "__main__":
    main()
