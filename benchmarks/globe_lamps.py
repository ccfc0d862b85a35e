#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes a room of 6 m x 5 m lit by four globes of 512 facets each, as a study: many small surfaces that shine."""
import argparse
import math
from pathlib import Path

WIDTH_M, DEPTH_M, HEIGHT_M = 6.0, 5.0, 2.8
GLOBES = [(x, y, 2.3) for x in (1.5, 4.5) for y in (1.5, 3.5)]
RADIUS_M = 0.15
MERIDIANS, PARALLELS = 32, 16
STUDY = """[model]
file = "globes.obj"
units = "m"

[materials.globe]
reflectance = 0.7
emission = { luminance_cd_m2 = 5000 }

[sky]
type = "none"

[[grids]]
name = "workplane"
surface = "floor"
height = 0.8
spacing = 0.25
"""


def box_room():
    """Material and corners of each polygon, fronts to the inside."""
    w, d, h = WIDTH_M, DEPTH_M, HEIGHT_M
    yield "floor", [(0, 0, 0), (w, 0, 0), (w, d, 0), (0, d, 0)]
    yield "ceiling", [(0, 0, h), (0, d, h), (w, d, h), (w, 0, h)]
    corners = [(0, 0), (w, 0), (w, d), (0, d)]
    for i, (x, y) in enumerate(corners):
        x2, y2 = corners[(i + 1) % 4]
        yield "wall", [(x, y, 0), (x, y, h), (x2, y2, h), (x2, y2, 0)]


def tables():
    for x, y in ((1.0, 1.0), (3.4, 3.0)):
        yield "desk", [(x, y, 0.75), (x + 1.6, y, 0.75), (x + 1.6, y + 0.8, 0.75), (x, y + 0.8, 0.75)]


def globe(centre):
    def at(meridian, parallel):
        polar = math.pi * parallel / PARALLELS
        azimuth = 2 * math.pi * (meridian % MERIDIANS) / MERIDIANS
        out = math.sin(polar) * math.cos(azimuth), math.sin(polar) * math.sin(azimuth), math.cos(polar)
        return tuple(c + RADIUS_M * o for c, o in zip(centre, out, strict=True))

    for p in range(PARALLELS):
        for m in range(MERIDIANS):
            corners = [at(m, p), at(m, p + 1), at(m + 1, p + 1), at(m + 1, p)]
            if p == 0:
                corners.pop()
            elif p == PARALLELS - 1:
                corners.pop(1)
            yield "globe", corners


def write(folder):
    """Writes globes.obj and globes.toml; gives the latter's path."""
    polygons = [*box_room(), *tables(), *(facet for centre in GLOBES for facet in globe(centre))]
    lines = []
    vertices = 0
    for material, corners in polygons:
        lines.append(f"usemtl {material}")
        lines += [f"v {x:.6f} {y:.6f} {z:.6f}" for x, y, z in corners]
        lines.append("f " + " ".join(str(vertices + i + 1) for i in range(len(corners))))
        vertices += len(corners)
    (folder / "globes.obj").write_text("\n".join(lines) + "\n")
    study = folder / "globes.toml"
    study.write_text(STUDY)
    return study


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path)
    arguments = parser.parse_args()
    arguments.folder.mkdir(parents=True, exist_ok=True)
    print(write(arguments.folder))


if __name__ == "__main__":
    main()
